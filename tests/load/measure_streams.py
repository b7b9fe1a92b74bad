"""Measures the memory of idle connections and prints figures; asserts nothing.

    measure_streams.py VERNE [COUNT]

COUNT connections (default: 5,000) each follow the events of one job; then each ask for a family of 500 workspaces and
wait for it. The figures are the growth of the resident memory by connection."""

import argparse
import json
import os
import resource
import socket
import tempfile
import time

from concurrent_clients import LONG
from verne_process import Client, Service

MEBI = 1 << 20


def connected(port, count, request):
    """So many connections, each with this request."""
    sockets = []
    for _ in range(count):
        sockets.append(socket.create_connection(("127.0.0.1", port)))
        sockets[-1].sendall(request)
    return sockets


def settled(node):
    """The resident memory when it grows no more, bytes."""
    before, now = 0, node.rss()
    while now != before:
        time.sleep(1)
        before, now = now, node.rss()
    return now


def grown(name, node, count, request):
    """Prints the memory of connections with this request. Returns them."""
    before = settled(node)
    sockets = connected(node.port, count, request)
    after = settled(node)
    print(f"{count} {name}: resident {before / MEBI:.0f} MiB before, {after / MEBI:.0f} MiB with them, "
          f"{(after - before) / count / 1024:.1f} KiB each", flush=True)
    return sockets


def with_service(verne, count, measure):
    with tempfile.TemporaryDirectory() as place:
        node = Service(verne, os.path.join(place, "node"), "--max-connections", str(count + 100),
                       "--cache-bytes", str(MEBI), "--timeout", "3600").start()
        measure(node)
        node.kill()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verne")
    parser.add_argument("count", type=int, nargs="?", default=5_000)
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)

    def streams(node):
        job = Client(node.port).ask("POST", "/workspace", LONG, Prefer="respond-async").headers["Location"]
        request = f"GET {job}/events HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
        for stream in grown("event streams", node, options.count, request):
            assert stream.recv(15) == b"HTTP/1.1 200 OK"

    def waits(node):
        body = json.dumps(LONG)
        head = "POST /workspace HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nPrefer: wait=3000\r\n"
        request = f"{head}Content-Length: {len(body)}\r\n\r\n{body}".encode()
        # The job runs already: its own memory does not count.
        Client(node.port).ask("POST", "/workspace", LONG, Prefer="respond-async")
        waiting = grown("requests that wait for a job", node, options.count, request)
        for one in waiting:
            one.setblocking(False)
            try:
                raise SystemExit(f"a request does not wait: {one.recv(200)}")
            except BlockingIOError:
                pass

    with_service(options.verne, options.count, streams)
    with_service(options.verne, options.count, waits)


main()
