"""Finite-element simulation of jaw and knee tissue, from Python.

Lengths are metres, times seconds, forces newtons and stresses pascals, unless a name says its unit.

>>> import articular
>>> scenario = articular.Scenario("verification/pendulum", set={"duration": "20 ms"})
>>> results = articular.run(scenario, "out/pendulum")
>>> results.summary["outcome"]
'finished'
"""

from . import collision, fem
from ._core import (
    Body,
    Contact,
    ContactPairs,
    InputError,
    Ligament,
    Model,
    Muscle,
    RunWarning,
    Scenario,
    Sheet,
    Simulation,
    SimulationError,
    SystemFailure,
    scenarios,
)
from ._run import run
from .results import Frame, Mesh, Results

__all__ = [
    "Body",
    "Contact",
    "ContactPairs",
    "Frame",
    "InputError",
    "Ligament",
    "Mesh",
    "Model",
    "Muscle",
    "Results",
    "RunWarning",
    "Scenario",
    "Sheet",
    "Simulation",
    "SimulationError",
    "SystemFailure",
    "collision",
    "fem",
    "run",
    "scenarios",
]
