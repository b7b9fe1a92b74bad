"""Makes a set of forward problems of machines with R1 = r1 or e1 = e2, or nearly so, with every solution.

    python3 tests/reference/solve_family_edge.py MACHINES SEED > set.json

The method shares nothing with the solver: no elimination, no polynomial, no chart of leg I. Newton's method on Eqs (3)-(6)
in (x, y, z, alpha) starts from many random poses in double precision. mpmath then refines each distinct solution with 60
digits and checks it: rods closed to 1e-45 mm. Starts are added until each solution has been reached at least eight
times and the last 4,000 starts have reached no new one. A case with a condition number over 1e6, or with solutions
closer than 1e-3 mm and 1e-6 rad, is not kept: there double precision could not tell them apart.
"""

import argparse
import json
import math
import random
import sys

import mpmath
import numpy

mpmath.mp.dps = 60
DIFFERENCES = [0.0] + [10.0**power for power in range(-12, -1)]
STARTS = 4000


def errors(g, rho, pose, lib):
    """The four equations (|B - A|² - L²) / 2L and the rods, for numbers of numpy or mpmath."""
    x, y, z, a = pose
    c, s = lib.cos(a), lib.sin(a)
    e1, e2 = g["D1"] - g["d1"], g["D2"] - g["d2"]
    u, v, p, q = g["R1"] * c - g["r1"], g["R1"] * s, g["R2"] * c - g["r4"], g["R2"] * s
    rods = [
        (x + e1, y + u, z + v - rho[0]),
        (x + e1, y - u, z - v - rho[0]),
        (x + e2, y - p, z - q - rho[1]),
        (x + e2, y + p, z + q - rho[2]),
    ]
    lengths = [g["L1"], g["L1"], g["L2"], g["L3"]]
    arms = [g["R1"], -g["R1"], -g["R2"], g["R2"]]
    values = [(bx * bx + by * by + bz * bz - l * l) / (2 * l) for (bx, by, bz), l in zip(rods, lengths)]
    rows = [
        [bx / l, by / l, bz / l, arm * (c * bz - s * by) / l]
        for (bx, by, bz), l, arm in zip(rods, lengths, arms)
    ]
    return values, rows, rods


def multistart(g, rho, count, generator):
    """The poses that Newton's method reaches from `count` random starts."""
    longest = max(g["L1"], g["L2"], g["L3"])
    x = -(g["D1"] - g["d1"]) + longest * generator.uniform(-1.2, 1.2, count)
    y = longest * generator.uniform(-1.2, 1.2, count)
    z = rho[0] + longest * generator.uniform(-1.2, 1.2, count)
    a = generator.uniform(-math.pi, math.pi, count)
    a[: count // 4] *= 1e-3
    pose = numpy.array([x, y, z, a])
    for _ in range(60):
        values, rows, _ = errors(g, rho, pose, numpy)
        matrix = numpy.moveaxis(numpy.array(rows), 2, 0) + 1e-300 * numpy.eye(4)
        try:
            step = numpy.linalg.solve(matrix, numpy.array(values).T[:, :, None])[:, :, 0].T
        except numpy.linalg.LinAlgError:
            matrix = matrix + 1e-13 * longest * generator.standard_normal(matrix.shape)
            step = numpy.linalg.solve(matrix, numpy.array(values).T[:, :, None])[:, :, 0].T
        size = numpy.abs(step[3])
        scale = numpy.where(size > 1.0, 1.0 / numpy.maximum(size, 1e-300), 1.0)
        pose = pose - step * scale
    values, _, _ = errors(g, rho, pose, numpy)
    worst = numpy.max(numpy.abs(numpy.array(values)), axis=0)
    good = numpy.isfinite(worst) & (worst < 1e-9 * (longest + abs(rho[0])))
    pose = pose[:, good]
    pose[3] = numpy.remainder(pose[3] + math.pi, 2 * math.pi) - math.pi
    return pose.T


def same(a, b, length, angle):
    turn = abs(math.remainder(float(a[3] - b[3]), 2 * math.pi))
    return max(abs(float(a[i] - b[i])) for i in range(3)) < length and turn < angle


def refine(g, rho, pose):
    """The solution with 60 digits, or None."""
    exact = {name: mpmath.mpf(value) for name, value in g.items()}
    sliders = [mpmath.mpf(value) for value in rho]
    point = [mpmath.mpf(float(value)) for value in pose]
    for _ in range(12):
        values, rows, _ = errors(exact, sliders, point, mpmath)
        try:
            step = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(values))
        except ZeroDivisionError:
            return None
        point = [point[i] - step[i] for i in range(4)]
    values, rows, rods = errors(exact, sliders, point, mpmath)
    if max(abs(value) for value in values) > mpmath.mpf(10) ** -45:
        return None
    while point[3] > mpmath.pi:
        point[3] -= 2 * mpmath.pi
    while point[3] <= -mpmath.pi:
        point[3] += 2 * mpmath.pi
    return point, rows, rods


def determinant(g, rows):
    """det_P: the last column is per R1 alpha."""
    return float(mpmath.det(mpmath.matrix(rows))) / g["R1"]


def home_determinant(g):
    e1, e2 = g["D1"] - g["d1"], g["D2"] - g["d2"]
    u, p = g["R1"] - g["r1"], g["R2"] - g["r4"]
    heights = [math.sqrt(g["L1"] ** 2 - e1**2 - u**2)]
    heights += [math.sqrt(g[name] ** 2 - e2**2 - p**2) for name in ("L2", "L3")]
    _, rows, _ = errors(g, [-height for height in heights], [0.0, 0.0, 0.0, 0.0], math)
    return float(numpy.linalg.det(numpy.array(rows))) / g["R1"]


def solve(g, rho, generator):
    """Every solution, or None if double precision could not tell them apart."""
    found, hits, quiet = [], [], False
    for _ in range(12):
        new = False
        for pose in multistart(g, rho, STARTS, generator):
            for i, known in enumerate(found):
                if same(pose, known, 1e-3, 1e-6):
                    hits[i] += 1
                    break
            else:
                found.append(pose)
                hits.append(1)
                new = True
        quiet = not new
        if quiet and min(hits, default=8) >= 8:
            break
    if not quiet:
        return None
    refined = [refine(g, rho, pose) for pose in found]
    if any(item is None for item in refined):
        return None
    points = []
    for point, rows, rods in refined:
        scaled = numpy.array([[float(value) for value in row] for row in rows])
        scaled[:, 3] /= g["R1"]
        if numpy.linalg.cond(scaled) > 1e6:
            return None
        if any(same(point, other[0], 1e-3, 1e-6) for other in points):
            return None
        points.append((point, rows, rods))
    return [describe(g, *item) for item in mark_working(g, points)]


def mark_working(g, points):
    """Of several solutions with all rods up and uncrossed rods those on home's side are in the working mode.

    There det_P has the sign of home. With nearly equal offsets x + e has it, too: x = -e is a singularity.
    """
    e1, e2 = g["D1"] - g["d1"], g["D2"] - g["d2"]
    nearly_equal = abs(e1 - e2) < 1e-2 * max(g["L1"], g["L2"], g["L3"])
    up = []
    for point, _, rods in points:
        cosine = mpmath.mpf(g["R1"]) * mpmath.cos(point[3]) - mpmath.mpf(g["r1"])
        level = g["R1"] == g["r1"] and abs(point[3]) < mpmath.mpf(10) ** -30
        up.append((cosine > 0 or level) and all(bz > 0 for _, _, bz in rods))
    if sum(up) > 1:
        home = home_determinant(g)
        on_side = [is_up and determinant(g, rows) * home > 0 for is_up, (_, rows, _) in zip(up, points)]
        if nearly_equal:
            on_side = [is_up and (2 * x[0] + e1 + e2) * (e1 + e2) > 0 for is_up, (x, _, _) in zip(on_side, points)]
        up = on_side if any(on_side) else up
    return [(*item, is_up) for item, is_up in zip(points, up)]


def describe(g, point, rows, rods, working):
    digits = [mpmath.nstr(value, 50, strip_zeros=True) for value in point[:3]]
    alpha = mpmath.nstr(mpmath.degrees(point[3]), 50) if abs(point[3]) > mpmath.mpf(10) ** -40 else "0.0"
    return {"x": digits[0], "y": digits[1], "z": digits[2], "alpha": alpha, "working": bool(working)}


def geometry(kind, difference, draw):
    """A machine of some proportions at a distance from R1 = r1, from e1 = e2, or from both."""
    size = 1000.0
    between = lambda low, high: size * draw.uniform(low, high)
    g = {"D1": between(-0.2, 0.2), "D2": between(-0.2, 0.2), "R2": between(0.05, 0.4), "r4": between(0.1, 0.6)}
    g["r1"] = between(0.05, 0.4)
    g["R1"] = between(0.05, 0.4) + g["r1"]
    g["L1"], g["L2"] = between(0.7, 1.3), between(0.7, 1.3)
    g["L3"] = g["L2"] if draw.random() < 0.5 else between(0.7, 1.3)
    g["d1"] = g["D1"] + between(0.05, 0.5) * draw.choice([1, -1])
    g["d2"] = g["D2"] + between(0.05, 0.5) * draw.choice([1, -1])
    if kind in ("delta", "both"):
        g["R1"] = g["r1"] * (1.0 + difference)
    if kind in ("offsets", "both"):
        # D1 = D2: then the offsets differ by exactly d2 - d1.
        g["D2"] = g["D1"]
        g["d2"] = g["d1"] + difference * max(g["L1"], g["L2"], g["L3"])
    return g


def sliders(g, symmetric, draw):
    """Sliders of a random posture that reaches, most rods up."""
    for _ in range(200):
        a = draw.choice([0.0, draw.uniform(-0.5, 0.5), draw.uniform(-math.pi, math.pi)])
        if g["R1"] / g["r1"] - 1 < 1e-2 and draw.random() < 0.5:
            a = 0.0
        x = -(g["D1"] - g["d1"]) + g["L1"] * draw.uniform(-0.8, 0.8)
        u, v = g["R1"] * math.cos(a) - g["r1"], g["R1"] * math.sin(a)
        square = g["L1"] ** 2 - (x + g["D1"] - g["d1"]) ** 2 - u * u - v * v
        if square <= 0:
            continue
        size, length = math.sqrt(square), math.hypot(u, v)
        turn = math.atan2(-v, u) if length > 1e-3 * g["R1"] else draw.uniform(-1.2, 1.2)
        y, w = size * math.sin(turn), size * math.cos(turn)
        if symmetric:
            a, y, w = 0.0, 0.0, size
        p, q = g["R2"] * math.cos(a) - g["r4"], g["R2"] * math.sin(a)
        x2 = x + g["D2"] - g["d2"]
        second, third = g["L2"] ** 2 - x2**2 - (y - p) ** 2, g["L3"] ** 2 - x2**2 - (y + p) ** 2
        if second <= 0 or third <= 0:
            continue
        sign = lambda: -1.0 if draw.random() < 0.15 else 1.0
        rho = [-w, -q - sign() * math.sqrt(second), q - sign() * math.sqrt(third)]
        if symmetric:
            rho[2] = rho[1]
        return rho
    return None


def main():
    parser = argparse.ArgumentParser(description="Makes forward problems with every solution.")
    parser.add_argument("machines", type=int)
    parser.add_argument("seed", type=int)
    arguments = parser.parse_args()
    count, seed = arguments.machines, arguments.seed
    draw, generator = random.Random(seed), numpy.random.default_rng(seed)
    cases, dropped, number = [], 0, 0
    while len(cases) < count:
        kind = ["delta", "offsets", "both", "delta", "offsets"][number % 5]
        difference = DIFFERENCES[(number // 5) % len(DIFFERENCES)]
        number += 1
        g = geometry(kind, difference, draw)
        try:
            if abs(home_determinant(g)) < 1e-3:
                continue
        except ValueError:
            continue
        rho = sliders(g, g["L2"] == g["L3"] and draw.random() < 0.3, draw)
        if rho is None:
            continue
        solutions = solve(g, rho, generator)
        if solutions is None:
            dropped += 1
            continue
        cases.append({"tag": f"{kind} {difference:.0e}", "geometry": g, "rho": rho, "solutions": solutions})
    print(f"{len(cases)} cases, {dropped} dropped", file=sys.stderr)
    print("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]")


if __name__ == "__main__":
    main()
