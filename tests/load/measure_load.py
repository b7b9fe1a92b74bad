"""Measures the service under load and prints figures; asserts nothing.

    measure_load.py VERNE

- GET /ik on one connection, idle, beside a long job, and beside clients that send one batch after the other: p50, p99.
- Memory with slow readers of one large mesh.
- How long after DELETE a running job has ended, and its cores are idle."""

import argparse
import http.client
import json
import multiprocessing
import os
import socket
import tempfile
import time

from verne_process import Client, Service

REQUESTS = 3000
BATCHERS = 8
POSES = [[i % 400 - 200, i % 7, 100 + i % 90, 5, 20] for i in range(10_000)]
LONG = {"kind": "part", "tool_length": {"from": 1, "to": 500, "step": 1}, "tolerance": 0.02}
LARGE = {"kind": "part", "tool_length": 50, "tolerance": 0.01}
MEBI = 1 << 20


def latencies(client):
    """p50 and p99 of GET /ik, ms."""
    times = []
    for i in range(REQUESTS):
        began = time.perf_counter()
        reply = client.ask("GET", f"/ik?x={i % 100}&y=0&z=100&phi1=5&phi2=20&tool_length=50")
        times.append(1000 * (time.perf_counter() - began))
        assert reply.status == 200, reply.body
    times.sort()
    return times[len(times) // 2], times[len(times) * 99 // 100]


def start(client, question):
    """The path of a job that computes."""
    reply = client.ask("POST", "/workspace", question, Prefer="respond-async")
    path = reply.headers["Location"]
    while client.ask("GET", path).json()["progress"] == 0:
        time.sleep(0.01)
    return path


def cpu_seconds(service):
    """CPU time of the process, seconds."""
    with open(f"/proc/{service.process.pid}/stat") as stat:
        fields = stat.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def cancel(service, client, path):
    """Seconds until the job has ended, and until the process has used less than a tenth of a core for 0.2 s."""
    began = time.perf_counter()
    client.ask("DELETE", path)
    while client.ask("GET", path).json()["state"] != "cancelled":
        time.sleep(0.001)
    ended = time.perf_counter() - began
    while True:
        since, used = time.perf_counter() - began, cpu_seconds(service)
        time.sleep(0.2)
        if cpu_seconds(service) - used < 0.02:
            return ended, since


def send_batches(port, lines):
    """One batch after the other; counts the lines that were answered."""
    body = json.dumps({"tool_length": 50, "poses": POSES}).encode()
    connection = http.client.HTTPConnection("127.0.0.1", port)
    while True:
        connection.request("POST", "/ik/batch", body, {"Content-Type": "application/json"})
        reply = connection.getresponse()
        reply.read()
        with lines.get_lock():
            lines.value += len(POSES) if reply.status == 200 else 0


def beside_batches(client):
    """p50 and p99 of GET /ik, ms, and how many lines of batches were answered each second meanwhile."""
    fork = multiprocessing.get_context("fork")
    lines = fork.Value("q")
    batchers = [fork.Process(target=send_batches, args=(client.port, lines), daemon=True) for _ in range(BATCHERS)]
    for batcher in batchers:
        batcher.start()
    while lines.value < BATCHERS * len(POSES):
        time.sleep(0.01)
    began, before = time.perf_counter(), lines.value
    found = latencies(client)
    rate = (lines.value - before) / (time.perf_counter() - began)
    for batcher in batchers:
        batcher.kill()
        batcher.join()
    return found, rate


def slow_readers(service, path, count):
    """Connections that have read the first bytes of a mesh and then no more."""
    readers = []
    for _ in range(count):
        reader = socket.create_connection(("127.0.0.1", service.port))
        reader.sendall(f"GET {path} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        readers.append(reader)
    for reader in readers:
        assert reader.recv(12) == b"HTTP/1.1 200"
    time.sleep(1)
    return readers


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("verne")
options = parser.parse_args()
with tempfile.TemporaryDirectory() as data:
    service = Service(options.verne, data).start()
    client = Client(service.port)
    latencies(client)
    idle = latencies(client)
    path = start(client, LONG)
    loaded = latencies(client)
    print("GET /ik p50, p99 ms: idle {:.2f} {:.2f}, beside a long job {:.2f} {:.2f}".format(*idle, *loaded))
    print(f"p99 ratio {loaded[1] / idle[1]:.1f}")
    print("DELETE: ended after {:.3f} s, idle after {:.3f} s".format(*cancel(service, client, path)))
    crowded, rate = beside_batches(client)
    print("beside {} clients' batches {:.2f} {:.2f}, p99 ratio {:.1f}; {:.0f} lines a second".format(
        BATCHERS, *crowded, crowded[1] / idle[1], rate))

    reply = client.ask("POST", "/workspace", LARGE, Prefer="wait=29")
    while reply.status == 202:
        reply = client.ask("POST", "/workspace", LARGE, Prefer="wait=29")
    mesh = f"{reply.json()['links']['mesh']}?format=json"
    size = len(client.ask("GET", mesh).body)
    time.sleep(1)
    print(f"mesh of {size / MEBI:.1f} MiB; no reader: {service.rss() / MEBI:.0f} MiB resident")
    for count in (1, 50, 200):
        readers = slow_readers(service, mesh, count)
        print(f"{count} slow readers: {service.rss() / MEBI:.0f} MiB resident")
        for reader in readers:
            reader.close()
    client.close()
    print("SIGTERM: exit code {}, {:.1f} s".format(*service.terminate()))
