#!/usr/bin/env python3
"""Checks proofs of solutions against all solutions of the equations, computed with exact numbers.

    cargo bench -p verne-solver --bench certificate -- lines | check_certificates.py

Each line has a machine, a question, the boxes of the solver's postures and whether they are claimed to be complete. The
numbers of a line are doubles, so they are rational, and eliminating all unknowns but t = tan(a/2) gives a polynomial with
rational coefficients. FLINT isolates its real roots. The other unknowns follow with 150 digits. No formula of the solver's
proofs is used but the elimination itself, and each solution is put back into Eqs (3)-(6).

A proved box must contain exactly one solution; if completeness is claimed, each solution must be in a box.
"""

import json
import sys
from fractions import Fraction

if "--help" in sys.argv:
    sys.exit(print(__doc__))

from flint import arb, ctx, fmpq, fmpq_poly

ctx.dps = 150
# Distance of a coordinate within which two numbers of 150 digits are equal.
EQUAL = arb("1e-60")


def rational(number):
    return fmpq(*Fraction(number).as_integer_ratio())


class Trig:
    """A trigonometric polynomial with rational coefficients, as numerator over (1 + t²)^degree."""

    def __init__(self, numerator, degree):
        self.numerator, self.degree = numerator, degree

    def __add__(self, other):
        degree = max(self.degree, other.degree)
        return Trig(self.raised(degree) + other.raised(degree), degree)

    def __mul__(self, other):
        if isinstance(other, Trig):
            return Trig(self.numerator * other.numerator, self.degree + other.degree)
        return Trig(self.numerator * other, self.degree)

    def __sub__(self, other):
        return self + other * fmpq(-1)

    def raised(self, degree):
        return self.numerator * fmpq_poly([1, 0, 1]) ** (degree - self.degree)

    def angles(self):
        """Cosine and sine of its real zeros, each once, exact zeros of the sine included."""
        found = []
        if self.numerator.degree() < 2 * self.degree:
            found.append((arb(-1), arb(0)))
        numerator = self.numerator
        if numerator.degree() < 0:
            raise ZeroDivisionError("vanishes everywhere")
        if numerator[0] == 0:
            found.append((arb(1), arb(0)))
            while numerator[0] == 0:
                numerator = fmpq_poly([numerator[i] for i in range(1, numerator.degree() + 1)])
        if numerator.degree() > 0:
            for root, _ in numerator.complex_roots():
                if root.imag == 0:
                    t = root.real
                    found.append(((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)))
        return found

    def at(self, direction):
        """The value at a cosine and sine."""
        c, s = direction
        if c == -1 and s == 0:
            return arb(self.numerator[2 * self.degree])
        t = s / (1 + c)
        value = arb(0)
        for i in reversed(range(self.numerator.degree() + 1)):
            value = value * t + arb(self.numerator[i])
        return value / (1 + t * t) ** self.degree


def constant(number):
    return Trig(fmpq_poly([rational(number)]), 0)


def linear(number, cos, sin):
    number, cos, sin = (value if isinstance(value, fmpq) else rational(value) for value in (number, cos, sin))
    return Trig(fmpq_poly([number + cos, 2 * sin, number - cos]), 1)


def roots_of_quadratic(a, b, c):
    """Real zeros of a x² + 2 b x + c. Exactly coinciding zeros are one."""
    discriminant = b * b - a * c
    if discriminant < 0:
        return []
    if not discriminant > 0:
        return [-b / a]
    root = discriminant.sqrt()
    return [(-b + root) / a, (-b - root) / a]


class Machine:
    def __init__(self, geometry):
        for name, value in geometry.items():
            setattr(self, name, rational(value))
        self.e1, self.e2 = self.D1 - self.d1, self.D2 - self.d2
        self.u = linear(-self.r1, self.R1, 0)
        self.v = linear(0, 0, self.R1)
        self.p = linear(-self.r4, self.R2, 0)
        self.q = linear(0, 0, self.R2)
        self.spread = self.u * self.u + self.v * self.v

    def errors(self, pose, rho):
        """The four rods' squared lengths less those of the machine."""
        x, y, z, (c, s) = pose
        u, v = self.R1 * c - self.r1, self.R1 * s
        p, q = self.R2 * c - self.r4, self.R2 * s
        rods = [
            (x + self.e1, y + u, z + v - rho[0], self.L1),
            (x + self.e1, y - u, z - v - rho[0], self.L1),
            (x + self.e2, y - p, z - q - rho[1], self.L2),
            (x + self.e2, y + p, z + q - rho[2], self.L3),
        ]
        return [a * a + b * b + d * d - length * length for a, b, d, length in rods]

    def hangs_uncrossed(self, pose, rho):
        _, _, z, (c, s) = pose
        v, q = self.R1 * s, self.R2 * s
        heights = [z + v - rho[0], z - v - rho[0], z - q - rho[1], z + q - rho[2]]
        uncrossed = s == 0 and c == 1 if self.R1 == self.r1 else self.R1 * c > self.r1
        return uncrossed and all(height > 0 for height in heights)

    def determinant(self, pose, rho):
        x, y, z, (c, s) = pose
        u, v = self.R1 * c - self.r1, self.R1 * s
        p, q = self.R2 * c - self.r4, self.R2 * s
        rods = [(x + self.e1, y + u, z + v - rho[0], self.R1), (x + self.e1, y - u, z - v - rho[0], -self.R1)]
        rods += [(x + self.e2, y - p, z - q - rho[1], -self.R2), (x + self.e2, y + p, z + q - rho[2], self.R2)]
        rows = [[a, b, d, arm * (c * d - s * b)] for a, b, d, arm in rods]
        from flint import arb_mat

        return arb_mat(rows).det()


def forward(m, rho):
    """All poses (x, y, z, (cos a, sin a)) for slider positions."""
    r1, r2, r3 = (rational(number) for number in rho)
    a, b, gap, delta = r1 - r2, r1 - r3, r3 - r2, m.e1 - m.e2
    s, k = a + b, m.L2**2 - m.L3**2
    d = linear(0, 0, 4 * (m.R2 * m.r1 - m.R1 * m.r4)) + m.u * (2 * gap)
    n = constant(0) + linear(k - gap * s, 0, 2 * m.R2 * s)
    t = (m.p * m.p + m.q * m.q - m.spread) + linear(
        m.L1**2 - (m.L2**2 + m.L3**2) / 2 + (a * a + b * b) / 2 + delta * delta, 0, -gap * m.R2
    )
    poses = []

    def add(direction, lam, x1):
        c, sine = direction
        poses.append((x1 - m.e1, -lam * m.R1 * sine, r1 + lam * (m.R1 * c - m.r1), direction))

    if m.R1 == m.r1:
        return forward_of_delta(m, (r1, a, b, gap, s, k, delta))
    if delta != 0:
        x = m.u * n * s + t * d
        f = x * x * (1 / (4 * delta * delta)) + m.spread * n * n + (m.spread - constant(0) - linear(m.L1**2, 0, 0)) * d * d
    else:
        f = m.u * n * s + t * d
    for direction in f.angles():
        values = [poly.at(direction) for poly in (d, n, t, m.u, m.spread)]
        dv, nv, tv, uv, spread = values
        if abs(dv) > EQUAL:
            lams = [nv / dv]
        elif abs(nv) > EQUAL:
            continue
        elif delta != 0:
            w, x0 = uv * s / (2 * delta), tv / (2 * delta)
            lams = roots_of_quadratic(w * w + spread, w * x0, x0 * x0 + spread - m.L1**2)
        else:
            lams = [-tv / (uv * s)]
        for lam in lams:
            if delta != 0:
                add(direction, lam, (lam * uv * s + tv) / (2 * delta))
            else:
                square = m.L1**2 - (lam * lam + 1) * spread
                for root in roots_of_quadratic(arb(1), arb(0), -square):
                    add(direction, lam, root)
    return poses


def forward_of_delta(m, numbers):
    """The same with R1 = r1: the platform does not turn, or the rods of leg I cross."""
    r1, a, b, gap, s, k, delta = numbers
    p0 = m.R2 - m.r4
    half = (m.L2**2 + m.L3**2) / 2
    level, poses = (arb(1), arb(0)), []

    def add_level(x1, y, w):
        poses.append((x1 - m.e1, y, r1 + w, level))

    # a = 0: 2 w (a - b) + a² - b² - k = 2 (2 p0 y) / 2 and so on; two linear equations in (x1, y, w) and a sphere.
    xc = p0 * p0 + (a * a + b * b) / 2 + delta * delta - half + m.L1**2
    if p0 != 0 and delta != 0:
        y0, y1 = (a * a - b * b - k) / (4 * p0), (a - b) / (2 * p0)
        x0, x1 = xc / (2 * delta), s / (2 * delta)
        for w in roots_of_quadratic(arb(1 + y1**2 + x1**2), arb(y0 * y1 + x0 * x1), arb(y0**2 + x0**2 - m.L1**2)):
            add_level(x0 + x1 * w, y0 + y1 * w, w)
    elif p0 != 0:
        if s == 0:
            raise ZeroDivisionError("self-motion or nothing")
        w = -xc / s
        y = (2 * w * (a - b) + a * a - b * b - k) / (4 * p0)
        for x in roots_of_quadratic(arb(1), arb(0), arb(w * w + y * y - m.L1**2)):
            add_level(x, arb(y), arb(w))
    else:
        raise ZeroDivisionError("p0 = 0")
    # Crossed: (y, w) = μ (cos h, sin h) with a = 2 h; h is the angle of the polynomial.
    d = linear(0, 2 * p0, -gap)
    sine, cosine = linear(0, 0, 1), linear(0, 1, 0)
    n = constant(0) + linear(k - gap * s, 0, 0) + sine * cosine * (4 * m.R2 * s)
    # cos a = 1 - 2 sin² h, sin a = 2 sin h cos h.
    spread = sine * sine * (4 * m.R1 * m.R1)
    tc = m.R2**2 + m.r4**2 - 2 * m.R2 * m.r4 - half + (a * a + b * b) / 2 + delta * delta + m.L1**2
    t = linear(tc, 0, 0) + sine * sine * (4 * m.R2 * m.r4) - spread - sine * cosine * (2 * gap * m.R2)
    if delta != 0:
        x = d * t * fmpq(2) - n * sine * s
        g = x * x * (1 / (4 * delta * delta)) + n * n + (spread - linear(m.L1**2, 0, 0)) * d * d * fmpq(4)
    else:
        g = d * t * fmpq(2) - n * sine * s
    seen = []
    for c, si in g.angles():
        # h and h + π are the same pose with the other sign of μ.
        if si < 0 or (si == 0 and c < 0):
            continue
        dv, nv, tv = (poly.at((c, si)) for poly in (d, n, t))
        if abs(dv) > EQUAL:
            mus = [-nv / (2 * dv)]
        elif abs(nv) > EQUAL:
            continue
        elif delta != 0:
            w, x0 = si * s / (2 * delta), tv / (2 * delta)
            mus = roots_of_quadratic(w * w + 1, w * x0, x0 * x0 + 4 * m.R1**2 * si * si - m.L1**2)
        else:
            mus = [-tv / (si * s)]
        turn = (c * c - si * si, 2 * si * c)
        for mu in mus:
            if delta != 0:
                xs = [(mu * si * s + tv) / (2 * delta)]
            else:
                xs = roots_of_quadratic(arb(1), arb(0), mu * mu + 4 * m.R1**2 * si * si - m.L1**2)
            for x1 in xs:
                poses.append((x1 - m.e1, mu * c, r1 + mu * si, turn))
    del seen
    return poses


def locus(m, kind, numbers):
    """x, and y and z as trigonometric polynomials of the platform's angle."""
    if kind == "part":
        x, y, z, phi1, phi2, length = numbers
        turns = []
        for angle in (phi1, phi2):
            exact = arb(rational(angle))
            turns += [rational_of(exact.cos()), rational_of(exact.sin())]
        c1, s1, c2, s2 = turns
        x, y, z, length = (rational(number) for number in (x, y, z, length))
        a = length * s1 - (y * c2 - x * s2)
        b = m.dt - z - length * c1
        along, across = a * c1 + b * s1, a * s1 - b * c1
        return x * c2 + y * s2, linear(fmpq(0), along, across), linear(m.da, -across, along)
    length = rational(numbers[3]) if kind == "tool" else fmpq(0)
    x, y, z = (rational(number) for number in numbers[:3])
    return x, linear(y, fmpq(0), length), linear(z, -length, fmpq(0))


def rational_of(number):
    """A rational number within 1e-140 of an arb."""
    mantissa, exponent = number.mid().man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(exponent)


def inverse(m, kind, numbers):
    """All (pose, rho)."""
    x, y, z = locus(m, kind, numbers)
    x1, x2 = x + m.e1, x + m.e2
    height = linear(m.L1**2 - x1 * x1, 0, 0) - m.spread
    vu, yu = m.v * m.v, y * m.u
    g = vu * (height - y * y) - yu * yu
    solutions = []
    for direction in g.angles():
        c, s = direction
        uv, vv, yv, zv = m.R1 * c - m.r1, m.R1 * s, y.at(direction), z.at(direction)
        square = height.at(direction) - yv * yv
        if not s == 0:
            heights = [-yv * uv / vv]
        elif abs(yv * uv) > EQUAL:
            continue
        else:
            heights = roots_of_quadratic(arb(1), arb(0), -square)
        p, q = m.R2 * c - m.r4, m.R2 * s
        second = roots_of_quadratic(arb(1), arb(0), x2 * x2 + (yv - p) ** 2 - m.L2**2)
        third = roots_of_quadratic(arb(1), arb(0), x2 * x2 + (yv + p) ** 2 - m.L3**2)
        for w in heights:
            for h2 in second:
                for h3 in third:
                    solutions.append(((arb(x), yv, zv, direction), (zv - w, zv - q - h2, zv + q - h3)))
    return solutions


def inside(bounds, pose, rho):
    """Whether a solution is in a box."""
    low, high = (arb(bound) for bound in bounds["pose"][3])
    c, s = pose[3]
    middle = (low + high) / 2
    away = (s * middle.cos() - c * middle.sin()).asin()
    if c * middle.cos() + s * middle.sin() < 0 or not abs(away) <= (high - low) / 2:
        return False
    numbers = [*zip(bounds["pose"][:3], pose[:3], strict=True), *zip(bounds["rho"], rho, strict=True)]
    return all(arb(low) - EQUAL <= number and number <= arb(high) + EQUAL for (low, high), number in numbers)


def check(case, tally):
    m = Machine(case["geometry"])
    kind, numbers = case["kind"], case["numbers"]
    if case["boxes"] is None:
        tally["refused"] += 1
        return
    if kind == "forward":
        rho = tuple(arb(rational(number)) for number in numbers)
        solutions = [(pose, rho) for pose in forward(m, numbers)]
    else:
        solutions = inverse(m, kind, numbers)
    for pose, rho in solutions:
        size = m.L1 + m.L2 + m.L3 + m.R1 + m.R2 + m.r4
        assert all(abs(error) < arb("1e-50") * size * size for error in m.errors(pose, rho)), "no solution"
    if case["scope"] == "working":
        wanted = [(pose, rho) for pose, rho in solutions if m.hangs_uncrossed(pose, rho)]
    else:
        wanted = solutions
    boxes = [box for box in case["boxes"] if box is not None]
    tally["boxes"] += len(boxes)
    tally["unproved"] += len(case["boxes"]) - len(boxes)
    for box in boxes:
        found = sum(inside(box, *solution) for solution in solutions)
        assert found == 1, f"{found} solutions in {box}"
        widths = [high - low for low, high in box["pose"]]
        tally["widest"] = max(tally["widest"], *widths)
    if case["complete"] == "complete":
        tally["complete"] += 1
        several = case["scope"] == "working" and kind == "forward" and len(wanted) > 1
        if several:
            # Those on home's side of the singularity are in the working mode.
            tally["several"] += 1
            sides = [m.determinant(pose, rho) > 0 for pose, rho in wanted]
            (chosen,) = [i for i, solution in enumerate(wanted) if any(inside(box, *solution) for box in boxes)]
            assert sides.count(sides[chosen]) == 1 or m.e1 == m.e2 or abs(m.e1 - m.e2) < m.L1 / 50, "home's side"
        else:
            assert len(wanted) == len(boxes), f"{len(wanted)} solutions, {len(boxes)} boxes"
            for solution in wanted:
                assert sum(inside(box, *solution) for box in boxes) == 1, "a solution is in no box"
    else:
        tally[case["complete"]] = tally.get(case["complete"], 0) + 1


def main():
    tally = {"cases": 0, "boxes": 0, "unproved": 0, "complete": 0, "several": 0, "refused": 0, "skipped": 0, "widest": 0.0}
    faults = 0
    for line in sys.stdin:
        case = json.loads(line)
        tally["cases"] += 1
        try:
            check(case, tally)
        except ZeroDivisionError:
            tally["skipped"] += 1
        except AssertionError as fault:
            faults += 1
            print(f"{fault}: {line.strip()}", file=sys.stderr)
    print(json.dumps(tally))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
