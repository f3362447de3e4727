"""Energy, forces and stiffness of one mesh of tetrahedra with one material.

Nothing here needs a scenario. The material is a dict with the keys that `material` has in scenario files.

>>> import numpy as np
>>> points = 0.01 * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
>>> material = {"law": "neo-hookean", "young_modulus": "15 kPa", "poisson_ratio": 0.45}
>>> elements = Elements(points, [[0, 1, 2, 3]], material)
>>> round(elements.energy(1.1 * points), 9)  # J
0.000458453
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Tuple

from numpy.typing import ArrayLike

from . import _core

if TYPE_CHECKING:
    import scipy.sparse

__all__ = ["Elements"]


def _sparse() -> Any:
    try:
        import scipy.sparse
        import scipy.sparse.linalg
    except ImportError:
        raise ImportError("sparse matrices need the package scipy, which is not installed") from None
    return scipy.sparse


class Elements(_core.fem.Elements):
    __doc__ = _core.fem.Elements.__doc__

    def _stiffness(self, points: ArrayLike, activation: float) -> "scipy.sparse.csr_matrix":
        size = 3 * len(self.points)
        return _sparse().bsr_matrix(
            self.stiffness_parts(points, activation), shape=(size, size)
        ).tocsr()

    def _pressure_coupling(
        self, points: ArrayLike
    ) -> "Tuple[scipy.sparse.csr_matrix, scipy.sparse.csr_matrix]":
        sparse = _sparse()
        values, columns, begin, num_pressures = self.pressure_gradient_parts(points)
        gradient = sparse.bsr_matrix(
            (values, columns, begin), shape=(3 * len(self.points), num_pressures)
        ).tocsr()
        values, rows, begin = self.pressure_compliance_parts()
        upper = sparse.csc_matrix((values, rows, begin), shape=(num_pressures, num_pressures))
        return gradient, (upper + sparse.triu(upper, 1).T).tocsr()

    def tangent(self, points: ArrayLike, activation: float = 0.0) -> "scipy.sparse.csr_matrix":
        """The derivative of `forces` by the points: (3 N, 3 N) [N/m], unknown 3 i + k for axis k of point i.

        Smoothed elements couple all points through their pressure, so that their matrix is full: for
        meshes of more than some thousand points use `saddle_point`. Raises ImportError without scipy.
        """
        stiffness = self._stiffness(points, activation)
        if not self.is_smoothed:
            return stiffness
        gradient, compliance = self._pressure_coupling(points)
        solve = _sparse().linalg.factorized(compliance.tocsc())
        pressures = _sparse().csr_matrix(
            [solve(column) for column in gradient.toarray()]
        )  # a row of G each: A is symmetric
        return (stiffness + gradient @ pressures.T).tocsr()

    def saddle_point(self, points: ArrayLike, activation: float = 0.0) -> "scipy.sparse.csr_matrix":
        """The same for smoothed elements, with their P pressures as unknowns behind the points: the sparse matrix
        ((K, G), (Gᵀ, -A)), of which `tangent` is K + G A⁻¹ Gᵀ. (3 N + P, 3 N + P). Raises ImportError without scipy.
        """
        stiffness = self._stiffness(points, activation)
        gradient, compliance = self._pressure_coupling(points)
        return _sparse().bmat([[stiffness, gradient], [gradient.T, -compliance]]).tocsr()
