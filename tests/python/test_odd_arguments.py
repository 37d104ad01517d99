"""Every keyword of every public function, with values that nobody means: an answer or an exception, never an end."""

import inspect
import itertools
import json
import subprocess
import sys
import unittest

from support import Scratch, strip

import kinetix

ODD = ["None", "-1", "-3", "0", "100000", "2**70", "-2**63", "1e308", "float('nan')", "float('inf')", "-1.5", "'x'", "''", "b''", "[]",
       "[[]]", "{}", "{1: 2}", "()", "object()", "True", "1j", "np.zeros(3)", "np.zeros((2, 3))", "np.full((2, 3, 4), np.nan)",
       "np.array(['a'])", "np.zeros(0)", "lambda *a: 1 / 0", "range(3)", "np.zeros((200000, 5))"]

# Valid arguments of every public function; each keyword in turn is replaced by every odd value.
CALLS = {
    "Design": {"source": "design", "folder": "''"},
    "Design.with_hinges": {"t": "d.t", "alpha": "d.alpha", "beta": "d.beta", "offset_mm": "d.offset_mm"},
    "Design.with_theta": {"theta": "0.1"},
    "Design.poses": {"theta": "0.1"},
    "Design.fold": {"theta": "np.zeros(200000)", "threads": "1"},
    "Design.derivatives": {"theta": "0.1"},
    "Design.from_text": {"text": "d.text()", "folder": "''"},
    "fold_strips": {"beta": "np.zeros((200000, 5))", "theta": "0.1", "cell_mm": "1.0", "t": "None", "rows": "1", "out": "None",
                    "threads": "1"},
    "strip_derivatives": {"beta": "np.zeros((20000, 5))", "theta": "0.1", "cell_mm": "1.0", "rows": "1", "threads": "1"},
    "strip_gradients": {"beta": "np.zeros((10000, 5))", "theta": "0.1", "by_poses": "np.ones((10000, 12, 6))", "cell_mm": "1.0",
                        "rows": "1", "threads": "1"},
    "simulate": {"design": "d", "model": "'exact'", "theta": "None", "folder": "''", "threads": "1", "fidelity": "False",
                 "progress": "None"},
    "verify": {"design": "d", "folder": "''", "fidelity": "False", "progress": "None"},
    "optimise": {"target": "target", "folder": "''", "threads": "1", "seed": "0", "verify": "False", "prints": "0",
                 "fidelity": "False", "time_limit_s": "1.0", "progress": "None"},
    "export": {"design": "d", "formats": "['svg']", "folder": "'out'", "process": "''", "hinge": "''", "clearance_mm": "0",
               "cell_mm": "0", "bed_mm": "None", "loose_rods": "False", "folded": "False", "orient": "'flat'", "slice": "False",
               "caps": "False"},
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
design, name, keyword, odd, values = json.loads(sys.stdin.read())
target = {"kinetix": 1, "target": {"kind": "curve", "points": [[0, 0], [20, 5], [40, 0]]}, "structure": {"cells": [3, 1]}}
d = kinetix.Design(design)
function = kinetix
for part in name.split("."):
    function = getattr(d if function is kinetix.Design and part != "from_text" else function, part)
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
    def run_calls(self, name, keyword):
        given = json.dumps([strip(4, [5, 6, 7, 8]), name, keyword, ODD, CALLS[name]])
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
        for name in CALLS:
            for keyword in CALLS[name]:
                with self.subTest(name, keyword=keyword):
                    self.run_calls(name, keyword)


if __name__ == "__main__":
    unittest.main()
