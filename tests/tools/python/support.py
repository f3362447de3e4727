"""What the tests of the Python package share."""

import os
import signal
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(__file__).parents[3]
EXAMPLES = SOURCES / "tools/python/examples"
PROGRAM = os.environ["ARTICULAR_PROGRAM"]


class InFolder(unittest.TestCase):
    """Each test runs in an empty folder of its own."""

    def setUp(self):
        # Who starts tests in the background may have Ctrl-C ignored.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = Path(folder.name)


def block(**more):
    """The block under a plate, coarse."""
    import articular

    settings = {"body.block.geometry.box.cells": [2, 2, 2], "duration": "0.1 s", **more}
    return articular.Scenario(EXAMPLES / "block.toml", set=settings)


def lever(**more):
    """The forearm on a hinge."""
    import articular

    return articular.Scenario(EXAMPLES / "lever.toml", set={"duration": "0.1 s", **more})
