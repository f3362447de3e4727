"""A muscle law of one's own: its force is computed in Python before every step.

The muscle of the scenario pulls with activation times max_force, at any length and speed
(force_length = false). The law sets that activation, and the force holds over the step. So it is one
step late: keep steps short beside the times in which the force changes. A law that must hold within
the step, such as that of a stiff tendon, can't be given so.

    python3 own_muscle_law.py --out out/own_law
"""

import argparse
import math
from pathlib import Path

import articular

HERE = Path(__file__).parent
WIDTH = 0.45  # of the force-length curve, by the optimal length
MAX_VELOCITY = 8.0  # optimal lengths / s


def own_law(excitation, length, rate):
    """Force by max_force: a Gaussian of the length, and a straight line down to no force when it
    shortens at the highest speed. Both by the optimal length."""
    force_length = math.exp(-(((length - 1) / WIDTH) ** 2))
    force_velocity = min(max(1 + rate / MAX_VELOCITY, 0.0), 1.4)
    return min(excitation * force_length * force_velocity, 1.0)


def set_force(step):
    muscle = step.muscles["flexor"]
    length = muscle.length / muscle.optimal_length
    rate = muscle.rate / muscle.optimal_length
    excitation = 0.06 if step.time > 0.1 else 0.0
    force = own_law(excitation, length, rate)
    muscle.activation = force  # now,
    muscle.excitation = force  # and it stays so over the step


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=Path("out/own_law"))
    arguments.add_argument("--short", action="store_true", help="is quick as it is")
    given = arguments.parse_args()

    scenario = articular.Scenario(HERE / "lever.toml", set={"muscle.flexor.force_length": False})
    results = articular.run(scenario, given.out, on_step=set_force)
    strongest = results["flexor.force"].max()
    print(f"The muscle pulled with up to {strongest:.1f} N and lifted the forearm to "
          f"{results['elbow.angle'].max():.1f} degrees.")


if __name__ == "__main__":
    main()
