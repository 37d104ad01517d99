"""The first design of the README: the strip that kinetix-opt finds for eight points, flat and folded."""
from math import atan2, radians

from linkage import Sheet, design_sheet, fold_sheet, half_walls, rectangle
from svg import MARK, MUTED, Page
from vectors import Y, add, product, rotation, scaled, sub, times
from view import Camera, draw_boxes, plates

# What the program wrote to design.yaml for the curve of the README: degrees, by columns, and mm.
THETA, CELL_MM = 27.0168, 8.38382
TILTS = (31.3301, 31.1659, 30.8638, 29.7965, 24.3742, -11.1698, 8.0994, 11.4271, 12.2186, 12.9944, 13.2590,
         -41.7290, -38.9857, -37.1145, -34.6797, -29.8004, -16.8880, -40.3068, -40.7250, -40.2231, -40.1594,
         -40.3134, -38.5180, -13.1059, -26.2949, -31.2800, -34.6585, -37.9087, -41.7401, 14.3584, 11.9355,
         8.3679, 3.3749, -5.2908, -25.8724, 6.9588, 9.9014, 9.1384, 7.9511, 7.1396)
CURVE = ((0, 0), (30, 25), (70, 38), (110, 30), (150, 8), (190, 0), (230, 14), (260, 40))
HEIGHT, THICKNESS = 0.6, 0.1  # of the plates, cell edges: the program's defaults
VIEW = radians(-4), radians(24)


def strip(theta):
    sheet = Sheet(rectangle(len(TILTS), 1))
    design_sheet(sheet, beta=[radians(tilt) for tilt in TILTS])
    return sheet, fold_sheet(sheet, theta)


def middle_of_column(poses, i):
    return scaled(0.5, add(poses[(i, 0)][1], poses[(i, 1)][1]))


def laid_along(poses, first, last):
    """The strip moved so that its ends lie on a line between two points (x, z)."""
    ends = [middle_of_column(poses, i) for i in (0, len(TILTS))]
    slope = lambda a, b: atan2(b[-1] - a[-1], b[0] - a[0])
    R = rotation(Y, slope(*ends) - slope(first, last))
    center = scaled(0.5, add(*ends))
    goal = ((first[0] + last[0]) / 2, 0.0, (first[1] + last[1]) / 2)
    return {v: (product(R, Q), add(times(R, sub(p, center)), goal)) for v, (Q, p) in poses.items()}


def draw(page, theta, first, last, camera):
    sheet, poses = strip(theta)
    placed = laid_along(poses, first, last)
    draw_boxes(page, plates(placed, half_walls(sheet, placed), HEIGHT, THICKNESS), camera, 0.5)


def write():
    page = Page(960, 300, "A strip of forty cells, flat, and compressed into a curve of eight points")
    draw(page, 0.0, (0, 0), (40, 0), Camera(*VIEW, 22.6, (28, 52)))
    page.text((28, 92), "flat, as it is printed", fill=MUTED)
    goal = [(x / CELL_MM, z / CELL_MM) for x, z in CURVE]
    camera = Camera(*VIEW, 28, (42, 254))
    draw(page, radians(THETA), goal[0], goal[-1], camera)
    line = [camera((x, 0.0, z)) for x, z in goal]
    page.line(line, MARK, 2.4)
    page.dots(line, 4.6, "#ffffff", MARK)
    page.text((932, 284), "compressed: it runs through the points that were asked for", "end", fill=MUTED)
    return page.written()
