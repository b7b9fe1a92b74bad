"""Tables as streams of Apache Arrow, in which the service receives and sends rows."""

from __future__ import annotations

import io

import pyarrow

MEDIA_TYPE = "application/vnd.apache.arrow.stream"
ROWS_PER_MESSAGE = 65536
"""The service answers message by message."""


def write_stream(table: pyarrow.Table) -> bytes:
    """The bytes of a table."""
    stream = io.BytesIO()
    with pyarrow.ipc.new_stream(stream, table.schema) as writer:
        writer.write_table(table, max_chunksize=ROWS_PER_MESSAGE)
    return stream.getvalue()


def read_stream(content: bytes) -> pyarrow.Table:
    """The table in these bytes."""
    with pyarrow.ipc.open_stream(content) as reader:
        return reader.read_all()
