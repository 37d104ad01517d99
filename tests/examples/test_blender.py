"""Tests the script for Blender in Blender without a window: objects are at the positions of result.json at every
step."""
import json
import os
import pathlib
import re
import shutil
import tempfile
import unittest

from support import PROGRAM, SOURCE, command_output

SCRIPT = SOURCE / "examples/blender/kinetix_to_blender.py"
SHAPES = SOURCE / "targets/shapes"
BLENDER = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python"]
IS_LONG = "KINETIX_SOAK" in os.environ  # the long proof (make soak) makes the shipped helmet of 844 bodies
AS_FILED = 1e-5  # mm
ROUNDING = 2**-24  # relative error of the 32-bit numbers in Blender: 7.6e-6 mm at 128 mm, more than AS_FILED beyond 256 mm


def matrix_of(pose):
    w, x, y, z = pose["quaternion_wxyz"]
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return [row + [p] for row, p in zip(rows, pose["position_mm"])]


def scene_made(folder, target, *options, verify=False):
    """Makes SCENE.blend of a result in a folder. Returns the result and what the script printed."""
    folder.mkdir()
    command_output(PROGRAM, target, "-o", folder, "--quiet", *([] if verify else ["--no-verify"]))
    said = command_output(*BLENDER, SCRIPT, "--", folder / "result.json", "-o", folder / "scene.blend", *options)
    return json.loads((folder / "result.json").read_text()), said


@unittest.skipUnless(shutil.which("blender"), "no Blender here")
class Blender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Makes two scenes and opens both in one Blender, whose start takes longer."""
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        helmet = cls.folder / "helmet.yaml"
        text = (SHAPES / "headform.yaml").read_text().replace("headform.obj", str(SHAPES / "headform.obj"))
        helmet.write_text(text if IS_LONG else text.replace("ribs: 8", "ribs: 2").replace("cell_mm: 6", "cell_mm: 10"))
        cls.helmet, cls.said = scene_made(cls.folder / "helmet", helmet)
        cls.arch, _ = scene_made(cls.folder / "arch", SHAPES / "half_circle.yaml", "--model", "bullet", verify=True)
        command_output(*BLENDER, SOURCE / "tests/examples/blender_scene.py", "--",
                *(cls.folder / name / "scene.blend" for name in ("helmet", "arch")))
        cls.helmet_scene, cls.arch_scene = (json.loads((cls.folder / name / "scene.json").read_text())
                                            for name in ("helmet", "arch"))

    def expect_poses(self, objects, state, when):
        for thing, pose in zip(objects, state["poses"]):
            for row, expected in zip(thing["matrices"][when], matrix_of(pose)):
                self.assertAlmostEqual(row[3], expected[3], delta=max(AS_FILED, ROUNDING * abs(expected[3])))
                for number, wanted in zip(row[:3], expected[:3]):
                    self.assertAlmostEqual(number, wanted, delta=1e-6)

    def objects_of(self, result, scene):
        """Returns the objects in the order of the result's bodies."""
        names = ["body " + "_".join(map(str, body["vertex"])) for body in result["structure"]["bodies"]]
        return sorted(scene["objects"], key=lambda thing: names.index(thing["name"]))

    def test_a_helmet_stands_where_the_result_says(self):
        result, objects = self.helmet, self.objects_of(self.helmet, self.helmet_scene)
        self.assertEqual(len(objects), len(result["structure"]["bodies"]))
        self.assertEqual(len(objects) == 844, IS_LONG)
        self.assertGreater(len(objects), 80)
        frames = [state for state in result["states"] if state["name"] == "frame"]
        self.expect_poses(objects, frames[0], 0)
        self.expect_poses(objects, frames[-1], 2)
        if len(frames) % 2:
            self.expect_poses(objects, frames[len(frames) // 2], 1)
        self.assertEqual(round(self.helmet_scene["scale"], 9), 0.001)
        print(re.search(r"kinetix: .*", self.said).group())  # reports the time; not a test of speed

    def test_bodies_are_closed_and_as_large_as_their_half_walls(self):
        structure, things = self.arch["structure"], self.arch_scene["objects"]
        wall = structure["wall_mm"]
        whole = structure["cell_mm"] * wall["thickness"] * wall["height"] * len(structure["hinges"])
        self.assertAlmostEqual(sum(thing["volume_mm3"] for thing in things), whole, delta=1e-5 * whole)
        self.assertTrue(all(thing["closed"] and thing["volume_mm3"] > 0 for thing in things))

    def test_the_physics_run_can_be_the_end_of_the_motion(self):
        (bullet,) = [state for state in self.arch["states"] if state["model"] == "bullet"]
        self.expect_poses(self.objects_of(self.arch, self.arch_scene), bullet, 2)

    def test_invalid_results_are_refused_and_nothing_is_written(self):
        wrong = self.folder / "wrong.json"
        wrong.write_text('{"schema": "kinetix-print/1"}')
        said = command_output(*BLENDER, SCRIPT, "--", wrong, "-o", self.folder / "scene.blend", expected=1)
        self.assertIn("wrong.json is no result of kinetix", said)
        self.assertFalse((self.folder / "scene.blend").exists())


if __name__ == "__main__":
    unittest.main()
