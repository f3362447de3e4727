"""A calibration: which stiffness of the tissue gives the force that was measured under a plate.

The force grows with the stiffness, nearly in proportion: a secant through the last two runs, in
logarithms, finds it in three or four. `articular fit` does this for several numbers at once, and
says how well they are known.

    python3 calibration.py --force 0.8
"""

import argparse
import math
from pathlib import Path

import articular

HERE = Path(__file__).parent
TOLERANCE = 1e-3  # of the force


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--force", type=float, default=0.8, help="as measured [N]")
    arguments.add_argument("--out", type=Path, default=Path("out/calibration"))
    arguments.add_argument("--short", action="store_true", help="coarse and quick")
    given = arguments.parse_args()

    scenario = articular.Scenario(HERE / "block.toml")
    if given.short:
        scenario.set("body.block.geometry.box.cells", [2, 2, 2])

    def force_of(modulus):
        """The force at the end [N] with a Young's modulus [kPa]."""
        scenario.set("body.block.material.young_modulus", f"{modulus} kPa")
        results = articular.run(scenario, given.out)
        force = float(abs(results["plate.force.z"][-1]))
        print(f"E = {modulus:.3f} kPa: {force:.4f} N")
        return force

    low, high = 10.0, 20.0
    force_low, force_high = force_of(low), force_of(high)
    while abs(force_high / given.force - 1) > TOLERANCE:
        slope = math.log(force_high / force_low) / math.log(high / low)
        next_one = high * (given.force / force_high) ** (1 / slope)
        low, force_low = high, force_high
        high, force_high = next_one, force_of(next_one)
    print(f"The block has E = {high:.2f} kPa.")


if __name__ == "__main__":
    main()
