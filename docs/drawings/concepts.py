"""Draws the concepts of the guide with the numbers of the built-in machine, which are invented:
python3 docs/drawings/concepts.py

Writes docs/NAME.svg. With --check it writes nothing, and fails if a drawing is another one."""

from math import cos, pi, radians, sin, sqrt

from limits_of_joints import oblique
from machine import D1, D2, L1, L2, LIMITS, R1, R2, ROOT, Posture, da, d1, d2, dt, r1, r4, rot_x
from svg import BAD, BASE, GOOD, INK, PALE, PART, ROD, Drawing, flat, write


def angles():
    """phi1 and phi2 of the tool in the part frame, and the other preimage."""
    phi1, phi2 = radians(35), radians(50)
    view = oblique(300, 290, 0.95, turn=-35, rise=28)
    drawing = Drawing("The angles phi1 and phi2 of the tool in the part frame",
                      view=lambda v: view((v[0], -v[1], -v[2])))
    ground = [(170 * cos(t), 170 * sin(t), 0) for t in (2 * pi * i / 72 for i in range(72))]
    drawing.line(ground, PALE, 1.2, fill="#e9eef3", close=True)
    for axis, name in (((230, 0, 0), "X"), ((0, 230, 0), "Y"), ((0, 0, 250), "Z")):
        drawing.line([(0, 0, 0), axis], PART, 1.8, arrows=">")
        drawing.text(axis, name, 6, -2, PART)
    axis = (sin(phi1) * sin(phi2), -sin(phi1) * cos(phi2), cos(phi1))
    tip = tuple(240 * c for c in axis)
    foot = (tip[0], tip[1], 0)
    drawing.line([(0, 0, 0), tip], INK, 6)
    drawing.text(tip, "tool, to the holder", 10, 0)
    drawing.line([tip, foot], PALE, 1.2, "4 4")
    drawing.line([(0, 0, 0), foot], PALE, 1.2, "4 4")
    drawing.line([(0, 0, 0), (0, -200, 0)], PALE, 1.2, "4 4")
    drawing.text((0, -200, 0), "−Y", -22, 6, ROD)
    inclined = lambda s: (150 * sin(s) * sin(phi2), -150 * sin(s) * cos(phi2), 150 * cos(s))
    drawing.line([inclined(phi1 * i / 30) for i in range(31)], GOOD, 2, arrows=">")
    drawing.text(inclined(phi1 / 2), "φ1", 0, -10, GOOD)
    steps = [phi2 * i / 30 for i in range(31)]
    drawing.line([(120 * sin(s), -120 * cos(s), 0) for s in steps], GOOD, 2, arrows=">")
    drawing.text((120 * sin(phi2 / 2), -120 * cos(phi2 / 2), 0), "φ2", -4, 22, GOOD)
    drawing.dot((0, 0, 0), PART)
    drawing.note(490, 40, "axis = (sin φ1 sin φ2, −sin φ1 cos φ2, cos φ1)", anchor="middle")
    drawing.note(490, 64, "(−φ1, φ2 + 180°) is the other preimage of this axis", ROD, "middle")
    drawing.note(20, 384, "the part frame: Z points up from the table", ROD)
    return drawing


def columns():
    """A section of the platform's workspace at x = 0: columns between the sliders' ends."""
    drawing = Drawing("A section of the workspace of the platform: each column ends where a slider does", height=440,
                      view=lambda p: (335 + 0.46 * p[0], 40 + 0.42 * (p[1] - 850)))
    low_stroke, high_stroke = LIMITS["stroke"][0]
    colours = (BASE, PART, GOOD)
    ends = []
    for y in range(-540, 541, 4):
        f = Posture(0, y, 0).f
        low, high = max(low_stroke + v for v in f), min(high_stroke + v for v in f)
        if low < high:
            binding = (f.index(max(f)), f.index(min(f)))
            ends.append((y, low, high, *binding))
    outline = [(y, low) for y, low, *_ in ends] + [(y, high) for y, _, high, *_ in reversed(ends)]
    drawing.area(outline, INK, 0.08)
    for y, low, high, *_ in ends[::9]:
        drawing.line([(y, low), (y, high)], PALE, 1)
    for place, which in ((1, 3), (2, 4)):
        for slider in range(3):
            points = [(end[0], end[place]) for end in ends if end[which] == slider]
            for part in runs(points):
                drawing.line(part, colours[slider], 3)
    drawing.line([(-600, 850), (-600, 1650)], INK, 1.2, arrows=">")
    drawing.text((-600, 1650), "z, mm", -4, 20, anchor="end")
    for z in (900, 1200, 1500):
        drawing.text((-600, z), str(z), -8, 5, anchor="end")
        drawing.line([(-606, z), (-600, z)])
    for y in (-400, 0, 400):
        drawing.text((y, 1650), f"y = {y}".replace("-", "−"), 0, 20, anchor="middle")
    for slider in range(3):
        drawing.note(594, 60 + 24 * slider, f"slider {slider + 1} at its end", colours[slider])
    drawing.note(20, 424, "x = 0; the other limits end the region on the left and on the right", ROD)
    return drawing


def runs(points):
    """The points in parts without gaps."""
    parts, last = [], None
    for point in points:
        if last is None or point[0] - last > 4:
            parts.append([])
        parts[-1].append(point)
        last = point[0]
    return [part for part in parts if len(part) > 1]


def leg_one():
    """The symbols of leg I, seen along x."""
    a, w1 = radians(-32), 640
    u, v = R1 * cos(a) - r1, R1 * sin(a)
    y = -w1 * v / u
    drawing = Drawing("Leg I seen along x: the symbols of the derivation", view=flat(0.36, 160, 60))
    for sign in (1, -1):
        _, across, down = rot_x(a, (0, sign * R1, 0))
        drawing.line([(sign * r1, 0), (y + across, w1 + down)], ROD, 3)
        drawing.dot((y + across, w1 + down))
        drawing.line([(sign * r1 - 24, 0), (sign * r1 + 24, 0)], INK, 8)
        drawing.text((sign * r1, 0), "11" if sign > 0 else "12", 0, -10, anchor="middle")
    _, across, down = rot_x(a, (0, R1, 0))
    drawing.line([(y - across, w1 - down), (y + across, w1 + down)], INK, 5)
    drawing.dot((y, w1), INK, 5)
    drawing.text((y, w1), "P", 10, -8, weight="bold")
    drawing.line([(0, 0), (0, w1 + 60)], PALE, 3)
    drawing.text((0, w1 + 60), "guideway", 6, 8, ROD)
    drawing.line([(0, 0), (y, w1)], BASE, 1.3, "5 4")
    drawing.measure((-130, 0), (-130, w1), "w1 = z − ρ1", BASE, dx=-8, anchor="end")
    drawing.measure((0, w1), (y, w1), "y", BASE, dx=0, dy=-8, anchor="middle")
    end = (y + across, w1 + down)
    drawing.measure((y, w1 + 150), (y + across, w1 + 150), "R1 cos α", GOOD, dx=0, dy=20, anchor="middle")
    drawing.measure((end[0] + 60, w1), (end[0] + 60, end[1]), "v = R1 sin α", GOOD)
    drawing.line([(y, w1), (y + across + 90, w1)], PALE, 1, "3 3")
    drawing.note(470, 60, "u = R1 cos α − r1", GOOD)
    drawing.note(470, 84, "rod 11: (X1, y + u, w1 + v)")
    drawing.note(470, 108, "rod 12: (X1, y − u, w1 − v)")
    drawing.note(470, 132, "their lengths are equal:")
    drawing.note(470, 156, "y u + w1 v = 0", weight="bold")
    return drawing


def plane_place(rho1, rho2):
    """x and z of P in the plane of symmetry (y = 0, alpha = 0), by bisection."""
    u, p = R1 - r1, R2 - r4
    f1 = lambda x: sqrt(L1**2 - (x + D1 - d1) ** 2 - u * u)
    f2 = lambda x: sqrt(L2**2 - (x + D2 - d2) ** 2 - p * p)
    low, high = -400.0, 400.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if f1(middle) - f2(middle) < rho2 - rho1 else (low, middle)
    return low, rho1 + f1(low)


def bend():
    """The tip's way if a controller moves the joints straight from one end of a line to the other."""
    tool, height = 100, 300
    z = da + dt - tool - height
    start, end = Posture(-150, 0, z).rho, Posture(150, 0, z).rho
    way = []
    for i in range(101):
        s = i / 100
        x, place = plane_place(*(a + s * (b - a) for a, b in zip(start[:2], end[:2])))
        way.append((x, da + dt - tool - place))
    drawing = Drawing("A straight line, and the tip’s way while the joints move straight", height=300,
                      view=lambda p: (360 + 1.9 * p[0], 70 + 8 * (height - p[1])))
    drawing.line([(-150, height), (150, height)], GOOD, 3)
    drawing.line(way, BAD, 3)
    lowest = min(way, key=lambda point: point[1])
    drawing.measure((lowest[0], height), lowest, f"{height - lowest[1]:.1f} mm", INK)
    for x in (-150, 150):
        drawing.dot((x, height))
        drawing.text((x, height), f"({x}, 0, {height})".replace("-", "−"), 0, -14, anchor="middle")
    drawing.note(20, 284, "tool of 100 mm, phi1 = phi2 = 0; heights are drawn about four times as large as lengths", ROD)
    return drawing


if __name__ == "__main__":
    write(ROOT / "docs", (angles, columns, leg_one, bend))
