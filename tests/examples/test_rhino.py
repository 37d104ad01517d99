"""Tests the script for Rhino and Grasshopper in plain Python: all of it except the objects of Rhino."""
import functools
import importlib.util
import json
import math
import pathlib
import sys
import tempfile
import unittest

from support import PROGRAM, SOURCE, Scratch, command_output

sys.path.insert(0, str(SOURCE / "examples"))
import kinetix_reader as reader  # noqa: E402

spec = importlib.util.spec_from_file_location("script", SOURCE / "examples/rhino/kinetix_to_grasshopper.py")
script = importlib.util.module_from_spec(spec)
spec.loader.exec_module(script)


def volume(corners, sides):
    """Computes the volume of a closed surface. Its sides are counter-clockwise seen from outside."""
    total = 0
    for side in sides:
        a = corners[side[0]]
        for p, q in zip(side[1:], side[2:]):
            total += reader.dot(a, reader.cross(corners[p], corners[q])) / 6
    return total


def distance(a, b):
    return math.dist(a, b)


@functools.cache
def result_text(target):
    """Returns the result of a shipped target, which the tests share."""
    with tempfile.TemporaryDirectory() as folder:
        command_output(PROGRAM, SOURCE / "targets/shapes" / target, "-o", folder, "--quiet", "--no-verify")
        return (pathlib.Path(folder) / "result.json").read_text()


class Rhino(Scratch):
    def result_of(self, target):
        file = self.folder / "result.json"
        file.write_text(result_text(target))
        self.document = json.loads(file.read_text())
        return reader.Result(file)

    def test_shapes_are_closed_and_as_large_as_the_half_walls_in_every_state(self):
        for target in ("half_circle.yaml", "disc.yaml"):
            result = self.result_of(target)
            structure = self.document["structure"]
            wall = structure["wall_mm"]
            lengths = [distance(*(structure["bodies"][b]["position_mm"] for b in hinge["bodies"]))
                       for hinge in structure["hinges"]]
            for part in (0, 0.37, 1):
                made = script.shapes(reader, result, part)
                self.assertEqual(len(made), len(structure["bodies"]))
                self.assertAlmostEqual(sum(volume(*shape) for shape in made),
                                       sum(lengths) * wall["thickness"] * wall["height"], delta=1e-6 * sum(lengths))

    def test_the_motion_begins_flat_and_ends_in_the_state_found(self):
        result = self.result_of("half_circle.yaml")
        for part, poses in ((0, None), (1, self.document["states"][0]["poses"])):
            for body, pose, k in zip(result.bodies, result.poses_at(part), range(1000)):
                wanted = body.rest if poses is None else poses[k]["position_mm"]
                self.assertLess(distance(pose.position, wanted), 1e-9)  # the last step's theta is rounded

    def test_results_of_imported_bodies_are_refused_in_words(self):
        file = self.folder / "imported.json"
        structure = {"cell_mm": 20, "bodies": [{"name": "left", "position_mm": [0, 0, 0]}], "hinges": [], "cells": []}
        file.write_text(json.dumps({"schema": "kinetix-result/1", "name": "pair", "structure": structure, "states": []}))
        with self.assertRaisesRegex(ValueError, "is of imported bodies, which have no walls"):
            reader.Result(file)

    def test_both_bodies_carry_each_hinge_to_one_place(self):
        result = self.result_of("half_circle.yaml")
        poses = result.poses_at(1)
        for hinge, (top, bottom) in zip(result.hinges, script.hinge_lines(reader, result, 1)):
            self.assertAlmostEqual(distance(top, bottom), 2 * hinge["reach_mm"], places=9)
            other = hinge["bodies"][1]
            arm = reader.add(hinge["point_mm"], reader.times(-1, result.bodies[other].rest))
            middle = reader.times(0.5, reader.add(top, bottom))
            self.assertLess(distance(poses[other].carry(arm), middle), 1e-9)

    def test_neighbours_are_of_different_classes(self):
        result = self.result_of("disc.yaml")
        of = script.classes(result)
        for hinge in result.hinges:
            a, b = hinge["bodies"]
            self.assertEqual({of[a], of[b]}, {"class A", "class B"})

    def test_walls_lean_with_their_hinges(self):
        """Checks that the upright edges at a half wall's end are parallel to the hinge's axis, for axes square to
        the wall."""
        result = self.result_of("half_circle.yaml")
        hinge = result.hinges[0]
        box = result.bodies[hinge["bodies"][0]].boxes[0]
        upright = reader.unit(reader.add(box[5], reader.times(-1, box[4])))
        self.assertAlmostEqual(reader.dot(upright, hinge["axis"]), 1, places=12)
        self.assertGreater(abs(hinge["beta_rad"]), 0.01)

    def test_invalid_results_are_refused(self):
        wrong = self.folder / "wrong.json"
        wrong.write_text("{}")
        with self.assertRaisesRegex(ValueError, "is no result of kinetix"):
            reader.Result(wrong)


if __name__ == "__main__":
    unittest.main()
