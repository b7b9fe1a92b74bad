"""Draws the frames, the joints and the angles of the architecture: python3 docs/frames.py > docs/frames.svg

Dimensions: the built-in machine's, which are invented. Projection: parallel, from the front, above and to the right.
"""

from math import cos, pi, radians, sin, sqrt

D1, d1, D2, d2, R1, r1, R2, r4, W, L, DA, DT = 100, 600, -100, -600, 275, 75, 150, 500, 80, 1050, 1500, 200
TOOL = 190
POSE = (0.0, -330.0, 1070.0)
THETA1, THETA2 = radians(20), radians(25)
TURN, RISE, SCALE = radians(32), radians(22), 0.42

INK, PALE, ROD, BASE, PART, JOINT = "#1f2933", "#9aa5b1", "#52606d", "#0b5cad", "#b54708", "#0f7b53"


def rot_x(a, v):
    return (v[0], v[1] * cos(a) - v[2] * sin(a), v[1] * sin(a) + v[2] * cos(a))


def rot_z(a, v):
    return (v[0] * cos(a) - v[1] * sin(a), v[0] * sin(a) + v[1] * cos(a), v[2])


def add(*vectors):
    return tuple(sum(c) for c in zip(*vectors))


def times(k, v):
    return tuple(k * c for c in v)


def working_angle(x, y):
    """alpha of the working mode: the root near zero of y u + w1 v = 0, by bisection."""

    def miss(a):
        u, v = R1 * cos(a) - r1, R1 * sin(a)
        w1 = sqrt(L * L - (x + D1 - d1) ** 2 - y * y - u * u - v * v)
        return y * u + w1 * v

    low, high = -1.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if miss(middle) < 0 else (low, middle)
    return low


def screen(v):
    x, y, z = v
    across, toward = x * cos(TURN) - y * sin(TURN), x * sin(TURN) + y * cos(TURN)
    return (410 + SCALE * across, 130 + SCALE * (z * cos(RISE) + toward * sin(RISE)))


shapes = []


def line(points, colour=INK, width=1.5, dash="", arrow=False, fill="none", close=False):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(screen, points))
    tag = "polygon" if close else "polyline"
    extra = f' stroke-dasharray="{dash}"' if dash else ""
    extra += f' marker-end="url(#{colour[1:]})"' if arrow else ""
    shapes.append(f'<{tag} points="{path}" stroke="{colour}" stroke-width="{width}" fill="{fill}"{extra}/>')


def text(at, content, dx=0, dy=0, colour=INK, anchor="start", flat=False):
    x, y = at if flat else screen(at)
    shapes.append(f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{colour}" text-anchor="{anchor}">{content}</text>')


def dot(at, colour=INK, radius=3):
    x, y = screen(at)
    shapes.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')


def arc(centre, first, second, start, end, colour):
    steps = [start + (end - start) * i / 24 for i in range(25)]
    line([add(centre, times(cos(a), first), times(sin(a), second)) for a in steps], colour, 1.4, arrow=True)


def main():
    x, y, z = POSE
    alpha = working_angle(x, y)
    u, v = R1 * cos(alpha) - r1, R1 * sin(alpha)
    p, q = R2 * cos(alpha) - r4, R2 * sin(alpha)
    w1 = sqrt(L * L - (x + D1 - d1) ** 2 - y * y - u * u - v * v)
    x2 = x + D2 - d2
    rho = (z - w1, z - q - sqrt(L * L - x2 * x2 - (y - p) ** 2), z + q - sqrt(L * L - x2 * x2 - (y + p) ** 2))
    platform = lambda w: add(POSE, rot_x(alpha, w))
    legs = [
        ([(d1, r1), (d1, -r1)], [(D1, R1), (D1, -R1)], rho[0]),
        ([(d2 + W, -r4), (d2 - W, -r4)], [(D2 + W, -R2), (D2 - W, -R2)], rho[1]),
        ([(d2 + W, r4), (d2 - W, r4)], [(D2 + W, R2), (D2 - W, R2)], rho[2]),
    ]
    middles = [tuple(sum(c) / 2 for c in zip(*a)) for a, _, _ in legs]

    # The plane of the sliders' zero, the guideways and the sliders.
    line([(*m, 0) for m in middles], PALE, 1, "4 4", close=True)
    for number, ((a, b, height), middle) in enumerate(zip(legs, middles), 1):
        line([(*middle, 0), (*middle, 900)], PALE, 5)
        line([(*middle, 0), (*middle, height)], JOINT, 2, arrow=True)
        text((*middle, height / 2), f"ρ{number}", 9 if number == 1 else -9, 4, JOINT, "start" if number == 1 else "end")
        line([(*c, height) for c in a], INK, 7)
    # Rods, platform, tool.
    for a, b, height in legs:
        for end_a, end_b in zip(a, b):
            line([(*end_a, height), platform((*end_b, 0))], ROD, 2.5)
    corners = [(D1, R1), (D1, -R1), (D2 - W, -R2), (D2 - W, R2)]
    line([platform((*c, 0)) for c in corners], INK, 1.5, fill="#d9e2ecb0", close=True)
    tip = platform((0, 0, TOOL))
    line([POSE, tip], INK, 5)

    # The table with its frame.
    origin = add((0, 0, DA), rot_x(THETA1, (0, 0, DT)))
    table = lambda w: add(origin, rot_x(THETA1, rot_x(pi, rot_z(THETA2, w))))
    disc = [table((280 * cos(a), 280 * sin(a), 0)) for a in (2 * pi * i / 60 for i in range(60))]
    line(disc, INK, 1.2, fill="#f0f4f8", close=True)
    line([(-430, 0, DA), (430, 0, DA)], PALE, 1.2, "8 4 2 4")
    line([(0, 0, DA), origin], PALE, 1.2)
    text((-430, 0, DA), "tilting axis", -6, 5, ROD, "end")
    for axis, name in (((360, 0, 0), "X"), ((0, 360, 0), "Y"), ((0, 0, 240), "Z")):
        line([origin, table(axis)], PART, 1.8, arrow=True)
        text(table(axis), name, 5, 14 if name != "Z" else -4, PART)
    dot(origin, PART)
    text(origin, "part frame", -8, 18, PART, "end")

    # The base frame and the platform's own axes.
    for axis, name in (((230, 0, 0), "x"), ((0, 230, 0), "y"), ((0, 0, 230), "z (down)")):
        line([(0, 0, 0), axis], BASE, 1.8, arrow=True)
        text(axis, name, 6, 4, BASE)
    dot((0, 0, 0), BASE)
    text((0, 0, 0), "O, base frame", 8, -8, BASE)
    dot(POSE, INK, 4)
    text(POSE, "P (x, y, z)", 10, -6, INK)
    dot(tip, INK, 3)
    text(tip, "tool end", 8, 12)
    text(add(POSE, times(0.55, add(tip, times(-1, POSE)))), "tool_length", 9, 4)

    # Angles: alpha from the vertical to the tool, theta1 of the table, theta2 about its own axis.
    line([POSE, add(POSE, (0, 0, 330))], PALE, 1, "3 3")
    arc(POSE, (0, 0, 290), (0, -290, 0), 0, alpha, JOINT)
    text(add(POSE, (0, 0, 330)), "α", 0, 16, JOINT, "middle")
    pivot = (-330, 0, DA)
    line([pivot, add(pivot, (0, 0, 170))], PALE, 1, "3 3")
    arc(pivot, (0, 0, 150), (0, -150, 0), 0, THETA1, JOINT)
    text(add(pivot, (0, 60, 185)), "θ1", 14, 2, JOINT)
    flat = lambda w: add(origin, rot_x(THETA1, rot_x(pi, w)))
    line([origin, flat((330, 0, 0))], PALE, 1, "3 3")
    arc(origin, rot_x(THETA1, (300, 0, 0)), rot_x(THETA1, (0, -300, 0)), 0, THETA2, JOINT)
    text(flat((310, 0, 0)), "θ2", 6, 6, JOINT)

    notes = [
        ("φ1 = α − θ1,  φ2 = −θ2", INK),
        ("axis (tool end → holder, in the part frame) =", INK),
        ("(sin φ1 sin φ2, −sin φ1 cos φ2, cos φ1)", INK),
        ("α, θ1 turn about +x; θ2 turns about the table’s axis", ROD),
        ("dimensions: the built-in machine’s, invented", ROD),
    ]
    for number, (content, colour) in enumerate(notes):
        text((590, 660 + 20 * number), content, colour=colour, flat=True)

    markers = "".join(
        f'<marker id="{c[1:]}" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="7" markerHeight="7" '
        f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0 10 5 0 10z" fill="{c}"/></marker>'
        for c in (BASE, PART, JOINT)
    )
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 890" font-family="sans-serif" font-size="15">')
    print('<rect width="960" height="890" fill="#ffffff"/>')
    print(f"<defs>{markers}</defs>")
    print("\n".join(shapes))
    print("</svg>")


main()
