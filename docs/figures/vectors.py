"""Vectors of three numbers as tuples, and 3 x 3 matrices as tuples of rows."""
from math import cos, sin, sqrt

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
X, Y, Z = IDENTITY


def add(*vectors):
    return tuple(sum(parts) for parts in zip(*vectors))


def scaled(factor, v):
    return tuple(factor * c for c in v)


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(v):
    return sqrt(dot(v, v))


def unit(v):
    return scaled(1 / norm(v), v)


def columns(matrix):
    return tuple(zip(*matrix))


def times(matrix, v):
    return tuple(dot(row, v) for row in matrix)


def product(a, b):
    return tuple(tuple(dot(row, column) for column in columns(b)) for row in a)


def rotation(axis, angle):
    """About a unit axis, rad, counter-clockwise (Rodrigues)."""
    (x, y, z), c, s = axis, cos(angle), sin(angle)
    v = 1 - c
    return ((c + v * x * x, v * x * y - s * z, v * x * z + s * y),
            (v * x * y + s * z, c + v * y * y, v * y * z - s * x),
            (v * x * z - s * y, v * y * z + s * x, c + v * z * z))
