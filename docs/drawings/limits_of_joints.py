"""Drawings of the limits of joints and rods, in a parallel projection from the front, above and to the right."""

from math import cos, pi, radians, sin, tan

from machine import (
    D1, D2, HOME, LIMITS, R1, R2, ROD_RADIUS, Posture, W, add, cone_angles, cross, dot, minus, rot_x, times, unit,
)
from svg import BAD, GOOD, INK, PALE, ROD, Drawing


def oblique(left, top, scale, turn=32, rise=22):
    """A parallel projection of the base frame, whose z points down."""
    turn, rise = radians(turn), radians(rise)

    def view(v):
        x, y, z = v
        across, toward = x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn)
        return (left + scale * across, top + scale * (z * cos(rise) + toward * sin(rise)))

    return view


def draw_machine(drawing, posture, bold):
    """Guideways, sliders, rods and the platform; one rod is bold."""
    low, high = LIMITS["stroke"][0]
    rods = posture.rods()
    for pair in (("11", "12"), ("21", "22"), ("31", "32")):
        ends = [rods[name][0] for name in pair]
        middle = times(0.5, add(*ends))
        drawing.line([(*middle[:2], low), (*middle[:2], high)], PALE, 4)
        drawing.line(ends, INK, 6)
    for name, (a, b) in rods.items():
        drawing.line([a, b], INK if name == bold else ROD, 4 if name == bold else 1.6)
    corners = [(D1, R1, 0), (D1, -R1, 0), (D2 - W, -R2, 0), (D2 - W, R2, 0)]
    drawing.line([posture.platform(corner) for corner in corners], INK, 1.5, fill="#d9e2ec", close=True, opacity=0.8)


def draw_cone(drawing, apex, axis, half_angle, length):
    """The cone with its axis."""
    axis = unit(axis)
    first = unit(cross(axis, (0.3, 0.9, 0.1)))
    second = cross(axis, first)
    radius, base = length * tan(half_angle), add(apex, times(length, axis))
    rim = [add(base, times(radius * cos(t), first), times(radius * sin(t), second))
           for t in (2 * pi * i / 72 for i in range(72))]
    drawing.line(rim, BAD, 1.5, close=True)
    seen = [drawing.view(point) for point in rim]
    x, y = drawing.view(apex)
    # The outline: the two points of the rim between which the apex sees all others.
    side = lambda i, j: (seen[i][0] - x) * (seen[j][1] - y) - (seen[i][1] - y) * (seen[j][0] - x)
    for sign in (1, -1):
        for i in range(len(seen)):
            if all(sign * side(i, j) >= -1e-6 for j in range(len(seen))):
                drawing.line([apex, rim[i]], BAD, 1.5)
                break
    drawing.line([apex, add(apex, times(1.25 * length, axis))], BAD, 1.5, "6 4")
    drawing.area(rim, BAD, 0.12)


def cone(at, position, title, view):
    posture = Posture(*position)
    angles = cone_angles(posture, at)
    name = max(angles, key=angles.get)
    home, (a, b) = HOME.rods()[name], posture.rods()[name]
    limit = LIMITS[f"{at}_cone"]
    axis = minus(home[1], home[0])
    drawing = Drawing(title, view=view)
    draw_machine(drawing, posture, name)
    if at == "slider":
        draw_cone(drawing, a, axis, radians(limit), 330)
        drawing.dot(a, BAD, 5)
    else:
        draw_cone(drawing, b, times(-1, rot_x(posture.alpha, axis)), radians(limit), 400)
        drawing.dot(b, BAD, 5)
    where = "the base frame" if at == "slider" else "the platform’s frame"
    drawing.note(20, 28, f"rod {name} is {angles[name]:.1f}° off the axis of its cone")
    drawing.note(20, 50, f"{at}_cone = {limit}°: margin {limit - angles[name]:.1f}°", GOOD)
    drawing.note(20, 384, f"the axis stands still in {where}: it is the rod’s direction at home", ROD)
    return drawing


def slider_joint():
    title = "Slider joint: the angle between a rod and the axis of its joint at the slider"
    return cone("slider", (100, 440, 1130), title, oblique(420, 90, 0.215))


def platform_joint():
    title = "Platform joint: the angle between a rod and the axis of its joint at the platform"
    return cone("platform", (-390, 0, 1150), title, oblique(420, 60, 0.235, turn=20, rise=14))


def nearest(first, second):
    """The points of two segments that are nearest to each other, by alternating projection."""
    s, t = 0.5, 0.5
    (a, b), (c, d) = first, second
    u, v = minus(b, a), minus(d, c)
    for _ in range(2000):
        s = min(1, max(0, dot(minus(add(c, times(t, v)), a), u) / dot(u, u)))
        t = min(1, max(0, dot(minus(add(a, times(s, u)), c), v) / dot(v, v)))
    return add(a, times(s, u)), add(c, times(t, v))


def rod_interference():
    posture = Posture(250, 300, 1130)
    rods = posture.rods()
    names = list(rods)
    pairs = [(one, other) for i, one in enumerate(names) for other in names[i + 1:] if one[0] != other[0]]
    distance = lambda pair: dot(*[minus(*nearest(rods[pair[0]], rods[pair[1]]))] * 2) ** 0.5
    pair = min(pairs, key=distance)
    one, other = rods[pair[0]], rods[pair[1]]
    start, end = nearest(one, other)
    gap = distance(pair)
    # The view is along the first rod, so the shortest way between the rods has its true length.
    along = unit(minus(one[1], one[0]))
    across = unit(minus(end, start))
    down = cross(along, across)
    drawing = Drawing("Rod interference: the distance between the surfaces of two rods")
    scale = min(0.9, 330 / gap)
    drawing.view = lambda v: (190 + scale * dot(minus(v, start), across), 190 + scale * dot(minus(v, start), down))
    direction = unit(minus(other[1], other[0]))
    a, b = add(end, times(-230, direction)), add(end, times(230, direction))
    # The second rod as a strip of its width.
    seen = unit((dot(direction, across), dot(direction, down), 0))
    normal = add(times(-seen[1], across), times(seen[0], down))
    strip = [add(a, times(ROD_RADIUS, normal)), add(b, times(ROD_RADIUS, normal)),
             add(b, times(-ROD_RADIUS, normal)), add(a, times(-ROD_RADIUS, normal))]
    drawing.line(strip, ROD, 1.5, fill="#d9e2ec", close=True)
    drawing.line([a, b], ROD, 1, "8 4 2 4")
    drawing.circle(start, scale * ROD_RADIUS, ROD, 1.5, "#d9e2ec")
    drawing.dot(start, ROD, 2.5)
    drawing.text(start, f"rod {pair[0]}, end on", 0, 48, ROD, "middle")
    drawing.text(b, f"rod {pair[1]}", 34, 0, ROD)
    drawing.measure(add(start, times(ROD_RADIUS, across)), add(end, times(-ROD_RADIUS, across)),
                    f"margin {gap - 2 * ROD_RADIUS:.0f} mm", dy=-10, anchor="middle")
    drawing.note(20, 28, f"distance of the axes {gap:.0f} mm less 2 rod_radius = {2 * ROD_RADIUS} mm")
    drawing.note(20, 384, f"P = ({', '.join(f'{c:.0f}' for c in posture.position)}); seen along rod {pair[0]}", ROD)
    return drawing
