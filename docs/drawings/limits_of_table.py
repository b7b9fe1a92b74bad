"""Drawings of the limits of the table."""

from math import cos, radians, sin

from machine import D1, LIMITS, R1, Posture, add, da, dt, rot_x
from svg import BAD, BASE, GOOD, INK, PALE, PART, ROD, Drawing, flat


def arc(centre, radius, start, end, squash=1.0):
    """Points of an arc; angles in degrees, counted from the right and upwards on the screen."""
    steps = [radians(start + (end - start) * i / 90) for i in range(91)]
    return [(centre[0] + radius * cos(t), centre[1] - squash * radius * sin(t)) for t in steps]


def tilt():
    theta, (low, high) = 35, LIMITS["tilt"]
    drawing = Drawing("Tilt: theta1 turns the table within its range", view=flat(0.56, 360, 195))
    axis = (0, 0)
    # theta1 turns about x; seen from the front of the tilting axis, positive angles turn the table to the left.
    up = lambda degrees_, length: (-length * sin(radians(degrees_)), -length * cos(radians(degrees_)))
    drawing.area([axis, *arc(axis, 250, 90 + low, 90 + high)], GOOD, 0.10)
    for limit in (low, high):
        drawing.line([axis, up(limit, 280)], BAD, 2)
    drawing.line([axis, up(0, 280)], PALE, 1.2, "4 4")
    middle, side = up(theta, -dt), (cos(radians(theta)), -sin(radians(theta)))
    ends = [(middle[0] + s * side[0], middle[1] + s * side[1]) for s in (-230, 230)]
    drawing.line([axis, middle], INK, 4)
    drawing.line(ends, INK, 8)
    drawing.line([middle, (middle[0] + up(theta, 130)[0], middle[1] + up(theta, 130)[1])], PART, 2, arrows=">")
    drawing.text((middle[0] + up(theta, 130)[0], middle[1] + up(theta, 130)[1]), "Z", 8, 20, PART)
    drawing.line([axis, up(theta, 250)], GOOD, 1.2, "4 4")
    drawing.dot(axis, BASE, 6)
    drawing.text(axis, "tilting axis (x)", -12, 22, BASE, "end")
    drawing.line(arc(axis, 170, 90, 90 + theta), INK, 1.5, arrows=">")
    drawing.text(up(theta / 2, 190), f"θ1 = {theta}°", 0, 0, anchor="middle")
    drawing.line(arc(axis, 215, 90 + theta, 90 + high), GOOD, 1.8, arrows="<>")
    drawing.text(up((theta + high) / 2, 232), f"margin {high - theta}°", -4, 0, GOOD, "end")
    drawing.text(up(low, 288), f"{low}°".replace("-", "−"), 4, 5, BAD)
    drawing.text(up(high, 288), f"{high}°", -4, 5, BAD, "end")
    drawing.note(20, 384, f"seen against x; the table’s plane is dt = {dt} mm from the tilting axis", ROD)
    return drawing


def rotary():
    theta, (low, high) = 130, LIMITS["rotary"]
    title = "Rotary: theta2 turns the table within its range, which may be several turns"
    drawing = Drawing(title, view=flat(0.58, 330, 195))
    spiral = lambda degrees_: (230 + 90 * degrees_ / 720)
    at = lambda degrees_: (spiral(degrees_) * cos(radians(degrees_)), -spiral(degrees_) * sin(radians(degrees_)))
    way = lambda start, end: [at(start + (end - start) * i / 200) for i in range(201)]
    drawing.circle((0, 0), 0.58 * 170, INK, 1.5, "#e4e9ef")
    drawing.dot((0, 0), PART)
    drawing.text((0, 0), "table’s axis", 10, -8, PART)
    drawing.line(way(low, high), GOOD, 2)
    for limit in (low, high):
        drawing.dot(at(limit), BAD, 6)
        drawing.text(at(limit), f"{limit}°".replace("-", "−"), 10 if limit > 0 else -12, -8 if limit > 0 else 5, BAD,
                     "start" if limit > 0 else "end")
    drawing.line([(0, 0), at(theta)], INK, 1.5)
    for winding in (theta, theta - 360):
        drawing.dot(at(winding), INK, 5)
    drawing.text(at(theta), f"θ2 = {theta}°, margin {high - theta}°", -16, -14, INK, "end")
    drawing.text(at(theta - 360), f"winding {theta - 360}°".replace("-", "−"), 8, 34, ROD)
    drawing.note(470, 330, f"range {low}° to {high}°:".replace("-", "−"))
    drawing.note(470, 352, "most angles have two windings")
    drawing.note(20, 384, "seen along the table’s axis; the radius shows the turns", ROD)
    return drawing


def table_clearance():
    posture, tool_length, radius, clearance = Posture(0, -120, 1010), 160, 40, 30
    theta1, alpha = posture.alpha, posture.alpha
    origin = add((0, 0, da), rot_x(theta1, (0, 0, dt)))
    along, up = rot_x(theta1, (0, 1, 0)), rot_x(theta1, (0, 0, -1))
    tip = posture.platform((0, 0, tool_length))
    height = lambda point: sum(u * (p - o) for u, p, o in zip(up, point, origin))
    drawing = Drawing("Table clearance: the least height of tool and joints over the table", height=440,
                      view=flat(0.42, 330, -368, 1, 2))
    plane = lambda s, h=0: add(origin, tuple(s * c for c in along), tuple(h * c for c in up))
    drawing.line([plane(-560), plane(520)], INK, 6)
    drawing.area([plane(-560), plane(520), plane(520, clearance), plane(-560, clearance)], BAD, 0.2)
    drawing.line([plane(-560, clearance), plane(520, clearance)], BAD, 1.5)
    drawing.text(plane(520, clearance), f"table_clearance = {clearance}", 0, 34, BAD, "end")
    drawing.text(plane(-560), "table, Z = 0", 0, 24)
    drawing.line([posture.platform((0, -R1, 0)), posture.platform((0, R1, 0))], INK, 5)
    drawing.line([posture.position, tip], INK, 4)
    circle = [add(tip, rot_x(alpha, (0, s * radius, 0))) for s in (-1, 1)]
    drawing.line(circle, PART, 4)
    drawing.text(circle[1], "end of the tool", 12, -2, PART)
    for sign in (-1, 1):
        joint = posture.platform((D1, sign * R1, 0))
        drawing.dot(joint, INK, 5)
        foot = add(joint, tuple(-(height(joint) - clearance) * c for c in up))
        drawing.measure(joint, foot, f"{height(joint) - clearance:.0f} mm", dx=8 if sign > 0 else -8,
                        anchor="start" if sign > 0 else "end")
    lowest = circle[0] if height(circle[0]) < height(circle[1]) else circle[1]
    foot = add(lowest, tuple(-(height(lowest) - clearance) * c for c in up))
    drawing.measure(lowest, foot, f"{height(lowest) - clearance:.0f} mm", dx=-8, anchor="end")
    drawing.note(20, 28, f"tool of {tool_length} mm with a radius of {radius} mm; the least of the heights counts")
    drawing.note(20, 424, "seen along x", ROD)
    return drawing
