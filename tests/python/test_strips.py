import concurrent.futures
import json
import math
import multiprocessing
import unittest

import numpy as np
from support import Scratch, numbers_of, program

import kinetix

SEED = 20
print("seed", SEED)


def random_strips(count, columns):
    rng = np.random.default_rng(SEED)
    return rng.uniform(-0.6, 0.6, (count, columns)), rng.uniform(-0.7, 0.7, count)


def as_design(beta, theta, cell_mm, t=None):
    """Returns a strip as a design with all its hinges."""
    sheet = kinetix.Design({"kinetix": 1, "structure": {"cells": [len(beta), 1], "cell_mm": cell_mm}})
    tilts, fractions = sheet.beta.copy(), sheet.t.copy()
    for hinge, wall in enumerate(sheet.walls):
        (i, j), (to, _) = json.loads(wall)
        if to > i:
            tilts[hinge] = -beta[i] if j else beta[i]
            if t is not None:
                fractions[hinge] = 1 - t[i] if j else t[i]
    return sheet.with_hinges(t=fractions, beta=tilts).with_theta(theta)


class Strips(Scratch):
    def state_of(self, file):
        """The state that the program simulates. Strips that roll up so far that their walls meet are bad ends, but have poses."""
        result = program("simulate", file, "-o", self.folder / "out", expected=(0, 3))
        flags = [flag for flag in ("met", "agrees", "printable", "reaches") if result["verdict"][flag] is False]
        errors = [problem["text"] for problem in result["verdict"]["problems"] if problem["level"] == "error"]
        if flags:
            self.assertEqual(flags, ["reaches"])
            self.assertRegex(errors[0], "^walls .* overlap at")
        return result["states"][0]

    def test_poses_equal_those_of_the_program_to_the_last_bit(self):
        beta, theta = random_strips(4, 40)
        poses = kinetix.fold_strips(beta, theta, 8.1)
        for k in range(len(theta)):
            file = self.folder / "design.yaml"
            as_design(beta[k], theta[k], 8.1).save(file)
            self.assertEqual(numbers_of(self.state_of(file)["poses"]), poses[k].tolist())

    def test_columns_that_shear_equal_those_of_the_program_too(self):
        beta, theta = random_strips(3, 12)
        beta[:, ::3] = 0
        t = np.full(beta.shape, 0.5)
        t[:, ::3] = np.random.default_rng(SEED + 1).uniform(0.3, 0.7, t[:, ::3].shape)
        poses = kinetix.fold_strips(beta, theta, 5, t=t)
        for k in range(len(theta)):
            file = self.folder / "design.yaml"
            as_design(beta[k], theta[k], 5, t[k]).save(file)
            self.assertEqual(numbers_of(self.state_of(file)["poses"]), poses[k].tolist())

    def test_threads_and_rows_of_the_batch_change_nothing(self):
        beta, theta = random_strips(101, 7)
        one = kinetix.fold_strips(beta, theta, 3, rows=2, threads=1)
        self.assertEqual(one.shape, (101, 24, 7))
        np.testing.assert_array_equal(one, kinetix.fold_strips(beta, theta, 3, rows=2, threads=2))
        np.testing.assert_array_equal(one[50:51], kinetix.fold_strips(beta[50:51], theta[50:51], 3, rows=2))

    def test_processes_that_are_forked_later_fold_as_well(self):
        beta, theta = random_strips(5000, 20)
        here = kinetix.fold_strips(beta, theta, 3, threads=2)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            there = pool.starmap_async(kinetix.fold_strips, [(beta[:2500], theta[:2500], 3), (beta[2500:], theta[2500:], 3)])
            np.testing.assert_array_equal(here, np.concatenate(there.get(timeout=60)))

    def test_threads_of_python_simulate_at_once(self):
        designs = [as_design(*strip, 8) for strip in zip(*random_strips(8, 10))]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            together = list(pool.map(lambda design: kinetix.simulate(design, "bullet").poses, designs))
        for design, poses in zip(designs, together):
            np.testing.assert_array_equal(poses, design.poses())

    def test_writes_into_an_array_of_the_caller(self):
        beta, theta = random_strips(5, 6)
        out = np.zeros((5, 14, 7))
        self.assertIs(kinetix.fold_strips(beta, theta, 3, out=out), out)
        np.testing.assert_array_equal(out, kinetix.fold_strips(beta, theta, 3))

    def test_an_arch_of_like_tilts_lies_on_a_circle(self):
        """Each column turns by 2 atan(tan(beta) sin(theta)), and its chord is cos(theta) cos(half turn) cells long."""
        beta, theta, cell = 0.2, 0.5, 10.0
        signs = np.array([1, -1] * 10)
        poses = kinetix.fold_strips([signs * beta], theta, cell)[0]
        half = math.atan(math.tan(beta) * math.sin(theta))
        line = (poses[0::2, :3] + poses[1::2, :3]) / 2
        chords = np.diff(line, axis=0)
        lengths = np.linalg.norm(chords, axis=1)
        np.testing.assert_allclose(lengths, cell * math.cos(theta) * math.cos(half), rtol=1e-12)
        turns = np.arccos(np.clip(np.sum(chords[1:] * chords[:-1], axis=1) / (lengths[1:] * lengths[:-1]), -1, 1))
        np.testing.assert_allclose(turns, 2 * half, rtol=1e-6)

    def test_derivatives_are_those_of_central_differences(self):
        beta, theta = random_strips(3, 5)
        poses, rates = kinetix.strip_derivatives(beta, theta, 4, rows=2)
        np.testing.assert_array_equal(poses, kinetix.fold_strips(beta, theta, 4, rows=2))
        self.assertEqual(rates.shape, (3, 6, 18, 6))
        step = 1e-6
        for c in range(6):
            change = np.zeros(6)
            change[c] = step
            after = kinetix.fold_strips(beta + change[:5], theta + change[5], 4, rows=2)
            before = kinetix.fold_strips(beta - change[:5], theta - change[5], 4, rows=2)
            shift = (after[..., :3] - before[..., :3]) / (2 * step)
            np.testing.assert_allclose(rates[:, c, :, :3], shift, atol=1e-8)
            turn = [[rotation_between(a, b) / (2 * step) for a, b in zip(x, y)] for x, y in zip(before, after)]
            np.testing.assert_allclose(rates[:, c, :, 3:], turn, atol=1e-8)

    def test_gradients_are_sums_of_derivatives(self):
        beta, theta = random_strips(4, 5)
        by_poses = np.random.default_rng(3).normal(size=(4, 18, 6))
        _, rates = kinetix.strip_derivatives(beta, theta, 4, rows=2)
        gradients = kinetix.strip_gradients(beta, theta, by_poses, 4, rows=2)
        np.testing.assert_allclose(gradients, np.einsum("kpbi,kbi->kp", rates, by_poses), rtol=1e-12, atol=1e-12)
        np.testing.assert_array_equal(gradients, kinetix.strip_gradients(beta, theta, by_poses, 4, rows=2, threads=1))

    def test_says_which_entry_is_out_of_range(self):
        beta, theta = random_strips(3, 4)
        beta[1, 2] = math.nan
        with self.assertRaisesRegex(kinetix.InvalidInput, r"beta\[1, 2\] is nan, must be within \(-pi/2, pi/2\) rad"):
            kinetix.fold_strips(beta, theta)
        with self.assertRaisesRegex(kinetix.InvalidInput, r"theta\[0\] is 2, must be within"):
            kinetix.fold_strips(np.zeros((1, 3)), 2.0)
        with self.assertRaisesRegex(kinetix.InvalidInput, "theta must be one angle a strip, 3 in all"):
            kinetix.fold_strips(np.zeros((3, 2)), [0.1, 0.2])
        with self.assertRaisesRegex(kinetix.InvalidInput, r"t\[0, 1\] is 0.4, must be 0.5 in a column that is tilted"):
            kinetix.fold_strips([[0.1, 0.1]], 0.2, t=[[0.5, 0.4]])
        with self.assertRaisesRegex(kinetix.InvalidInput, r"out must be a writable array .* of shape \(1, 6, 7\)"):
            kinetix.fold_strips([[0.1, 0.1]], 0.2, out=np.zeros((1, 6, 6)))
        with self.assertRaisesRegex(kinetix.InvalidInput, r"by_poses must be of shape \(1, 6, 6\)"):
            kinetix.strip_gradients([[0.1, 0.1]], 0.2, np.zeros((1, 6, 7)))
        with self.assertRaisesRegex(kinetix.InvalidInput, "cell_mm is 0, must be positive"):
            kinetix.fold_strips([[0.1, 0.1]], 0.2, 0)


def rotation_between(before, after):
    """Returns the small turn from one pose to the next, as a vector in space."""
    w, v = before[3], before[4:7]
    W, V = after[3], after[4:7]
    return 2 * (w * V - W * v - np.cross(V, v)) * np.sign(w * W + v @ V)


if __name__ == "__main__":
    unittest.main()
