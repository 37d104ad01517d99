"""A planar sheet seen from above."""
from linkage import far_end, hinge_point
from svg import CLASS_A, CLASS_B
from vectors import add, scaled


class Plan:
    """Cell edges to pixels, y upwards."""

    def __init__(self, page, sheet, poses, center, edge, thickness):
        """`edge` and `thickness` of a wall in pixels; `center` is where the middle of the vertices goes."""
        self.page, self.sheet, self.poses, self.edge, self.thickness = page, sheet, poses, edge, thickness
        middle = scaled(1 / len(poses), add(*(p for _, p in poses.values())))
        self.origin = (center[0] - edge * middle[0], center[1] + edge * middle[1])

    def at(self, point):
        return (self.origin[0] + self.edge * point[0], self.origin[1] - self.edge * point[1])

    def vertex(self, vertex):
        return self.at(self.poses[vertex][1])

    def hinge(self, wall):
        return self.at(hinge_point(self.sheet, self.poses, wall))

    def opening(self, cell, fill):
        i, j = cell
        walls = [((i, j), 0), ((i + 1, j), 1), ((i, j + 1), 0), ((i, j), 1)]
        corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        outline = [p for v, w in zip(corners, walls) for p in (self.vertex(v), self.hinge(w))]
        self.page.polygon(outline, fill)

    def draw(self, hinge_radius=4.6):
        for k, color in enumerate((CLASS_A, CLASS_B)):
            ends = [(v, w) for w in self.sheet.walls for v in (w[0], far_end(w)) if sum(v) % 2 == k]
            self.page.segments([(self.vertex(v), self.hinge(w)) for v, w in ends], color, self.thickness)
        self.page.dots([self.hinge(w) for w in self.sheet.walls], hinge_radius, rim=hinge_radius / 3)

    def halo(self, vertex):
        """A bright rim round one body."""
        ends = [self.hinge(w) for w in self.sheet.walls if vertex in (w[0], far_end(w))]
        self.page.segments([(self.vertex(vertex), end) for end in ends], "#f6d365", self.thickness + 11)
