"""Draws each limit at a posture of the built-in machine, whose dimensions are invented: python3 docs/drawings/limits.py

Writes docs/limits/NAME.svg, NAME as in the API. With --check it writes nothing, and fails if a drawing is another one.
"""

from math import cos, radians, sin, sqrt

from limits_of_joints import platform_joint, rod_interference, slider_joint
from limits_of_table import rotary, table_clearance, tilt
from machine import HOME, L1, L2, LIMITS, R1, ROOT, Posture, Symmetric, r1, rot_x, serial_angle
from svg import BAD, GOOD, INK, PALE, ROD, Drawing, flat, write

def stroke():
    posture = Posture(0, -190, 1010)
    low, high = LIMITS["stroke"][0]
    title = "Stroke: the distance of each slider from the ends of its guideway"
    drawing = Drawing(title, view=flat(0.3, 360, 40, 1, 2))
    for guideway in (-500, 0, 500):
        drawing.line([(0, guideway, low - 60), (0, guideway, high + 60)], PALE, 3)
        for end in (low, high):
            drawing.line([(0, guideway - 50, end), (0, guideway + 50, end)], BAD, 2.5)
    for name, (a, b) in posture.rods().items():
        drawing.line([a, b], ROD, 2)
        if name[1] == "2" or name == "11":
            drawing.line([(0, a[1] - 30, a[2]), (0, a[1] + 30, a[2])], INK, 7)
    drawing.line([posture.platform((0, -R1, 0)), posture.platform((0, R1, 0))], INK, 4)
    drawing.dot(posture.position)
    drawing.text(posture.position, "P", 0, 22, anchor="middle")
    one, two, three = posture.rho
    drawing.measure((0, -560, two), (0, -560, high), f"{high - two:.0f} mm to slider2.max", dx=-8, anchor="end")
    drawing.measure((0, 0, low), (0, 0, one), f"{one - low:.0f} mm to slider1.min")
    drawing.measure((0, 560, low), (0, 560, three), f"{three - low:.0f} mm to slider3.min")
    drawing.note(20, 28, f"rho from {low} to {high} mm", BAD)
    drawing.note(20, 384, "seen along x; z points down", ROD)
    return drawing


def leg_length():
    drawing = Drawing("Leg length: a rod reaches from its guideway to the platform's joint")
    for left, reach in ((190, 760), (440, 1105)):
        drawing.view = flat(0.22, left, 60)
        drawing.line([(0, -60), (0, 1300)], PALE, 4)
        drawing.text((0, 1300), "guideway", 8, 0, ROD)
        root = sqrt(abs(L2**2 - reach**2))
        if reach < L2:
            drawing.line([(0, 1100 - root), (reach, 1100)], ROD, 4)
            drawing.text((reach / 2, 1100 - root / 2), f"L = {L2}", 10, -6, ROD)
            drawing.line([(0, 1100), (reach, 1100)], INK, 1, "4 4")
            drawing.text((reach / 2, 1100), f"d = {reach}", 0, 20, anchor="middle")
            drawing.measure((0, 1100 - root), (0, 1100), f"√(L² − d²) = {root:.0f} mm", dx=-12, anchor="end")
            drawing.dot((0, 1100 - root))
        else:
            drawing.line([(0, 1100), (L2, 1100)], ROD, 4)
            drawing.text((L2 / 2, 1100), f"L = {L2}", 0, -10, ROD, "middle")
            drawing.line([(0, 1160), (reach, 1160)], INK, 1, arrows="<>")
            drawing.text((reach / 2, 1160), f"d = {reach}", 0, 20, anchor="middle")
            drawing.line([(L2, 1050), (L2, 1150)], BAD, 2)
            drawing.text((0, 940), f"margin −√(d² − L²) = −{root:.0f} mm", 12, 0, BAD)
            drawing.dot((0, 1100))
        drawing.dot((reach, 1100), INK if reach < L2 else BAD)
    drawing.note(190, 28, "reached", GOOD, weight="bold")
    drawing.note(440, 28, "not reached", BAD, weight="bold")
    drawing.note(20, 384, "the plane of guideway and joint; d is their distance, L the rod’s length", ROD)
    return drawing


def serial_singularity():
    drawing = Drawing("Serial singularity: a rod is perpendicular to its guideway", view=flat(0.36, 150, 150))
    limit = radians(serial_angle())
    reach = 1.1 * L2
    fan = [(0, 0), (reach * cos(limit), reach * sin(limit)), (reach * cos(limit), -reach * sin(limit))]
    drawing.area(fan, BAD, 0.16)
    drawing.line([(0, -300), (0, 560)], PALE, 4)
    drawing.text((0, 560), "guideway", -8, 0, ROD, "end")
    drawing.line([(0, 0), (reach, 0)], BAD, 1, "6 4")
    drawing.text((reach, 0), "perpendicular", 0, -6, BAD, "end")
    drawing.line([(0, 0), fan[1]], BAD, 1.5)
    slope = radians(24)
    end = (L2 * cos(slope), L2 * sin(slope))
    drawing.line([(0, 0), end], ROD, 5)
    drawing.dot((0, 0))
    drawing.dot(end)
    drawing.text((0, 0), "slider", -10, 4, anchor="end")
    drawing.text(end, "platform’s joint", -30, 22)
    least = LIMITS["serial_margin"] * L2
    drawing.line([(end[0], least), (L2 * cos(limit), least)], BAD, 1, "3 3")
    drawing.measure((end[0], least), end, "")
    margin = sin(slope) - LIMITS["serial_margin"]
    drawing.text((end[0], end[1] * 0.62), f"margin {margin:.2f}", -8, 6, GOOD, "end")
    drawing.note(20, 28, f"height of the rod / L ≥ serial_margin = {LIMITS['serial_margin']}: "
                 f"at least {serial_angle():.1f}° from the perpendicular")
    drawing.note(20, 384, "the plane of guideway and rod; the margin is a pure number", ROD)
    return drawing


def parallel_singularity():
    drawing = Drawing("Parallel singularity: det_P vanishes", view=lambda p: (300 + 0.33 * p[0], 330 - 200 * p[1]))
    # The machine's plane of symmetry, y = 0; below zero leg I points upwards.
    heights = range(-560, 1001, 10)
    line = [(height, Symmetric(height).conditioning()) for height in heights]
    least, bottom = LIMITS["parallel_margin"], -0.15
    drawing.area([(-600, bottom), (1050, bottom), (1050, least), (-600, least)], BAD, 0.14)
    drawing.line([(-600, 0), (1050, 0)], INK, 1.2, arrows=">")
    drawing.text((1050, 0), "w1, mm", 6, 5)
    drawing.line([(-600, bottom), (-600, 1.45)], INK, 1.2, arrows=">")
    drawing.text((-600, 1.45), "det_P × sign at home", 10, 6)
    for tick in (-400, 0, 400, 800):
        drawing.line([(tick, 0), (tick, -0.03)])
        drawing.text((tick, 0), f"{tick}".replace("-", "−"), 0, 22, anchor="middle")
    for tick in (0.5, 1.0):
        drawing.line([(-600, tick), (-615, tick)])
        drawing.text((-600, tick), f"{tick}", -10, 5, anchor="end")
    drawing.line([point for point in line if point[1] > bottom], INK, 2.5)
    singular = next(a[0] for a, b in zip(line, line[1:]) if a[1] < 0 <= b[1])
    drawing.dot((singular, 0), BAD, 5)
    drawing.text((singular, 0), "two assembly modes merge", 12, -22, BAD)
    drawing.line([(0, 0), (0, 1.2)], PALE, 1.5, "5 4")
    drawing.text((0, 1.2), "leg I is level", -6, 0, ROD, "end")
    home = HOME.conditioning()
    drawing.dot((HOME.f[0], home))
    drawing.measure((HOME.f[0], least), (HOME.f[0], home), f"margin at home {home - least:.2f}", dx=-8, anchor="end")
    drawing.note(20, 28, f"det_P ≥ parallel_margin = {least}")
    drawing.note(20, 384, "w1 is the height of leg I; y = 0. On this machine other limits come first", ROD)
    return drawing


def rod_crossing():
    drawing = Drawing("Rod crossing: the rods of leg I cross")
    for left, alpha in ((60, -55), (660, -80)):
        a = radians(alpha)
        u, v = R1 * cos(a) - r1, R1 * sin(a)
        # y u + w1 v = 0, and the length of the rods, with X1 = -500.
        w1 = sqrt((L1**2 - 500**2 - u * u - v * v) / (1 + (v / u) ** 2))
        drawing.view = flat(0.22, left, 105)
        colour, y = (GOOD, -w1 * v / u) if u > 0 else (BAD, -w1 * v / u)
        for sign in (1, -1):
            _, across, down = rot_x(a, (0, sign * R1, 0))
            drawing.line([(sign * r1, 0), (y + across, w1 + down)], ROD if u > 0 else BAD, 3)
            drawing.line([(sign * r1 - 24, 0), (sign * r1 + 24, 0)], INK, 8)
            drawing.dot((y + across, w1 + down))
        _, across, down = rot_x(a, (0, R1, 0))
        drawing.line([(y - across, w1 - down), (y + across, w1 + down)], INK, 5)
        level = w1 + abs(down) + 70
        drawing.line([(y - across, level), (y + across, level)], INK, 1.2, arrows="<>")
        drawing.text((y, level), f"2 R1 cos α = {2 * R1 * cos(a):.0f}", 0, 20, anchor="middle")
        drawing.line([(-r1, -60), (r1, -60)], INK, 1.2, arrows="<>")
        drawing.text((0, -60), f"2 r1 = {2 * r1}", 0, -8, anchor="middle")
        drawing.text((y, level), f"margin {u:.0f} mm".replace("-", "−"), 0, 44, colour, "middle")
        drawing.text((y, level), f"α = {alpha}°".replace("-", "−"), 0, 68, anchor="middle")
    drawing.note(360, 28, f"margin = R1 cos α − r1, with R1 = {R1} mm, r1 = {r1} mm", anchor="middle")
    drawing.note(20, 384, "leg I seen along x", ROD)
    return drawing


DRAWINGS = (
    stroke, leg_length, serial_singularity, parallel_singularity, slider_joint, platform_joint, rod_crossing,
    rod_interference, tilt, rotary, table_clearance,
)


if __name__ == "__main__":
    write(ROOT / "docs/limits", DRAWINGS)
