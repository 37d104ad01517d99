"""Ctrl-C, sent to a separate program as a terminal sends it."""
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np

import kinetix

WAITS = """
import sys, time, kinetix
def error(poses):
    print("called", flush=True)
    time.sleep({seconds})
    return poses[-1, 0] - 50
goal = kinetix.Goal(error, 1e-9, columns=10, starts=50)
try:
    result = kinetix.optimise(goal, threads=2)
    print("stopped", result.stopped, result.agrees, len(result.poses))
except KeyboardInterrupt:
    print("KeyboardInterrupt")
"""

FOLDS = """
import kinetix
print("called", flush=True)
sheet = kinetix.Design({"kinetix": 1, "structure": {"cells": [40, 40], "cell_mm": 10}, "design": {"theta_deg": 30}})
try:
    print("done", kinetix.simulate(sheet, "bullet"))
except KeyboardInterrupt:
    print("KeyboardInterrupt")
"""


BATCH = """
import numpy as np, kinetix
out = np.zeros((20_000, 82, 7))
beta = np.zeros((20_000, 40))
print("called", flush=True)
try:
    for _ in range(10000):
        kinetix.fold_strips(beta, 0.4, out=out)
except KeyboardInterrupt:
    print("KeyboardInterrupt")
"""


def interrupted(script, times, calls=3):
    """Interrupts a program `times` times after `calls` lines of output. Returns its last line of output and its errors."""
    run = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(calls):
        run.stdout.readline()
    for _ in range(times):
        time.sleep(0.1)
        run.send_signal(signal.SIGINT)
    out, errors = run.communicate(timeout=100)
    return out.splitlines()[-1], errors


class Interrupts(unittest.TestCase):
    def test_the_first_gives_the_best_so_far(self):
        last, errors = interrupted(WAITS.format(seconds=0.01), 1, calls=40)
        self.assertEqual(last, "stopped True None 22")
        self.assertEqual(errors, "stopping and keeping the best result so far\n")

    def test_the_second_raises(self):
        last, errors = interrupted(WAITS.format(seconds=0.5), 2)
        self.assertEqual(last, "KeyboardInterrupt")

    def test_a_simulation_has_no_best_and_raises(self):
        last, errors = interrupted(FOLDS, 1, calls=1)
        self.assertEqual((last, errors), ("KeyboardInterrupt", ""))

    def test_a_batch_of_folds_raises(self):
        last, errors = interrupted(BATCH, 1, calls=1)
        self.assertEqual((last, errors), ("KeyboardInterrupt", ""))

    def test_other_threads_of_python_go_on_while_a_batch_folds(self):
        beats, ends = [], threading.Event()

        def heartbeat():
            while not ends.wait(0.001):
                beats.append(time.monotonic())

        heart = threading.Thread(target=heartbeat)
        heart.start()
        begin = time.monotonic()
        kinetix.fold_strips(np.zeros((60_000, 40)), 0.4, threads=1)
        end = time.monotonic()
        ends.set()
        heart.join()
        self.assertGreater(sum(begin < at < end for at in beats), 5)


if __name__ == "__main__":
    unittest.main()
