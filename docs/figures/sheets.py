"""Family F2, sheets that bend into cylinders, and F3, those whose rows lean too."""
from math import atan2, degrees, radians

from linkage import Sheet, design_sheet, fold_sheet, half_walls, hinge_point, rectangle
from svg import INK, MARK, MUTED, Page, arc
from vectors import Y, add, cross, dot, product, rotation, scaled, sub, times, unit
from view import Camera, draw_boxes, plates

HEIGHT, THICKNESS = 0.42, 0.07  # of the plates, cell edges


def middle(poses):
    return scaled(1 / len(poses), add(*(p for _, p in poses.values())))


def levelled(poses):
    """The whole sheet about its middle, turned about y until its first and last column are equally high."""
    m = middle(poses)
    last = max(i for i, _ in poses)
    first_point, last_point = (poses[(i, 0)][1] for i in (0, last))
    span = sub(last_point, first_point)
    R = rotation(Y, atan2(span[2], span[0]))
    return {v: (product(R, Q), times(R, sub(p, m))) for v, (Q, p) in poses.items()}


def draw(page, sheet, poses, camera):
    draw_boxes(page, plates(poses, half_walls(sheet, poses), HEIGHT, THICKNESS), camera)


TILT, THETA = radians(26), radians(30)
BETA, ROWS = (TILT, 0.0) * 3 + (TILT,), 3
VIEW = radians(-24), radians(22)


def sheet_at(theta, gamma=0.0):
    sheet = Sheet(rectangle(len(BETA), ROWS))
    design_sheet(sheet, beta=BETA, gamma=gamma)
    return sheet, levelled(fold_sheet(sheet, theta))


def flat(page, at, scale, gamma=0.0):
    draw(page, *sheet_at(0.0, gamma), Camera(*VIEW, scale, at))


def mirror_plane(sheet, poses, column):
    """A point of it, its unit normal, and the corners of a piece; it holds the hinge axes of the column."""
    first, last = (hinge_point(sheet, poses, ((column, j), 0)) for j in (0, ROWS))
    axis = times(poses[(column, 0)][0], sheet.up(((column, 0), 0)))
    across = unit(sub(last, first))
    normal = unit(cross(across, axis))
    up = cross(normal, across)
    corners = [add(p, scaled(a, across), scaled(h, up)) for p, a, h in
               ((first, -0.4, -0.7), (last, 0.4, -0.7), (last, 0.4, 0.7), (first, -0.4, 0.7))]
    return first, normal, corners


def folded(page, at):
    """The arch with a mirror plane: what lies behind it is drawn before it."""
    sheet, poses = sheet_at(THETA)
    camera = Camera(*VIEW, 70, at)
    point, normal, corners = mirror_plane(sheet, poses, 4)
    if dot(normal, camera.toward) < 0:
        normal = scaled(-1, normal)
    boxes = plates(poses, half_walls(sheet, poses), HEIGHT, THICKNESS)
    in_front = [dot(sub(box.center, point), normal) > 0 for box in boxes]
    draw_boxes(page, [box for box, front in zip(boxes, in_front) if not front], camera)
    page.polygon([camera(c) for c in corners], MARK, MARK, 1.2, 0.2)
    draw_boxes(page, [box for box, front in zip(boxes, in_front) if front], camera)
    return [camera(c) for c in corners]


def profile(page, at, scale):
    """The arch along y: vertices, hinges, and the planes that mirror a body into the next one."""
    sheet, poses = sheet_at(THETA)
    seen = lambda p: (at[0] + scale * p[0], at[1] - scale * p[2])
    line = []
    for i in range(len(BETA) + 1):
        line.append(seen(poses[(i, 0)][1]))
        if i < len(BETA):
            line.append(seen(hinge_point(sheet, poses, ((i, 0), 0))))
    for column in range(len(BETA)):
        point, normal, _ = mirror_plane(sheet, poses, column)
        up = cross(normal, Y)
        page.line([seen(add(point, scaled(h, up))) for h in (-0.42, 0.42)], MARK, 1.3, "5 3")
    page.line(line, INK, 3)
    page.dots(line[1::2], 3.6)
    page.dots(line[::2], 2.6, INK, INK)
    fold_mark(page, line[7], line[9], line[11])


def fold_mark(page, before, hinge, after):
    """How far a line turns at a hinge."""
    ahead, there = (direction(a, b) for a, b in ((before, hinge), (hinge, after)))
    page.line([hinge, arc(hinge, 62, ahead, ahead, 1)[0]], INK, 1.2, "4 4")
    page.arrow(arc(hinge, 50, ahead, there, 12), INK, 1.5)
    x, y = arc(hinge, 76, (ahead + there) / 2, 0, 1)[0]
    page.text((x, y + 2), "2*ψ*", "middle", 16)


def direction(a, b):
    return atan2(a[1] - b[1], b[0] - a[0])


def bending():
    page = Page(960, 400, "A sheet of family F2, flat, folded and from the side")
    flat(page, (196, 104), 46)
    page.text((196, 190), "flat: tilts *b*, 0, *b*, 0, *b*, 0, *b* by columns", "middle", fill=MUTED)
    profile(page, (196, 290), 48)
    page.text((196, 376), "from the side: each hinge lies in a mirror plane", "middle", fill=MUTED)
    corners = folded(page, (676, 200))
    x, y = corners[2]
    page.text((x, y - 8), "mirror plane of a column", "middle", fill=MARK)
    page.text((676, 376), f"folded by *θ* = {degrees(THETA):.0f}°", "middle", fill=MUTED)
    return page.written()


def tilted_rows():
    page = Page(960, 300, "A sheet of family F3, flat and folded")
    gamma = radians(24)
    flat(page, (230, 130), 52, gamma)
    words = "flat: the walls along *y* lean as well, all by the same angle"
    page.text((230, 276), words, "middle", fill=MUTED)
    draw(page, *sheet_at(THETA, gamma), Camera(*VIEW, 62, (705, 130)))
    page.text((705, 276), f"folded by *θ* = {degrees(THETA):.0f}°", "middle", fill=MUTED)
    return page.written()
