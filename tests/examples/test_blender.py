"""Tests the script for Blender in Blender without a window: objects are at the positions of result.json at every
step."""
import json
import re
import shutil
import unittest

from support import PROGRAM, SOURCE, Scratch, command_output

SCRIPT = SOURCE / "examples/blender/kinetix_to_blender.py"
AS_FILED = 1e-5  # mm
ROUNDING = 2**-24  # relative error of the 32-bit numbers in Blender: 7.6e-6 mm at 128 mm, more than AS_FILED beyond 256 mm


def matrix_of(pose):
    w, x, y, z = pose["quaternion_wxyz"]
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return [row + [p] for row, p in zip(rows, pose["position_mm"])]


@unittest.skipUnless(shutil.which("blender"), "no Blender here")
class Blender(Scratch):
    def scene_of(self, target, *options, verify=False):
        command_output(PROGRAM, SOURCE / "targets/shapes" / target, "-o", self.folder, "--quiet", *([] if verify else ["--no-verify"]))
        self.said = command_output("blender", "-b", "--factory-startup", "--python-exit-code", 1, "--python", SCRIPT, "--",
                            self.folder / "result.json", "-o", self.folder / "scene.blend", *options)
        command_output("blender", "-b", self.folder / "scene.blend", "--python-exit-code", 1, "--python",
                SOURCE / "tests/examples/blender_scene.py", "--", self.folder / "scene.json")
        return (json.loads((self.folder / "result.json").read_text()), json.loads((self.folder / "scene.json").read_text()))

    def expect_poses(self, objects, state, when):
        for thing, pose in zip(objects, state["poses"]):
            for row, expected in zip(thing["matrices"][when], matrix_of(pose)):
                self.assertAlmostEqual(row[3], expected[3], delta=max(AS_FILED, ROUNDING * abs(expected[3])))
                for number, wanted in zip(row[:3], expected[:3]):
                    self.assertAlmostEqual(number, wanted, delta=1e-6)

    def test_a_helmet_of_844_bodies_stands_where_the_result_says(self):
        result, scene = self.scene_of("headform.yaml")
        objects = scene["objects"]
        self.assertEqual(len(objects), 844)
        self.assertEqual(len(result["structure"]["bodies"]), 844)
        frames = [state for state in result["states"] if state["name"] == "frame"]
        names = ["body " + "_".join(map(str, body["vertex"])) for body in result["structure"]["bodies"]]
        objects.sort(key=lambda thing: names.index(thing["name"]))
        self.expect_poses(objects, frames[0], 0)
        self.expect_poses(objects, frames[-1], 2)
        if len(frames) % 2:
            self.expect_poses(objects, frames[len(frames) // 2], 1)
        self.assertEqual(round(scene["scale"], 9), 0.001)
        print(re.search(r"kinetix: .*", self.said).group())  # reports the time; not a test of speed

    def test_bodies_are_closed_and_as_large_as_their_half_walls(self):
        result, scene = self.scene_of("half_circle.yaml")
        structure, wall = result["structure"], result["structure"]["wall_mm"]
        whole = structure["cell_mm"] * wall["thickness"] * wall["height"] * len(structure["hinges"])
        self.assertAlmostEqual(sum(thing["volume_mm3"] for thing in scene["objects"]), whole, delta=1e-5 * whole)
        self.assertTrue(all(thing["closed"] and thing["volume_mm3"] > 0 for thing in scene["objects"]))

    def test_the_physics_run_can_be_the_end_of_the_motion(self):
        result, scene = self.scene_of("half_circle.yaml", "--model", "bullet", verify=True)
        (bullet,) = [state for state in result["states"] if state["model"] == "bullet"]
        names = ["body " + "_".join(map(str, body["vertex"])) for body in result["structure"]["bodies"]]
        scene["objects"].sort(key=lambda thing: names.index(thing["name"]))
        self.expect_poses(scene["objects"], bullet, 2)

    def test_invalid_results_are_refused_and_nothing_is_written(self):
        wrong = self.folder / "wrong.json"
        wrong.write_text('{"schema": "kinetix-print/1"}')
        said = command_output("blender", "-b", "--factory-startup", "--python-exit-code", 1, "--python", SCRIPT, "--", wrong, "-o",
                       self.folder / "scene.blend", expected=1)
        self.assertIn("wrong.json is no result of kinetix", said)
        self.assertFalse((self.folder / "scene.blend").exists())


if __name__ == "__main__":
    unittest.main()
