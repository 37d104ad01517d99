import json
import math
import unittest

import numpy as np
from support import SOURCE, Scratch

import kinetix

COLUMNS, CELL = 20, 10.0


def up(pose):
    """Third column of the rotation matrix."""
    w, x, y, z = pose[3:]
    return np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])


def quarter_pipe(poses):
    """How far the last body is from turned by 90 degrees against the first, and the sheet's height from nine tenths."""
    u = up(poses[-1])
    return [u[2], u[0] - 1, np.linalg.norm(poses[1, :3] - poses[0, :3]) / CELL - 0.9]


def quarter_pipe_gradient(poses):
    u = up(poses[-1])
    across = (poses[1, :3] - poses[0, :3]) / np.linalg.norm(poses[1, :3] - poses[0, :3])
    rates = np.zeros((3, len(poses), 6))
    rates[0, -1, 3:] = [u[1], -u[0], 0]
    rates[1, -1, 3:] = [0, u[2], -u[1]]
    rates[2, 0, :3], rates[2, 1, :3] = -across / CELL, across / CELL
    return rates


def goal(error=quarter_pipe, tolerance=1e-4, **options):
    return kinetix.Goal(error, tolerance, columns=COLUMNS, cell_mm=CELL, **options)


class Goals(Scratch):
    def test_a_gradient_is_compared_with_central_differences(self):
        self.assertLess(goal(gradient=quarter_pipe_gradient).gradient_error(), 1e-8)
        wrong = goal(gradient=lambda poses: 1.01 * quarter_pipe_gradient(poses))
        self.assertAlmostEqual(wrong.gradient_error(), 0.01, places=4)
        with self.assertRaisesRegex(kinetix.InvalidInput, "has no gradient to compare"):
            goal().gradient_error()
        with self.assertRaisesRegex(kinetix.InvalidInput, "states is 0, must be at least 1"):
            wrong.gradient_error(0)

    def test_the_search_finds_the_closed_form(self):
        """cos(theta) = 0.9; each of 20 columns turns by pi / 40: tan(pi / 80) = tan(tilt) sin(theta). Steeper tilts would turn
        the strip by 270 degrees the other way."""
        for gradient in (None, quarter_pipe_gradient):
            result = kinetix.optimise(goal(gradient=gradient, per="all", beta=(-0.2, 0.2)))
            self.assertTrue(result.met and result.agrees, result.summary())
            theta = math.acos(0.9)
            self.assertAlmostEqual(result.theta, theta, places=5)
            tilt = math.atan(math.tan(math.pi / 80) / math.sin(theta))
            tilts = result.design.beta[result.design.beta != 0]
            np.testing.assert_allclose(abs(tilts), tilt, atol=1e-5)

    def test_tilts_by_column_meet_the_goal_with_and_without_a_gradient(self):
        for gradient in (None, quarter_pipe_gradient):
            result = kinetix.optimise(goal(gradient=gradient))
            self.assertTrue(result.met and result.agrees, result.summary())
            self.assertLess(np.linalg.norm(quarter_pipe(result.poses)), 1e-4)
            self.assertLess(np.linalg.norm(quarter_pipe(result.design.poses(result.theta))), 1e-4)

    def test_the_answer_is_the_same_for_any_number_of_threads(self):
        one, two = (kinetix.optimise(goal(), threads=threads, seed=3, verify=False).poses for threads in (1, 2))
        np.testing.assert_array_equal(one, two)

    def test_the_error_sees_the_poses_that_the_result_has(self):
        seen = []

        def span(poses):
            seen.append(poses.copy())
            return np.linalg.norm(poses[-1, :3] - poses[0, :3]) - 120

        result = kinetix.optimise(goal(span, 1e-3))
        self.assertTrue(result.met, result.summary())
        self.assertEqual(seen[0].shape, (2 * (COLUMNS + 1), 7))
        self.assertTrue(any((poses == result.poses).all() for poses in seen))
        self.assertAlmostEqual(result.metrics["error"], abs(span(result.poses)), places=12)

    def test_a_goal_out_of_reach_is_missed_in_words(self):
        result = kinetix.optimise(goal(lambda poses: poses[-1, 0] - 1000, 1), verify=False)
        self.assertFalse(result.met)
        self.assertRegex(result.violations[0], "the error is .*; at most 1 is allowed")

    def test_every_solver_takes_it(self):
        for solver in ("ceres", "slsqp", "mma", "ccsa", "bobyqa", "cobyla"):
            result = kinetix.optimise(goal(per="all", solver=solver, tolerance=0.05, starts=3), verify=False)
            self.assertTrue(result.met, solver + ": " + result.summary())

    def test_exceptions_of_python_are_raised(self):
        calls = []

        def fails_later(poses):
            calls.append(1)
            return 1 / (5 - len(calls))

        with self.assertRaises(ZeroDivisionError):
            kinetix.optimise(goal(fails_later))
        with self.assertRaises(ZeroDivisionError):
            goal(lambda poses: 1 / 0)
        with self.assertRaisesRegex(KeyError, "of the gradient"):
            kinetix.optimise(goal(gradient=lambda poses: {}["of the gradient"]))

    def test_errors_of_the_wrong_shape_are_bad_input(self):
        with self.assertRaisesRegex(kinetix.InvalidInput, "the error must give numbers, not 'far'"):
            goal(lambda poses: "far")
        with self.assertRaisesRegex(kinetix.InvalidInput, "the error must give a number or a list"):
            goal(lambda poses: [])
        lengths = iter(range(1, 10000))
        with self.assertRaisesRegex(kinetix.InvalidInput, "numbers, and 1 before"):
            kinetix.optimise(goal(lambda poses: [0.5] * next(lengths)))
        with self.assertRaisesRegex(kinetix.InvalidInput, r"shape \(3, 42, 6\)"):
            kinetix.optimise(goal(gradient=lambda poses: np.zeros((3, 42))))
        with self.assertRaisesRegex(kinetix.InvalidInput, "no finite value at any start"):
            kinetix.optimise(goal(lambda poses: math.nan))

    def test_options_out_of_range_are_bad_input(self):
        for options, text in (({"theta": (0.5, 0.4)}, r"theta\[0\] is 0.5"), ({"columns": 1}, "columns is 1"),
                              ({"beta": (-2, 1)}, r"beta\[0\] is -2"), ({"per": "colum"}, "did you mean `column`"),
                              ({"solver": "newton"}, "allowed: ceres"), ({"tolerance": math.nan}, "tolerance is nan"),
                              ({"name": "a/b"}, "name: the name cannot be the name of a folder"), ({"starts": 0}, "starts"),
                              ({"wall_mm": (9.9, 6)}, "theta"), ({"wall_mm": (-1, 6)}, r"wall_mm\[0\] is -1"),
                              ({"wall_mm": (1, 0)}, r"wall_mm\[1\] is 0")):
            with self.assertRaisesRegex(kinetix.InvalidInput, text):
                kinetix.Goal(quarter_pipe, **{"tolerance": 1, "columns": COLUMNS, **options})

    def test_its_results_are_as_the_schema_has_them(self):
        result = kinetix.optimise(goal(name="quarter_pipe"))
        document = result.to_dict()
        schema = json.loads((SOURCE / "app/schema/result.schema.json").read_text())
        self.assertEqual([key for key in schema["required"] if key not in document], [])
        (target,) = [one for one in schema["properties"]["target"]["oneOf"]
                     if one.get("properties", {}).get("kind") == {"const": "own", "description": "the kind of goal"}]
        self.assertEqual(set(target["required"]), set(document["target"]))
        self.assertEqual(len(document["own"]["residuals"]), 3)
        self.assertEqual(document["own"]["reasons_physics"], [])
        self.assertEqual(len(document["optimiser"]["runs"]), 8)
        result.write(self.folder / "out")
        self.assertIn("quarter_pipe", (self.folder / "out/report.html").read_text())


if __name__ == "__main__":
    unittest.main()
