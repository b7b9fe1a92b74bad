"""Derives the constants of src/solver/src/fast_math.rs, and checks that the file contains them.

    fit_polynomials.py            prints the constants, their errors, and the greatest errors of the functions
    fit_polynomials.py --check    fails if the file has other constants

The polynomials of sine and cosine are minimax polynomials: Remez's exchange algorithm makes the greatest relative error
of the function as small as it can be. Their coefficients are rounded to double precision one after the other, from the
lowest power; the remaining ones are then fitted anew, so that they correct the rounding. The arc sine is a rational
interpolant in Chebyshev nodes. The arithmetic has 60 digits."""

import argparse
import math
import sys
from decimal import ROUND_HALF_EVEN, Decimal, getcontext
from pathlib import Path
from random import Random

FILE = Path(__file__).parents[2] / "src/solver/src/fast_math.rs"
getcontext().prec = 60
D = Decimal
# Bits of a quarter turn that are subtracted without rounding: a count of quarters below 2^16 has the other ones.
QUARTER_BITS = 37


def arctangent(x):
    total, power, n = D(0), x, 1
    while abs(power) > D(10) ** -65:
        total += power / n if n % 4 == 1 else -power / n
        power, n = power * x * x, n + 2
    return total


PI = 16 * arctangent(D(1) / 5) - 4 * arctangent(D(1) / 239)


def series(first, term):
    """The sum of a power series whose terms follow from each other."""
    total, summand, n = D(0), first, 0
    while abs(summand) > D(10) ** -70:
        total += summand
        n += 1
        summand = term(summand, n)
    return total


def sine_rest(t):
    """(sin x - x) / x³ for t = x²."""
    return series(D(-1) / 6, lambda summand, n: -summand * t / ((2 * n + 2) * (2 * n + 3)))


def cosine_rest(t):
    """(cos x - 1 + x²/2) / x⁴ for t = x²."""
    return series(D(1) / 24, lambda summand, n: -summand * t / ((2 * n + 3) * (2 * n + 4)))


def arcsine_rest(t):
    """(asin x - x) / x³ for t = x²."""
    return series(D(1) / 6, lambda summand, n: summand * t * (2 * n + 1) ** 2 / ((2 * n + 2) * (2 * n + 3)))


def cosine(x):
    return series(D(1), lambda summand, n: -summand * x * x / ((2 * n - 1) * (2 * n)))


def solve(rows):
    """Solves linear equations: the coefficients and the right side of each row."""
    rows = [list(row) for row in rows]
    count = len(rows)
    for i in range(count):
        pivot = max(range(i, count), key=lambda row: abs(rows[row][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for j in range(i + 1, count):
            factor = rows[j][i] / rows[i][i]
            rows[j] = [a - factor * b for a, b in zip(rows[j], rows[i])]
    answer = [D(0)] * count
    for i in reversed(range(count)):
        answer[i] = (rows[i][count] - sum(rows[i][j] * answer[j] for j in range(i + 1, count))) / rows[i][i]
    return answer


def value(coefficients, t):
    total = D(0)
    for coefficient in reversed(coefficients):
        total = total * t + coefficient
    return total


def remez(function, weight, end, known, count):
    """The minimax coefficients after the known ones, on [0, end]; the error of t is that of the value times weight(t)."""
    free = count - len(known)
    grid = [end * (1 - cosine(PI * i / 400)) / 2 for i in range(1, 401)]
    wanted = [function(t) - value(known, t) for t in grid]
    weights = [weight(t) for t in grid]
    points = [round(400 * (i + D(1) / 2) / (free + 1)) - 1 for i in range(free + 1)]
    for _ in range(30):
        rows = [[grid[p] ** (len(known) + j) for j in range(free)] + [(-1) ** i / weights[p], wanted[p]]
                for i, p in enumerate(points)]
        coefficients = known + solve(rows)[:free]
        errors = [(function_value - value(coefficients[len(known):], t) * t ** len(known)) * w
                  for function_value, t, w in zip(wanted, grid, weights)]
        # The greatest error of each run of one sign.
        runs = []
        for i, error in enumerate(errors):
            if runs and (error > 0) == (errors[runs[-1]] > 0):
                if abs(error) > abs(errors[runs[-1]]):
                    runs[-1] = i
            else:
                runs.append(i)
        while len(runs) > free + 1:
            runs.pop(0 if abs(errors[runs[0]]) < abs(errors[runs[-1]]) else -1)
        if len(runs) < free + 1 or runs == points:
            break
        points = runs
    return coefficients, max(map(abs, errors))


def rounded_polynomial(function, weight, end, count):
    """Coefficients in double precision, and their greatest error."""
    known = []
    while len(known) < count:
        known = known + [D(float(remez(function, weight, end, known, count)[0][len(known)]))]
    grid = [end * i / 2000 for i in range(1, 2001)]
    return list(map(float, known)), max(abs(function(t) - value(known, t)) * weight(t) for t in grid)


def rational(function, weight, end, over, under):
    """Numerator and denominator, which begins with 1, and their greatest error."""
    count = over + under + 1
    rows = []
    for i in range(count):
        t = end * (1 - cosine(PI * (2 * i + 1) / (2 * count))) / 2
        y = function(t)
        rows.append([t ** j for j in range(over + 1)] + [-y * t ** j for j in range(1, under + 1)] + [y])
    answer = [D(float(number)) for number in solve(rows)]
    numerator, denominator = answer[:over + 1], [D(1)] + answer[over + 1:]
    grid = [end * i / 1000 for i in range(1, 1001)]
    error = max(abs(function(t) - value(numerator, t) / value(denominator, t)) * weight(t) for t in grid)
    return list(map(float, numerator)), list(map(float, denominator)), error


def split_quarter():
    """A quarter turn: its first bits, and the rest."""
    unit = D(2) ** (QUARTER_BITS - 1)
    first = (PI / 2 * unit).quantize(D(1), rounding=ROUND_HALF_EVEN) / unit
    return [float(first), float(PI / 2 - first)]


def constants():
    """Names, values in the order of the file, and errors."""
    end = (PI / 4) ** 2 * (1 + D(10) ** -9)
    # Relative to sin x, which is at least x (1 - x²/6), and to cos x, which is at least 1 - x²/2.
    sine, sine_error = rounded_polynomial(sine_rest, lambda t: t / (1 + t * sine_rest(t)), end, 6)
    cosine_, cosine_error = rounded_polynomial(
        cosine_rest, lambda t: t * t / (1 - t / 2 + t * t * cosine_rest(t)), end, 6)
    over, under, error = rational(arcsine_rest, lambda t: t / (1 + t * arcsine_rest(t)), D(1) / 2, 7, 5)
    return [("QUARTER", split_quarter(), None), ("SINE", sine, sine_error), ("COSINE", cosine_, cosine_error),
            ("NUMERATOR", over, error), ("DENOMINATOR", under, error)]


def polynomial(coefficients, x):
    """The function of the same name in the file, operation by operation."""
    square = x * x
    pairs = [a + b * x for a, b in zip(coefficients[::2], coefficients[1::2])]
    total = pairs[-1]
    for pair in reversed(pairs[:-1]):
        total = total * square + pair
    return total


def greatest_errors(count):
    """The greatest errors of sine, cosine and arc sine in units in the last place, for random arguments: of an angle up
    to an eighth of a turn, up to a turn, and of the arc sine up to 1/sqrt(2)."""
    values = {name: numbers for name, numbers, _ in constants()}
    random = Random(1)
    greatest = {}

    def compare(name, found, exact):
        error = abs(D(found) - exact) / D(math.ulp(float(exact)))
        greatest[name] = max(greatest.get(name, D(0)), error)

    for _ in range(count):
        for name, end in (("an eighth of a turn", math.pi / 4), ("a turn", 2 * math.pi)):
            angle = random.uniform(-end, end)
            quarters = round(angle * (2 / math.pi))
            x = (angle - quarters * values["QUARTER"][0]) - quarters * values["QUARTER"][1]
            square = x * x
            pair = [x + x * (square * polynomial(values["SINE"], square)),
                    1.0 - (0.5 * square - square * square * polynomial(values["COSINE"], square))]
            rest = D(angle) - quarters * PI / 2
            exact = [rest * (1 + rest * rest * sine_rest(rest * rest)), cosine(rest)]
            for found, truth in zip(pair, exact):
                compare(f"sine and cosine, up to {name}", found, truth)
        x = random.uniform(-math.sqrt(0.5), math.sqrt(0.5))
        square = x * x
        exact = D(x) * (1 + D(x) * D(x) * arcsine_rest(D(x) * D(x)))
        over, under = (polynomial(values[name], square) for name in ("NUMERATOR", "DENOMINATOR"))
        compare("arc sine", x + x * (square * over / under), exact)
    return greatest


def numbers_of(text, name):
    """The numbers of a constant in the file."""
    body = text.split(f"const {name}:", 1)[1].split("=", 1)[1].split(";", 1)[0]
    return [float(word) for word in body.replace("_", "").replace("[", " ").replace("]", " ").replace(",", " ").split()]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("--check", action="store_true")
    check = arguments.parse_args().check
    text = FILE.read_text()
    differing = []
    for name, numbers, error in constants():
        if not check:
            print(name, *map(repr, numbers), "" if error is None else f"relative error {error:.2e}")
        if numbers_of(text, name) != numbers:
            differing.append(name)
    if not check:
        for name, error in greatest_errors(20_000).items():
            print(f"{name}: {error:.3f} units in the last place")
    if check and differing:
        sys.exit(f"{FILE} has other constants than derived here: {', '.join(differing)}")


if __name__ == "__main__":
    main()
