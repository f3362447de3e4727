"""A controller in the loop: a muscle lifts a forearm along a given path.

Before every step the controller sees the angle of the elbow, and sets the muscle's excitation: what
holds the weight, and more where the arm lags. The run writes its results like any other.

    python3 controller.py --out out/controller
    articular plot out/controller elbow.angle flexor.activation
"""

import argparse
import math
from pathlib import Path

import articular

HERE = Path(__file__).parent
STIFFNESS, DAMPING = 12.0, 0.8  # N m/rad, N m s/rad
WEIGHT_MOMENT = 0.2574 * 9.81 * 0.13  # N m, of the level forearm
LEVER = 0.03  # m, of the muscle about the elbow, about
TARGET, RISE = math.radians(60), 0.5  # rad, s


def wanted_angle(time):
    """Smoothly from 0 to the target [rad]."""
    part = min(time / RISE, 1.0)
    return TARGET * part * part * (3 - 2 * part)


class Controller:
    def __init__(self):
        self.last = None  # time and error before

    def __call__(self, step):
        angle = math.radians(step.probes["elbow.angle [deg]"])
        error = wanted_angle(step.time) - angle
        rate = 0.0
        if self.last is not None:
            rate = (error - self.last[1]) / (step.time - self.last[0])
        self.last = step.time, error
        moment = WEIGHT_MOMENT * math.sin(angle) + STIFFNESS * error + DAMPING * rate
        muscle = step.muscles["flexor"]
        muscle.excitation = min(max(moment / LEVER / muscle.max_force, 0.0), 1.0)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--out", type=Path, default=Path("out/controller"))
    arguments.add_argument("--short", action="store_true", help="is quick as it is")
    given = arguments.parse_args()

    results = articular.run(HERE / "lever.toml", given.out, on_step=Controller())
    print(f"The forearm is at {results['elbow.angle'][-1]:.1f} degrees; 60.0 were wanted.")


if __name__ == "__main__":
    main()
