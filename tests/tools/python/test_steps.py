import gc
import os
import signal
import threading
import unittest

import numpy as np

import articular
from support import InFolder, block, lever


class Views(InFolder):
    def test_arrays_of_a_model_are_no_copies_and_can_not_be_written(self):
        body = articular.Model(block()).bodies["block"]
        for name in ["positions", "tetrahedra"]:
            a, b = getattr(body, name), getattr(body, name)
            self.assertEqual(a.__array_interface__["data"], b.__array_interface__["data"])
            self.assertFalse(a.flags.writeable)
            with self.assertRaises(ValueError):
                a.setflags(write=True)
        self.assertEqual((body.positions.shape, body.tetrahedra.shape), ((27, 3), (48, 4)))

    def test_views_of_a_simulation_stay_in_place_and_show_what_is_now(self):
        steps = articular.Model(block()).steps()
        x, v = steps.positions("block"), steps.velocities("block")
        elastic, contact = steps.elastic_forces("block"), steps.contact_forces("block")
        start, kept = x.__array_interface__["data"], np.array(x)
        for step in steps:
            self.assertEqual(step.positions("block").__array_interface__["data"], start)
        self.assertGreater(np.abs(x - kept).max(), 1e-5)
        self.assertGreater(np.abs(v).max(), 0)
        self.assertGreater(np.abs(elastic).max(), 0)
        self.assertLess(contact[:, 2].sum(), 0)  # the plate presses it down
        with self.assertRaises(ValueError):
            x[0, 0] = 0

    def test_views_keep_what_they_show_alive(self):
        model = articular.Model(block())
        steps = model.steps()
        steps.advance()
        views = [steps.positions("block"), model.bodies["block"].tetrahedra,
                 model.bodies["block"].positions]
        before = [view.copy() for view in views]
        muscle = articular.Model(lever()).steps().muscles["flexor"]
        del steps, model
        gc.collect()
        waste = [np.full((27, 3), 7.0) for _ in range(1000)]
        for view, copy in zip(views, before):
            np.testing.assert_array_equal(view, copy)
        self.assertAlmostEqual(muscle.length, 0.29)
        del waste

    def test_positions_are_those_of_the_frames(self):
        steps = articular.Model(block()).steps()
        for step in steps:
            pass
        frame = articular.run(block(), "out").frames[-1]
        for body in ["block", "plate"]:
            np.testing.assert_allclose(
                1e3 * steps.positions(body), frame.mesh(body).points, rtol=1e-6, atol=1e-9
            )

    def test_elastic_and_contact_forces_balance_on_the_tissue_at_equilibrium(self):
        scenario = block(analysis="static", duration="0.4 s", **{"integrator.step": "0.1 s"})
        for step in articular.Model(scenario).steps():
            pass
        x = step.positions("block")
        free = articular.Model(scenario).bodies["block"].positions[:, 2] > 1e-4  # not attached
        residual = (step.contact_forces("block") - step.elastic_forces("block"))[free]
        scale = np.abs(step.elastic_forces("block")).max()
        self.assertLess(np.abs(residual).max(), 1e-4 * scale)
        self.assertEqual(len(x), 27)


class Sheets(InFolder):
    def test_stretch_and_pull_of_a_sheet_are_those_of_its_probe(self):
        scenario = articular.Scenario(
            "verification/pennate_muscle", set={"duration": "0.4 s", "integrator.step": "0.2 s"}
        )
        model = articular.Model(scenario)
        self.assertEqual(model.sheets, ["upper", "lower"])
        for step in model.steps():
            pass
        sheet = step.sheets["upper"]
        self.assertEqual((sheet.name, sheet.body), ("upper", "muscle"))
        stretches, tensions, areas = sheet.stretches, sheet.tensions, sheet.areas
        # 60 of its 88 mm, 10 mm wide, on its upper side.
        self.assertAlmostEqual(areas.sum(), 60e-3 * 10e-3, places=9)
        corners = model.bodies["muscle"].positions[sheet.faces]
        edges = corners[:, 1:] - corners[:, :1]
        sizes = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
        np.testing.assert_allclose(areas, sizes, rtol=1e-9)
        probes = step.probes
        np.testing.assert_allclose(
            [np.average(stretches, weights=areas), stretches.max(), tensions.max()],
            [probes[f"upper.{what}"] for what in ["stretch [-]", "largest_stretch [-]", "largest_tension [N/m]"]],
            rtol=1e-12,
        )
        self.assertGreater(tensions.max(), 100)


class Contacts(InFolder):
    def test_contacts_have_the_force_of_the_history(self):
        for step in articular.Model(block()).steps():
            pass
        (contact,) = step.contacts
        self.assertEqual({contact.a, contact.b}, {"plate", "block"})
        sign = 1 if contact.a == "plate" else -1
        self.assertAlmostEqual(sign * contact.force[2], step.probes["plate.force.z [N]"])
        (pairs,) = step.contact_pairs
        self.assertEqual({pairs.triangle_body, pairs.face_body}, {"plate", "block"})
        self.assertEqual(pairs.pairs.shape[1], 2)
        self.assertGreater(len(pairs.pairs), 0)


class Muscles(InFolder):
    def test_an_excitation_that_is_set_drives_the_muscle(self):
        steps = articular.Model(lever()).steps()
        muscle = steps.muscles["flexor"]
        self.assertEqual((muscle.excitation, muscle.activation), (0, 0))
        steps.advance()
        muscle.excitation = 0.5
        start, time = muscle.activation, steps.time
        for step in steps:
            pass
        # first order with the time constant of activation, 15 ms: a' = (u - a) / tau
        expected = 0.5 + (start - 0.5) * np.exp(-(steps.time - time) / 0.015)
        self.assertAlmostEqual(muscle.activation, expected, places=3)
        self.assertGreater(muscle.force, 10)

    def test_a_constant_excitation_is_that_of_the_scenario(self):
        excitation = '{time = ["0 s", "1 s"], value = [0.3, 0.3]}'
        driven = articular.Model(lever(**{"muscle.flexor.excitation": excitation})).steps()
        mine = articular.Model(lever()).steps()
        mine.muscles["flexor"].excitation = mine.muscles["flexor"].activation = 0.3
        self.assertEqual(mine.muscles["flexor"].activation, 0.3)
        while driven.advance() and mine.advance():
            self.assertEqual(driven.probes, mine.probes)
        self.assertTrue(driven.is_done and not mine.advance())

    def test_in_statics_the_excitation_is_the_activation_of_the_next_load_step(self):
        # The block of muscle pulls with its active stress, 0.3 MPa on 1 cm2, by the activation.
        steps = articular.Model(articular.Scenario("verification/muscle_block", set={
            "analysis": "static", "integrator.step": "0.1 s", "body.muscle.geometry.box.cells": [2, 2, 4],
        })).steps()
        muscle = steps.muscles["fibres"]
        for excitation in [0.5, 0.2]:
            muscle.excitation = excitation
            steps.advance()
            self.assertEqual(muscle.activation, excitation)
            self.assertAlmostEqual(steps.probes["pull.force.z [N]"], -30 * excitation, places=6)
        with self.assertRaisesRegex(ValueError, "static"):
            muscle.activation = 0.1
        with self.assertRaisesRegex(articular.InputError, "fibres"):
            print(muscle.length)

    def test_two_simulations_of_a_model_have_excitations_of_their_own(self):
        model = articular.Model(lever())
        a, b = model.steps(), model.steps()
        a.muscles["flexor"].excitation = 1.0
        self.assertEqual(b.muscles["flexor"].excitation, 0)

    def test_values_that_no_muscle_can_have_are_refused(self):
        muscle = articular.Model(lever()).steps().muscles["flexor"]
        for value in [-0.1, 1.1, float("nan")]:
            with self.assertRaisesRegex(ValueError, "expected 0 to 1"):
                muscle.excitation = value
            with self.assertRaisesRegex(ValueError, "expected 0 to 1"):
                muscle.activation = value
        with self.assertRaises(TypeError):
            muscle.excitation = "much"


class Interruption(InFolder):
    def test_ctrl_c_within_a_step_leaves_the_simulation_where_the_step_began(self):
        scenario = block(analysis="static", duration="0.4 s", **{
            "integrator.step": "0.4 s", "body.block.geometry.box.cells": [10, 10, 10]})
        steps = articular.Model(scenario).steps()
        timer = threading.Timer(0.15, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            steps.advance()
        self.assertEqual(steps.time, 0)
        while steps.advance():
            pass
        alone = articular.Model(scenario).steps()
        while alone.advance():
            pass
        self.assertEqual(steps.probes, alone.probes)


class Misuse(InFolder):
    def test_names_that_there_are_not(self):
        steps = articular.Model(block()).steps()
        with self.assertRaisesRegex(articular.InputError, "no body `blok`; did you mean `block`"):
            steps.positions("blok")
        with self.assertRaisesRegex(articular.InputError, "is a bone"):
            steps.elastic_forces("plate")
        with self.assertRaisesRegex(articular.InputError, "is a tissue"):
            steps.pose("block")
        with self.assertRaises(TypeError):
            articular.Model("block.toml")

    def test_after_the_end_there_is_no_step(self):
        steps = articular.Model(lever()).steps()
        count = sum(1 for _ in steps)
        self.assertEqual(count, 50)
        self.assertTrue(steps.is_done)
        self.assertFalse(steps.advance())
        self.assertEqual(list(steps), [])
        self.assertEqual(steps.time, 0.1)

    def test_a_simulation_that_computes_answers_no_other_thread(self):
        scenario = block(**{"body.block.geometry.box.cells": [12, 12, 12]})
        steps = articular.Model(scenario).steps()
        worker = threading.Thread(target=lambda: [steps.advance() for _ in range(3)])
        worker.start()
        refused = 0
        while worker.is_alive():
            try:
                steps.probes
            except RuntimeError:
                refused += 1
        worker.join()
        self.assertGreater(refused, 0)


if __name__ == "__main__":
    unittest.main()
