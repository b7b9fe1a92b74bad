"""A drawing on a light panel, which stands on light and on dark pages. World coordinates become screen coordinates."""

import sys

INK, PALE, ROD, BASE, PART, GOOD, BAD = "#1f2933", "#9aa5b1", "#52606d", "#0b5cad", "#b54708", "#0f7b53", "#c2261c"
PANEL = "#f7f9fb"


class Drawing:
    """Shapes in world coordinates; `view` maps a point to the screen."""

    def __init__(self, title, width=720, height=400, view=lambda point: point):
        self.title, self.width, self.height, self.view = title, width, height, view
        self.shapes = []

    def line(self, points, colour=INK, width=1.5, dash="", arrows="", fill="none", close=False, opacity=1):
        """A polyline. `arrows` has `<` and `>` for the ends that have an arrow."""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.view, points))
        tag = "polygon" if close else "polyline"
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        extra += f' marker-start="url(#{colour[1:]})"' if "<" in arrows else ""
        extra += f' marker-end="url(#{colour[1:]})"' if ">" in arrows else ""
        extra += f' opacity="{opacity}"' if opacity != 1 else ""
        self.shapes.append(f'<{tag} points="{path}" stroke="{colour}" stroke-width="{width}" fill="{fill}"{extra}/>')

    def area(self, points, colour, opacity=0.15):
        """A filled polygon without an outline."""
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.view, points))
        self.shapes.append(f'<polygon points="{path}" fill="{colour}" opacity="{opacity}"/>')

    def dot(self, at, colour=INK, radius=4.0):
        x, y = self.view(at)
        self.shapes.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')

    def circle(self, at, radius, colour=INK, width=1.5, fill="none", dash=""):
        """A circle whose radius is in pixels."""
        x, y = self.view(at)
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.shapes.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" stroke="{colour}" stroke-width="{width}" '
            f'fill="{fill}"{extra}/>')

    def text(self, at, content, dx=0, dy=0, colour=INK, anchor="start", weight=""):
        x, y = self.view(at)
        extra = f' font-weight="{weight}"' if weight else ""
        self.shapes.append(
            f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{colour}" text-anchor="{anchor}"{extra}>{content}</text>')

    def note(self, x, y, content, colour=INK, anchor="start", weight=""):
        """A text at a place of the screen."""
        view, self.view = self.view, lambda point: point
        self.text((x, y), content, colour=colour, anchor=anchor, weight=weight)
        self.view = view

    def measure(self, start, end, content, colour=GOOD, dx=8, dy=5, anchor="start"):
        """A dimension: a line with two arrows and its length."""
        self.line([start, end], colour, 1.6, arrows="<>")
        middle = tuple((a + b) / 2 for a, b in zip(start, end))
        self.text(middle, content, dx, dy, colour, anchor)

    def svg(self):
        markers = "".join(
            f'<marker id="{c[1:]}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8" '
            f'markerUnits="userSpaceOnUse" orient="auto-start-reverse"><path d="M0 0 10 5 0 10z" fill="{c}"/></marker>'
            for c in (INK, PALE, ROD, BASE, PART, GOOD, BAD)
        )
        size = f'viewBox="0 0 {self.width} {self.height}"'
        return "\n".join([
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="14" role="img">',
            f"<title>{self.title}</title>",
            f"<defs>{markers}</defs>",
            f'<rect width="{self.width}" height="{self.height}" rx="8" fill="{PANEL}"/>',
            *self.shapes,
            "</svg>",
            "",
        ])


def flat(scale, left, top, across=0, down=1):
    """A view along an axis: the coordinate `across` goes to the right, `down` goes down."""
    return lambda point: (left + scale * point[across], top + scale * point[down])


def write(folder, drawings):
    """Writes each drawing under the name of its function; with --check it only compares."""
    stale = []
    for draw in drawings:
        path, text = folder / f"{draw.__name__}.svg", draw().svg()
        if "--check" not in sys.argv[1:]:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            stale.append(str(path))
    if stale:
        sys.exit(f"not what the script draws: {', '.join(stale)}")
