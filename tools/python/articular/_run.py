"""A whole run, with its results."""

from __future__ import annotations

import os
from typing import Callable, Optional, Union

from . import _core
from .results import Results


def run(
    scenario: Union[_core.Scenario, str, "os.PathLike[str]"],
    out: Union[str, "os.PathLike[str]", None] = None,
    *,
    on_step: Optional[Callable[[_core.Simulation], Optional[bool]]] = None,
    resume: bool = False,
    overwrite: bool = False,
) -> Results:
    """Computes a scenario and writes its results, bit for bit those of `articular run`.

    scenario: a Scenario, the path of a file, or the name of a shipped one.
    out: folder of the results; default as of `articular run`: `output.directory`, else `out/NAME`.
    on_step: called at the start and after every step with the Simulation. It may read what it likes
        and set excitations and activations of muscles. When it returns True the run ends there, in
        good order. What it raises ends the run so too, and is raised then.
    resume: goes on from the folder's last checkpoint, if there is one.
    overwrite: replaces results of another scenario in the folder.

    Ctrl-C ends the run in good order and raises KeyboardInterrupt; `resume` goes on.

    Raises InputError, SimulationError or SystemFailure, with the text that `articular run` prints.
    Each warning of the run is a RunWarning of Python's module `warnings`.
    """
    if not isinstance(scenario, _core.Scenario):
        scenario = _core.Scenario(scenario)
    return Results(
        _core.run(scenario, out, on_step=on_step, resume=resume, overwrite=overwrite)
    )
