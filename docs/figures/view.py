"""Boxes seen at a slant from above, nearer ones over those behind them."""
from math import cos, sin

from svg import CLASS_A, CLASS_B, mixed, number
from vectors import add, cross, dot, norm, scaled, sub, unit

LIGHT = unit((-0.35, -0.55, 1.0))
TOUCH = 1e-9  # cell edges: boxes that overlap by less are apart
EDGE_ON = 0.02  # cosine: a face seen at less than a degree is left out


class Camera:
    """Parallel rays. Angles in rad: to the right of the -y axis, and above the plane."""

    def __init__(self, right_of_y, above, scale, at):
        a, e = right_of_y, above
        self.right = (cos(a), sin(a), 0.0)
        self.toward = (cos(e) * sin(a), -cos(e) * cos(a), sin(e))
        self.up = cross(self.toward, self.right)
        self.scale, self.at = scale, at

    def __call__(self, point):
        right, up = dot(point, self.right), dot(point, self.up)
        return (self.at[0] + self.scale * right, self.at[1] - self.scale * up)

    def depth(self, point):
        return dot(point, self.toward)


class Box:
    def __init__(self, center, axes, half, color):
        self.center, self.axes, self.half, self.color = center, axes, half, color

    def corner(self, signs):
        return add(self.center, *(scaled(s * h, a) for s, h, a in zip(signs, self.half, self.axes)))

    def corners(self):
        return [self.corner((a, b, c)) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]

    def faces(self):
        """(outward normal, four corners in a loop)"""
        for k in range(3):
            for side in (-1, 1):
                loop = []
                for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    signs = [0, 0, 0]
                    signs[k], signs[(k + 1) % 3], signs[(k + 2) % 3] = side, p, q
                    loop.append(self.corner(signs))
                yield scaled(side, self.axes[k]), loop

    def radius(self, direction):
        return sum(h * abs(dot(a, direction)) for h, a in zip(self.half, self.axes))


def plate(vertex_point, arm, up, height, thickness, color):
    """The box of a half wall."""
    along = unit(arm)
    return Box(add(vertex_point, scaled(0.5, arm)), (along, up, cross(along, up)),
               (norm(arm) / 2, height / 2, thickness / 2), color)


def color_of_class(vertex, wall):
    return (CLASS_A, CLASS_B)[sum(vertex) % 2]


def plates(poses, half_walls, height, thickness, color_of=color_of_class):
    return [plate(poses[v][1], arm, up, height, thickness, color_of(v, wall))
            for v, wall, arm, up in half_walls]


def order(boxes, camera):
    """Indices from the furthest box to the nearest: behind means parted by a plane, on its far side."""
    behind = [set() for _ in boxes]
    shadows = [shadow(box, camera) for box in boxes]
    for a in range(len(boxes)):
        for b in range(a):
            if not apart(shadows[a], shadows[b]):
                side = nearer(boxes[a], boxes[b], camera)
                if side > 0:
                    behind[a].add(b)
                elif side < 0:
                    behind[b].add(a)
    return sorted_by(behind, sorted(range(len(boxes)), key=lambda k: camera.depth(boxes[k].center)))


def sorted_by(behind, start):
    """Every index after those behind it, else as in `start`; a circle is cut where it is met."""
    done, out = set(), []

    def visit(k):
        done.add(k)
        for other in sorted(behind[k], key=start.index):
            if other not in done:
                visit(other)
        out.append(k)

    for k in start:
        if k not in done:
            visit(k)
    return out


def shadow(box, camera):
    seen = [camera(corner) for corner in box.corners()]
    return [(min(c), max(c)) for c in zip(*seen)]


def apart(a, b):
    return any(low > other_high or other_low > high for (low, high), (other_low, other_high) in zip(a, b))


def nearer(a, b, camera):
    """+1 where box a may hide b, -1 the other way, 0 where neither: by the plane that parts them best."""
    offset = sub(a.center, b.center)
    best, side = float("-inf"), 0
    for direction in candidates(a, b):
        toward_a = scaled(1 if dot(offset, direction) > 0 else -1, direction)
        free = dot(offset, toward_a) - a.radius(direction) - b.radius(direction)
        if free > best + TOUCH:
            facing = dot(toward_a, camera.toward)
            best, side = free, (facing > TOUCH) - (facing < -TOUCH)
    return side


def candidates(a, b):
    yield from a.axes
    yield from b.axes
    for p in a.axes:
        for q in b.axes:
            c = cross(p, q)
            if norm(c) > 1e-6:
                yield unit(c)


def shade(color, normal):
    lit = max(0.0, dot(normal, LIGHT))
    return mixed(mixed(color, "#ffffff", 0.35 + 0.4 * lit), "#10151c", 0.25 * (1 - lit))


RIM = "#22303f"


def draw_boxes(page, boxes, camera, outline=0.6):
    """@param outline of the faces, pixels"""
    page.add(f'<g stroke="{RIM}" stroke-width="{number(outline)}" stroke-linejoin="round">')
    for k in order(boxes, camera):
        for normal, corners in boxes[k].faces():
            if dot(normal, camera.toward) > EDGE_ON:
                page.face([camera(c) for c in corners], shade(boxes[k].color, normal))
    page.add("</g>")
