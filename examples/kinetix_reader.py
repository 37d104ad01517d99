"""Reads a result.json of kinetix: bodies with their walls as boxes, and their poses. No other package is needed.

For scripts in other programs (blender, rhino beside this file). It runs on Python 2.7, which Rhino 7 has, and 3.
Lengths are in mm; vectors are lists of three numbers, quaternions w x y z.
"""
import json
import math


def add(a, b):
    return [p + q for p, q in zip(a, b)]


def times(factor, a):
    return [factor * p for p in a]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return times(1 / math.sqrt(dot(a, a)), a)


def rotated(quaternion, v):
    """Returns v turned by a unit quaternion."""
    w, axis = quaternion[0], quaternion[1:]
    twice = times(2, cross(axis, v))
    return add(v, add(times(w, twice), cross(axis, twice)))


class Pose(object):
    """Pose of a body. It moves point p of the body's frame (origin at the rest position) to position + R p."""

    def __init__(self, position, quaternion):
        self.position, self.quaternion = position, quaternion

    def carry(self, point):
        return add(self.position, rotated(self.quaternion, point))


class Body(object):
    """Rigid body: its name, its rest position, and its half walls as boxes of 8 corners in its own frame."""

    def __init__(self, name, rest):
        self.name, self.rest, self.boxes = name, rest, []


# The six sides of a box, by its corners, seen from outside counter-clockwise.
BOX_SIDES = [[2, 3, 1, 0], [5, 7, 6, 4], [1, 5, 4, 0], [6, 7, 3, 2], [4, 6, 2, 0], [3, 7, 5, 1]]


def box(length, edge, up, thickness, height):
    """Returns the corners of a plate from the body's vertex along `edge`. The bits of a corner's number are, from the
    first: along, across, up."""
    across = cross(up, edge)
    return [add(times(along, edge), add(times(side, across), times(high, up)))
            for along in (0, length) for side in (thickness / 2, -thickness / 2) for high in (-height / 2, height / 2)]


class Result(object):
    """Content of a result.json.

    `bodies`: in the order of all poses. `hinges`: as in the file. `steps`: the motion from flat to the goal, a list of
    poses per step. `targets`: the folded state by model.
    """

    def __init__(self, path):
        with open(path) as file:
            document = json.load(file)
        if document.get("schema") != "kinetix-result/1":
            raise ValueError("%s is no result of kinetix (kinetix-result/1)" % path)
        structure = document["structure"]
        if "wall_mm" not in structure:
            raise ValueError("%s is of imported bodies, which have no walls: kinetix-opt export --format glb has their "
                             "shapes and their motion" % path)
        self.name = document["name"]
        self.hinges = structure["hinges"]
        self.bodies = [Body(name_of(body), body["position_mm"]) for body in structure["bodies"]]
        wall = structure["wall_mm"]
        for hinge in self.hinges:
            self.add_walls(hinge, wall["thickness"], wall["height"])
        self.targets, self.steps = {}, []
        for state in document["states"]:
            poses = [Pose(pose["position_mm"], pose["quaternion_wxyz"]) for pose in state["poses"]]
            if state["name"] == "frame":
                self.steps.append(poses)
            elif state["model"] not in self.targets:
                self.targets[state["model"]] = poses
        if not self.steps:
            self.steps = [self.flat()] + list(self.targets.values())[:1]
        for before, after in zip(self.steps, self.steps[1:]):
            keep_signs(before, after)

    def flat(self):
        return [Pose(body.rest, [1.0, 0.0, 0.0, 0.0]) for body in self.bodies]

    def add_walls(self, hinge, thickness, height):
        """Adds the half walls of a hinge. A wall's height is along the component of the hinge's axis normal to it."""
        lower, upper = (self.bodies[b] for b in hinge["bodies"])
        whole = add(upper.rest, times(-1, lower.rest))
        edge = unit(whole)
        axis = hinge["axis"]
        up = unit(add(axis, times(-dot(axis, edge), edge)))
        length = math.sqrt(dot(whole, whole))
        lower.boxes.append(box(hinge["t"] * length, edge, up, thickness, height))
        upper.boxes.append(box((1 - hinge["t"]) * length, times(-1, edge), up, thickness, height))

    def poses_at(self, part):
        """Returns the poses at a part of the motion, 0 (flat) to 1. Linear between two steps."""
        place = min(max(part, 0.0), 1.0) * (len(self.steps) - 1)
        k = min(int(place), len(self.steps) - 2)
        return [between(a, b, place - k) for a, b in zip(self.steps[k], self.steps[k + 1])]


def name_of(body):
    return "body " + "_".join("%d" % i for i in body["vertex"])


def keep_signs(before, after):
    """Selects the nearer of q and -q, which are one rotation, for programs that interpolate between steps."""
    for a, b in zip(before, after):
        if dot(a.quaternion, b.quaternion) < 0:
            b.quaternion = times(-1, b.quaternion)


def between(a, b, part):
    quaternion = unit4(add(times(1 - part, a.quaternion), times(part, b.quaternion)))
    return Pose(add(times(1 - part, a.position), times(part, b.position)), quaternion)


def unit4(q):
    return times(1 / math.sqrt(dot(q, q)), q)
