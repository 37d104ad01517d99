"""python_folds.py PROGRAM: folds strips of 40 columns by kinetix.fold_strips on one thread; prints a line of JSON.

first: folds per second of the first call.
fresh: folds per second of later calls, each into memory that it takes itself.
own: folds per second into an array of the caller.
equal: whether strips that the program also folds are the same to the last bit.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import kinetix

COLUMNS, CELL_MM = 40, 8.1
FOLDS = 100_000
COMPARED = 20  # strips folded by the program too
RUNS = 5

rng = np.random.default_rng(20)
beta = rng.uniform(-0.6, 0.6, (FOLDS, COLUMNS))
theta = rng.uniform(0.1, 0.7, FOLDS)


def rate(**options):
    begin = time.perf_counter()
    kinetix.fold_strips(beta, theta, CELL_MM, threads=1, **options)
    return FOLDS / (time.perf_counter() - begin)


def by_program(k, folder):
    """Poses of strip k by the program, rows of seven numbers."""
    sheet = kinetix.Design({"kinetix": 1, "structure": {"cells": [COLUMNS, 1], "cell_mm": CELL_MM}})
    tilts = sheet.beta.copy()
    for hinge, wall in enumerate(sheet.walls):
        (i, j), (to, _) = json.loads(wall)
        if to > i:
            tilts[hinge] = -beta[k, i] if j else beta[k, i]
    sheet.with_hinges(beta=tilts).with_theta(theta[k]).save(folder / "design.yaml")
    said = subprocess.run([sys.argv[1], "simulate", folder / "design.yaml", "-o", folder / "out", "--json", "--quiet"],
                          capture_output=True, text=True, check=True).stdout
    return [pose["position_mm"] + pose["quaternion_wxyz"] for pose in json.loads(said)["states"][0]["poses"]]


first = rate()
fresh = statistics.median(rate() for _ in range(RUNS))
out = np.zeros((FOLDS, 2 * (COLUMNS + 1), 7))
own = statistics.median(rate(out=out) for _ in range(RUNS))
with tempfile.TemporaryDirectory() as folder:
    equal = all(out[k].tolist() == by_program(k, pathlib.Path(folder)) for k in range(COMPARED))
print(json.dumps({"first": first, "fresh": fresh, "own": own, "equal": equal}))
