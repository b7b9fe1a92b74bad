"""Programs and tool paths."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, TypeAlias, TypedDict

from verne.answers.machine import Machine
from verne.answers.toolpath import ProgramSummary, ToolpathReport
from verne.arrow_stream import write_stream
from verne.decoding import decode
from verne.operations.batches import POSE, POSE_WITH_AXIS, POSITION
from verne.operations.jobs import Submission, submit
from verne.operations.start import Start, joints_of
from verne.session import Operation, Session, given
from verne.table import Rows, to_arrow

ProgramFormat = Literal["apt", "gcode", "csv", "ndjson", "arrow"]
Source: TypeAlias = str | os.PathLike[str] | bytes | Rows
"""A program: the path of its file, the bytes of this file, or its points as rows."""

EXTENSIONS: dict[str, ProgramFormat] = {
    **dict.fromkeys((".apt", ".cls", ".cl", ".clt", ".ncl", ".aptsource"), "apt"),
    **dict.fromkeys((".nc", ".ngc", ".tap", ".gcode", ".cnc"), "gcode"),
    ".csv": "csv",
    **dict.fromkeys((".ndjson", ".jsonl"), "ndjson"),
    ".arrow": "arrow",
}


class Setup(TypedDict, total=False):
    """A program's frame in the part frame: an origin, mm, and rotations about x, then y, then z, degrees."""

    x: float
    y: float
    z: float
    a: float
    b: float
    c: float


class Tolerance(TypedDict, total=False):
    """Greatest deviations: of the tip in feed moves, mm, of the axis, degrees, and of the tip in rapids, mm."""

    tip: float
    axis: float
    rapid: float


def program(
    session: Session,
    source: Source,
    *,
    format: ProgramFormat | None = None,
    units: Literal["mm", "inch"] | None = None,
    compensation: Literal["accept", "refuse"] | None = None,
    tcp: bool = False,
    tcp_on: Sequence[str] = (),
    tcp_off: Sequence[str] = (),
    rapid_feed: float | None = None,
    rotary_sense: Literal["tool", "table"] | None = None,
) -> Operation[ProgramSummary]:
    """Sends a program. The service keeps it; ``toolpath`` takes the answer.

    Args:
        source: The path of a file, the bytes of a file, or points: columns x, y, z in mm, phi1, phi2 in degrees or the
            tool axis i, j, k, and perhaps feed in mm/min, kind and line.
        format: ``apt`` (CL text), ``gcode``, ``csv``, ``ndjson`` or ``arrow``. By default the extension of the path
            decides.
        units: Unit of a program that states none.
        compensation: ``refuse``: cutter radius compensation is a fault instead of a warning.
        tcp: G-code: control of the tool centre point is always on.
        tcp_on: G-code: further codes that begin control of the tool centre point, such as ``M428``.
        tcp_off: G-code: further codes that end it.
        rapid_feed: G-code: moves with at least this feed are rapids, mm/min.
        rotary_sense: G-code: ``table`` for programs that count the angles of the table instead of the tool.

    Raises:
        Problem: The program has faults: ``errors`` has line, column and word of each.
    """
    content, format = _read(source, format)
    request = session.post_bytes(
        "programs",
        content,
        "application/octet-stream",
        format=format,
        units=units,
        compensation=compensation,
        tcp=tcp or None,
        tcp_on=",".join(tcp_on) or None,
        tcp_off=",".join(tcp_off) or None,
        rapid_feed=rapid_feed,
        rotary_sense=rotary_sense,
    )
    response = yield from session.send(request)
    return decode(ProgramSummary, response.json())


def toolpath(
    session: Session,
    source: Source | ProgramSummary,
    *,
    format: ProgramFormat | None = None,
    tool_length: float | Mapping[int, float] | None = None,
    length_before: int | None = None,
    setup: Setup | None = None,
    offsets: Mapping[str, Setup] | None = None,
    tip: Literal["end", "centre"] = "end",
    tool_radius: float = 0.0,
    orientation: Literal["vector", "rotary"] | None = None,
    tolerance: Tolerance | None = None,
    pole: float | None = None,
    rapids: Literal["linear", "joint"] = "linear",
    hold_rotary: bool = False,
    start: Start | None = None,
    table_clearance: float | None = None,
    on_limit: Literal["fail", "retract"] = "fail",
    clearance: float | None = None,
    retract_z: float | None = None,
    cycle: float | None = None,
    machine: str | Machine = "verne",
) -> Operation[Submission[ToolpathReport]]:
    """Submits the computation of the joint motion of a program. The job has its report, rows and joint program.

    Args:
        source: A program as for ``program``, or the answer of ``program``, which has more options for reading.
        format: Format of the file, as for ``program``.
        tool_length: Distance from P to the tool end, mm: one number, or one for each tool number. By default it is
            the length that the program states.
        length_before: Number of the tool whose length holds before the program calls a tool.
        setup: The program's frame in the part frame.
        offsets: A frame for each work offset that the program calls, such as ``G55``.
        tip: ``centre``: the program moves the centre of the tool's ball.
        tool_radius: Radius of the tool's end, mm. Only ``tip="centre"`` and ``table_clearance`` use it.
        orientation: Motion of the axis between two points: ``vector``: great circles; ``rotary``: linear angles.
        tolerance: Greatest deviations; by default 0.01 mm, 0.05 degrees, and 1 mm in rapids.
        pole: Half-angle of the cone in which the rotary axis is free, degrees.
        rapids: ``joint``: all joints move straight in rapids, instead of the tip.
        hold_rotary: The table keeps the program's C where the tool is parallel to the axis of the table.
        start: Where the machine stands before the program: rho1, rho2, rho3 in mm, theta1, theta2 in degrees.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        on_limit: ``retract``: the tool leaves the part and the table turns where no winding serves a whole cut.
        clearance: For ``retract``: way along the tool's axis and over the highest point, mm.
        retract_z: For ``retract``: height in the part frame at which the table turns, mm.
        cycle: Seconds in which the velocity of a drive may change at a corner of the path.
        machine: Name of a published machine, or a machine.

    Raises:
        Problem: The program has faults, or the service refused the request.
    """
    if not isinstance(source, ProgramSummary):
        source = yield from program(session, source, format=format)
    body = given(
        program=source.id,
        tool_length=lengths_of(tool_length),
        length_before=length_before,
        setup=setup,
        offsets=offsets,
        tip=tip,
        tool_radius=tool_radius,
        orientation=orientation,
        tolerance=tolerance,
        pole=pole,
        rapids=rapids,
        hold_rotary=hold_rotary or None,
        start=joints_of(start),
        table_clearance=table_clearance,
        on_limit=on_limit,
        clearance=clearance,
        retract_z=retract_z,
        cycle=cycle,
        machine=machine,
    )
    return (yield from submit(session, "toolpath", body, ToolpathReport))


def lengths_of(lengths: float | Mapping[int, float] | None) -> Any:
    """The lengths of tools as the service reads them."""
    return {str(tool): length for tool, length in lengths.items()} if isinstance(lengths, Mapping) else lengths


def _read(source: Source, format: ProgramFormat | None) -> tuple[bytes, ProgramFormat]:
    """The bytes of a program and their format."""
    if isinstance(source, str | os.PathLike):
        path = Path(source)
        format = format or EXTENSIONS.get(path.suffix.lower())
        if format is None:
            raise ValueError(f"the extension of {path} does not tell the format: state it")
        return path.read_bytes(), format
    if isinstance(source, bytes):
        if format is None:
            raise ValueError("the bytes of a program need a format")
        return source, format
    return write_stream(to_arrow(source, POSE, POSE_WITH_AXIS, POSITION)), "arrow"
