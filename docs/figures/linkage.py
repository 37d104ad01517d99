"""Sheets of square cells of edge 1, and the closed forms of kinematics.md that fold them.

Vertices are pairs (i, j); a wall is (vertex, axis), axis 0 along x and 1 along y; a pose is (R, p).
"""
from math import atan, cos, sin, tan

from vectors import (IDENTITY, X, Y, Z, add, columns, cross, dot, norm, product, rotation, scaled, sub, times,
                     unit)

DIRECTIONS = (X, Y)
CLOSED = 1e-12  # cell edges: the largest gap at a hinge with which a picture may be drawn


class Sheet:
    """Any set of cells. All hinges stand upright at the middle of their walls until they are set."""

    def __init__(self, cells):
        self.cells = sorted(set(cells))
        corners = ((0, 0), (1, 0), (0, 1), (1, 1))
        self.vertices = sorted({(i + a, j + b) for i, j in self.cells for a, b in corners})
        sides = (((0, 0), 0), ((0, 1), 0), ((0, 0), 1), ((1, 0), 1))
        self.walls = sorted({((i + a, j + b), axis) for i, j in self.cells for (a, b), axis in sides})
        self.t = {wall: 0.5 for wall in self.walls}
        self.tilt = {wall: 0.0 for wall in self.walls}

    def up(self, wall):
        """w(beta), along the height of the plate, which is the hinge's axis where alpha is 90 degrees."""
        across = cross(DIRECTIONS[wall[1]], Z)
        return add(scaled(cos(self.tilt[wall]), Z), scaled(sin(self.tilt[wall]), across))


def rectangle(columns_of_cells, rows):
    return [(i, j) for i in range(columns_of_cells) for j in range(rows)]


def sense(vertex):
    """+1 for class A, which turns by +theta, -1 for class B."""
    return 1 if sum(vertex) % 2 == 0 else -1


def far_end(wall):
    (i, j), axis = wall
    return (i + 1 - axis, j + axis)


def alternation(wall):
    """Sign of the tilts along a crease: by rows for walls along x, by columns for walls along y."""
    (i, j), axis = wall
    return 1 if (i if axis else j) % 2 == 0 else -1


def fraction_of_a(t, vertex):
    """From the wall's lower vertex, given the fraction that belongs to class A."""
    return t if sense(vertex) > 0 else 1 - t


# Sheets of families F1, F2, F3: section 2 of kinematics.md, a body's neighbours are its mirror images.

def design_sheet(sheet, t=(), s=(), beta=(), gamma=0.0):
    """Sets the hinges: t and beta by columns, s by rows, gamma the tilt of all walls along y."""
    for wall in sheet.walls:
        (i, j), axis = wall
        along, line = (s, j) if axis else (t, i)
        sheet.t[wall] = fraction_of_a(along[line] if along else 0.5, (i, j))
        sheet.tilt[wall] = alternation(wall) * (gamma if axis else beta[i] if beta else 0.0)


def mirrored(R, normal):
    """The frame of a mirror image, in which the direction along the wall keeps its sense."""
    reflect = lambda v: sub(v, scaled(2 * dot(normal, v), normal))
    return [reflect(column) for column in columns(R)]


def neighbour(sheet, wall, pose, theta):
    """Pose of the body at the far end of a wall, given that at its lower end."""
    R, p = pose
    axis = wall[1]
    normal = Y if axis else unit(cross(Y, times(R, sheet.up(wall))))
    image = mirrored(R, normal)
    image[axis] = scaled(-1, image[axis])
    R_far = columns(image)
    t = sheet.t[wall]
    edge = DIRECTIONS[axis]
    return R_far, add(p, scaled(t, times(R, edge)), scaled(1 - t, times(R_far, edge)))


def fold_sheet(sheet, theta):
    """Poses of all bodies of a rectangle of cells; body (0, 0) turns about the axis of its wall along y."""
    poses = {(0, 0): (rotation(sheet.up(((0, 0), 1)), theta), (0.0, 0.0, 0.0))}
    for vertex in sheet.vertices:
        i, j = vertex
        wall = ((i, j - 1), 1) if j else ((i - 1, j), 0)
        if vertex not in poses:
            poses[vertex] = neighbour(sheet, wall, poses[wall[0]], theta)
    return checked(sheet, poses)


# Nets, family F4: panels of upright hinges, joined by creases.

def fold_net(sheet, theta, root):
    """Poses of all bodies; the panel of `root` stays level."""
    frames = {root: IDENTITY}
    poses = {root: (in_panel(IDENTITY, root, theta), (float(root[0]), float(root[1]), 0.0))}
    queue = [root]
    for vertex in queue:
        for wall, other in walls_at(sheet, vertex):
            if other in poses:
                continue
            axis = wall[1]
            turn = 2 * atan(tan(sheet.tilt[wall]) * sin(theta)) * sense(vertex)
            line = Y if axis == 0 else scaled(-1, X)
            frames[other] = product(frames[vertex], rotation(line, turn))
            poses[other] = beyond(sheet, wall, vertex, poses[vertex], in_panel(frames[other], other, theta))
            queue.append(other)
    return checked(sheet, poses)


def in_panel(frame, vertex, theta):
    return product(frame, rotation(Z, sense(vertex) * theta))


def walls_at(sheet, vertex):
    i, j = vertex
    for wall in (((i, j), 0), ((i, j), 1), ((i - 1, j), 0), ((i, j - 1), 1)):
        if wall in sheet.t:
            yield wall, far_end(wall) if wall[0] == vertex else wall[0]


def beyond(sheet, wall, vertex, pose, R_far):
    forward = wall[0] == vertex
    t = sheet.t[wall] if forward else 1 - sheet.t[wall]
    edge = scaled(1 if forward else -1, DIRECTIONS[wall[1]])
    return R_far, add(pose[1], scaled(t, times(pose[0], edge)), scaled(1 - t, times(R_far, edge)))


# What pictures need of a folded sheet.

def hinge_point(sheet, poses, wall):
    R, p = poses[wall[0]]
    return add(p, scaled(sheet.t[wall], times(R, DIRECTIONS[wall[1]])))


def gap(sheet, poses, wall):
    """How far the two bodies of a hinge disagree about its point and its axis."""
    R, p = poses[far_end(wall)]
    point = add(p, scaled(sheet.t[wall] - 1, times(R, DIRECTIONS[wall[1]])))
    axes = sub(times(R, sheet.up(wall)), times(poses[wall[0]][0], sheet.up(wall)))
    return max(norm(sub(point, hinge_point(sheet, poses, wall))), norm(axes))


def checked(sheet, poses):
    worst = max(gap(sheet, poses, wall) for wall in sheet.walls)
    if not worst < CLOSED:
        raise ValueError(f"a hinge of the sheet is open by {worst} cell edges: it would be drawn wrong")
    return poses


def half_walls(sheet, poses):
    """(vertex, wall, from the vertex to the hinge, up direction of the plate) of every half wall."""
    for wall in sheet.walls:
        edge = DIRECTIONS[wall[1]]
        for vertex, reach in ((wall[0], sheet.t[wall]), (far_end(wall), sheet.t[wall] - 1)):
            R = poses[vertex][0]
            yield vertex, wall, scaled(reach, times(R, edge)), times(R, sheet.up(wall))


def tilt_that_folds(angle, theta):
    """Crease law: the tilt that folds by an angle at theta, rad."""
    return atan(tan(angle / 2) / sin(theta))
