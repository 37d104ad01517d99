"""Things behind a folded design that show what it is for: a head, the faces of a solid, the cells of a letter. Lengths in mm."""
import re
from pathlib import Path

import numpy as np

from picture import Mesh
from walls import places_and_normals_of

HEAD, FACE, LIT = (196, 196, 196), (224, 140, 60), (250, 190, 70)
SHAPES = Path(__file__).resolve().parents[2] / "targets/shapes"


def fan(points):
    """Returns triangles of a polygon, seen from both sides."""
    points = np.asarray(points, float)
    one = [[points[0], points[k], points[k + 1]] for k in range(1, len(points) - 1)]
    return one + [triangle[::-1] for triangle in one]


def head(name):
    """Returns the triangles of an OBJ file of triangles."""
    lines = [line.split() for line in (SHAPES / name).read_text().splitlines()]
    corners = np.array([words[1:4] for words in lines if words[:1] == ["v"]], float)
    faces = [[int(word.split("/")[0]) - 1 for word in words[1:]] for words in lines if words[:1] == ["f"]]
    return [corners[[face[0], face[k], face[k + 1]]] for face in faces for k in range(1, len(face) - 1)]


def letter_cells(result):
    """Returns the cells of the letter, under the walls."""
    places, normals = places_and_normals_of(result)
    depth = result["structure"]["wall_mm"]["height"] / 2
    return [triangle for cell in result["structure"]["cells"] if cell.get("on")
            for triangle in fan(places[cell["bodies"]] - depth * normals[cell["bodies"]])]


def backdrop_of(name, result):
    """Returns the backdrop of targets/shapes/NAME.yaml in the frame of the result's first state; None for designs without one."""
    kind, mesh = result["target"].get("kind"), re.search(r"mesh: (\w+\.obj)", (SHAPES / f"{name}.yaml").read_text())
    if kind == "helmet" and mesh:
        return Mesh(head(mesh.group(1)), HEAD)
    if kind == "fold" and len(result["fold"].get("ideal_mm", [])) > 6:
        return Mesh([triangle for face in result["fold"]["ideal_mm"] for triangle in fan(face[:-1])], FACE)
    cells = letter_cells(result) if kind == "display" else []
    return Mesh(cells, LIT) if cells else None
