"""Family F1: planar sheets that scale evenly (Eq. 3) and that shear (Eq. 4)."""
from math import atan, atan2, cos, degrees, pi, radians, tan

from linkage import Sheet, design_sheet, fold_sheet, rectangle
from plan import Plan
from svg import INK, MUTED, Page, arc

EDGE, THICKNESS, CELLS = 44, 3.4, 4  # pixels, pixels, along each side
K = 0.2  # hinges at a fifth of the wall, as in Fig. 5 of the paper


def planar_plan(page, center, theta, s):
    sheet = Sheet(rectangle(CELLS, CELLS))
    design_sheet(sheet, t=(K,) * CELLS, s=(s,) * CELLS)
    return Plan(page, sheet, fold_sheet(sheet, theta), center, EDGE, THICKNESS)


def draw(plan):
    plan.opening((1, 1), "#cfe3f5")
    plan.draw(2.6)


def column(k):
    return 126 + 236 * k


def caption(page, k, y, words):
    page.text((column(k), y + 138), words, "middle", fill=MUTED)


def scaling(page, y):
    page.text((20, y - 130), f"**Even scaling**: *t*_A_ = *k* in all walls, here *k* = {K} (Eq. 3)")
    for k, theta in enumerate(radians(a) for a in (0, 22.5, 45, 67.5)):
        draw(planar_plan(page, (column(k), y), theta, K))
        area = K * K + (1 - K) * (1 - K) + 2 * K * (1 - K) * cos(2 * theta)
        caption(page, k, y, f"*θ* = {degrees(theta):g}°, area × {area:.2f}")


def shear(page, y):
    page.text((20, y - 130), "**Shear**: *t*_A_ = *k* in walls along *x*, 1 − *k* in walls along *y* (Eq. 4)")
    for k, theta in enumerate(radians(a) for a in (0, 15, 30, 45)):
        plan = planar_plan(page, (column(k), y), theta, 1 - K)
        draw(plan)
        sides(page, plan)
        angle = pi / 2 + 2 * atan((1 - 2 * K) * tan(theta))
        caption(page, k, y, f"*θ* = {degrees(theta):g}°, sides at {degrees(angle):.0f}°")


def sides(page, plan):
    """The angle between a row and a column of vertices, from the sheet's lower left corner."""
    corner, right, top = (plan.vertex(v) for v in ((0, 0), (CELLS, 0), (0, CELLS)))
    page.line([top, corner, right], INK, 1.2, "4 4")
    angles = [atan2(corner[1] - y, x - corner[0]) for x, y in (right, top)]
    page.line(arc(corner, 26, *angles), INK, 1.5)


def write():
    page = Page(960, 606, "Planar sheets of family F1 that scale evenly and that shear")
    scaling(page, 154)
    shear(page, 462)
    return page.written()
