#!/usr/bin/env python3
"""Writes the goal curves of this folder: points x,z (in space x,y,z) in mm, evenly spaced by arc length.

helmet_rib: sagittal section of a man's head from the glabella over the vertex to the opisthocranion. Mean dimensions
of men in the 2012 survey of U.S. Army personnel (Gordon et al., 2012 Anthropometric Survey of U.S. Army Personnel:
Methods and Summary Statistics, technical report NATICK/TR-15/007, 2014): head length 199.5 mm, head breadth 154.3 mm,
head circumference 574.4 mm, tragion to top of head 131.1 mm. The section is a half superellipse; its exponent is the
one that gives the horizontal section (length by breadth) the published circumference. That the longest section lies a
quarter of the way up from tragion to vertex is our assumption: the survey does not say.
"""
import math
import pathlib

HEAD_LENGTH, HEAD_BREADTH, HEAD_CIRCUMFERENCE, TRAGION_TO_TOP = 199.5, 154.3, 574.4, 131.1
LEVEL_OF_LENGTH = 0.25  # of tragion to top
POINTS = 481


def superellipse(a, b, exponent, u):
    power = lambda v: math.copysign(abs(v) ** (2 / exponent), v)
    return -a * power(math.cos(u)), b * power(math.sin(u))


def length(points):
    return sum(math.dist(p, q) for p, q in zip(points, points[1:]))


def dense(curve, count=200001):
    return [curve(k / (count - 1)) for k in range(count)]


def head_exponent():
    """Bisection: a larger exponent gives a longer circumference."""
    low, high = 2.0, 4.0
    for _ in range(40):
        middle = (low + high) / 2
        quarter = dense(lambda f: superellipse(HEAD_LENGTH / 2, HEAD_BREADTH / 2, middle, f * math.pi / 2), 20001)
        low, high = (middle, high) if 4 * length(quarter) < HEAD_CIRCUMFERENCE else (low, middle)
    return low


def evenly(points, count):
    total, out, walked, k = length(points), [], 0.0, 0
    for n in range(count):
        goal = total * n / (count - 1)
        while k + 2 < len(points) and walked + math.dist(points[k], points[k + 1]) < goal:
            walked += math.dist(points[k], points[k + 1])
            k += 1
        step = math.dist(points[k], points[k + 1])
        f = min((goal - walked) / step, 1.0) if step else 0.0
        out.append(tuple((1 - f) * p + f * q for p, q in zip(points[k], points[k + 1])))
    return out


def helmet_rib():
    exponent, rise = head_exponent(), (1 - LEVEL_OF_LENGTH) * TRAGION_TO_TOP
    return lambda f: superellipse(HEAD_LENGTH / 2, rise, exponent, f * math.pi)


def half_circle(radius=100.0):
    return lambda f: (-radius * math.cos(f * math.pi), radius * math.sin(f * math.pi))


def pillow(half=80.0, exponent=6.0):
    """A square with round corners, which ends at its first point."""
    return lambda f: superellipse(half, half, exponent, 2 * math.pi * f)


def s_curve(span=240.0, height=40.0):
    return lambda f: (span * f, height * math.sin(2 * math.pi * f))


def spiral(inner=35.0, pitch=30.0, turns=1.75):
    def point(f):
        angle = 2 * math.pi * turns * f
        radius = inner + pitch * turns * f
        return radius * math.cos(angle), radius * math.sin(angle)
    return point


def helix(radius=40.0, pitch=40.0, turns=2.0):
    def point(f):
        angle = 2 * math.pi * turns * f
        return radius * math.cos(angle), radius * math.sin(angle), pitch * turns * f
    return point


def trefoil_arc(size=37.5, height=13.5, part=0.45):
    """A part of a trefoil knot, from one inner turn to the next but one."""
    def point(f):
        u = 2 * math.pi * (0.02 + part * f)
        return (size * (math.sin(u) + 2 * math.sin(2 * u)), size * (math.cos(u) - 2 * math.cos(2 * u)),
                -height * math.sin(3 * u))
    return point


def handle(grip=128.0, rise=49.0, lean=18.0):
    """A pull for a drawer: it rises from one foot, runs along, and comes down to the other foot, set off to the side."""
    def point(f):
        u = math.pi * f
        return -grip / 2 * math.cos(u), -lean / 2 * math.cos(u) ** 3, rise * math.sin(u) ** 0.8
    return point


def spectacle_frame(width=200.0, temple=142.0, wrap=24.0, drop=18.0):
    """From one ear over the brow to the other: temples that drop to the ears, a front that wraps round the face."""
    half = width / 2
    def point(f):
        x = 2 * f - 1  # ear to ear
        bow = math.tanh(5.2 * x) / math.tanh(5.2)
        back = temple * (1 - (1 - abs(x) ** 3.0)) + wrap * x * x
        return half * bow, -back, -drop * abs(x) ** 4
    return point


def write(folder, header, name, curve):
    digits = lambda v: f"{v:.6f}".replace("-0.000000", "0.000000")
    rows = "".join(",".join(map(digits, p)) + "\n" for p in evenly(dense(curve), POINTS))
    (folder / f"{name}.csv").write_text(header + "\n" + rows)


if __name__ == "__main__":
    folder = pathlib.Path(__file__).parent
    for name, curve in {"helmet_rib": helmet_rib(), "half_circle": half_circle(), "s_curve": s_curve(),
                        "spiral": spiral()}.items():
        write(folder, "x,z", name, curve)
    for name, curve in {"helix": helix(), "trefoil_arc": trefoil_arc(), "handle": handle(),
                        "spectacle_frame": spectacle_frame()}.items():
        write(folder, "x,y,z", name, curve)
    write(folder, "x,y", "pillow", pillow())
