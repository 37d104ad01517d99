import json
import unittest

import numpy as np
from support import SOURCE, Scratch, half_circle, numbers_of, program, strip

import kinetix

CURVE = {"kinetix": 1, "name": "half_circle", "target": {"kind": "curve", "points": half_circle()},
         "structure": {"cells": [20, 1], "cell_mm": 11}}


class Runs(Scratch):
    def test_a_search_from_a_dict_equals_that_of_the_program(self):
        (self.folder / "half_circle.csv").write_text(
            "x,z\n" + "".join(f"{x!r},{z!r}\n" for x, z in half_circle()))
        file = self.folder / "half_circle.yaml"
        file.write_text("kinetix: 1\ntarget: {kind: curve, points: half_circle.csv}\n"
                        "structure: {cells: [20, 1], cell_mm: 11}\n")
        of_program = program(file, "-o", self.folder / "out")
        for result in (kinetix.optimise(CURVE), kinetix.optimise(file),
                       kinetix.optimise({**CURVE, "target": {"kind": "curve", "points": "half_circle.csv"}},
                                        folder=self.folder)):
            self.assertTrue(result.met and result.agrees and not result.stopped)
            self.assertEqual(numbers_of(of_program["states"][0]["poses"]), result.poses.tolist())
            self.assertEqual(of_program["metrics"]["shape_rms"], result.metrics["shape_rms"])
            self.assertEqual(result.name, "half_circle")

    def test_the_verdict_is_that_of_the_program(self):
        thin = {**CURVE, "structure": {"cells": [20, 1], "cell_mm": 11, "wall_mm": {"thickness": 0.3, "height": 6}}}
        for goal, code in ((CURVE, 0), (thin, 3)):
            result = kinetix.optimise(goal, verify=False)
            self.assertEqual(result.exit_code, code)
            verdict = result.verdict
            self.assertEqual(json.loads(json.dumps(verdict._asdict())) | {"problems": []},
                             result.to_dict()["verdict"] | {"problems": []})
            self.assertEqual([problem._asdict() for problem in verdict.problems], result.to_dict()["verdict"]["problems"])
            self.assertEqual((verdict.met, verdict.agrees, verdict.printable), (True, None, code == 0))
            self.assertEqual(any(problem.level == "error" for problem in verdict.problems), code == 3)
        forward = kinetix.verify(strip(6))
        self.assertEqual(forward.exit_code, 0)
        self.assertEqual((forward.met, forward.agrees, forward.verdict.printable), (None, True, None))

    def test_the_same_seed_gives_the_same_answer_for_any_number_of_threads(self):
        one, two = (kinetix.optimise(CURVE, threads=threads, verify=False).poses for threads in (1, 2))
        np.testing.assert_array_equal(one, two)

    def test_arrays_are_views_that_keep_the_run_alive(self):
        state = kinetix.simulate(strip(6)).state()
        poses, positions, rotations = state.poses, state.positions, state.rotations
        self.assertIs(type(poses.base), type(state._core))
        self.assertEqual(state.poses.ctypes.data, poses.ctypes.data)
        self.assertEqual(state.positions.ctypes.data, positions.ctypes.data)
        self.assertFalse(poses.flags.writeable or positions.flags.writeable or poses.flags.owndata)
        kept = poses.copy()
        del state
        np.testing.assert_array_equal(poses, kept)
        np.testing.assert_array_equal(positions, kept[:, :3])
        w, x, y, z = kept[:, 3:].T
        np.testing.assert_allclose(rotations[:, 0, 1], 2 * (x * y - w * z), atol=1e-15)
        np.testing.assert_allclose(rotations[:, 2, 0], 2 * (x * z - w * y), atol=1e-15)
        np.testing.assert_allclose(rotations @ rotations.transpose(0, 2, 1), np.broadcast_to(np.eye(3), (14, 3, 3)),
                                   atol=1e-14)

    def test_every_model_comes_to_the_same_planar_strip(self):
        states = {model: kinetix.simulate(strip(4), model).state(model).poses
                  for model in ("exact", "equilibrium", "bullet")}
        between = [np.linalg.norm(p[:, None, :3] - p[None, :, :3], axis=2) for p in states.values()]
        np.testing.assert_allclose(between[1], between[0], atol=1e-3)
        np.testing.assert_allclose(between[2], between[0], atol=1e-6)

    def test_the_path_of_an_equilibrium_follows_the_closed_form(self):
        """4 x 4 cells between plates: 40 hinges of 0.1 N mm/rad turn by 2 theta."""
        result = kinetix.simulate({"kinetix": 1, "structure": {"cells": [4, 4], "cell_mm": 10},
                                   "drive": {"kind": "plates", "axis": "y", "compression": 0.1},
                                   "hinge": {"model": "elastic", "k_point": 1000, "k_turn": 0.1}}, "equilibrium")
        self.assertTrue(result.reached)
        theta = np.arccos(0.9)
        self.assertAlmostEqual(result.path["energy"][-1], 8 * theta**2, delta=2e-3 * 8 * theta**2)
        self.assertAlmostEqual(result.path["load"][-1], 0.4 * theta / np.sin(theta), delta=1e-3)
        self.assertAlmostEqual(result.path["drive"][-1], 0.1, places=12)

    def test_a_path_is_none_without_an_equilibrium(self):
        result = kinetix.simulate(strip(4))
        self.assertIsNone(result.path)
        self.assertIsNone(result.reached)
        self.assertIsNone(result.agrees)
        self.assertIsNone(result.met)
        with self.assertRaisesRegex(KeyError, "there are: exact"):
            result.state("bullet")

    def test_verify_judges_a_result_and_a_design_alike(self):
        found = kinetix.optimise(CURVE, verify=False)
        self.assertIsNone(found.agrees)
        self.assertTrue(kinetix.verify(found).agrees)
        self.assertTrue(kinetix.verify(found.design).agrees)

    def test_the_design_of_a_result_has_its_hinges(self):
        found = kinetix.optimise(CURVE, verify=False)
        np.testing.assert_array_equal(found.design.poses(found.theta), found.poses)

    def test_writes_the_files_of_the_program(self):
        result = kinetix.simulate(strip(4))
        result.write(self.folder / "out")
        written = json.loads((self.folder / "out/result.json").read_text())
        self.assertEqual(numbers_of(written["states"][0]["poses"]), result.poses.tolist())
        self.assertEqual(written["schema"], "kinetix-result/1")
        self.assertTrue((self.folder / "out/report.html").exists())
        self.assertEqual((self.folder / "out/design.yaml").read_text(), result.design.text())
        self.assertEqual(result.to_dict()["structure"], written["structure"])

    def test_export_writes_files_of_every_body(self):
        made = kinetix.export(strip(4, cell_mm=16), ["stl", "dxf"], self.folder / "print", process="fdm")
        self.assertEqual(made.print["bodies"], 10)
        self.assertEqual(sorted(made.files), sorted(p.name for p in (self.folder / "print").iterdir()))
        self.assertEqual(list(made.print["slicer_settings"]), ["prusa", "orca", "bambu", "cura"])
        cura = kinetix.export(strip(4, cell_mm=16), "3mf", self.folder / "cura", process="fdm", slicer="cura")
        self.assertEqual(list(cura.print["slicer_settings"]), ["cura"])
        with self.assertRaisesRegex(kinetix.InvalidInput, "unknown .*`slt`.*did you mean `stl`"):
            kinetix.export(strip(4), "slt", self.folder / "none")
        for lengths, text in (({"cell_mm": -5}, "cell_mm is -5"), ({"clearance_mm": 50}, "clearance_mm is 50"),
                              ({"bed_mm": (250,)}, "bed_mm must be two lengths"), ({"bed_mm": (250, 0)}, "bed_mm is 0")):
            with self.assertRaisesRegex(kinetix.InvalidInput, text):
                kinetix.export(strip(4), "stl", self.folder / "none", **lengths)
        self.assertFalse((self.folder / "none").exists())

    def test_bad_models_and_options_are_refused(self):
        with self.assertRaisesRegex(kinetix.InvalidInput, "allowed: exact, equilibrium, rigid_body"):
            kinetix.simulate(strip(4), "newton")
        with self.assertRaisesRegex(kinetix.InvalidInput, "theta is 3"):
            kinetix.simulate(strip(4), theta=3)
        with self.assertRaisesRegex(kinetix.InvalidInput, "time_limit_s is 0"):
            kinetix.optimise(CURVE, time_limit_s=0)
        with self.assertRaisesRegex(kinetix.InvalidInput, "this file is a design, not a target"):
            kinetix.optimise(strip(4))

    def test_errors_found_after_reading_name_the_file(self):
        file = self.folder / "sheet.yaml"
        file.write_text("kinetix: 1\nstructure: {cells: [3, 3], cell_mm: 10}\n"
                        "design: {hinges: [{wall: [[1, 1], [2, 1]], beta_deg: 20}]}\n")
        with self.assertRaises(kinetix.InvalidInput) as caught:
            kinetix.simulate(file)
        self.assertEqual(caught.exception.file, str(file))

    def test_progress_is_heard_and_its_errors_end_the_run(self):
        received = []
        kinetix.optimise(CURVE, progress=lambda stage, done, words: received.append((stage, done)))
        self.assertIn("search", [stage for stage, _ in received])
        self.assertTrue(all(done is None or 0 <= done <= 1 for _, done in received), received)

        def fails(stage, done, words):
            raise ZeroDivisionError("of the listener")

        with self.assertRaisesRegex(ZeroDivisionError, "of the listener"):
            kinetix.optimise(CURVE, progress=fails)

    def test_a_time_limit_keeps_the_best_so_far(self):
        result = kinetix.optimise(SOURCE / "targets/shapes/headform.yaml", time_limit_s=0.05)
        self.assertTrue(result.stopped)
        self.assertIsNone(result.agrees)


if __name__ == "__main__":
    unittest.main()
