"""The numbers of the built-in machine, which are invented, and its working mode, for the drawings."""

import json
import pathlib
from math import acos, asin, cos, degrees, sin, sqrt

ROOT = pathlib.Path(__file__).parents[2]
MACHINE = json.loads((ROOT / "tests/reference/machine-verne.json").read_text())
GEOMETRY, TABLE, LIMITS = MACHINE["geometry"], MACHINE["table"], MACHINE["limits"]
D1, d1, D2, d2, R1, r1, R2, r4, L1, L2, L3 = (
    GEOMETRY[name] for name in ("D1", "d1", "D2", "d2", "R1", "r1", "R2", "r4", "L1", "L2", "L3"))
W, ROD_RADIUS = GEOMETRY["parallelogram_half_width"], GEOMETRY["rod_radius"]
da, dt = TABLE["da"], TABLE["dt"]


def add(*vectors):
    return tuple(sum(c) for c in zip(*vectors))


def times(k, v):
    return tuple(k * c for c in v)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    return times(1 / sqrt(dot(v, v)), v)


def angle(a, b):
    """Degrees between two vectors."""
    return degrees(acos(max(-1.0, min(1.0, dot(unit(a), unit(b))))))


def rot_x(a, v):
    return (v[0], v[1] * cos(a) - v[2] * sin(a), v[1] * sin(a) + v[2] * cos(a))


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    rest = [[row[:i] + row[i + 1:] for row in rows[1:]] for i in range(len(rows))]
    return sum((-1) ** i * rows[0][i] * determinant(rest[i]) for i in range(len(rows)))


class Posture:
    """The posture of the working mode at the platform's position. Raises ValueError where none exists."""

    def __init__(self, x, y, z):
        self.position = (x, y, z)
        self.alpha = self.working_angle(x, y)
        a = self.alpha
        self.u, self.v = R1 * cos(a) - r1, R1 * sin(a)
        p, q = R2 * cos(a) - r4, R2 * sin(a)
        x2 = x + D2 - d2
        self.f = (
            sqrt(L1**2 - (x + D1 - d1) ** 2 - y * y - self.u**2 - self.v**2),
            q + sqrt(L2**2 - x2**2 - (y - p) ** 2),
            -q + sqrt(L3**2 - x2**2 - (y + p) ** 2),
        )
        self.rho = tuple(z - f for f in self.f)

    @staticmethod
    def working_angle(x, y):
        """alpha: the root near zero of y u + w1 v = 0, by bisection."""
        if y == 0:
            return 0.0

        def miss(a):
            u, v = R1 * cos(a) - r1, R1 * sin(a)
            w1 = sqrt(max(0.0, L1**2 - (x + D1 - d1) ** 2 - y * y - u * u - v * v))
            return y * u + w1 * v

        low, high = -1.2, 1.2
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if miss(middle) < 0 else (low, middle)
        return low

    def platform(self, vector):
        """A point of the platform's frame in the base frame."""
        return add(self.position, rot_x(self.alpha, vector))

    def rods(self):
        """Each rod by its name: the slider's end and the platform's."""
        one, two, three = self.rho
        ends = {
            "11": ((d1, r1, one), (D1, R1, 0)), "12": ((d1, -r1, one), (D1, -R1, 0)),
            "21": ((d2 + W, -r4, two), (D2 + W, -R2, 0)), "22": ((d2 - W, -r4, two), (D2 - W, -R2, 0)),
            "31": ((d2 + W, r4, three), (D2 + W, R2, 0)), "32": ((d2 - W, r4, three), (D2 - W, R2, 0)),
        }
        return {name: (slider, self.platform(joint)) for name, (slider, joint) in ends.items()}

    def conditioning(self):
        """det_P: the determinant that vanishes where the sliders no longer hold the platform."""
        rods, s, c = self.rods(), sin(self.alpha), cos(self.alpha)
        rows = []
        for name, radius, length in (("11", -R1, L1), ("12", R1, L1), ("21", R2, L2), ("31", -R2, L3)):
            bx, by, bz = minus(rods[name][1], rods[name][0])
            turning = radius * (s * by - c * bz)
            rows.append([bx / length, by / length, bz / length, turning / (length * R1)])
        return determinant(rows)


class Symmetric(Posture):
    """The posture with y = 0 and alpha = 0 and a height of leg I, which may be negative."""

    def __init__(self, w1):
        self.alpha = 0.0
        x = d1 - D1 - sqrt(L1**2 - (R1 - r1) ** 2 - w1**2)
        f2 = sqrt(L2**2 - (x + D2 - d2) ** 2 - (R2 - r4) ** 2)
        self.position, self.rho = (x, 0.0, 0.0), (-w1, -f2, -f2)


HOME = Posture(0, 0, 1100)


def cone_angles(posture, at):
    """Degrees between each rod and the axis of its cone, at the `slider` or at the `platform`."""
    home, angles = HOME.rods(), {}
    for name, (a, b) in posture.rods().items():
        axis, rod = minus(home[name][1], home[name][0]), minus(b, a)
        angles[name] = angle(axis, rod if at == "slider" else rot_x(-posture.alpha, rod))
    return angles


def serial_angle():
    """Degrees between a rod on the limit of `serial_singularity` and the horizontal."""
    return degrees(asin(LIMITS["serial_margin"]))
