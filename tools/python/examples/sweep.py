"""A sweep: how the force under a plate grows with the stiffness of the tissue.

Each run is a process of its own, and as many run side by side as there are processors. Writes a
folder for each run, and forces.csv.

    python3 sweep.py --out out/sweep
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import articular

HERE = Path(__file__).parent


def force_under_plate(case):
    """The force at the end [N]."""
    scenario, out = case
    return float(abs(articular.run(scenario, out)["plate.force.z"][-1]))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=Path("out/sweep"))
    arguments.add_argument("--short", action="store_true", help="coarse and quick")
    given = arguments.parse_args()

    moduli = [5, 10, 15, 20, 30]  # kPa
    settings = {"body.block.geometry.box.cells": [2, 2, 2]} if given.short else {}
    cases = []
    for modulus in moduli:
        settings["body.block.material.young_modulus"] = f"{modulus} kPa"
        scenario = articular.Scenario(HERE / "block.toml", set=settings)
        cases.append((scenario, given.out / f"{modulus}kPa"))

    with ProcessPoolExecutor() as processes:
        forces = list(processes.map(force_under_plate, cases))

    print("E [kPa]  force [N]")
    for modulus, force in zip(moduli, forces):
        print(f"{modulus:7d}  {force:9.4f}")
    lines = [f"{modulus},{force:.6g}\n" for modulus, force in zip(moduli, forces)]
    (given.out / "forces.csv").write_text("E [kPa],force [N]\n" + "".join(lines))


if __name__ == "__main__":
    main()
