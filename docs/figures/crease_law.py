"""The crease law: why a column of tilted hinges folds, and by how much."""
from math import atan, degrees, pi, radians, sin, sqrt, tan

from svg import CLASS_A, CLASS_B, INK, MARK, MUTED, PALE, Page, arc

BETA, THETA = radians(52), radians(30)
PSI = atan(tan(BETA) * sin(THETA))


def polar(center, radius, angle):
    return arc(center, radius, angle, angle, 1)[0]


def middle(a, b):
    return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)


def from_above(page, hinge):
    """Two half walls at a hinge, and the level part of its axis as each of them carries it."""
    x, y = hinge
    page.line([(x, y - 96), (x, y + 172)], MARK, 1.3, "6 4")
    page.text((x + 8, y - 82), "fold line", fill=MARK)
    for color, wall, turn in ((CLASS_A, pi, THETA), (CLASS_B, 0, -THETA)):
        page.line([hinge, polar(hinge, 112, wall + turn)], color, 9)
        page.arrow([hinge, polar(hinge, 150 * sin(BETA), -pi / 2 + turn)], color, 2.4, size=10)
    page.circle(hinge, 4.6)
    length = 150 * sin(BETA)
    for color, sign in ((CLASS_A, 1), (CLASS_B, -1)):
        tip = polar(hinge, length, -pi / 2 + sign * THETA)
        page.line([tip, (x, tip[1])], color, 1.3, "3 3")
        page.text((polar(hinge, 62, -pi / 2 + sign * THETA / 2)[0], y + 62), "*θ*", "middle", 16)
    page.line(arc(hinge, 44, -pi / 2 - THETA, -pi / 2 + THETA), INK, 1.3)
    level = polar(hinge, length, -pi / 2 + THETA)[1]
    page.text((x + 12, level + 20), "sin *β* sin *θ*", size=14)
    tip = polar(hinge, length * 0.72, -pi / 2 + THETA)
    page.text((tip[0] + 8, tip[1] + 2), "sin *β*", size=14, fill=CLASS_A)
    page.text((x, y + 206), "from above: both carry the axis", "middle", fill=MUTED)
    page.text((x, y + 226), "equally far along the fold line", "middle", fill=MUTED)


def along_the_line(page, hinge):
    """The two panels edge on: the axis halves the angle between their normals."""
    x, y = hinge
    page.line([(x - 118, y), hinge], CLASS_A, 7)
    page.line([hinge, polar(hinge, 118, -2 * PSI)], CLASS_B, 7)
    page.line([hinge, (x + 112, y)], MUTED, 1.2, "4 4")
    for color, lean in ((CLASS_A, 0), (CLASS_B, 2 * PSI)):
        page.line([hinge, polar(hinge, 128, pi / 2 - lean)], color, 1.4, "5 4")
    page.arrow([hinge, polar(hinge, 140, pi / 2 - PSI)], INK, 2.4, size=10)
    page.text(polar(hinge, 150, pi / 2 - PSI), "axis")
    for k in (0, 1):
        page.line(arc(hinge, 58 + 8 * k, pi / 2 - k * PSI, pi / 2 - (k + 1) * PSI), INK, 1.3)
        px, py = polar(hinge, 82, pi / 2 - (k + 0.5) * PSI)
        page.text((px, py + 5), "*ψ*", "middle", 16)
    page.arrow(arc(hinge, 84, 0, -2 * PSI, 16), INK, 1.5)
    px, py = polar(hinge, 104, -PSI)
    page.text((px, py + 5), "*ρ*", "middle", 17)
    page.circle(hinge, 4.6)
    page.text((x, y + 126), "along the fold line: the axis leans", "middle", fill=MUTED)
    page.text((x, y + 146), "by *ψ* from each panel's normal", "middle", fill=MUTED)
    page.text((x, y + 184), "tan *ψ* = tan *β* sin *θ*,  *ρ* = 2*ψ*", "middle", 17)


TILTS = (10, 20, 30, 40, 50, 60, 70)  # degrees
MOST_THETA, MOST_FOLD = 45, 135  # degrees, of the axes


def chart(page, left, top, width, height):
    at = lambda theta, fold: (left + width * theta / MOST_THETA, top + height * (1 - fold / MOST_FOLD))
    for theta in range(0, MOST_THETA + 1, 15):
        page.line([at(theta, 0), at(theta, MOST_FOLD)], PALE, 1)
        page.text((at(theta, 0)[0], top + height + 20), f"{theta}°", "middle", 13, MUTED)
    for fold in range(0, MOST_FOLD + 1, 45):
        page.line([at(0, fold), at(MOST_THETA, fold)], PALE, 1)
        page.text((left - 8, at(0, fold)[1] + 5), f"{fold}°", "end", 13, MUTED)
    for tilt in TILTS:
        curve(page, at, radians(tilt), MUTED, 1.5)
        x, y = at(MOST_THETA, fold_of(radians(tilt), radians(MOST_THETA)))
        page.text((x + 7, y + 5), f"{'*β* = ' if tilt == TILTS[-1] else ''}{tilt}°", size=13, fill=MUTED)
    curve(page, at, atan(sqrt(2)), CLASS_B, 2.6)
    page.dots([at(45, 90)], 4.2, CLASS_B, "#ffffff")
    x, y = at(45, 90)
    page.text((x + 7, y + 5), "**54.7°**", size=13, fill=CLASS_B)
    page.text((left + width / 2, top + height + 44), "fold angle *θ*", "middle", fill=MUTED)
    page.text((left - 34, top - 14), "fold *ρ*", fill=MUTED)


def fold_of(beta, theta):
    return degrees(2 * atan(tan(beta) * sin(theta)))


def curve(page, at, beta, stroke, width):
    thetas = [MOST_THETA * k / 30 for k in range(31)]
    page.line([at(theta, fold_of(beta, radians(theta))) for theta in thetas], stroke, width)


def write():
    page = Page(960, 380, "The crease law")
    from_above(page, (140, 132))
    along_the_line(page, (430, 182))
    chart(page, 640, 50, 240, 250)
    return page.written()
