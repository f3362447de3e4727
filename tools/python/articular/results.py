"""Results of a run: numbers as numpy arrays, or as pandas, meshio and pyvista objects where these
are installed."""

from __future__ import annotations

import csv
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core

if TYPE_CHECKING:
    import meshio
    import pandas
    import pyvista

Array = NDArray[Any]

# Kinds of cells as VTK numbers them, and as meshio calls them.
_TETRAHEDRON, _TRIANGLE = 10, 5


def _needs(package: str, instead: str) -> ImportError:
    return ImportError(f"this needs the package {package}, which is not installed; {instead}")


def _without_unit(column: str) -> str:
    return re.sub(r" \[[^]]*\]$", "", column)


def _unit(column: str) -> str:
    found = re.search(r" \[([^]]*)\]$", column)
    return found.group(1) if found else ""


class Results:
    """The folder of a run, which may go on while it is read.

    >>> results = Results("out/pendulum")
    >>> results.units["swing.angle [deg]"]
    'deg'
    >>> results["swing.angle"][0]
    0.0
    """

    folder: Path
    name: str  # of the scenario, which names the files

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        """Raises InputError where the folder has no results."""
        self.folder = Path(folder)
        if not (self.folder / "history.csv").is_file():
            raise _core.InputError(
                f"{self.folder}: no results of a run: expected a folder with history.csv"
            )
        names = sorted(file.stem for file in self.folder.glob("*.pvd"))
        self.name = names[0] if names else self.folder.name
        self._series = self.folder / f"{self.name}.pvd" if names else None

    def __repr__(self) -> str:
        return f"<articular.Results in {self.folder}>"

    @property
    def columns(self) -> Dict[str, Array]:
        """The history, one array a column by its name with unit: "time [s]". An empty cell is NaN."""
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        header = rows[0]
        whole = [row for row in rows[1:] if len(row) == len(header)]  # a run may be writing
        values = np.array(
            [[float(cell) if cell else np.nan for cell in row] for row in whole], dtype=float
        ).reshape(-1, len(header))
        return {name: values[:, i].copy() for i, name in enumerate(header)}

    @property
    def units(self) -> Dict[str, str]:
        """The unit of each column of the history."""
        return {column: _unit(column) for column in self.columns}

    def __getitem__(self, column: str) -> Array:
        """A column of the history by its name, with or without its unit."""
        columns = self.columns
        if column in columns:
            return columns[column]
        for name, values in columns.items():
            if _without_unit(name) == column:
                return values
        raise KeyError(f"no column {column!r}; there are: {', '.join(columns)}")

    @property
    def history(self) -> "pandas.DataFrame":
        """The history as a table of pandas. `attrs["units"]` has the unit of each column.

        Raises ImportError without pandas; `columns` has the same as numpy arrays.
        """
        try:
            import pandas
        except ImportError:
            raise _needs("pandas", "`columns` has numpy arrays") from None
        table = pandas.DataFrame(self.columns)
        table.attrs["units"] = self.units
        return table

    @property
    def summary(self) -> Dict[str, Any]:
        """`summary.json`: outcome, settings, counts, wall times, energy balance, warnings."""
        with open(self.folder / "summary.json") as file:
            summary: Dict[str, Any] = json.load(file)
        return summary

    @property
    def frames(self) -> "List[Frame]":
        """The frames in the order of time; none where the scenario writes none."""
        frames: Dict[float, Dict[str, Path]] = {}
        for time, part, file in _core.read_series(self._series) if self._series else []:
            frames.setdefault(time, {})[part] = self.folder / file
        return [Frame(time, files) for time, files in sorted(frames.items())]


@dataclass(frozen=True)
class Mesh:
    """One part of a frame as numpy arrays: lengths in the unit of the scenario's output (mm), all else in SI.

    Of N points and M cells. A tissue has tetrahedra, a bone and a contact surface triangles, muscles
    and ligaments are paths: lists of points.
    """

    points: Array  # (N, 3)
    tetrahedra: Array  # (M, 4)
    triangles: Array  # (M, 3)
    paths: List[Array]
    point_data: Dict[str, Array]  # N rows each
    cell_data: Dict[str, Array]  # M rows each
    texts: Dict[str, str]  # such as units

    def to_meshio(self) -> "meshio.Mesh":
        """Points, tetrahedra and triangles with their data as an object of meshio, without paths.

        Raises ImportError without meshio.
        """
        try:
            import meshio
        except ImportError:
            raise _needs("meshio", "the mesh itself has numpy arrays") from None
        cells: List[Tuple[str, Any]] = []
        if len(self.tetrahedra):
            cells.append(("tetra", self.tetrahedra))
        if len(self.triangles):
            cells.append(("triangle", self.triangles))
        sizes = np.cumsum([len(block) for _, block in cells])[:-1]
        of_blocks = {name: np.split(data, sizes) for name, data in self.cell_data.items()}
        return meshio.Mesh(self.points, cells, self.point_data, of_blocks if cells else {})


@dataclass(frozen=True)
class Frame:
    """All parts at one time: bodies, `lines`, and `BODY:contact` for contact surfaces."""

    time: float  # [s]
    files: Dict[str, Path]

    @property
    def parts(self) -> List[str]:
        """Names of bodies, and what else there is."""
        return list(self.files)

    def _file(self, part: str) -> Path:
        if part not in self.files:
            raise KeyError(f"no part {part!r} in this frame; there are: {', '.join(self.files)}")
        return self.files[part]

    def mesh(self, part: str) -> Mesh:
        """A part as numpy arrays. Raises KeyError where there is none of this name."""
        file = self._file(part)
        content = _core.read_mesh_file(file)
        begin, nodes = content["cells"]
        types = content["types"]

        def of_kind(kind: int, size: int) -> Array:
            rows = begin[:-1][types == kind]
            cells: Array = nodes[rows[:, None] + np.arange(size)].reshape(-1, size)
            return cells

        def split(cells: "Tuple[Array, Array]") -> List[Array]:
            return np.split(cells[1], cells[0][1:-1]) if len(cells[0]) > 1 else []

        polygons = split(content["polygons"])
        triangles = of_kind(_TRIANGLE, 3)
        if polygons:
            triangles = np.array(polygons).reshape(-1, 3)
        return Mesh(
            content["points"],
            of_kind(_TETRAHEDRON, 4),
            triangles,
            split(content["lines"]),
            content["point_data"],
            content["cell_data"],
            dict(content["texts"]),
        )

    def to_meshio(self, part: str) -> "meshio.Mesh":
        """A tissue, bone or contact surface as an object of meshio. Raises ImportError without it."""
        return self.mesh(part).to_meshio()

    def to_pyvista(self, part: str) -> "pyvista.DataSet":
        """A part as an object of pyvista. Raises ImportError without it."""
        file = self._file(part)
        try:
            import pyvista
        except ImportError:
            raise _needs("pyvista", "`mesh` has numpy arrays") from None
        return pyvista.read(file)
