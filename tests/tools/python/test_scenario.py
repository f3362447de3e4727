import pickle
import subprocess
import unittest

import numpy as np

import articular
from support import EXAMPLES, PROGRAM, InFolder, block


class Scenario(InFolder):
    def test_errors_have_the_text_that_the_program_prints(self):
        bad = self.folder / "bad.toml"
        bad.write_text((EXAMPLES / "block.toml").read_text().replace('"15 kPa"', '"15 kg"') + "\nx = 1\n")
        printed = subprocess.run(
            [PROGRAM, "check", str(bad)], capture_output=True, text=True, check=False
        ).stderr
        with self.assertRaises(articular.InputError) as raised:
            articular.Scenario(bad)
        lines = str(raised.exception).splitlines()
        self.assertGreater(len(lines), 0)
        for line in lines:
            self.assertIn(line, printed)
        self.assertTrue(lines[0].startswith(f"{bad}:"))

    def test_an_unknown_name_suggests_the_nearest(self):
        with self.assertRaisesRegex(articular.InputError, "did you mean `mandible/opening`"):
            articular.Scenario("mandible/openin")

    def test_a_wrong_value_leaves_the_scenario_as_it_was(self):
        scenario = block()
        with self.assertRaises(articular.InputError):
            scenario.set("duration", "-1 s")
        self.assertEqual(scenario.duration, 0.1)
        self.assertEqual(len(scenario.overrides), 2)
        scenario.set("duration", "0.2 s")
        self.assertEqual(scenario.duration, 0.2)

    def test_values_of_python_and_numpy_are_those_of_toml(self):
        scenario = block()
        for key, value, text in [
            ("body.block.geometry.box.cells", (3, 3, 3), "[3, 3, 3]"),
            ("body.block.geometry.box.cells", np.array([3, 3, 3]), "[3, 3, 3]"),
            ("contact", False, "false"),
            ("body.block.material.poisson_ratio", np.float64(0.25), "0.25"),
            ("body.block.material.poisson_ratio", 0, "0"),
            ("load.0.translation", ["0 0 0 mm", "0 0 -1 mm"], '["0 0 0 mm", "0 0 -1 mm"]'),
            (
                "body.block.material",
                {"law": "linear", "young_modulus": "1 kPa", "poisson_ratio": 0.3},
                '{"law" = "linear", "young_modulus" = "1 kPa", "poisson_ratio" = 0.3}',
            ),
        ]:
            with self.subTest(key=key, value=value):
                scenario.set(key, value)
                self.assertEqual(scenario.overrides[-1], f"{key}={text}")

    def test_what_is_no_value_of_a_scenario_is_a_type_error(self):
        for value in [object(), None, 1j, {1: 2}]:
            with self.subTest(value=value), self.assertRaises(TypeError):
                block().set("duration", value)
        with self.assertRaises(TypeError):
            articular.Scenario(EXAMPLES / "block.toml", set="duration=1 s")
        with self.assertRaises(ValueError):
            articular.Scenario(EXAMPLES / "block.toml", threads=0)

    def test_a_scenario_goes_to_another_process(self):
        scenario = block()
        scenario.threads = 2
        copy = pickle.loads(pickle.dumps(scenario))
        self.assertEqual((copy.file, copy.overrides, copy.threads, copy.duration),
                         (scenario.file, scenario.overrides, 2, 0.1))

    def test_shipped_scenarios_are_found_and_built(self):
        names = [name for name, kind, title in articular.scenarios()]
        self.assertIn("mandible/opening", names)
        model = articular.Model(articular.Scenario("verification/many_parts"))
        self.assertGreater(len(model.bodies), 1)


if __name__ == "__main__":
    unittest.main()
