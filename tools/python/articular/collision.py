"""Which surface triangles of one mesh of tetrahedra meet which tetrahedra of another.

Lengths have the unit of the points. Nothing here needs a scenario.

>>> import numpy as np
>>> points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
>>> tetrahedra = [[0, 1, 2, 3]]
>>> a, b = Collider(points, tetrahedra), Collider(points + [0.2, 0.2, 0.2], tetrahedra)
>>> a.pairs_in(b)  # face 0 of a meets tetrahedron 0 of b
array([[0, 0]], dtype=int32)
>>> b.update(points + 2)
>>> len(a.pairs_in(b))
0
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core.collision import Collider

__all__ = ["Collider", "Pairs", "find_pairs"]


class Pairs(NamedTuple):
    """Rows (face, tetrahedron), sorted. `face` is a row of `Collider.faces`."""

    a_in_b: NDArray[np.int32]  # (P, 2) faces of a in tetrahedra of b
    b_in_a: NDArray[np.int32]  # (Q, 2) faces of b in tetrahedra of a


def find_pairs(
    points_a: ArrayLike,
    tetrahedra_a: ArrayLike,
    points_b: ArrayLike,
    tetrahedra_b: ArrayLike,
    margin: float = 0.0,
) -> Pairs:
    """All pairs of two meshes that meet. For meshes that move, keep a Collider of each instead.

    points: (N, 3), tetrahedra: (M, 4) numbers of points from 0.
    margin: all pairs nearer than this too, and near edges some that are a little farther.
    """
    a, b = Collider(points_a, tetrahedra_a), Collider(points_b, tetrahedra_b)
    if margin != 0:
        a.update(points_a, margin)
        b.update(points_b, margin)
    return Pairs(a.pairs_in(b), b.pairs_in(a))
