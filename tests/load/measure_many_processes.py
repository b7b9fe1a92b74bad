"""Compares many processes with one on this machine and prints figures; asserts nothing. Needs an idle machine with two
cores or more.

    measure_many_processes.py VERNE NATS_SERVER

- A dexterity map on two workers of one thread each against one.
- Jobs of about a second through broker and store against the same in one process.
- How long after DELETE a running job has ended and its worker is free."""

import argparse
import os
import resource
import socket
import tempfile
import time

from concurrent_clients import LONG
from cluster import Cluster
from verne_process import Client, Service

ROUNDS = 8


def dexterity(tool_length, cell):
    return {"tool_length": tool_length, "phi1": {"from": -30, "to": 30}, "cell": cell}


def second(number):
    """A workspace that takes about a second."""
    return {"kind": "tool", "tool_length": 50 + number / 100, "tolerance": 0.014}


def seconds(port, path, questions):
    """Until all are answered, asked at once."""
    client = Client(port)
    began = time.monotonic()
    jobs = [client.ask("POST", path, question, Prefer="respond-async").headers["Location"]
             for question in questions]
    for job in jobs:
        events = client.ask("GET", f"{job}/events").body
        assert b'"succeeded"' in events, events[-500:]
    return time.monotonic() - began


def with_workers(verne, nats, workers):
    place = tempfile.TemporaryDirectory()
    return Cluster(verne, nats, place.name, 1, workers), place


def efficiency(verne, nats):
    one, here = with_workers(verne, nats, 1)
    two, there = with_workers(verne, nats, 2)
    for i in range(3):
        times = [seconds(cluster.ports()[0], "/workspace/dexterity", [dexterity(50 + i, 16)]) for cluster in (one, two)]
        print(f"map: one worker {times[0]:.2f} s, two {times[1]:.2f} s, {times[0] / times[1]:.2f} times as fast", flush=True)
    two.end()
    return one, (here, there)


def overhead(verne, one):
    with tempfile.TemporaryDirectory() as place:
        alone = Service(verne, os.path.join(place, "alone"), "--job-threads", "1").start()
        ports, sums = [alone.port, one.ports()[0]], [0.0, 0.0]
        for i in range(ROUNDS):
            questions = [second(10 * i + k) for k in range(10)]
            for n in (0, 1) if i % 2 == 0 else (1, 0):
                sums[n] += seconds(ports[n], "/workspace", questions)
        print(f"{10 * ROUNDS} jobs: one process {sums[0]:.1f} s, broker and store {sums[1]:.1f} s, "
              f"{100 * (sums[1] / sums[0] - 1):+.1f} %", flush=True)
        alone.kill()


def busy(worker):
    text = Client(worker.port).ask("GET", "/metrics").body.decode()
    return "\nverne_worker_seats_busy 0" not in text


def cancelling(one):
    client, times = Client(one.ports()[0]), []
    for i in range(10):
        path = client.ask("POST", "/workspace", {**LONG, "phi1": i / 10}, Prefer="respond-async").headers["Location"]
        while client.ask("GET", path).json()["progress"] == 0:
            time.sleep(0.01)
        began = time.monotonic()
        client.ask("DELETE", path)
        while client.ask("GET", path).json()["state"] != "cancelled" or busy(one.workers[0]):
            time.sleep(0.002)
        times.append(time.monotonic() - began)
    times.sort()
    print(f"DELETE to ended and free: median {times[5]:.3f} s, longest {times[-1]:.3f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verne")
    parser.add_argument("nats_server")
    options = parser.parse_args()
    verne, nats = options.verne, options.nats_server
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    one, _places = efficiency(verne, nats)
    overhead(verne, one)
    cancelling(one)
    one.end()


main()
