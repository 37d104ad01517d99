"""Lattices other than squares, flat and folded. Hinges are basic: X(theta) = cos(theta) x (kinematics.md section 5)."""
from math import cos, pi, radians, sin, sqrt

from svg import CLASS_A, CLASS_B, MUTED, Page

THETA = radians(30)
WIDTH, EDGE_WIDTH = 3.4, 200  # pixels: of a wall, of a flat panel


def polygon(walls, first, middle):
    radius = 0.5 / sin(pi / walls)
    angles = [first + 2 * pi * k / walls for k in range(walls)]
    return [(middle[0] + radius * cos(a), middle[1] + radius * sin(a)) for a in angles]


def honeycomb(i, j):
    return polygon(6, pi / 2, (sqrt(3) * (i + 0.5 * (j % 2)), 1.5 * j))


def octagon(i, j):
    pitch = 1 + sqrt(2)
    return polygon(8, pi / 8, (pitch * i, pitch * j))


def brick(i, j):
    return [(2 * i + j % 2 + x, j + y) for x, y in ((0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1))]


def rhombus(i, j):
    across = (cos(pi / 3), sin(pi / 3))
    return [(i + a + (j + b) * across[0], (j + b) * across[1]) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]


def walls_of(corners, columns, rows):
    """Vertices and walls, from class A to class B."""
    vertices, walls = {}, set()
    for j in range(rows):
        for i in range(columns):
            keys = []
            for x, y in corners(i, j):
                key = (round(1e6 * y), round(1e6 * x))
                vertices.setdefault(key, (x, y))
                keys.append(key)
            walls |= {tuple(sorted(wall)) for wall in zip(keys, keys[1:] + keys[:1])}
    senses = senses_of(sorted(vertices), sorted(walls))
    return vertices, [wall if senses[wall[0]] > 0 else wall[::-1] for wall in sorted(walls)]


def senses_of(vertices, walls):
    beside = {v: [] for v in vertices}
    for a, b in walls:
        beside[a].append(b)
        beside[b].append(a)
    senses, open_ends = {vertices[0]: 1}, [vertices[0]]
    while open_ends:
        at = open_ends.pop()
        for near in beside[at]:
            if near not in senses:
                senses[near] = -senses[at]
                open_ends.append(near)
    return senses


def turned(v, angle):
    return (cos(angle) * v[0] - sin(angle) * v[1], sin(angle) * v[0] + cos(angle) * v[1])


def panel(page, drawn, center, theta, edge):
    vertices, walls = drawn
    xs, ys = zip(*vertices.values())
    middle = ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)
    scale = edge * cos(theta)
    place = {k: (center[0] + scale * (x - middle[0]), center[1] - scale * (y - middle[1]))
             for k, (x, y) in vertices.items()}
    halves, hinges = ([], []), []
    for a, b in walls:
        along = tuple(vertices[b][k] - vertices[a][k] for k in (0, 1))
        arm = turned((edge / 2 * along[0], edge / 2 * along[1]), theta)
        hinge = (place[a][0] + arm[0], place[a][1] - arm[1])
        hinges.append(hinge)
        halves[0].append((place[a], hinge))
        halves[1].append((place[b], hinge))
    for color, segments in zip((CLASS_A, CLASS_B), halves):
        page.segments(segments, color, WIDTH)
    page.dots(hinges, 2, rim=1)


def write():
    page = Page(960, 560, "Honeycomb, bricks, octagons and rhombi, flat and folded")
    panels = ((honeycomb, 3, 4, "honeycomb"), (brick, 3, 5, "brick"), (octagon, 3, 3, "octagon"),
              (rhombus, 4, 5, "rhombus"))
    for k, (corners, columns, rows, name) in enumerate(panels):
        drawn = walls_of(corners, columns, rows)
        xs, ys = zip(*drawn[0].values())
        edge = EDGE_WIDTH / max(max(xs) - min(xs), max(ys) - min(ys))
        for row, theta in enumerate((0, THETA)):
            panel(page, drawn, (126 + 236 * k, 140 + 250 * row), theta, edge)
        page.text((126 + 236 * k, 525), name, "middle")
    page.text((20, 24), "flat", fill=MUTED)
    page.text((20, 274), "*θ* = 30°", fill=MUTED)
    return page.written()
