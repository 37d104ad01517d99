"""Shared parts of the module's tests."""

import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["KINETIX_SOURCE"])
PROGRAM = os.environ["KINETIX_OPT"]


def strip(columns, beta_deg=(), theta_deg=20.0, cell_mm=10.0):
    """A design of one row as a dict; tilts of its columns by the walls of row 0 and, the other way, of row 1."""
    hinges = []
    for c, beta in enumerate(beta_deg):
        for j, sign in ((0, 1), (1, -1)):
            hinges.append({"wall": [[c, j], [c + 1, j]], "beta_deg": sign * beta})
    design = {"theta_deg": theta_deg}
    if hinges:
        design["hinges"] = hinges
    return {"kinetix": 1, "structure": {"cells": [columns, 1], "cell_mm": cell_mm}, "design": design}


def half_circle(radius_mm=60.0, points=31):
    """x, z of a half circle."""
    angles = [k * math.pi / (points - 1) for k in range(points)]
    return [[-radius_mm * math.cos(a), radius_mm * math.sin(a)] for a in angles]


def program(*arguments, expected=(0,)):
    """Runs the program, which ends with one of the expected codes, and gives what it prints as JSON."""
    run = subprocess.run([PROGRAM, *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True)
    assert run.returncode in expected, (run.returncode, run.stderr)
    return json.loads(run.stdout)


def numbers_of(poses):
    """Poses of result.json as rows of seven numbers."""
    return [pose["position_mm"] + pose["quaternion_wxyz"] for pose in poses]


class Scratch(unittest.TestCase):
    """Test with a temporary folder, `self.folder`."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
