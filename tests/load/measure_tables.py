"""Measures /ik/batch in JSON and as tables, and prints figures; asserts nothing.

    measure_tables.py VERNE [ROWS]

For each format: rows a second with transport, from the first byte of the request to the last of the answer, and the
memory of the service before and at its greatest. The best of three rounds. JSON has batches of 100,000 rows. The client
sends and reads at the same time; it does not read what the rows contain."""

import argparse
import json
import tempfile
import threading
import time

import pyarrow as pa
import pyarrow.csv
from verne_process import Client, Service

PATH = "/ik/batch?tool_length=50"
ROUNDS = 3


def poses(count):
    """A table of poses."""
    index = range(count)
    return pa.table({
        "x": [float(i % 400 - 200) + i % 13 / 13 for i in index],
        "y": [float(i % 7) + i % 11 / 11 for i in index],
        "z": [300.0 + i % 90 + i % 17 / 17 for i in index],
        "phi1": [i % 50 / 7 for i in index],
        "phi2": [i % 300 - 150.3 for i in index],
    })


def arrow(table):
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table, max_chunksize=65536)
    return sink.getvalue().to_pybytes()


def csv(table):
    sink = pa.BufferOutputStream()
    pyarrow.csv.write_csv(table, sink)
    return sink.getvalue().to_pybytes()


def ndjson(table):
    return "".join(json.dumps(row) + "\n" for row in table.to_pylist()).encode()


def exchange(port, media, body):
    """Seconds for a table, and the bytes of its answer."""
    client = Client(port)
    client.ask("GET", "/livez")
    socket = client.connection.sock
    head = f"POST {PATH} HTTP/1.1\r\nHost: localhost\r\nContent-Type: {media}\r\nContent-Length: {len(body)}\r\n\r\n"
    began = time.perf_counter()
    sender = threading.Thread(target=lambda: (socket.sendall(head.encode()), socket.sendall(body)))
    sender.start()
    count, end = 0, b""
    buffer = bytearray(1 << 20)
    while not end.endswith(b"\r\n0\r\n\r\n"):
        length = socket.recv_into(buffer)
        assert length, "the answer is incomplete"
        count += length
        end = (end + buffer[:length])[-7:] if length < 7 else bytes(buffer[length - 7:length])
    sender.join()
    seconds = time.perf_counter() - began
    client.close()
    return seconds, count


class Watch:
    """The greatest memory of a process while it is watched."""

    def __init__(self, service):
        self.service, self.greatest, self.ended = service, 0, threading.Event()
        self.thread = threading.Thread(target=self.run)

    def run(self):
        while not self.ended.wait(0.01):
            self.greatest = max(self.greatest, self.service.rss())

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.thread.join()


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("verne")
    arguments.add_argument("rows", nargs="?", type=int, default=1_000_000)
    options = arguments.parse_args()
    table = poses(options.rows)
    batch = [list(row.values()) for row in table.slice(0, 100_000).to_pylist()]
    batch = json.dumps({"tool_length": 50, "poses": batch})
    print("| format | rows/s | of JSON | request, MB | answer, MB | memory before, MB | greatest, MB |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    bodies = [("json", None), ("arrow", arrow), ("csv", csv), ("ndjson", ndjson)]
    media = {"arrow": "application/vnd.apache.arrow.stream", "csv": "text/csv", "ndjson": "application/x-ndjson"}
    of_json = None
    for name, write in bodies:
        body = write(table) if write else batch.encode()
        with tempfile.TemporaryDirectory() as data:
            service = Service(options.verne, data).start()
            before, best = service.rss(), float("inf")
            with Watch(service) as watch:
                for _ in range(ROUNDS):
                    seconds, answer = measure_json(service.port, body) if write is None else exchange(
                        service.port, media[name], body)
                    best = min(best, seconds)
            service.terminate()
        rate = (options.rows if write else 100_000) / best
        of_json = of_json or rate
        figures = [f"{rate:.0f}", f"{rate / of_json:.1f}", *(f"{n / 1e6:.0f}" for n in (
            len(body), answer, before, watch.greatest))]
        print(f"| {name} | " + " | ".join(figures) + " |", flush=True)


def measure_json(port, body):
    client = Client(port)
    client.ask("GET", "/livez")
    began = time.perf_counter()
    client.connection.request("POST", "/ik/batch", body, {"Content-Type": "application/json"})
    answer = client.connection.getresponse()
    size = len(answer.read())
    seconds = time.perf_counter() - began
    assert answer.status == 200
    client.close()
    return seconds, size


if __name__ == "__main__":
    main()
