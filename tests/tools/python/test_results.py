import json
import os
import sys
import unittest
from unittest import mock

import numpy as np

import articular
from support import InFolder, block, lever


class Results(InFolder):
    def test_columns_are_found_with_and_without_their_unit(self):
        results = articular.run(lever(), "out")
        angle = results["elbow.angle [deg]"]
        np.testing.assert_array_equal(results["elbow.angle"], angle)
        self.assertEqual((len(angle), results.units["flexor.force [N]"]), (51, "N"))
        with self.assertRaisesRegex(KeyError, "there are: time"):
            results["elbow"]

    def test_the_history_is_a_table_of_pandas_with_units(self):
        results = articular.run(block(), "out")
        table = results.history
        self.assertEqual(list(table.columns), list(results.columns))
        self.assertEqual(table.attrs["units"]["plate.area [mm^2]"], "mm^2")
        self.assertTrue(np.isnan(table["plate.center.x [mm]"].iloc[0]))  # nothing touches yet

    def test_a_row_that_is_being_written_is_left_out(self):
        results = articular.run(lever(), "out")
        with open("out/history.csv", "a") as file:
            file.write("0.102,3")
        self.assertEqual(len(results["time"]), 51)

    def test_the_summary_is_that_of_the_file(self):
        results = articular.run(lever(), "out")
        with open("out/summary.json") as file:
            self.assertEqual(results.summary, json.load(file))

    def test_frames_have_meshes_as_arrays_and_for_meshio(self):
        scenario = block(**{"output.contact_surfaces": True})
        frame = articular.run(scenario, "out").frames[-1]
        self.assertEqual(frame.parts, ["plate", "plate:contact", "block", "block:contact"])
        self.assertEqual(frame.time, 0.1)
        mesh = frame.mesh("block")
        model = articular.Model(scenario)
        np.testing.assert_array_equal(mesh.tetrahedra, model.bodies["block"].tetrahedra)
        self.assertEqual(mesh.cell_data["cauchy_stress"].shape, (48, 6))
        self.assertEqual(mesh.texts["displacement.unit"], "mm")
        np.testing.assert_array_equal(
            frame.mesh("plate").triangles, model.bodies["plate"].triangles
        )
        converted = frame.to_meshio("block")
        self.assertEqual([(block.type, len(block.data)) for block in converted.cells], [("tetra", 48)])
        np.testing.assert_array_equal(converted.points, mesh.points)
        np.testing.assert_array_equal(converted.cell_data["von_mises"][0], mesh.cell_data["von_mises"])
        self.assertEqual(frame.to_meshio("block:contact").cells[0].type, "triangle")
        with self.assertRaisesRegex(KeyError, "no part 'blok'"):
            frame.mesh("blok")

    def test_lines_are_paths(self):
        mesh = articular.run(lever(), "out").frames[0].mesh("lines")
        (path,) = mesh.paths
        np.testing.assert_allclose(mesh.points[path], [[30, 0, 250], [30, 0, -40]])
        self.assertEqual(mesh.cell_data["force"].shape, (1,))

    def test_without_a_package_the_error_names_it_and_what_there_is(self):
        results = articular.run(block(), "out")
        frame = results.frames[0]
        for package, ask in [
            ("pandas", lambda: results.history),
            ("meshio", lambda: frame.to_meshio("block")),
            ("pyvista", lambda: frame.to_pyvista("block")),
        ]:
            with self.subTest(package), mock.patch.dict(sys.modules, {package: None}):
                with self.assertRaisesRegex(ImportError, f"{package}, which is not installed; .*numpy"):
                    ask()

    def test_pyvista_reads_the_file_of_a_part(self):
        frame = articular.run(block(), "out").frames[-1]
        pyvista = mock.Mock()
        with mock.patch.dict(sys.modules, {"pyvista": pyvista}):
            frame.to_pyvista("block")
        pyvista.read.assert_called_once_with(frame.files["block"])
        self.assertTrue(os.path.isfile(frame.files["block"]))

    def test_a_folder_without_results_is_refused(self):
        with self.assertRaisesRegex(articular.InputError, "no results of a run"):
            articular.Results(self.folder)

    def test_a_damaged_frame_is_refused(self):
        frame = articular.run(block(), "out").frames[-1]
        frame.files["block"].write_bytes(frame.files["block"].read_bytes()[:500])
        with self.assertRaises(articular.InputError):
            frame.mesh("block")


if __name__ == "__main__":
    unittest.main()
