"""A page of SVG: white, readable in light and dark surroundings, the same bytes on every machine."""
from math import atan2, cos, pi, sin

INK, MUTED, LINE, PALE = "#1b1f24", "#57606a", "#9aa5b1", "#d5dae0"
CLASS_A, CLASS_B = "#2b6cb0", "#d97a1e"
MARK, GOOD = "#0f766e", "#eaf2fa"
FONT = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"


def number(x):
    """Two decimals: rounding in the last place of the computation does not show."""
    text = f"{x:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def points(corners):
    return " ".join(f"{number(x)},{number(y)}" for x, y in corners)


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def spans(text):
    """Marked text: **bold**, *italic*, and a subscript between underscores."""
    out = []
    for k, bold in enumerate(text.split("**")):
        for m, part in enumerate(bold.split("*")):
            style = ' font-weight="bold"' if k % 2 else ' font-style="italic"' if m % 2 else ""
            out.append(f"<tspan{style}>{escaped(part)}</tspan>" if style else lowered(part))
    return "".join(out)


def lowered(text):
    lower = '<tspan dy="4" font-size="70%">{}</tspan><tspan dy="-4">\u200b</tspan>'
    return "".join(lower.format(escaped(p)) if k % 2 else escaped(p) for k, p in enumerate(text.split("_")))


class Page:
    def __init__(self, width, height, title):
        self.lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}" font-family="{FONT}" font-size="15" fill="{INK}">',
            f"<title>{escaped(title)}</title>",
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>']

    def add(self, element):
        self.lines.append(element)

    def polygon(self, corners, fill, stroke="none", width=1.0, opacity=1.0):
        faint = f' fill-opacity="{number(opacity)}"' if opacity < 1 else ""
        edge = f' stroke="{stroke}" stroke-width="{number(width)}" stroke-linejoin="round"'
        edge = edge if stroke != "none" else ""
        self.add(f'<polygon points="{points(corners)}" fill="{fill}"{faint}{edge}/>')

    def face(self, corners, fill):
        """A polygon that takes its outline from the group round it; tenths of a pixel, by differences."""
        tenths = [(round(10 * x), round(10 * y)) for x, y in corners]
        steps = [(x - x0, y - y0) for (x0, y0), (x, y) in zip(tenths, tenths[1:])]
        numbers = " ".join(number(c / 10) for point in [tenths[0], *steps] for c in point)
        self.add(f'<path fill="{fill}" d="m{numbers.replace(" -", "-")}z"/>')

    def line(self, corners, stroke=INK, width=1.5, dash="", cap="round"):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<polyline points="{points(corners)}" fill="none" stroke="{stroke}" '
                 f'stroke-width="{number(width)}" stroke-linecap="{cap}" stroke-linejoin="round"{dashes}/>')

    def segments(self, pairs, stroke, width):
        """Many separate lines as one path."""
        path = "".join(f"M{number(a[0])} {number(a[1])}L{number(b[0])} {number(b[1])}" for a, b in pairs)
        self.path(path, stroke, width)

    def dots(self, centers, radius, fill="#ffffff", stroke=INK, rim=1.5):
        """Many circles as two paths of lines without length."""
        path = "".join(f"M{number(x)} {number(y)}h0" for x, y in centers)
        for color, size in ((stroke, 2 * radius + rim), (fill, 2 * radius - rim)):
            self.path(path, color, size)

    def path(self, data, stroke, width):
        self.add(f'<path d="{data}" fill="none" stroke="{stroke}" stroke-width="{number(width)}" '
                 'stroke-linecap="round"/>')

    def circle(self, center, radius, fill="#ffffff", stroke=INK, width=1.5):
        x, y = center
        self.add(f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}" fill="{fill}" '
                 f'stroke="{stroke}" stroke-width="{number(width)}"/>')

    def text(self, at, text, anchor="start", size=15, fill=INK, halo=False):
        x, y = at
        outline = ' stroke="#ffffff" stroke-width="4" stroke-linejoin="round" paint-order="stroke"'
        outline = outline if halo else ""
        self.add(f'<text x="{number(x)}" y="{number(y)}" text-anchor="{anchor}" font-size="{size}" '
                 f'fill="{fill}"{outline}>{spans(text)}</text>')

    def arrow(self, corners, stroke=INK, width=1.5, both=False, size=8):
        """A line with a head at its last corner, or one at each end."""
        corners = list(corners)
        trimmed = shortened(corners, size * 0.8)
        self.line(shortened(trimmed[::-1], size * 0.8)[::-1] if both else trimmed, stroke, width)
        self.head(corners[-2], corners[-1], stroke, size)
        if both:
            self.head(corners[1], corners[0], stroke, size)

    def head(self, tail, tip, fill, size):
        angle = atan2(tip[1] - tail[1], tip[0] - tail[0])
        wings = [(tip[0] - size * cos(angle + a), tip[1] - size * sin(angle + a)) for a in (-0.38, 0.38)]
        self.polygon([tip, *wings], fill)

    def dimension(self, a, b, label, at, anchor="middle", tick=6, size=15):
        """A length between two points, with ticks at its ends."""
        angle = atan2(b[1] - a[1], b[0] - a[0]) + pi / 2
        dx, dy = tick * cos(angle), tick * sin(angle)
        for x, y in (a, b):
            self.line([(x - dx, y - dy), (x + dx, y + dy)], MUTED, 1.2)
        self.line([a, b], MUTED, 1.2)
        self.text(at, label, anchor, size)

    def written(self):
        return "\n".join([*self.lines, "</svg>", ""])


def shortened(corners, by):
    (x0, y0), (x1, y1) = corners[-2], corners[-1]
    length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
    share = max(0.0, 1 - by / length)
    return [*corners[:-1], (x0 + share * (x1 - x0), y0 + share * (y1 - y0))]


def arc(center, radius, start, end, steps=24):
    """Corners along a circle, angles in rad counter-clockwise from the right, y upwards on the page."""
    angles = [start + (end - start) * k / steps for k in range(steps + 1)]
    return [(center[0] + radius * cos(a), center[1] - radius * sin(a)) for a in angles]


def mixed(color, other, share):
    """`share` of the other colour in the first."""
    parts = [(int(color[k:k + 2], 16), int(other[k:k + 2], 16)) for k in (1, 3, 5)]
    return "#" + "".join(f"{int(a + (b - a) * share + 0.5):02x}" for a, b in parts)
