"""The labelled cell: flat, compressed, and the two angles of a hinge."""
from math import acos, cos, radians, sin

from linkage import Sheet, design_sheet, fold_sheet, rectangle
from plan import Plan
from svg import CLASS_A, CLASS_B, GOOD, INK, LINE, MUTED, Page, arc
from vectors import X, Z, add, cross, dot, scaled, unit
from view import Camera

EDGE, THICKNESS = 112, 9  # pixels


def labelled_sheet(theta):
    sheet = Sheet(rectangle(2, 2))
    design_sheet(sheet, t=(0.6, 0.6), s=(0.6, 0.6))
    return sheet, fold_sheet(sheet, theta)


def label(page, at, target, text, anchor="start"):
    """A word and a thin line from it to what it names."""
    page.line([at, target], INK, 1)
    page.circle(target, 2.6, INK, "#ffffff", 0.8)
    page.text((at[0] + (5 if anchor == "start" else -5), at[1] + 5), text, anchor)


def part(a, b, share):
    return tuple(p + share * (q - p) for p, q in zip(a, b))


def below(point, by):
    return (point[0], point[1] + by)


def flat_panel(page, center):
    plan = Plan(page, *labelled_sheet(0.0), center, EDGE, THICKNESS)
    plan.opening((0, 1), GOOD)
    plan.halo((1, 1))
    plan.draw()
    dimensions(page, plan)
    names(page, plan)


def dimensions(page, plan):
    left, hinge, right = plan.vertex((0, 0)), plan.hinge(((0, 0), 0)), plan.vertex((1, 0))
    page.dimension(below(left, 22), below(hinge, 22), "*tL*", below(part(left, hinge, 0.5), 42))
    page.dimension(below(hinge, 22), below(right, 22), "(1−*t*)*L*", below(part(hinge, right, 0.5), 42))
    top_left, top_right = plan.vertex((0, 2)), plan.vertex((1, 2))
    page.dimension(below(top_left, -22), below(top_right, -22), "**wall**, length *L*",
                   below(part(top_left, top_right, 0.5), -32))


def names(page, plan):
    x = plan.vertex((2, 1))[0] + 22
    middle = plan.vertex((1, 1))
    page.text(below(part(middle, plan.vertex((0, 2)), 0.5), 5), "**cell**", "middle")
    half = part(plan.vertex((2, 2)), plan.hinge(((2, 1), 1)), 0.5)
    label(page, (x, half[1]), half, "**half wall**")
    label(page, (x, middle[1] + 24), part(middle, plan.hinge(((1, 1), 0)), 0.8), "**body**")
    hinge = plan.hinge(((2, 0), 1))
    label(page, (x, hinge[1] + 16), hinge, "**hinge**")


def folded_panel(page, center, theta):
    plan = Plan(page, *labelled_sheet(theta), center, EDGE, THICKNESS)
    plan.opening((0, 1), GOOD)
    plan.halo((1, 1))
    plan.draw()
    turn_mark(page, plan, (1, 1), theta, 54, (40, 18), "+*θ*", CLASS_A)
    turn_mark(page, plan, (1, 2), -theta, 34, (52, -7), "−*θ*", CLASS_B)


def turn_mark(page, plan, vertex, turn, radius, offset, word, color):
    """The angle between where a half wall along x pointed when flat, dashed, and where it points now."""
    x, y = center = plan.vertex(vertex)
    page.line([center, (x + 78, y)], INK, 1.2, "4 4")
    page.arrow(arc(center, radius, 0, turn, 16), INK, 1.5)
    page.text((x + offset[0], y + offset[1]), word, "middle", 18, color)


# The two angles of a hinge, on one wall at a slant.

HEIGHT, HINGE_AT = 0.62, 0.5


def plate_corners(up, starts_and_ends):
    """Lower and upper corners in a loop, by how far along the wall each is."""
    return [add(scaled(s, X), scaled(h * HEIGHT / 2, up)) for s, h in zip(starts_and_ends, (-1, -1, 1, 1))]


def split_wall(page, camera, up, slope):
    """Both half walls, cut along the axis; slope is the axis' run along the wall over its rise."""
    low, high = (HINGE_AT + h * slope * HEIGHT / 2 for h in (-1, 1))
    for ends, color in (((0, low, high, 0), CLASS_A), ((low, 1, 1, high), CLASS_B)):
        page.polygon([camera(c) for c in plate_corners(up, ends)], color, "#ffffff", 1.2, 0.8)


def axis_line(page, camera, direction, anchor):
    foot = scaled(HINGE_AT, X)
    ends = [camera(add(foot, scaled(h, direction))) for h in (-0.44, 0.6)]
    page.line(ends, INK, 2, "7 3 1.5 3")
    page.circle(camera(foot), 4.6)
    x, y = ends[1]
    page.text((x + 5, y - 4) if anchor == "start" else (x - 6, y + 10), "axis", anchor)


def angle_mark(page, camera, first, second, radius, word, at):
    """The angle at the hinge point from one unit vector to another, about their common normal."""
    foot = scaled(HINGE_AT, X)
    normal = unit(cross(first, second))
    side = cross(normal, first)
    total = acos(dot(first, second))
    spoke = lambda a: add(foot, scaled(radius * cos(a), first), scaled(radius * sin(a), side))
    page.arrow([camera(spoke(total * k / 16)) for k in range(17)], INK, 1.5)
    page.text(at, word, "middle", 17, halo=True)


def edge_line(page, camera):
    page.arrow([camera(scaled(s, X)) for s in (-0.12, 1.3)], MUTED, 1.3)
    x, y = camera(scaled(1.3, X))
    page.text((x + 6, y + 5), "*e*", size=16, fill=MUTED)


def tilt_inset(page, at):
    camera = Camera(radians(-32), radians(24), 155, at)
    beta = radians(32)
    up = add(scaled(cos(beta), Z), scaled(sin(beta), cross(X, Z)))
    page.polygon([camera(c) for c in plate_corners(Z, (0, 1, 1, 0))], "none", LINE, 1.2)
    split_wall(page, camera, up, 0)
    edge_line(page, camera)
    foot = scaled(HINGE_AT, X)
    page.line([camera(foot), camera(add(foot, scaled(0.6, Z)))], MUTED, 1.2, "4 4")
    axis_line(page, camera, up, "start")
    x, y = camera(add(foot, scaled(0.52, Z)))
    angle_mark(page, camera, Z, up, 0.48, "*β*", (x - 13, y + 4))


def in_plane_inset(page, at):
    camera = Camera(radians(-32), radians(24), 155, at)
    alpha = radians(62)
    axis = (cos(alpha), 0.0, sin(alpha))
    split_wall(page, camera, Z, cos(alpha) / sin(alpha))
    edge_line(page, camera)
    axis_line(page, camera, axis, "end")
    x, y = camera(add(scaled(HINGE_AT, X), scaled(0.36, unit(add(axis, X)))))
    angle_mark(page, camera, X, axis, 0.26, "*α*", (x, y + 4))


def legend(page, at):
    x, y = at
    words = ((CLASS_A, "sublattice A", 0), (CLASS_B, "sublattice B: every other vertex, as on a checkerboard", 142))
    for color, word, dx in words:
        page.line([(x + dx, y - 5), (x + dx + 20, y - 5)], color, THICKNESS)
        page.text((x + dx + 30, y), word)


def write():
    page = Page(960, 440, "A sheet of four cells with the names of its parts")
    flat_panel(page, (150, 190))
    folded_panel(page, (500, 190), radians(21))
    tilt_inset(page, (728, 132))
    in_plane_inset(page, (728, 320))
    for at, word in (((150, 388), "flat, from above"), ((500, 388), "folded by *θ*"),
                     ((805, 202), "the wall leans by its tilt *β*"),
                     ((805, 388), "the axis leans in the wall: *α*")):
        page.text(at, word, "middle", fill=MUTED)
    legend(page, (182, 426))
    return page.written()
