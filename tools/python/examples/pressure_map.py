"""A pressure map: where a tool presses on a layer of tissue, from the frames of a run.

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
    scenario.set("output.contact_surfaces", True)
    scenario.set("body.block.geometry.box.cells", [4, 4, 4] if given.short else [12, 12, 8])
    results = articular.run(scenario, given.out)

    surface = results.frames[-1].mesh("block:contact")
    pressure = np.nan_to_num(surface.point_data["contact_pressure"])  # Pa
    top = surface.points[:, 2] > surface.points[:, 2].max() - 0.5  # mm
    x, y = surface.points[:, 0], surface.points[:, 1]
    np.savetxt(
        given.out / "pressure.csv",
        np.column_stack([x[top], y[top], pressure[top]]),
        delimiter=",",
        header="x [mm],y [mm],pressure [Pa]",
        comments="",
        fmt="%.6g",
    )
    faces = surface.triangles[top[surface.triangles].all(axis=1)]
    draw(x, y, faces, pressure, given.out / "pressure.png")
    print(f"highest pressure: {1e-3 * pressure.max():.2f} kPa at "
          f"({x[pressure.argmax()]:.1f}, {y[pressure.argmax()]:.1f}) mm")


if __name__ == "__main__":
    main()
