"""Family F4: a cube that closes itself and a fishbone, flat and folded."""
from math import degrees, radians

from linkage import Sheet, alternation, fold_net, half_walls, sense, tilt_that_folds
from svg import CLASS_B, MUTED, Page
from vectors import add, scaled
from view import Camera, draw_boxes, plates

HEIGHT, THICKNESS = 0.36, 0.07  # of the plates, cell edges
THETA = radians(33)
PANELS, BENDS = "#7f9dbd", CLASS_B


def crease(sheet, wall, tilt):
    """Tilts the walls that lie opposite each other from cell to cell, starting at one."""
    found = [wall]
    for (i, j), axis in found:
        across = (0, 1) if axis == 0 else (1, 0)
        for step in (-1, 1):
            cell = (i + across[0] * min(step, 0), j + across[1] * min(step, 0))
            other = ((i + across[0] * step, j + across[1] * step), axis)
            if cell in sheet.cells and other not in found:
                found.append(other)
    for other in found:
        sheet.tilt[other] = alternation(other) * tilt


def downwards(wall):
    """The sign with which a positive tilt lowers the far side."""
    return sense(wall[0]) * alternation(wall)


FACE, BEND = 3, 1  # cells along a face, columns of cells that share a bend


def cube():
    """A cross of six faces; each of its five bends is spread over two columns of cells."""
    step = FACE + BEND
    cells = [(i + step, j) for i in range(FACE) for j in range(4 * FACE + 3 * BEND)]
    cells += [(i, j + step) for i in range(3 * FACE + 2 * BEND) for j in range(FACE)]
    sheet = Sheet(cells)
    tilt = tilt_that_folds(radians(90 / BEND), THETA)
    for k in range(BEND):
        for wall in [((FACE + k, step), 0), ((step + FACE + k, step), 0)]:
            crease(sheet, wall, downwards(wall) * tilt)
        for start in (FACE, step + FACE, 2 * step + FACE):
            wall = ((step, start + k), 1)
            crease(sheet, wall, downwards(wall) * tilt)
    return sheet


def fishbone(half=5, rows=9):
    """A spine along y; every other row carries a rib."""
    cells = [(i, j) for j in range(rows) for i in range(2 * half + 1) if i == half or j % 2 == 0]
    sheet = Sheet(cells)
    for j in range(1, rows, 2):
        wall = ((half, j), 1)
        crease(sheet, wall, downwards(wall) * radians(28))
    for j in range(0, rows, 2):
        for i in range(2 * half + 1):
            if i != half:
                wall = ((i, j), 0)
                crease(sheet, wall, downwards(wall) * radians(9 + 1.5 * j))
    return sheet


def color_of(sheet):
    return lambda vertex, wall: BENDS if sheet.tilt[wall] else PANELS


def draw(page, sheet, theta, root, camera):
    poses = fold_net(sheet, theta, root)
    x, y = camera(scaled(1 / len(poses), add(*(p for _, p in poses.values()))))
    camera.at = (2 * camera.at[0] - x, 2 * camera.at[1] - y)
    boxes = plates(poses, half_walls(sheet, poses), HEIGHT, THICKNESS, color_of(sheet))
    draw_boxes(page, boxes, camera, 0.5)


def view(scale, at, right_of_y=-30, above=34):
    return Camera(radians(right_of_y), radians(above), scale, at)


def states(page, sheet, root, y, at, below):
    """Draws a net at several theta; `at` has theta, middle x, shift in y and pixels per cell edge of each."""
    for theta, x, dy, scale in at:
        draw(page, sheet, theta, root, view(scale, (x, y + dy)))
        page.text((x, below), f"*θ* = {degrees(theta):.0f}°", "middle", fill=MUTED)


def write():
    page = Page(960, 616, "Nets of family F4: a cube and a fishbone")
    page.text((20, 30), "**A package**: flat panels, joined by creases (orange) that fold by 90° at the same *θ*")
    states(page, cube(), (FACE + BEND, FACE + BEND), 160,
           ((0.0, 180, 0, 22), (radians(15), 500, 16, 26), (THETA, 806, 14, 33)), 294)
    page.text((20, 340), "**A fishbone**, the form of helmets: a spine with ribs, each with tilts of its own")
    states(page, fishbone(4, 7), (4, 3), 462,
           ((0.0, 168, 0, 24), (radians(15), 480, 0, 29), (radians(30), 790, 0, 33)), 596)
    return page.written()
