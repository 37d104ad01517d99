"""Every keyword of every public function, with values that nobody means: an answer or an exception, never an end."""

import inspect
import json
import os
import subprocess
import sys
import unittest

from support import Scratch, strip

import kinetix

ODD = ["None", "-1", "-3", "0", "100000", "2**70", "-2**63", "1e308", "float('nan')", "float('inf')", "-1.5", "'x'", "''", "b''", "[]",
       "[[]]", "{}", "{1: 2}", "()", "object()", "True", "1j", "np.zeros(3)", "np.zeros((2, 3))", "np.full((2, 3, 4), np.nan)",
       "np.array(['a'])", "np.zeros(0)", "lambda *a: 1 / 0", "range(3)", "np.zeros((odd_rows, 5))"]

# The long proof (make soak) passes whole batches to every keyword. Otherwise only odd numbers of threads get them.
IS_LONG = "KINETIX_SOAK" in os.environ
ODD_ROWS = 200_000 if IS_LONG else 4_000
BATCHES = {"Design.fold": 200_000, "fold_strips": 200_000, "strip_derivatives": 20_000, "strip_gradients": 10_000}
SMALLER = 100  # times

# Valid arguments of every public function; each keyword in turn is replaced by every odd value.
CALLS = {
    "Design": {"source": "design", "folder": "''"},
    "Design.with_hinges": {"t": "d.t", "alpha": "d.alpha", "beta": "d.beta", "offset_mm": "d.offset_mm"},
    "Design.with_theta": {"theta": "0.1"},
    "Design.poses": {"theta": "0.1"},
    "Design.fold": {"theta": "np.zeros(rows)", "threads": "1"},
    "Design.derivatives": {"theta": "0.1"},
    "Design.from_text": {"text": "d.text()", "folder": "''"},
    "fold_strips": {"beta": "np.zeros((rows, 5))", "theta": "0.1", "cell_mm": "1.0", "t": "None", "rows": "1", "out": "None",
                    "threads": "1"},
    "strip_derivatives": {"beta": "np.zeros((rows, 5))", "theta": "0.1", "cell_mm": "1.0", "rows": "1", "threads": "1"},
    "strip_gradients": {"beta": "np.zeros((rows, 5))", "theta": "0.1", "by_poses": "np.ones((rows, 12, 6))", "cell_mm": "1.0",
                        "rows": "1", "threads": "1"},
    "simulate": {"design": "d", "model": "'exact'", "theta": "None", "folder": "''", "threads": "1", "fidelity": "False",
                 "progress": "None"},
    "verify": {"design": "d", "folder": "''", "fidelity": "False", "progress": "None"},
    "optimise": {"target": "target", "folder": "''", "threads": "1", "seed": "0", "verify": "False", "prints": "0",
                 "fidelity": "False", "time_limit_s": "1.0", "progress": "None"},
    "export": {"design": "d", "formats": "['svg']", "folder": "'out'", "process": "''", "hinge": "''", "clearance_mm": "0",
               "cell_mm": "0", "bed_mm": "None", "loose_rods": "False", "folded": "False", "orient": "'flat'", "slice": "False",
               "caps": "False", "slicer": "''"},
    "Goal": {"error": "lambda poses: poses[0, :3]", "tolerance": "1.0", "gradient": "None", "columns": "3", "cell_mm": "10.0",
             "rows": "1", "wall_mm": "None", "beta": "(-1.0, 1.0)", "theta": "(0.035, 0.77)", "per": "'column'",
             "symmetry": "'none'", "solver": "'ceres'", "starts": "1", "max_evaluations": "10", "name": "'goal'"},
}

CODE = """
import json, resource, sys, warnings
import numpy as np
resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
import kinetix
warnings.simplefilter("ignore")
design, name, odd, odd_rows, rows_of, values = json.loads(sys.stdin.read())
target = {"kinetix": 1, "target": {"kind": "curve", "points": [[0, 0], [20, 5], [40, 0]]}, "structure": {"cells": [3, 1]},
          "solver": {"starts": 1}}
d = kinetix.Design(design)
function = kinetix
for part in name.split("."):
    function = getattr(d if function is kinetix.Design and part != "from_text" else function, part)
for keyword, rows in rows_of.items():
    for value in odd:
        print("calls", name, keyword, value, flush=True)
        given = {k: eval(v) for k, v in values.items()}
        given[keyword] = eval(value)
        try:
            function(**given)
        except Exception as error:
            assert str(error), type(error)
            assert "internal error" not in str(error), error
print("done")
"""


class OddArguments(Scratch):
    def run_calls(self, name, keywords):
        """Makes all odd calls of a function in one interpreter, the last line of which names the call that ended it."""
        batch = BATCHES.get(name, 0)
        rows_of = {keyword: batch if IS_LONG or keyword == "threads" else batch // SMALLER for keyword in keywords}
        given = json.dumps([strip(2, [5, 6]), name, ODD, ODD_ROWS, rows_of, CALLS[name]])
        done = subprocess.run([sys.executable, "-B", "-c", CODE], input=given, capture_output=True, text=True, timeout=300,
                              cwd=self.folder)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1:]), (0, ["done"]), done.stdout[-300:] + done.stderr[-1500:])

    def test_every_keyword_of_every_public_function_is_tried(self):
        made_by_runs = ("InvalidInput", "Result", "State", "Exported")
        found = {name: getattr(kinetix, name) for name in kinetix.__all__ if name not in made_by_runs}
        found.update({f"Design.{name}": method for name, method in inspect.getmembers(kinetix.Design, callable)
                      if not name.startswith("_") and name not in ("text", "save")})
        keywords = {name: set(inspect.signature(function).parameters) - {"self"} for name, function in found.items()}
        self.assertEqual(keywords, {name: set(given) for name, given in CALLS.items()})

    def test_no_argument_ends_the_interpreter(self):
        for name, keywords in CALLS.items():
            with self.subTest(name):
                self.run_calls(name, keywords)


if __name__ == "__main__":
    unittest.main()
