"""What the elastic and the physics model add: springs of a hinge, contact of wall tips, clamps of plates."""
from math import cos, radians, sin

from linkage import Sheet, fold_sheet, rectangle
from plan import Plan
from svg import CLASS_A, CLASS_B, INK, MUTED, Page

WALL, HEIGHT, REACH = 104, 150, 52  # pixels: half wall, plate, from the hinge point to an anchor


class Half:
    """A half wall seen from its side, in its own place: u along the wall from the hinge, v upwards."""

    def __init__(self, hinge, turn):
        self.hinge, self.turn = hinge, turn

    def at(self, u, v):
        c, s = cos(self.turn), sin(self.turn)
        return (self.hinge[0] + c * u - s * v, self.hinge[1] - s * u - c * v)

    def draw(self, page, side, color):
        corners = [self.at(0, -HEIGHT / 2), self.at(side * WALL, -HEIGHT / 2),
                   self.at(side * WALL, HEIGHT / 2), self.at(0, HEIGHT / 2)]
        page.polygon(corners, color, color, 1.5, 0.35)
        page.line([self.at(0, -HEIGHT / 2 - 14), self.at(0, HEIGHT / 2 + 14)], color, 1.8, "7 3 1.5 3")


def spring(page, a, b, coils=4, width=6):
    """A zigzag between two points."""
    length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
    along = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
    across = (-along[1], along[0])
    corners = [a]
    for k in range(2 * coils):
        s, d = length * (k + 1) / (2 * coils + 1), width if k % 2 else -width
        corners.append((a[0] + s * along[0] + d * across[0], a[1] + s * along[1] + d * across[1]))
    page.line([*corners, b], INK, 1.5)


def stretched_hinge(page, center):
    x, y = center
    lower, upper = Half((x - 17, y + 5), radians(-2)), Half((x + 17, y - 4), radians(5))
    lower.draw(page, -1, CLASS_A)
    upper.draw(page, 1, CLASS_B)
    for v in (-REACH, REACH):
        spring(page, lower.at(0, v), upper.at(0, v))
        page.dots([lower.at(0, v), upper.at(0, v)], 3.6, INK, INK)
    page.dots([lower.at(0, 0), upper.at(0, 0)], 4.6)
    foot, anchor = lower.at(-26, 0), lower.at(-26, REACH)
    page.dimension(foot, anchor, "*h*", (foot[0] - 14, (foot[1] + anchor[1]) / 2 + 5))
    words(page, upper)
    page.text((x, y + 128), "a hinge that is stretched", "middle", fill=MUTED)


def words(page, upper):
    for v, word in ((0, "hinge point"), (REACH, "anchor"), (-HEIGHT / 2 - 12, "axis")):
        px, py = upper.at(0, v)
        page.text((px + 13, py + 5), word, size=14)


def bar(page, start, angle, length, thickness, color):
    """A half wall from above, its end at `start`; returns the corners of that end."""
    along, across = (cos(angle), -sin(angle)), (sin(angle), cos(angle))
    corner = lambda u, v: (start[0] + u * along[0] + v * across[0], start[1] + u * along[1] + v * across[1])
    h = thickness / 2
    corners = [corner(0, -h), corner(length, -h), corner(length, h), corner(0, h)]
    page.polygon(corners, color, color, 1.5, 0.35)
    return corners[0], corners[3]


def contact(page, center):
    """The tip of one half wall in the side of another."""
    x, y = center
    thickness = 44
    bar(page, (x - 120, y + 46), 0, 240, thickness, CLASS_B)
    side = y + 46 - thickness / 2
    tip = (x + 4, side + 14)
    angle = radians(62)
    start = (tip[0] - thickness / 2 * sin(angle), tip[1] - thickness / 2 * cos(angle))
    _, low = bar(page, start, angle, 130, thickness, CLASS_A)
    page.dots([low], 4, INK, INK)
    page.dimension((x + 62, side), (x + 62, low[1]), "depth", (x + 76, side + 12), "start", size=14)
    page.line([low, (x + 62, low[1])], MUTED, 1, "3 3")
    page.text((x - 14, low[1] + 24), "wall tip", "middle", 14)
    page.text((x, y + 128), "contact, from above", "middle", fill=MUTED)


def plates(page, center):
    x, y = center
    sheet = Sheet(rectangle(3, 2))
    plan = Plan(page, sheet, fold_sheet(sheet, radians(24)), center, 68, 6)
    rows = [[plan.vertex((i, j)) for i in range(4)] for j in (0, 2)]
    for row in rows:
        page.line([(row[0][0] - 30, row[0][1]), (row[-1][0] + 30, row[0][1])], "#c3cad2", 15, cap="butt")
    plan.draw(3.4)
    for row in rows:
        for px, py in row:
            square = [(px + 6 * a, py + 6 * b) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            page.polygon(square, "#ffffff", INK, 1.6)
    for row, sign in zip(rows, (-1, 1)):
        edge = row[0][0] - 20
        page.arrow([(edge, row[0][1] - sign * 42), (edge, row[0][1] - sign * 12)], INK, 2, size=9)
    px, py = rows[1][-1]
    page.text((px + 40, py + 5), "plate", size=14)
    px, py = rows[0][-1]
    page.text((px + 40, py + 5), "clamp", size=14)
    page.line([(px + 8, py), (px + 36, py)], INK, 1)
    page.text((x, y + 128), "plates that clamp two rows of vertices", "middle", fill=MUTED)


def write():
    page = Page(960, 280, "Springs of a hinge, a wall tip in contact, and plates")
    stretched_hinge(page, (140, 128))
    contact(page, (450, 128))
    plates(page, (745, 128))
    return page.written()
