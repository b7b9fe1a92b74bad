"""Sends tables to the service as clients do, and reads its answers with pyarrow.

    check_tables.py VERNE

The same poses in JSON, Arrow, CSV and NDJSON have the same joints, to the last bit. The types of the answer are those
that docs/api.md names. A client that sends everything before it reads gets the answer of a table as long as the
limit."""

import argparse
import io
import json
import sys
import urllib.request

import pyarrow as pa
import pyarrow.csv
import pyarrow.json

sys.path.insert(0, __file__.rsplit("/", 2)[0] + "/load")
from verne_process import Process, free_port

ARROW = "application/vnd.apache.arrow.stream"
MEDIA = {"arrow": ARROW, "csv": "text/csv", "ndjson": "application/x-ndjson"}
JOINTS = ["rho1", "rho2", "rho3", "theta1", "theta2"]


def poses(count):
    return pa.table({
        "id": [f"pose {i}" for i in range(count)],
        "z": pa.array([300 + i % 90 for i in range(count)], pa.int16()),
        "x": [float(i % 400 - 200) + i % 13 / 13 for i in range(count)],
        "y": [None if i % 97 == 5 else i % 7 / 7 for i in range(count)],
        "phi2": [i % 300 - 150.3 for i in range(count)],
        "phi1": pa.array([i % 50 / 8 for i in range(count)], pa.float32()),
        "tool": pa.array(["drill" if i % 3 else "mill" for i in range(count)]).dictionary_encode(),
    })


def written(table, form):
    sink = pa.BufferOutputStream()
    if form == "arrow":
        with pa.ipc.new_stream(sink, table.schema) as writer:
            writer.write_table(table, max_chunksize=1000)
    elif form == "csv":
        pyarrow.csv.write_csv(table, sink)
    else:
        return "".join(json.dumps(row) + "\n" for row in table.to_pylist()).encode()
    return sink.getvalue().to_pybytes()


def read(body, form):
    if form == "arrow":
        return pa.ipc.open_stream(body).read_all()
    if form == "csv":
        return pyarrow.csv.read_csv(io.BytesIO(body))
    return pyarrow.json.read_json(io.BytesIO(body))


def answer(port, path, media, body):
    request = urllib.request.Request(f"http://127.0.0.1:{port}{path}", body, {"content-type": media})
    with urllib.request.urlopen(request, timeout=60) as response:
        return response.read()


def faults(port):
    """What is wrong, as lines of text."""
    table = poses(20_000)
    rows = [[row[name] for name in ("x", "y", "z", "phi1", "phi2")] for row in table.to_pylist()]
    expected = json.loads(answer(port, "/ik/batch", "application/json", json.dumps(
        {"tool_length": 50, "poses": rows}).encode()))
    for sent in MEDIA:
        for wanted in MEDIA:
            name = f"{sent} to {wanted}"
            body = answer(port, f"/ik/batch?tool_length=50&format={wanted}", MEDIA[sent], written(table, sent))
            found = read(body, wanted)
            if found.column_names[:2] != ["id", "tool"]:
                yield f"{name}: the columns are {found.column_names}"
            if found["id"].to_pylist() != table["id"].to_pylist():
                yield f"{name}: id is not passed on"
            joints = list(zip(*(found[column].to_pylist() for column in JOINTS)))
            if joints != [tuple(row or [None] * 5) for row in expected["joints"]]:
                yield f"{name}: other joints than in JSON"
            for column in ("status", "constraint", "margin", "element"):
                values = [None if value == "" else value for value in found[column].to_pylist()]
                if values != expected[column]:
                    yield f"{name}: another {column} than in JSON"
            if wanted == "arrow":
                kinds = {column: found.schema.field(column).type for column in found.column_names}
                if not all(pa.types.is_dictionary(kinds[column]) for column in ("status", "constraint", "element")):
                    yield f"{name}: the types are {kinds}"
    # urllib sends the whole body before it reads.
    rows = 250_000
    whole = written(poses(rows).drop_columns(["id", "tool"]), "arrow")
    if read(answer(port, "/ik/batch", ARROW, whole), "arrow").num_rows != rows:
        yield f"a table of {len(whole)} bytes has another number of rows"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("verne")
    port = free_port()
    command = [arguments.parse_args().verne, "serve", "--listen", f"127.0.0.1:{port}", "--memory-only"]
    service = Process(port, *command).start()
    try:
        found = list(faults(port))
    finally:
        service.terminate()
    print("\n".join(found) or "tables: the same in JSON, Arrow, CSV and NDJSON")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
