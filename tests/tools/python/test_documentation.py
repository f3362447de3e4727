import ast
import doctest
import inspect
import subprocess
import sys
import unittest

import articular
from articular import _core, collision, fem, results
from support import EXAMPLES, SOURCES, InFolder

PACKAGE = SOURCES / "tools/python/articular"


def check_against(stub, module, path=()):
    """Names of a stub that the module does not have, and the reverse."""
    faults = []
    declared = set()
    for node in stub.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            declared.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            declared.add(node.target.id)
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not hasattr(module, node.name):
            faults.append(f"{'.'.join(path)}.{node.name} is not there")
        elif isinstance(node, ast.ClassDef):
            faults += check_against(node, getattr(module, node.name), (*path, node.name))
    if not (inspect.isclass(module) and issubclass(module, Exception)):
        own = {name for name in vars(module) if not name.startswith("_")}
        kept = {"collision", "fem"} if inspect.ismodule(module) else set()
        faults += [f"{'.'.join(path)}.{name} has no types" for name in own - declared - kept]
    return faults


class Documentation(InFolder):
    def test_examples_in_docstrings_and_readme_give_what_they_say(self):
        names = {name: getattr(articular, name) for name in articular.__all__}
        tried = 0
        for module in [articular, _core, results, collision, fem]:
            found = doctest.testmod(module, extraglobs=names)
            self.assertEqual(found.failed, 0, module.__name__)
            tried += found.attempted
        readme = doctest.testfile(
            str(SOURCES / "tools/python/README.md"), module_relative=False, globs=names
        )
        self.assertEqual(readme.failed, 0)
        self.assertGreater(tried, 20)
        self.assertGreater(readme.attempted, 20)

    def test_stubs_name_what_there_is(self):
        for name, module in [("__init__", _core), ("collision", _core.collision), ("fem", _core.fem)]:
            stub = ast.parse((PACKAGE / f"_core/{name}.pyi").read_text())
            self.assertEqual(check_against(stub, module), [])

    def test_all_that_is_public_has_words(self):
        silent = []
        for name in articular.__all__:
            thing = getattr(articular, name)
            if inspect.isclass(thing) and issubclass(thing, Exception):
                continue
            members = [(name, thing)]
            if inspect.isclass(thing):
                members += [(f"{name}.{key}", value) for key, value in vars(thing).items()
                            if not key.startswith("_") and not isinstance(value, str)
                            and (callable(value) or isinstance(value, property))]
            silent += [key for key, value in members if not inspect.getdoc(value)]
        self.assertEqual(silent, [])


class Examples(InFolder):
    def run_example(self, name, *more):
        return subprocess.run(
            [sys.executable, str(EXAMPLES / f"{name}.py"), "--short", "--out", "out", *more],
            check=True, capture_output=True, text=True,
        ).stdout

    def number_behind(self, words, text):
        return float(text.split(words)[1].split()[0].rstrip("."))

    def test_the_sweep_finds_a_force_in_proportion_to_the_stiffness(self):
        self.run_example("sweep")
        rows = (self.folder / "out/forces.csv").read_text().splitlines()[1:]
        ratios = [float(row.split(",")[1]) / float(row.split(",")[0]) for row in rows]
        self.assertEqual(len(ratios), 5)
        self.assertLess(max(ratios) / min(ratios), 1.01)

    def test_the_calibration_finds_the_stiffness_of_a_known_block(self):
        force = articular.run(
            articular.Scenario(EXAMPLES / "block.toml", set={
                "body.block.geometry.box.cells": [2, 2, 2],
                "body.block.material.young_modulus": "14 kPa"}), "known")["plate.force.z"][-1]
        text = self.run_example("calibration", "--force", str(abs(force)))
        self.assertAlmostEqual(self.number_behind("has E = ", text), 14, delta=0.05)

    def test_the_controller_reaches_its_target(self):
        text = self.run_example("controller")
        self.assertAlmostEqual(self.number_behind("is at ", text), 60, delta=2)

    def test_the_own_law_lifts_the_arm(self):
        text = self.run_example("own_muscle_law")
        self.assertGreater(self.number_behind("forearm to ", text), 10)

    def test_the_pressure_map_sums_to_the_force(self):
        text = self.run_example("pressure_map")
        self.assertGreater(self.number_behind("highest pressure: ", text), 1)
        header, *rows = (self.folder / "out/pressure.csv").read_text().splitlines()
        self.assertEqual(header, "x [mm],y [mm],pressure [Pa]")
        self.assertEqual(len(rows), 49)

    def test_results_are_read(self):
        text = self.run_example("reading_results")
        self.assertIn("block: finished", text)
        self.assertIn("27 points, 48 tetrahedra", text)


if __name__ == "__main__":
    unittest.main()
