"""Soak test of one service: short requests whose answers are checked, batches and jobs, among hostile clients that
disconnect, stall, send garbage, open 2,000 connections, and worse. Prints latencies, memory and open files; fails at a
wrong answer, a file that stays open, memory that grows, or a service that has ended.

    test_soak.py VERNE [--minutes N]

The expected answers come from an idle service; the other problem (inverse of forward) checks them."""

import argparse
import multiprocessing
import os
import random
import resource
import sys
import tempfile
import time

import hostile_clients as hostile
from concurrent_clients import check
from verne_process import Client, Service

QUESTIONS = 2000
CHECKERS = 2
MEBI = 1 << 20
# Greatest growth of resident memory after the first fifth of the time; the allocator causes some.
GROWTH = 48 * MEBI


def question(i):
    chance = random.Random(i)
    x, y, z = chance.uniform(-400, 400), chance.uniform(-300, 300), chance.uniform(50, 500)
    path = f"/ik?x={x:.3f}&y={y:.3f}&z={z:.3f}&phi1={chance.uniform(-40, 40):.2f}&phi2={chance.uniform(-90, 90):.2f}"
    return f"{path}&tool_length=50&solutions={chance.choice(['working', 'all', 'feasible'])}"


def round_trip(client, seed):
    """Whether the forward problem returns the pose of an inverse solution."""
    chance = random.Random(seed)
    pose = [chance.uniform(-200, 200), chance.uniform(-150, 150), chance.uniform(900, 1200)]
    found = client.ask("GET", "/ik?frame=platform&solutions=all&x={}&y={}&z={}".format(*pose)).json()["solutions"]
    if not found:
        return True
    solution = chance.choice(found)
    rho = ",".join(map(repr, solution["joints"]["rho"]))
    back = client.ask("GET", f"/fk?solutions=all&rho={rho}").json()["solutions"]
    near = lambda other: all(abs(other["platform"][axis] - value) < 1e-6 for axis, value in zip("xyz", pose))
    return any(near(other) for other in back)


def checker(port, expected, until, seed, reports):
    chance, client = random.Random(seed), Client(port)
    times, wrong, refused = [], [], 0
    while time.time() < until:
        i = chance.randrange(QUESTIONS)
        began = time.perf_counter()
        try:
            if chance.random() < 0.05:
                if not round_trip(client, chance.random()):
                    wrong.append("round trip")
                continue
            reply = client.ask("GET", question(i))
        except OSError as error:
            wrong.append(repr(error))
            continue
        times.append(time.perf_counter() - began)
        if reply.status in (429, 503):
            refused += 1
        elif reply.body != expected[i]:
            wrong.append((question(i), reply.status, reply.body[:200]))
    reports.put((times, wrong, refused))


def jobs(port, until, seed, reports):
    """Workspaces and batches; some jobs are cancelled."""
    chance, client, done, wrong = random.Random(seed), Client(port), 0, []
    rows = [[chance.uniform(-400, 400), chance.uniform(-300, 300), 300, 0, chance.uniform(-90, 90)] for _ in range(5000)]
    batch, first = {"tool_length": 50, "poses": rows}, None
    while time.time() < until:
        reply = client.ask("POST", "/ik/batch", batch)
        if reply.status == 200:
            first = first or reply.body
            if reply.body != first:
                wrong.append("batch")
        asked = {"kind": "part", "tool_length": chance.randint(1, 400), "tolerance": chance.choice([0.5, 2, 10])}
        reply = client.ask("POST", "/workspace", asked, Prefer=chance.choice(["respond-async", "wait=5"]))
        if reply.status == 202 and chance.random() < 0.3:
            client.ask("DELETE", reply.headers["Location"])
        elif reply.status not in (200, 202, 503):
            wrong.append((asked, reply.status, reply.body[:200]))
        done += 1
    reports.put(([], wrong, 0))


def attack(port, until, seed):
    random.seed(seed)
    # One attack at a time: threads would wait for each other.
    while time.time() < until:
        left = until - time.time()
        attacks = [hostile.garbage, hostile.disconnects, hostile.nested, hostile.nested_batch, hostile.bomb, hostile.huge,
                   "stalls", "trickles", "crowd", "resets"]
        chosen = random.choices(attacks, [20, 20, 5, 2, 1, 1, 4, 2, 1, 2])[0]
        try:
            if chosen == "stalls":
                hostile.stalls(port, min(5, left))
            elif chosen == "trickles":
                hostile.trickles(port, min(5, left))
            elif chosen == "crowd":
                hostile.crowd(port, 2000, min(3, left))
            elif chosen == "resets":
                hostile.rapid_resets(port, 2000)
            else:
                chosen(port)
        except OSError:
            pass  # The service is at its connection limit.


def files(service):
    return len(os.listdir(f"/proc/{service.process.pid}/fd"))


def attack_once_each(service):
    """Prints the answer to each attack, and the memory that it costs."""
    port = service.port
    for name, run in [("gzip bomb", lambda: hostile.bomb(port)), ("10,000 deep", lambda: hostile.nested(port)),
                       ("4,000,000 deep, batch", lambda: hostile.nested_batch(port)),
                       ("100 MB of JSON", lambda: hostile.huge(port)),
                       ("slow header, s", lambda: hostile.trickles(port, 30)),
                       ("HTTP/2 resets taken of 20,000", lambda: hostile.rapid_resets(port, 20_000)),
                       ("connections taken of 2,000", lambda: hostile.crowd(port, 2000, 1))]:
        before, answer = service.rss(), run()
        print(f"{name}: {answer}; resident {before / MEBI:.0f} -> {service.rss() / MEBI:.0f} MiB", flush=True)


def files_at_rest(service, baseline):
    """The number of open files, when the files of the attacks have been closed."""
    for _ in range(300):
        if files(service) <= baseline:
            break
        time.sleep(0.1)
    return files(service)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("verne")
    parser.add_argument("--minutes", type=float, default=0.5)
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    with tempfile.TemporaryDirectory() as place:
        service = Service(options.verne, os.path.join(place, "data"), "--header-timeout", "3",
                        "--cache-bytes", str(32 * MEBI), "--max-connections", "6000").start()
        client = Client(service.port)
        expected = [client.ask("GET", question(i)).body for i in range(QUESTIONS)]
        client.ask("GET", "/workspace?kind=part&tool_length=50&tolerance=0.05&format=ply")
        client.close()
        baseline = files(service)
        attack_once_each(service)
        began, seconds = time.time(), 60 * options.minutes
        until, reports = began + seconds, multiprocessing.Queue()
        workers = [multiprocessing.Process(target=checker, args=(service.port, expected, until, seed, reports))
                   for seed in range(CHECKERS)]
        workers.append(multiprocessing.Process(target=jobs, args=(service.port, until, 99, reports)))
        reporting = len(workers)
        workers += [multiprocessing.Process(target=attack, args=(service.port, until, seed)) for seed in (7, 8)]
        for worker in workers:
            worker.start()
        memory = []
        while time.time() < until:
            time.sleep(min(seconds / 60, 5))
            check(service.process.poll() is None, "the service has ended")
            memory.append(service.rss())
        reported = [reports.get() for _ in range(reporting)]
        for worker in workers:
            worker.join()
        times = sorted(time for report in reported for time in report[0])
        wrong = [error for report in reported for error in report[1]]
        warm = memory[len(memory) // 5:]
        print(f"{len(times)} answers checked, {len(wrong)} wrong, {sum(report[2] for report in reported)} refused; "
              f"p50 {1000 * times[len(times) // 2]:.2f} ms, p99 {1000 * times[len(times) * 99 // 100]:.2f} ms")
        print(f"resident after warm-up: {warm[0] / MEBI:.0f} MiB, then {min(warm) / MEBI:.0f} to {max(warm) / MEBI:.0f}, "
              f"at the end {warm[-1] / MEBI:.0f} MiB")
        after = files_at_rest(service, baseline)
        print(f"files: {baseline} before, {after} after")
        check(not wrong, wrong[:3])
        check(after <= baseline, "files stay open")
        check(warm[-1] < warm[0] + GROWTH, "memory grows")
        code, took = service.terminate()
        check(code == 0, f"SIGTERM: exit code {code}")
    print(f"SIGTERM: exits after {took:.1f} s")


if __name__ == "__main__":
    sys.exit(main())
