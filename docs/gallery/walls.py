"""Walls of a result as plates, for designs that no process prints as they are. Lengths in mm."""
import numpy as np

from picture import EVEN, ODD, Mesh

FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]  # of corners by their bits


def rotation_of(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def plate(start, end, up, height, thickness):
    along = (end - start) / np.linalg.norm(end - start)
    up = up - (up @ along) * along
    up /= np.linalg.norm(up)
    axes = np.stack([(end - start) / 2, np.cross(up, along) * thickness / 2, up * height / 2])
    corners = [(start + end) / 2 + sum(((k >> b & 1) * 2 - 1) * axes[b] for b in range(3)) for k in range(8)]
    return [[corners[i] for i in face[:3]] for face in FACES] + [[corners[face[k]] for k in (0, 2, 3)] for face in FACES]


def first_state(result):
    return next(state for state in result["states"] if state["name"] == "target")


def places_and_normals_of(result):
    """Returns the place of each body and the normal of the sheet there, in the first state of the model (n x 3 each)."""
    poses = first_state(result)["poses"]
    return (np.array([pose["position_mm"] for pose in poses], float),
            np.array([rotation_of(pose["quaternion_wxyz"])[:, 2] for pose in poses]))


def wall_meshes(result):
    """Returns the half walls of a result, flat and in its first state of the model."""
    structure = result["structure"]
    sizes = structure["wall_mm"]
    rest = [np.array(body["position_mm"], float) for body in structure["bodies"]]
    poses = [(np.array(p["position_mm"], float), rotation_of(p["quaternion_wxyz"])) for p in first_state(result)["poses"]]
    flat, folded, colours = [], [], []
    for hinge in structure["hinges"]:
        point, axis = np.array(hinge["point_mm"], float), np.array(hinge["axis"], float)
        for b in hinge["bodies"]:
            position, rotation = poses[b]
            flat += plate(rest[b], point, axis, sizes["height"], sizes["thickness"])
            folded += plate(position, position + rotation @ (point - rest[b]), rotation @ axis, sizes["height"], sizes["thickness"])
            parity = sum(structure["bodies"][b].get("vertex", [b])) % 2
            colours += [(EVEN, ODD)[parity]] * 12
    return Mesh(flat, colours), Mesh(folded, colours)
