import filecmp
import os
import signal
import subprocess
import threading
import time
import unittest
import warnings

import numpy as np

import articular
from support import PROGRAM, InFolder, block, lever


def run_program(scenario, out, *more):
    settings = [word for text in scenario.overrides for word in ("--set", text)]
    subprocess.run(
        [PROGRAM, "run", str(scenario.file), "--out", out, "--quiet", *settings, *more],
        check=True,
        capture_output=True,
    )


class Run(InFolder):
    def assert_same_results(self, a, b):
        files = ["history.csv"] + [f"frames/{name}" for name in os.listdir(f"{a}/frames")]
        self.assertGreater(len(files), 2)
        same, other, missing = filecmp.cmpfiles(a, b, files, shallow=False)
        self.assertEqual((other, missing), ([], []))

    def test_results_are_those_of_the_program_bit_for_bit(self):
        for name, scenario in [
            ("dynamic", block()),
            ("static", block(analysis="static", duration="0.4 s", **{"integrator.step": "0.1 s"})),
        ]:
            with self.subTest(name):
                run_program(scenario, f"program_{name}")
                articular.run(scenario, name)
                self.assert_same_results(f"program_{name}", name)

    def test_steps_are_those_of_a_run_past_checkpoints_too(self):
        scenario = block(**{"output.checkpoint_interval": "20 ms"})
        results = articular.run(scenario, "run")
        rows = [list(step.probes.values()) for step in articular.Model(scenario).steps()]
        written = np.loadtxt("run/history.csv", delimiter=",", skiprows=2,
                             converters=lambda cell: float(cell or "nan"), encoding=None)
        self.assertEqual(len(rows), len(written))
        np.testing.assert_allclose(rows, written, rtol=1e-8, atol=1e-12)
        self.assertEqual(results["time"][-1], 0.1)

    def test_a_callback_that_only_looks_changes_no_bit(self):
        times = []
        articular.run(block(), "looked", on_step=lambda step: times.append(step.time))
        articular.run(block(), "alone")
        self.assert_same_results("looked", "alone")
        np.testing.assert_allclose(times, articular.Results("alone")["time"], rtol=1e-11)

    def test_a_controller_without_memory_is_resumed_with_the_same_bits(self):
        def controller(step):
            step.muscles["flexor"].excitation = min(1.0, step.probes["elbow.angle [deg]"] / 50 + 0.2)

        def until_then(step):
            controller(step)
            return step.time > 0.07

        scenario = lever(**{"output.interval": "10 ms", "output.checkpoint_interval": "50 ms"})
        articular.run(scenario, "whole", on_step=controller)
        self.assertEqual(
            articular.run(scenario, "parts", on_step=until_then).summary["outcome"], "interrupted"
        )
        articular.run(scenario, "parts", on_step=controller, resume=True)
        self.assert_same_results("whole", "parts")

    def test_what_a_callback_raises_ends_the_run_in_good_order(self):
        def fail(step):
            if step.time > 0.05:
                raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            articular.run(block(), "out", on_step=fail)
        results = articular.Results("out")
        self.assertEqual(results.summary["outcome"], "interrupted")
        self.assertGreater(results["time"][-1], 0.05)

    def test_a_callback_ends_the_run_where_it_says_so(self):
        for when, rows in [(0.0, 1), (0.0105, 12)]:
            with self.subTest(when):
                results = articular.run(block(), "out", on_step=lambda step: step.time >= when)
                self.assertEqual(len(results["time"]), rows)
                self.assertEqual(results.summary["outcome"], "interrupted")

    def test_a_callback_that_answers_anything_but_yes_or_no_is_a_mistake(self):
        with self.assertRaisesRegex(TypeError, "on_step: expected True"):
            articular.run(block(), "out", on_step=lambda step: step.time)

    def test_the_step_of_a_callback_is_not_kept(self):
        kept = []
        articular.run(block(), "out", on_step=kept.append)
        with self.assertRaisesRegex(RuntimeError, "on_step"):
            print(kept[0].time)

    def test_ctrl_c_ends_a_run_in_good_order(self):
        scenario = block(duration="1000 s", **{"output.interval": "100 s"})
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            articular.run(scenario, "out")
        self.assertLess(time.monotonic() - start, 10)
        self.assertEqual(articular.Results("out").summary["outcome"], "interrupted")

    def test_other_threads_go_on_while_a_run_computes(self):
        counts, stop = [], threading.Event()

        def count():
            while not stop.is_set():
                counts.append(time.monotonic())
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        start = time.monotonic()
        articular.run(block(**{"output.frames": False}), "out")
        end = time.monotonic()
        stop.set()
        counter.join()
        self.assertGreater(sum(start + 0.1 * (end - start) < t < end for t in counts), 3)

    def test_a_simulation_that_can_not_go_on_raises_and_its_results_stay(self):
        hopeless = {"integrator.max_iterations": 1, "integrator.position_tolerance": "1e-9 um"}
        with self.assertRaisesRegex(articular.SimulationError, "cannot go on at t ="):
            articular.run(block(**hopeless), "out")
        self.assertIn("cannot go on", articular.Results("out").summary["outcome"])
        with self.assertRaisesRegex(articular.SimulationError, "cannot go on at t ="):
            for _ in articular.Model(block(**hopeless)).steps():
                pass

    def test_runs_in_several_threads_have_the_bits_of_one(self):
        articular.run(block(), "alone")
        runs = [threading.Thread(target=articular.run, args=(block(), f"{i}")) for i in range(3)]
        for run in runs:
            run.start()
        for run in runs:
            run.join()
        for i in range(3):
            self.assert_same_results("alone", str(i))

    def test_results_of_another_scenario_are_replaced_only_if_asked_for(self):
        articular.run(block(), "out")
        with self.assertRaises(articular.InputError):
            articular.run(lever(), "out")
        articular.run(lever(), "out", overwrite=True)
        self.assertEqual(articular.Results("out").name, "lever")

    def test_a_folder_that_can_not_be_written_is_a_failure_of_the_system(self):
        (self.folder / "file").write_text("")
        with self.assertRaises((articular.SystemFailure, articular.InputError)):
            articular.run(block(), "file/out")

    def test_warnings_are_python_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            articular.run(block(**{"body.block.geometry.box.cells": [1, 1, 1]}), "out")
        written = articular.Results("out").summary["warnings"]
        texts = [str(warning.message) for warning in caught
                 if issubclass(warning.category, articular.RunWarning)]
        self.assertEqual([text for text in written if text not in texts], [])


if __name__ == "__main__":
    unittest.main()
