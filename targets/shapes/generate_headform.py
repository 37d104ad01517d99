#!/usr/bin/env python3
"""Writes headform.obj: a man's head in mm, z up, y to the front, x to its right, the origin in the middle of the
longest horizontal section.

The dimensions are the means that generate.py cites (2012 survey of U.S. Army personnel). The solid is a superellipsoid
|x/a|^n + |y/b|^n + |z/c|^n = 1. Its a and b are half of head breadth and length, and c is the rise from the longest
section to the top. The exponent n is that of generate.py: the longest section has the published circumference, and the
sagittal section of the upper half is helmet_rib. We assume the same exponent for the coronal section. The lower half
mirrors the upper one to close the mesh and is not a likeness: the form has neither ears nor face.
"""
import math
import pathlib

from generate import HEAD_BREADTH, HEAD_LENGTH, LEVEL_OF_LENGTH, TRAGION_TO_TOP, head_exponent

LEVELS = 4  # an icosahedron cut that often: 2562 vertices, 5120 triangles


def icosahedron():
    golden = (1 + math.sqrt(5)) / 2
    vertices = [p for a in (-1, 1) for b in (-golden, golden) for p in ((0, a, b), (b, 0, a), (a, b, 0))]
    near = lambda *corners: all(math.dist(vertices[i], vertices[j]) < 2.1 for i in corners for j in corners)
    faces = [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near(i, j, k)]
    return vertices, [face if is_outward(vertices, face) else face[::-1] for face in faces]


def is_outward(vertices, face):
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[k] for k in face)
    return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx) > 0


def finer(vertices, faces):
    vertices, middles = list(vertices), {}

    def middle(i, j):
        key = min(i, j), max(i, j)
        if key not in middles:
            middle_point = [p + q for p, q in zip(vertices[i], vertices[j])]
            middles[key] = len(vertices)
            vertices.append(tuple(v / math.hypot(*middle_point) for v in middle_point))
        return middles[key]

    out = []
    for i, j, k in faces:
        ij, jk, ki = middle(i, j), middle(j, k), middle(k, i)
        out += [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    return vertices, out


def headform():
    exponent = head_exponent()
    axes = HEAD_BREADTH / 2, HEAD_LENGTH / 2, (1 - LEVEL_OF_LENGTH) * TRAGION_TO_TOP
    vertices, faces = icosahedron()
    for _ in range(LEVELS):
        vertices, faces = finer(vertices, faces)
    reach = lambda p: sum(abs(v / a) ** exponent for v, a in zip(p, axes)) ** (-1 / exponent)
    return [[v * reach(p) for v in p] for p in vertices], faces


if __name__ == "__main__":
    points, triangles = headform()
    coordinate = lambda v: f"{v:.4f}".replace("-0.0000", "0.0000")
    rows = [f"# {line}" for line in __doc__.strip().splitlines()]
    rows += ["v " + " ".join(map(coordinate, p)) for p in points]
    rows += ["f " + " ".join(str(k + 1) for k in t) for t in triangles]
    text = "\n".join(rows) + "\n"
    (pathlib.Path(__file__).parent / "headform.obj").write_text(text.replace("# \n", "#\n"))
