"""Compares the service with solvers that a Python user has otherwise, and prints a table; asserts nothing.

    python3 -m venv .venv
    .venv/bin/pip install ./clients/python -r tests/load/compare_requirements.txt
    .venv/bin/python tests/load/compare_python.py VERNE [--poses POSES]

- scipy: `fsolve` solves the closure equations of the machine `verne` ((3)-(6) of arXiv:0707.3507), for poses of the
  service. It starts 20 mm off in a random direction, as the iterative solver of docs/performance.md does, and with
  alpha off by 20 mm at the radius R1.
- roboticstoolbox: its numerical inverse solvers in Python (`ikine_LM`) and C++ (`ik_LM`), on its own robots. Its
  default tolerance leaves errors of a millimetre; the script demands micrometres (`tol=1e-12`).
- ikpy: its inverse solver with its defaults, on a chain with six revolute joints.
- The service answers batches of 100,000 rows to the client in clients/python. The time contains the transport.

The solvers of roboticstoolbox and ikpy have all joints off by 0.03 rad at the start. That moves the tools by 20 to
27 mm in the median. The script and the service share one core where the system can restrict a process to it. The
figures are the best of three rounds. The script reports a missing library and leaves it out.

`found` is the share of the rows in which a solver found the solution, to 5 mm. `difference` is the greatest difference
in these rows: of scipy from the service's answers, of the service from the answers to the inverse problem, and of the
others in the position of the tool."""

import argparse
import importlib
import math
import os
import time

import numpy as np

ROUNDS = 3
ROWS = 100_000
OFF = 20.0  # mm
JOINTS_OFF = 0.03  # rad
NEAR = 5.0  # mm
TOLERANCE = 1e-12  # Half the square of the errors, m and rad.
TOOL = 50.0  # mm


def closure(geometry):
    """Equations (3)-(6) of a machine: a function that returns their residuals, mm²."""
    names = ("D1", "d1", "D2", "d2", "R1", "r1", "R2", "r4", "L1", "L2", "L3")
    D1, d1, D2, d2, R1, r1, R2, r4, L1, L2, L3 = (float(geometry[name]) for name in names)

    def residuals(x, y, z, alpha, rho1, rho2, rho3):
        c, s = math.cos(alpha), math.sin(alpha)
        u, v, p, q = R1 * c - r1, R1 * s, R2 * c - r4, R2 * s
        X1, X2 = x + D1 - d1, x + D2 - d2
        return (
            X1 * X1 + (y + u) ** 2 + (z + v - rho1) ** 2 - L1 * L1,
            X1 * X1 + (y - u) ** 2 + (z - v - rho1) ** 2 - L1 * L1,
            X2 * X2 + (y - p) ** 2 + (z - q - rho2) ** 2 - L2 * L2,
            X2 * X2 + (y + p) ** 2 + (z + q - rho3) ** 2 - L3 * L3,
        )

    return residuals


def best(run):
    """The least seconds of some rounds, and the last answer."""
    seconds = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        answer = run()
        seconds.append(time.perf_counter() - began)
    return min(seconds), answer


def measure(solver, problem, robot, rows, run, truth, lengths=lambda answer: answer):
    """A row of the table: `lengths` makes of the answers what is compared with the truth, in mm."""
    seconds, answer = best(run)
    differences = np.abs(lengths(answer) - truth).max(axis=1)
    found = differences <= NEAR
    return solver, problem, robot, rows / seconds, found.mean(), differences[found].max(initial=0.0)


def off(random, values):
    """Vectors that end 20 mm from the given ones, in random directions."""
    directions = random.normal(size=values.shape)
    return values + OFF * directions / np.linalg.norm(directions, axis=1, keepdims=True)


def postures(client, machine, random):
    """Joints within all limits, and the service's answer for them."""
    low, high = np.array([*machine["limits"]["stroke"], machine["limits"]["tilt"], [-180.0, 180.0]]).T
    chosen = np.empty((0, len(low)))
    while len(chosen) < ROWS:
        joints = random.uniform(low, high, (ROWS, len(low)))
        chosen = np.vstack([chosen, joints[client.fk_batch(joints, tool_length=TOOL).ok]])[:ROWS]
    return chosen, client.fk_batch(chosen, tool_length=TOOL)


def service(client, joints, answer):
    """The service, each problem with the answers to its inverse."""
    point, part = answer.platform[:, :3], answer.part
    rho = client.ik_batch(point, frame="platform").joints
    return [
        measure("verne, `/fk/batch`", "forward", "verne", ROWS, lambda: client.fk_batch(rho).platform[:, :3], point),
        measure("verne, `/ik/batch`", "inverse, platform", "verne", ROWS,
                lambda: client.ik_batch(point, frame="platform").joints, joints[:, :3]),
        measure("verne, `/ik/batch`", "inverse, part", "verne", ROWS,
                lambda: client.ik_batch(part, tool_length=TOOL).joints[:, :3], joints[:, :3]),
    ]


def scipy(geometry, rho, pose, random):
    """fsolve for the unknowns x, y, z, alpha, and for rho1, rho2, rho3, alpha."""
    fsolve = importlib.import_module("scipy.optimize").fsolve
    residuals = closure(geometry)
    alpha = np.radians(pose[:, 3]) + OFF / geometry["R1"] * random.choice([-1.0, 1.0], len(pose))

    def forward(unknowns, rho):
        return residuals(*unknowns.tolist(), *rho)

    def inverse(unknowns, point):
        *rho, alpha = unknowns.tolist()
        return residuals(*point, alpha, *rho)

    point = pose[:, :3]
    for problem, equations, given, truth in (
        ("forward", forward, rho, point), ("inverse, platform", inverse, point, rho),
    ):
        tasks = list(zip(np.column_stack([off(random, truth), alpha]), given.tolist(), strict=True))

        def run(equations=equations, tasks=tasks):
            return np.array([fsolve(equations, start, (values,), full_output=True)[0][:3] for start, values in tasks])

        yield measure("scipy, `fsolve`", problem, "verne", len(tasks), run, truth)


def roboticstoolbox(poses, random):
    """The numerical solvers in Python and C++."""
    models = importlib.import_module("roboticstoolbox").models
    for name, robot in (("Puma 560", models.DH.Puma560()), ("Panda", models.ETS.Panda())):
        transforms = robot.ets()  # The methods of a Puma make it anew at each call.
        for solver, solve in (("`ikine_LM` (Python)", transforms.ikine_LM), ("`ik_LM` (C++)", transforms.ik_LM)):
            yield numerical(
                f"roboticstoolbox, {solver}", name, robot.qlim, lambda q, robot=robot: robot.fkine(q).A,
                lambda target, start, solve=solve: solve(target, q0=start, tol=TOLERANCE).q, poses, random)


def ikpy(poses, random):
    """The solver with its defaults, on a chain with the lengths of a common arm."""
    chains, links = importlib.import_module("ikpy.chain"), importlib.import_module("ikpy.link")
    axes = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}
    joints = (("z", 0.0, 0.67), ("y", 0.0, 0.0), ("y", 0.43, 0.0), ("x", 0.43, 0.0), ("y", 0.0, 0.0), ("x", 0.06, 0.0))
    chain = chains.Chain([links.OriginLink(), *(
        links.URDFLink(f"joint{i}", [x, 0.0, z], [0.0, 0.0, 0.0], rotation=axes[axis], bounds=(-2.6, 2.6))
        for i, (axis, x, z) in enumerate(joints))], active_links_mask=[False] + [True] * len(joints))
    limits = np.array([[0.0] + [-2.6] * 6, [0.0] + [2.6] * 6])  # The first link has no joint.
    yield numerical(
        "ikpy, `inverse_kinematics_frame`", "chain of 6 joints", limits, chain.forward_kinematics,
        lambda target, start: chain.inverse_kinematics_frame(target, start, orientation_mode="all"), poses, random)


def numerical(solver, robot, limits, forward, solve, poses, random):
    """A row for a solver that starts near joints in the inner 80 % of their ranges."""
    low, high = limits
    joints = low + (high - low) * random.uniform(0.1, 0.9, (poses, len(low)))
    starts = joints + JOINTS_OFF * random.choice([-1.0, 1.0], joints.shape)
    targets = [forward(q) for q in joints]

    def positions(frames):
        return 1000.0 * np.array([frame[:3, 3] for frame in frames])

    return measure(
        solver, "inverse", robot, poses, lambda: [solve(*task) for task in zip(targets, starts, strict=True)],
        positions(targets), lambda answers: positions([forward(q) for q in answers]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("verne", help="the program, built with --release")
    parser.add_argument("--poses", type=int, default=300, help="rows of the solvers in Python")
    options = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    else:
        print("This system does not restrict a process to one core: the service uses all cores.")
    random = np.random.default_rng(1)
    with importlib.import_module("verne").local(options.verne) as client:
        machine = client.machine("verne")
        joints, answer = postures(client, machine, random)
        rows = service(client, joints, answer)
    rho, pose = joints[:options.poses, :3], answer.platform[:options.poses]
    for solver, arguments in ((scipy, (machine["geometry"], rho, pose)),
                              (roboticstoolbox, (options.poses,)), (ikpy, (options.poses,))):
        try:
            rows.extend(solver(*arguments, random))
        except ImportError as error:
            print(f"{solver.__name__} is left out: {error}")
    rates = {problem: rate for _, problem, _, rate, *_ in rows[:3]}
    print("\n| solver | problem | robot | rows/s | the service is faster | found | difference, mm |")
    print("|---|---|---|---:|---:|---:|---:|")
    for name, problem, robot, rate, found, difference in rows:
        times = rates.get(problem, rates["inverse, part"]) / rate
        print(f"| {name} | {problem} | {robot} | {rate:.0f} | {times:.1f} times | {found:.1%} | {difference:.0e} |")


if __name__ == "__main__":
    main()
