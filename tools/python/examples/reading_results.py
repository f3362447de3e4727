"""Reading results: curves, summary and frames of a run that is done, in Python's own objects.

    articular run block.toml --out out/block
    python3 reading_results.py out/block
"""

import argparse
from pathlib import Path

import articular


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("folder", type=Path, nargs="?", help="of a run; none: makes one")
    arguments.add_argument("--out", type=Path, default=Path("out/reading"), help="for that one")
    arguments.add_argument("--short", action="store_true", help="coarse and quick")
    given = arguments.parse_args()

    if given.folder is None:
        cells = [2, 2, 2] if given.short else [6, 6, 6]
        articular.run(
            articular.Scenario(
                Path(__file__).parent / "block.toml", set={"body.block.geometry.box.cells": cells}
            ),
            given.out,
        )
    results = articular.Results(given.folder or given.out)

    summary = results.summary
    print(f"{results.name}: {summary['outcome']}, {len(summary['warnings'])} warnings")
    for column, values in results.columns.items():
        print(f"  {column}: from {values[0]:.4g} to {values[-1]:.4g}")

    try:
        table = results.history  # of pandas
        print(table.iloc[[0, -1], :3].to_string())
    except ImportError as error:
        print(error)

    for frame in results.frames[:: max(1, len(results.frames) - 1)]:
        for part in frame.parts:
            mesh = frame.mesh(part)
            print(f"  {frame.time:.2f} s, {part}: {len(mesh.points)} points, "
                  f"{len(mesh.tetrahedra)} tetrahedra, fields {', '.join(mesh.point_data)}")
            try:
                frame.to_meshio(part).write(results.folder / f"{part}_{frame.time:.2f}s.vtk")
            except ImportError as error:
                print(error)


if __name__ == "__main__":
    main()
