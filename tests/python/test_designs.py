import json
import pickle
import unittest

import numpy as np
from support import SOURCE, Scratch, numbers_of, program, strip

import kinetix


class Designs(Scratch):
    def test_a_dict_is_the_same_as_its_file(self):
        design = kinetix.Design(strip(6, [10, -10, 10, -10, 10, -10], theta_deg=25))
        file = self.folder / "strip.yaml"
        design.save(file)
        read = kinetix.Design(file)
        self.assertEqual(read.name, "design")
        np.testing.assert_array_equal(read.beta, design.beta)
        np.testing.assert_array_equal(read.poses(), design.poses())
        self.assertEqual((design.bodies, design.hinges, design.cells, design.cell_mm, design.family), (14, 19, 6, 10, "F2"))

    def test_errors_of_a_file_have_file_line_column_and_key(self):
        file = self.folder / "bad.yaml"
        file.write_text("kinetix: 1\nstructure:\n  cells: [2, -1]\n")
        with self.assertRaises(kinetix.InvalidInput) as caught:
            kinetix.Design(file)
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column, error.key), (str(file), 3, 14, "structure.cells[1]"))
        self.assertEqual(str(error), f"{file}:3:14: structure.cells[1]: {error.reason}")
        self.assertIsInstance(error, ValueError)
        self.assertEqual(vars(pickle.loads(pickle.dumps(error))), vars(error))

    def test_errors_of_a_dict_have_its_key_and_no_lines(self):
        with self.assertRaises(kinetix.InvalidInput) as caught:
            kinetix.Design({"kinetix": 1, "structure": {"cels": [6, 1]}})
        error = caught.exception
        self.assertEqual((error.file, error.line, error.key), ("", 0, "structure.cels"))
        self.assertTrue(str(error).startswith("structure.cels: unknown key (did you mean `cells`?)"), error)

    def test_values_no_file_can_hold_are_refused_with_their_place(self):
        for value, text in ((float("nan"), "structure.cell_mm: is nan"), (None, "structure.cell_mm: is None"),
                            ("10", "structure.cell_mm: is in quotes")):
            with self.assertRaisesRegex(kinetix.InvalidInput, text):
                kinetix.Design({"kinetix": 1, "structure": {"cells": [6, 1], "cell_mm": value}})
        with self.assertRaisesRegex(kinetix.InvalidInput, "keys are plain words"):
            kinetix.Design({"kinetix": 1, "a: b": 1})

    def test_a_missing_file_is_bad_input(self):
        with self.assertRaisesRegex(kinetix.InvalidInput, "nowhere.yaml"):
            kinetix.Design(self.folder / "nowhere.yaml")

    def test_hinges_change_in_a_copy_alone(self):
        flat = kinetix.Design(strip(4))
        tilted = flat.with_hinges(beta=np.linspace(-0.1, 0.1, flat.hinges))
        self.assertEqual(np.count_nonzero(flat.beta), 0)
        np.testing.assert_array_equal(tilted.beta, np.linspace(-0.1, 0.1, flat.hinges))
        with self.assertRaisesRegex(kinetix.InvalidInput, "one number per hinge, 13 in all"):
            flat.with_hinges(beta=[0.1])
        with self.assertRaisesRegex(kinetix.InvalidInput, "beta"):
            flat.with_hinges(beta=np.full(flat.hinges, 2.0))

    def test_writes_into_a_design_are_errors(self):
        design = kinetix.Design(strip(4, [5, 6, 7, 8]))
        for name in ("t", "alpha", "beta", "offset_mm", "rest_positions", "hinge_points", "hinge_axes", "hinge_bodies"):
            with self.subTest(name), self.assertRaises(ValueError):
                getattr(design, name)[0] = 0.5
        for name in ("tetha", "theta", "beta"):
            with self.subTest(name), self.assertRaises(AttributeError):
                setattr(design, name, 1)

    def test_made_hinges_may_be_off_their_wall(self):
        made = kinetix.Design({**strip(4), "hinge": {"kind": "pin", "diameter_mm": 1.5, "clearance_mm": 0.2}})
        self.assertEqual(made.with_hinges(offset_mm=np.full(made.hinges, 3.0)).offset_mm[0], 3)

    def test_a_sheet_without_closed_form_says_why(self):
        sheet = kinetix.Design({"kinetix": 1, "structure": {"cells": [3, 3], "cell_mm": 10},
                                "design": {"hinges": [{"wall": [[1, 1], [2, 1]], "beta_deg": 20}]}})
        self.assertFalse(sheet.is_exact)
        with self.assertRaisesRegex(kinetix.InvalidInput, "no exact family"):
            sheet.poses(0.3)

    def test_many_angles_of_any_exact_sheet_equal_one_at_a_time(self):
        angles = np.linspace(-0.5, 0.5, 21)
        for name in ("rosette", "twist_sheet"):
            file = SOURCE / "targets/shapes" / f"{name}.yaml"
            if not file.exists():
                continue
            design = kinetix.Design(file)
            poses = design.fold(angles)
            self.assertEqual(poses.shape, (21, design.bodies, 7))
            for k, theta in enumerate(angles):
                np.testing.assert_array_equal(poses[k], design.poses(theta))

    def test_hinges_close_in_the_poses(self):
        """Each hinge point, carried by its two bodies, is one point."""
        design = kinetix.Design(strip(8, [12, -7, 9, -3, 14, -12, 5, -8], theta_deg=30))
        poses = design.poses()
        lower, upper = design.hinge_bodies.T
        carried = [carry(poses[b], design.hinge_points - design.rest_positions[b]) for b in (lower, upper)]
        np.testing.assert_allclose(carried[0], carried[1], atol=1e-12)

    def test_derivatives_by_tilts_and_theta_are_those_of_central_differences(self):
        tilts, step = np.array([12.0, -7, 9, -3]), 1e-4
        sheet = kinetix.Design(strip(4, tilts, theta_deg=30))
        names, rates = sheet.derivatives()
        self.assertEqual(rates.shape, (len(names), sheet.bodies, 6))
        for c in range(4):
            two = [kinetix.Design(strip(4, tilts + sign * step * np.eye(4)[c], theta_deg=30)).poses() for sign in (1, -1)]
            by_beta = (two[0][:, :3] - two[1][:, :3]) / (2 * np.deg2rad(step))
            np.testing.assert_allclose(rates[names.index(f"beta[{c}]"), :, :3], by_beta, atol=1e-5)
        theta = np.deg2rad(30)
        by_theta = (sheet.poses(theta + 1e-6) - sheet.poses(theta - 1e-6))[:, :3] / 2e-6
        np.testing.assert_allclose(rates[names.index("theta"), :, :3], by_theta, atol=1e-7)

    def test_derivatives_by_the_places_of_hinges_are_those_of_central_differences(self):
        """Column 1 and row 0 of an upright sheet: from the lower body, hinges are at t of class A or at 1 - t of class B."""
        sheet = kinetix.Design({"kinetix": 1, "structure": {"cells": [[0, 0], [1, 0], [1, 1]], "cell_mm": 5}}).with_theta(0.4)
        names, rates = sheet.derivatives()
        for name, along, line in (("t[1]", 0, 1), ("s[0]", 1, 0)):
            two = []
            for sign in (1, -1):
                t = sheet.t.copy()
                for hinge, wall in enumerate(sheet.walls):
                    a, b = json.loads(wall)
                    if b[along] > a[along] and a[along] == line:
                        t[hinge] += sign * 1e-6 * (1 if sum(a) % 2 == 0 else -1)
                two.append(sheet.with_hinges(t=t).poses(0.4)[:, :3])
            np.testing.assert_allclose(rates[names.index(name), :, :3], (two[0] - two[1]) / 2e-6, atol=1e-7)

    def test_other_sheets_have_no_such_derivatives(self):
        with self.assertRaisesRegex(kinetix.InvalidInput, "families F1, F2 and F3"):
            kinetix.Design(SOURCE / "targets/shapes/rosette.yaml").derivatives(0.1)

    def test_designs_go_to_other_processes(self):
        sheet = kinetix.Design(strip(4, [12, -7, 9, -3], theta_deg=30))
        copy = pickle.loads(pickle.dumps(sheet))
        self.assertEqual(copy, sheet)
        self.assertNotEqual(copy, sheet.with_theta(0.1))
        np.testing.assert_array_equal(copy.poses(), sheet.poses())

    def test_theta_is_that_of_the_program(self):
        file = self.folder / "strip.yaml"
        kinetix.Design(strip(5, theta_deg=17)).save(file)
        states = program("simulate", file, "--theta-deg", 33, "-o", self.folder / "out")["states"]
        poses = kinetix.simulate(file, theta=np.deg2rad(33)).poses
        np.testing.assert_allclose(numbers_of(states[0]["poses"]), poses, atol=1e-13)


def carry(poses, arms):
    """Points by their places relative to bodies at rest."""
    w, v = poses[:, 3:4], poses[:, 4:]
    twice = 2 * np.cross(v, arms)
    return poses[:, :3] + arms + w * twice + np.cross(v, twice)


if __name__ == "__main__":
    unittest.main()
