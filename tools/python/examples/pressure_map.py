"""A pressure map: how a ball presses on a block of tissue, from the frames of a run.

Writes pressure.csv, and pressure.png where matplotlib is installed.

    python3 pressure_map.py --out out/pressure_map
"""

import argparse
from pathlib import Path

import numpy as np

import articular


def draw(x, y, triangles, pressure, file):
    try:
        import matplotlib
    except ImportError:
        print("no picture: matplotlib is not installed")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots()
    drawn = axes.tripcolor(x, y, triangles, 1e-3 * pressure, shading="gouraud")
    figure.colorbar(drawn, label="contact pressure [kPa]")
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    figure.savefig(file, dpi=150)
    print(file)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=Path("out/pressure_map"))
    arguments.add_argument("--short", action="store_true", help="coarse and quick")
    given = arguments.parse_args()

    scenario = articular.Scenario(Path(__file__).parent / "block.toml")
    scenario.set("body.block.geometry.box.cells", [6, 6, 4] if given.short else [12, 12, 8])
    ball = {"radius": "8 mm", "element_size": "1.5 mm", "center": "0 0 18.2 mm"}  # in place of the plate
    scenario.set("body.plate.geometry", {"sphere": ball})
    scenario.set("load.0.translation", ["0 0 0 mm", "0 0 -1.5 mm"])
    results = articular.run(scenario, given.out)

    block = results.frames[-1].mesh("block")
    pressure = np.nan_to_num(block.point_data["contact_pressure"])  # Pa
    rest = block.points - block.point_data["displacement"]
    top = rest[:, 2] > 9.9  # mm
    x, y = block.points[:, 0], block.points[:, 1]
    np.savetxt(
        given.out / "pressure.csv",
        np.column_stack([x[top], y[top], pressure[top]]),
        delimiter=",",
        header="x [mm],y [mm],pressure [Pa]",
        comments="",
        fmt="%.6g",
    )
    triangles = articular.Model(scenario).bodies["block"].triangles
    faces = triangles[top[triangles].all(axis=1)]
    draw(x, y, faces, pressure, given.out / "pressure.png")
    print(f"highest pressure: {1e-3 * pressure.max():.2f} kPa at "
          f"({x[pressure.argmax()]:.1f}, {y[pressure.argmax()]:.1f}) mm")


if __name__ == "__main__":
    main()
