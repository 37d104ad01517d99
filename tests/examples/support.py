"""Helpers for the tests of the examples."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["KINETIX_SOURCE"])
PROGRAM = os.environ["KINETIX_OPT"]


def command_output(*command, expected=0):
    run = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    assert run.returncode == expected, (command, run.returncode, run.stdout, run.stderr)
    return run.stdout + run.stderr


class Scratch(unittest.TestCase):
    """A test with a temporary folder, `self.folder`."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
