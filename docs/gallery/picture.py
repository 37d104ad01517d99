"""Pictures of solids: parallel rays, a depth buffer, and one light. Lengths in mm."""
import math
import struct
import zlib

import numpy as np

LIGHT = np.array([0.30, -0.50, 0.81])  # towards it
AMBIENT = 0.42  # share of the light that comes from everywhere
SAMPLES = 2  # per side, of each pixel
MARGIN = 16  # px
EVEN, ODD, SOFT, METAL = (222, 214, 196), (92, 132, 176), (226, 120, 60), (214, 176, 84)  # colours of bodies; of a coin
COIN_MM = 23.25, 2.33  # diameter and thickness of a 1 euro coin


class Mesh:
    """Triangles (n x 3 x 3) with a colour each (n x 3)."""

    def __init__(self, corners, colours):
        self.corners = np.asarray(corners, float).reshape(-1, 3, 3)
        self.colours = np.broadcast_to(np.asarray(colours, float), (len(self.corners), 3))

    def __add__(self, other):
        return Mesh(np.concatenate([self.corners, other.corners]), np.concatenate([self.colours, other.colours]))

    def moved(self, shift):
        return Mesh(self.corners + np.asarray(shift, float), self.colours)

    def turned(self, rotation):
        return Mesh(self.corners @ np.asarray(rotation, float).T, self.colours)

    def bounds(self):
        points = self.corners.reshape(-1, 3)
        return points.min(axis=0), points.max(axis=0)

    def size(self):
        low, high = self.bounds()
        return high - low

    def on_table(self):
        """Returns the mesh with its lowest point at z = 0 and its middle at x = y = 0."""
        low, high = self.bounds()
        return self.moved([-(low[0] + high[0]) / 2, -(low[1] + high[1]) / 2, -low[2]])


def read_stl(path):
    """Returns the corners of the triangles of a binary STL file."""
    data = path.read_bytes()
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    return np.frombuffer(data, record, struct.unpack_from("<I", data, 80)[0], 84)["corners"].astype(float)


def shells(corners):
    """Returns the number of the body of each triangle: triangles of a body are connected by shared corners. Bodies are
    numbered in the order of their first triangles."""
    _, points = np.unique(np.round(corners.reshape(-1, 3), 4), axis=0, return_inverse=True)
    triangles = points.reshape(-1, 3)
    labels = np.arange(points.max() + 1)
    while True:
        least = labels[triangles].min(axis=1)
        before = labels.copy()
        for column in triangles.T:
            np.minimum.at(labels, column, least)
        labels = labels[labels]
        if (labels == before).all():
            break
    of_triangles = labels[triangles[:, 0]]
    _, first, numbers = np.unique(of_triangles, return_index=True, return_inverse=True)
    order = np.empty(len(first), int)
    order[np.argsort(first)] = np.arange(len(first))
    return order[numbers]


def coin():
    radius, height, steps = COIN_MM[0] / 2, COIN_MM[1], 64
    at = [(radius * math.cos(2 * math.pi * k / steps), radius * math.sin(2 * math.pi * k / steps)) for k in range(steps + 1)]
    corners = []
    for (xa, ya), (xb, yb) in zip(at, at[1:]):
        corners += [[(0, 0, height), (xa, ya, height), (xb, yb, height)],
                    [(xa, ya, 0), (xb, yb, 0), (xb, yb, height)], [(xa, ya, 0), (xb, yb, height), (xa, ya, height)]]
    return Mesh(corners, METAL)


def view_of(azimuth_deg, elevation_deg):
    """Returns the rows right, up and towards the eye."""
    a, e = math.radians(azimuth_deg), math.radians(elevation_deg)
    toward = np.array([math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)])
    right = np.array([math.cos(a), math.sin(a), 0])
    return np.stack([right, np.cross(toward, right), toward])


def draw(mesh, azimuth_deg, elevation_deg, width, tallest):
    """Returns pixels (height x width x 3) that show the whole mesh. The height is at most `tallest`."""
    seen = mesh.corners @ view_of(azimuth_deg, elevation_deg).T
    low, high = seen.reshape(-1, 3).min(axis=0), seen.reshape(-1, 3).max(axis=0)
    span = high - low
    scale = min((width - 2 * MARGIN) / span[0], (tallest - 2 * MARGIN) / span[1])
    height = int(math.ceil(scale * span[1])) + 2 * MARGIN
    columns, rows = width * SAMPLES, height * SAMPLES
    x = columns / 2 + SAMPLES * scale * (seen[..., 0] - (low[0] + high[0]) / 2)
    y = rows / 2 - SAMPLES * scale * (seen[..., 1] - (low[1] + high[1]) / 2)
    depth, pixels = np.full((rows, columns), -np.inf), np.full((rows, columns, 3), 255.0)
    edges = mesh.corners[:, 1:] - mesh.corners[:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    lit = mesh.colours * (AMBIENT + (1 - AMBIENT) * np.clip(normals @ LIGHT, 0, 1))[:, None]
    areas = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])
    for k in np.flatnonzero(areas < 0):  # y runs downwards: these face the eye
        fill(depth, pixels, x[k], y[k], seen[k, :, 2], areas[k], lit[k])
    return pixels.reshape(height, SAMPLES, width, SAMPLES, 3).mean(axis=(1, 3)).astype(np.uint8)


def fill(depth, pixels, x, y, z, area, colour):
    """Fills the pixels of one triangle that nothing nearer hides."""
    rows, columns = depth.shape
    left, right = max(0, int(x.min())), min(columns - 1, int(x.max()) + 1)
    top, bottom = max(0, int(y.min())), min(rows - 1, int(y.max()) + 1)
    if left > right or top > bottom:
        return
    px, py = np.arange(left, right + 1) + 0.5, (np.arange(top, bottom + 1) + 0.5)[:, None]
    u = ((px - x[0]) * (y[2] - y[0]) - (py - y[0]) * (x[2] - x[0])) / area
    v = ((py - y[0]) * (x[1] - x[0]) - (px - x[0]) * (y[1] - y[0])) / area
    at = z[0] + u * (z[1] - z[0]) + v * (z[2] - z[0])
    part = depth[top:bottom + 1, left:right + 1]
    nearer = (u >= 0) & (v >= 0) & (u + v <= 1) & (at > part)
    part[nearer] = at[nearer]
    pixels[top:bottom + 1, left:right + 1][nearer] = colour


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
