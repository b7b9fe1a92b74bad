"""Hostile clients: each function is one attack and returns when the attack is over. Used by test_soak.py."""

import gzip
import os
import random
import socket
import struct
import time

PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
MEBI = 1 << 20


def connected(port, timeout=20):
    return socket.create_connection(("127.0.0.1", port), timeout=timeout)


def status(stream):
    """The status of the answer, if there is one before the connection ends."""
    answer = b""
    try:
        while b"\r\n" not in answer:
            more = stream.recv(4096)
            if not more:
                break
            answer += more
    except OSError:
        pass
    words = answer.split()
    return int(words[1]) if len(words) > 1 and words[0].startswith(b"HTTP/1") else None


def posted(port, path, body, headers="", length=None):
    """The status of the answer to a body."""
    length = len(body) if length is None else length
    head = f"POST {path} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {length}\r\n{headers}\r\n"
    with connected(port) as stream:
        try:
            stream.sendall(head.encode())
            stream.sendall(body)
        except OSError:
            pass  # The service has answered and closed the connection.
        return status(stream)


def garbage(port):
    with connected(port) as stream:
        try:
            stream.sendall(os.urandom(random.randint(1, 4096)))
            status(stream)
        except OSError:
            pass


def disconnects(port):
    """Disconnects during a request, or during its answer."""
    with connected(port) as stream:
        try:
            stream.sendall(random.choice([
                b"POST /ik HTTP/1.1\r\nHost: x\r\nContent-Le",
                b"POST /ik HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 500\r\n\r\n{\"x\":",
                b"GET /workspace?kind=part&tool_length=50&tolerance=1&format=json HTTP/1.1\r\nHost: x\r\n\r\n"]))
            if random.random() < 0.5:
                stream.recv(100)
        except OSError:
            pass


def stalls(port, seconds):
    """Requests a large answer and reads it slowly."""
    with connected(port) as stream:
        stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        path = "/workspace?kind=part&tool_length=50&tolerance=0.05&format=ply"
        until = time.monotonic() + seconds
        try:
            stream.sendall(f"GET {path} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
            while time.monotonic() < until and stream.recv(512):
                time.sleep(0.5)
        except OSError:
            pass


def trickles(port, seconds):
    """Sends a header byte by byte; returns the seconds until the service disconnects."""
    began = time.monotonic()
    with connected(port) as stream:
        try:
            stream.sendall(b"GET /ik HTTP/1.1\r\nHost: x\r\nX-A: ")
            while time.monotonic() - began < seconds:
                stream.sendall(b"a")
                time.sleep(0.2)
        except OSError:
            return time.monotonic() - began
    return None


def crowd(port, connections, seconds):
    """Opens many idle connections; returns how many the service has accepted."""
    open_ones = []
    try:
        for _ in range(connections):
            try:
                open_ones.append(connected(port, 5))
            except OSError:
                break
        time.sleep(seconds)
        return len(open_ones)
    finally:
        for stream in open_ones:
            stream.close()


def bomb(port):
    """A hundred megabytes of JSON, compressed to 100 kB."""
    return posted(port, "/ik", gzip.compress(b"[" + b"1," * (50 * MEBI) + b"1]"), "Content-Encoding: gzip\r\n")


def nested(port):
    return posted(port, "/ik", b'{"x":' * 10_000)


def nested_batch(port):
    return posted(port, "/ik/batch", b'{"poses":' + b"[" * 4_000_000)


def huge(port):
    """A hundred megabytes of JSON, uncompressed."""
    return posted(port, "/ik/batch", b'{"poses":[' + b"[1,2,3,4,5]," * (8 * MEBI) + b"[1,2,3,4,5]]}")


def frame(kind, flags, stream, payload=b""):
    return struct.pack(">I", len(payload))[1:] + bytes([kind, flags]) + struct.pack(">I", stream) + payload


def rapid_resets(port, streams):
    """HTTP/2 rapid reset: opens and resets streams; returns how many before the service closes the connection."""
    get = b"\x82\x86\x84\x41\x01x"  # :method GET, :scheme http, :path /, :authority x
    with connected(port) as stream:
        try:
            stream.sendall(PREFACE + frame(4, 0, 0))
            for i in range(streams):
                number = 2 * i + 1
                stream.sendall(frame(1, 5, number, get) + frame(3, 0, number, struct.pack(">I", 8)))
        except OSError:
            return i
    return streams
