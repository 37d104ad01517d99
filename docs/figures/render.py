#!/usr/bin/env python3
"""render.py FLAT.stl FOLDED.stl OUT.png: a picture of a printed strip as its files have it: flat, a few of its cells from
near, and folded. Draws every triangle into a depth buffer, with the standard library alone:

    kinetix-opt export results/helmet_rib --format stl -o flat
    kinetix-opt export results/helmet_rib --format stl --state folded -o folded
    docs/figures/render.py flat/all.stl folded/all.stl docs/figures/printed_rib.png
"""
import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 1400, 700  # px
SAMPLES = 2  # a side, of each pixel
LIGHT = (0.35, -0.45, 0.82)
COLOURS = ((214, 210, 196), (110, 140, 175))  # of bodies with forks and with eyes: every other one


def triangles(file):
    """Corners of each triangle, mm."""
    data = open(file, "rb").read()
    count = struct.unpack_from("<I", data, 80)[0]
    return [[v[3 * k:3 * k + 3] for k in range(1, 4)] for v in
            (struct.unpack_from("<12f", data, 84 + 50 * k) for k in range(count))]


def bodies(corners):
    """The number of the shell that each triangle is of: those that follow each other and share corners."""
    of, known, body = [], set(), 0
    for triangle in corners:
        if known and not any(p in known for p in triangle):
            known, body = set(), body + 1
        known.update(triangle)
        of.append(body)
    return of


def turned(point, azimuth, elevation):
    """To the right, up and towards the eye."""
    x, y, z = point
    c, s = math.cos(azimuth), math.sin(azimuth)
    right, away = c * x + s * y, -s * x + c * y
    c, s = math.cos(elevation), math.sin(elevation)
    return right, s * away + c * z, -c * away + s * z


class Picture:
    def __init__(self):
        self.width, self.height = WIDTH * SAMPLES, HEIGHT * SAMPLES
        self.depth = [-1e9] * (self.width * self.height)
        self.pixels = bytearray(b"\xff" * (3 * self.width * self.height))

    def draw(self, corners, box, azimuth, elevation, keep=lambda p: True, upright=False):
        """All bodies that lie where they are to be kept, as large as fits into the box: left, top, right, bottom in px.

        upright: turned by a right angle in the picture."""
        shells = bodies(corners)
        left_out = {shells[k] for k, t in enumerate(corners) if not all(keep(p) for p in t)}

        def view(p):
            x, y, z = turned(p, azimuth, elevation)
            return (-y, x, z) if upright else (x, y, z)
        shown = [(shells[k], [view(p) for p in t], t) for k, t in enumerate(corners) if shells[k] not in left_out]
        points = [p for _, view, _ in shown for p in view]
        low = [min(p[k] for p in points) for k in (0, 1)]
        high = [max(p[k] for p in points) for k in (0, 1)]
        left, top, right, bottom = (SAMPLES * edge for edge in box)
        scale = min((right - left) / (high[0] - low[0]), (bottom - top) / (high[1] - low[1]))
        x0 = (left + right) / 2 - scale * (low[0] + high[0]) / 2
        y0 = (top + bottom) / 2 + scale * (low[1] + high[1]) / 2
        for shell, view, t in shown:
            self.fill([(x0 + scale * x, y0 - scale * y, z) for x, y, z in view], self.colour(COLOURS[(shell // 2 + shell) % 2], t))

    @staticmethod
    def colour(base, t):
        a, b = ([t[k][i] - t[0][i] for i in range(3)] for k in (1, 2))
        n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        length = math.sqrt(sum(x * x for x in n)) or 1
        share = 0.45 + 0.55 * max(0, sum(x * y for x, y in zip(n, LIGHT)) / length)
        return bytes(int(share * c) for c in base)

    def fill(self, p, colour):
        (xa, ya, za), (xb, yb, zb), (xc, yc, zc) = p
        area = (xb - xa) * (yc - ya) - (xc - xa) * (yb - ya)
        if area >= 0:  # from behind, as y runs downwards
            return
        for y in range(max(0, int(min(ya, yb, yc))), min(self.height - 1, int(max(ya, yb, yc))) + 1):
            for x in range(max(0, int(min(xa, xb, xc))), min(self.width - 1, int(max(xa, xb, xc))) + 1):
                px, py = x + 0.5, y + 0.5
                u = ((px - xa) * (yc - ya) - (xc - xa) * (py - ya)) / area
                v = ((xb - xa) * (py - ya) - (px - xa) * (yb - ya)) / area
                if u < 0 or v < 0 or u + v > 1:
                    continue
                z, at = za + u * (zb - za) + v * (zc - za), y * self.width + x
                if z > self.depth[at]:
                    self.depth[at] = z
                    self.pixels[3 * at:3 * at + 3] = colour

    def png(self):
        rows = []
        for y in range(HEIGHT):
            row = bytearray(b"\0")
            for x in range(WIDTH):
                for c in range(3):
                    row.append(sum(self.pixels[3 * ((y * SAMPLES + j) * self.width + x * SAMPLES + i) + c]
                                   for i in range(SAMPLES) for j in range(SAMPLES)) // SAMPLES ** 2)
            rows.append(bytes(row))

        def chunk(name, data):
            return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) +
                chunk(b"IEND", b""))


def main():
    flat, folded = triangles(sys.argv[1]), triangles(sys.argv[2])
    picture = Picture()
    picture.draw(flat, (20, 20, WIDTH - 20, 140), 0.12, 0.7)
    picture.draw(flat, (20, 170, 640, HEIGHT - 20), 0.6, 0.75, keep=lambda p: 70 < p[0] < 104)
    picture.draw(folded, (680, 170, WIDTH - 20, HEIGHT - 20), 0.25, 0.25, upright=True)
    open(sys.argv[3], "wb").write(picture.png())


main()
