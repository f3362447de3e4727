import itertools
import subprocess
import unittest

import numpy as np

import articular
from articular import collision, fem
from support import PROGRAM, InFolder, block

MATERIAL = {"law": "neo-hookean", "young_modulus": "15 kPa", "poisson_ratio": 0.45}


def box(cells=2, size=0.01):
    """Points and tetrahedra of a cube, six a cell."""
    grid = np.arange(cells + 1) * size / cells
    points = np.array(list(itertools.product(grid, grid, grid)))
    number = np.arange((cells + 1) ** 3).reshape(cells + 1, cells + 1, cells + 1)
    tetrahedra = []
    for corner in itertools.product(range(cells), repeat=3):
        for order in itertools.permutations(range(3)):
            path = [np.array(corner)]
            for axis in order:
                path.append(path[-1] + np.eye(3, dtype=int)[axis])
            nodes = [number[tuple(place)] for place in path]
            edges = np.array([points[n] - points[nodes[0]] for n in nodes[1:]])
            if np.linalg.det(edges) < 0:
                nodes[1], nodes[2] = nodes[2], nodes[1]
            tetrahedra.append(nodes)
    return points, np.array(tetrahedra)


class Collision(InFolder):
    def test_pairs_are_those_of_the_program(self):
        results = articular.run(block(contact=False, probe=[], duration="0.5 s"), "out")
        frames = results.frames[-1]
        lower = frames.mesh("block")
        subprocess.run(
            [PROGRAM, "collide", str(frames.files["block"]), str(results.frames[0].files["block"]),
             "--pairs", "pairs.csv"], check=True, capture_output=True)
        listed = np.loadtxt("pairs.csv", delimiter=",", skiprows=1, dtype=int)
        first = results.frames[0].mesh("block")
        found = collision.find_pairs(lower.points, lower.tetrahedra, first.points, first.tetrahedra)
        a = collision.Collider(lower.points, lower.tetrahedra)
        expected = listed[listed[:, 1] == 0]
        self.assertEqual(len(found.a_in_b), len(expected))
        self.assertGreater(len(expected), 10)
        triangle_tets = a.face_tetrahedra[found.a_in_b[:, 0]]
        np.testing.assert_array_equal(
            np.unique(np.column_stack([triangle_tets, found.a_in_b[:, 1]]), axis=0),
            np.unique(expected[:, [2, 5]], axis=0),
        )

    def test_a_mesh_that_moves_away_meets_nothing(self):
        points, tetrahedra = box()
        a, b = collision.Collider(points, tetrahedra), collision.Collider(points, tetrahedra)
        b.update(points + [0.005, 0, 0])
        self.assertGreater(len(a.pairs_in(b)), 0)
        b.update(points + [0.0101, 0, 0])
        self.assertEqual(len(a.pairs_in(b)), 0)
        a.update(points, margin=0.001)
        b.update(points + [0.0101, 0, 0], margin=0.001)
        self.assertGreater(len(a.pairs_in(b)), 0)

    def test_a_mesh_meets_itself_where_it_is_folded(self):
        points, tetrahedra = box()
        a = collision.Collider(points, tetrahedra)
        self.assertEqual(len(a.pairs_in(a)), 0)
        folded = points.copy()
        folded[:, 0] = np.abs(folded[:, 0] - 0.005)
        a.update(folded)
        self.assertGreater(len(a.pairs_in(a)), 0)

    def test_views_are_no_copies_and_keep_the_mesh_alive(self):
        faces = collision.Collider(*box()).faces
        kept = faces.copy()
        waste = [collision.Collider(*box()) for _ in range(10)]
        np.testing.assert_array_equal(faces, kept)
        self.assertFalse(faces.flags.writeable)
        self.assertEqual((faces.shape, len(waste)), ((48, 3), 10))

    def test_misuse_says_what_was_expected(self):
        points, tetrahedra = box()
        a, b = collision.Collider(points, tetrahedra), collision.Collider(points, tetrahedra)
        nan = points.copy()
        nan[3, 1] = np.nan
        far = np.array(tetrahedra)
        far[5, 2] = 1000
        for error, text, call in [
            (ValueError, "points: expected N rows of 3", lambda: collision.Collider(points[:, :2], tetrahedra)),
            (ValueError, "tetrahedra: expected N rows of 4", lambda: collision.Collider(points, tetrahedra[:, :3])),
            (ValueError, "points: row 3 is not finite", lambda: collision.Collider(nan, tetrahedra)),
            (ValueError, "points: row 3 is not finite", lambda: a.update(nan)),
            (ValueError, "points: expected 27 rows", lambda: a.update(points[:-1])),
            (ValueError, "1000", lambda: collision.Collider(points, far)),
            (ValueError, "row 0 names node -1", lambda: collision.Collider(points, -np.ones((1, 4), int))),
            (TypeError, "whole numbers", lambda: collision.Collider(points, tetrahedra + 0.5)),
            (TypeError, "real numbers", lambda: collision.Collider(points * 1j, tetrahedra)),
            (TypeError, "real numbers", lambda: collision.Collider([["a", "b", "c"]], tetrahedra)),
            (TypeError, "", lambda: a.pairs_in(points)),
            (ValueError, "margin", lambda: a.update(points, margin=-1)),
        ]:
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                call()
        b.update(points, margin=0.001)
        with self.assertRaisesRegex(ValueError, "margin"):
            a.pairs_in(b)


class Fem(InFolder):
    def setUp(self):
        super().setUp()
        self.points, self.tetrahedra = box()
        random = np.random.default_rng(1)
        self.x = self.points @ np.diag([1.1, 0.95, 1.02]) + 2e-4 * random.standard_normal(self.points.shape)
        self.direction = 1e-3 * random.standard_normal(self.points.shape)

    def elements(self, kind, **more):
        return fem.Elements(self.points, self.tetrahedra, {**MATERIAL, "element": kind, **more})

    def best(self, error):
        """The least error of central differences over a sweep of steps."""
        return min(error(10.0**-k) for k in range(2, 6))

    def test_forces_are_the_derivative_of_the_energy(self):
        for kind in ["plain", "smoothed"]:
            elements = self.elements(kind)
            slope = (elements.forces(self.x) * self.direction).sum()

            def error(h):
                rise = elements.energy(self.x + h * self.direction) - elements.energy(self.x - h * self.direction)
                return abs(rise / (2 * h) / slope - 1)

            with self.subTest(kind):
                self.assertLess(self.best(error), 1e-7)

    def test_the_tangent_is_the_derivative_of_the_forces(self):
        for kind in ["plain", "smoothed"]:
            elements = self.elements(kind)
            tangent = elements.tangent(self.x)
            self.assertEqual((tangent.format, tangent.shape), ("csr", (81, 81)))
            change = (tangent @ self.direction.ravel()).reshape(-1, 3)

            def error(h):
                rise = elements.forces(self.x + h * self.direction) - elements.forces(self.x - h * self.direction)
                return np.abs(rise / (2 * h) - change).max() / np.abs(change).max()

            with self.subTest(kind):
                self.assertLess(self.best(error), 1e-6)
                self.assertLess(np.abs((tangent - tangent.T).toarray()).max(), 1e-9 * np.abs(tangent.toarray()).max())

    def test_the_saddle_point_matrix_solves_what_the_tangent_does(self):
        from scipy.sparse.linalg import spsolve

        elements = self.elements("smoothed")
        matrix = elements.saddle_point(self.x).tolil()
        size, fixed = 81, range(27)  # held: without that it is singular
        tangent = elements.tangent(self.x).tolil()
        for m in (matrix, tangent):
            for i in fixed:
                m[i, :], m[:, i] = 0, 0
                m[i, i] = 1
        load = np.zeros(matrix.shape[0])
        load[27:81] = self.direction.ravel()[27:]
        u = spsolve(tangent.tocsc(), load[:size])
        both = spsolve(matrix.tocsc(), load)
        np.testing.assert_allclose(both[:size], u, rtol=1e-6, atol=1e-9 * np.abs(u).max())

    def test_small_strain_is_hookes_law(self):
        # Confined: F = diag(1, 1, s). The force on the top is (lambda + 2 mu)(s - 1) A for small s - 1.
        E, nu, s = 15e3, 0.45, 1 - 1e-6
        elements = self.elements("plain", law="linear")
        forces = elements.forces(self.points * [1, 1, s])
        top = self.points[:, 2] > 0.0099
        modulus = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        self.assertAlmostEqual(forces[top, 2].sum() / (modulus * (s - 1) * 1e-4), 1, places=9)
        stress = elements.cauchy_stress(self.points * [1, 1, s])
        np.testing.assert_allclose(stress[:, 2], modulus * (s - 1), rtol=1e-6)
        np.testing.assert_allclose(elements.volume_ratio(self.points * [1, 1, s]), s)
        self.assertAlmostEqual(elements.lumped_mass(1000).sum(), 1e-3)
        self.assertAlmostEqual(elements.rest_volume.sum(), 1e-6)

    def test_fibres_are_given_as_a_direction_or_one_an_element(self):
        muscle = {"law": "muscle", "c10": "10 kPa", "bulk_modulus": "1 MPa", "element": "plain",
                  "fibres": {"direction": [0, 0, 1]}}
        along = fem.Elements(self.points, self.tetrahedra, muscle)
        given = np.tile([0, 0, 2.0], (len(self.tetrahedra), 1))
        each = fem.Elements(self.points, self.tetrahedra, muscle, fibres=given)
        np.testing.assert_array_equal(along.forces(self.x, 0.5), each.forces(self.x, 0.5))
        self.assertGreater(np.abs(along.forces(self.x, 0.5) - along.forces(self.x)).max(), 0)

    def test_misuse_says_what_was_expected(self):
        plain = self.elements("plain")
        inverted = self.tetrahedra[:, [1, 0, 2, 3]]
        for error, text, call in [
            (articular.InputError, "young_modulus.*a stress", lambda: self.elements("plain", young_modulus="15 kg")),
            (articular.InputError, "law", lambda: self.elements("plain", law="neohookean")),
            (ValueError, "", lambda: fem.Elements(self.points, inverted, MATERIAL)),
            (ValueError, "points: expected 27 rows", lambda: plain.energy(self.x[:5])),
            (ValueError, "row 0 is not finite", lambda: plain.forces(self.x * np.inf)),
            (articular.InputError, "without fibres",
             lambda: fem.Elements(self.points, self.tetrahedra, MATERIAL, fibres=self.points)),
            (articular.InputError, "plain elements", lambda: plain.saddle_point(self.x)),
            (TypeError, "", lambda: fem.Elements(self.points, self.tetrahedra, "neo-hookean")),
        ]:
            with self.subTest(text=text), self.assertRaisesRegex(error, text):
                call()


if __name__ == "__main__":
    unittest.main()
