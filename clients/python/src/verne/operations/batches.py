"""Batches: many rows in one request."""

from __future__ import annotations

import json
from typing import Any, Literal, TypeVar

import pyarrow

from verne.answers.machine import Machine
from verne.arrow_stream import MEDIA_TYPE, read_stream, write_stream
from verne.batch import JOINTS, JointBatch, Membership, PoseBatch
from verne.operations.kinematics import Frame
from verne.operations.start import Start, joints_of
from verne.operations.workspaces import WorkspaceKind
from verne.session import Operation, Session, given
from verne.table import Rows, Table, to_arrow

T = TypeVar("T", bound=Table)
JacobianColumns = Literal["condition", "matrix"]

POSITION = ("x", "y", "z")
POSE = (*POSITION, "phi1", "phi2")
POSE_WITH_AXIS = (*POSITION, "i", "j", "k")
ROW_COLUMNS = {
    "ik/batch": {*POSE, *POSE_WITH_AXIS},
    "fk/batch": {*JOINTS},
    "workspace/contains": {*POSITION},
}
"""The columns that the service reads."""
ROWS_PER_REQUEST = 100_000
"""A request has at most some 5 MB. The service bounds the rows that it reads before the client reads the answer."""


def ik_batch(
    session: Session,
    poses: Rows,
    *,
    frame: Frame = "part",
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    continuous: bool = False,
    start: Start | None = None,
    jacobian: JacobianColumns | None = None,
    characteristic_length: float | None = None,
    machine: str | Machine = "verne",
) -> Operation[JointBatch]:
    """Solves the inverse problem for many poses: one solution in the working mode for each.

    Args:
        poses: Columns x, y, z in mm, and in frame ``part`` phi1, phi2 in degrees or the tool axis i, j, k: an array,
            or a table of pandas, polars or Arrow. Other columns of a table stand before those of the answer.
        frame: ``part``: the tool end in the part frame; ``tool``: the tool end in the base frame; ``platform``: the
            platform's point P in the base frame.
        tool_length: Distance from P to the tool end, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        continuous: Whether each row continues from the row before. All rows then travel in one request, and its size
            must be below the service's limit: 16 MiB by default, or 300,000 rows.
        start: Joints from which the first row continues: rho1, rho2, rho3 in mm, theta1, theta2 in degrees.
        jacobian: Columns of the Jacobian in the answer: ``condition`` (det_p, condition_number, and speed_x to speed_z
            if the machine has drives), or ``matrix`` (j11 to j55, too). Only frame ``part`` has it.
        characteristic_length: Length by which the Jacobian's lengths are divided before its condition number is
            computed, mm. By default it is R1 of the machine.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: An array does not have these columns.
        Problem: The service refused the request or a column. An invalid row is no problem: ``detail`` says what is
            wrong with it.
    """
    options = given(
        frame=frame,
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        continuous=continuous or None,
        start=None if start is None else json.dumps(joints_of(start)),
        jacobian=jacobian,
        characteristic_length=characteristic_length,
        machine=machine if isinstance(machine, str) else json.dumps(machine),
    )
    layouts = (POSE, POSE_WITH_AXIS) if frame == "part" else (POSITION,)
    is_divisible = not continuous
    return (yield from _batch(session, "ik/batch", poses, layouts, options, JointBatch, is_divisible=is_divisible))


def fk_batch(
    session: Session,
    joints: Rows,
    *,
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    jacobian: JacobianColumns | None = None,
    characteristic_length: float | None = None,
    machine: str | Machine = "verne",
) -> Operation[PoseBatch]:
    """Solves the forward problem for many joints: one solution in the working mode for each row.

    Args:
        joints: Columns rho1, rho2, rho3 in mm, and perhaps theta1, theta2 in degrees: an array, or a table of pandas,
            polars or Arrow. Other columns of a table stand before those of the answer.
        tool_length: Distance from P to the tool end, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        jacobian: Columns of the Jacobian in the answer: ``condition`` (det_p, condition_number, and speed_x to speed_z
            if the machine has drives), or ``matrix`` (j11 to j55, too). It needs theta1 and theta2.
        characteristic_length: Length by which the Jacobian's lengths are divided before its condition number is
            computed, mm. By default it is R1 of the machine.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: An array does not have these columns.
        Problem: The service refused the request or a column. An invalid row is no problem: ``detail`` says what is
            wrong with it.
    """
    options = given(
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        jacobian=jacobian,
        characteristic_length=characteristic_length,
        machine=machine if isinstance(machine, str) else json.dumps(machine),
    )
    return (yield from _batch(session, "fk/batch", joints, (JOINTS, JOINTS[:3]), options, PoseBatch))


def contains(
    session: Session,
    points: Rows,
    kind: WorkspaceKind = "platform",
    *,
    tool_length: float = 0.0,
    phi1: float = 0.0,
    phi2: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[Membership]:
    """Tests which points are inside a workspace, without computing it.

    Args:
        points: Columns x, y, z in mm, in the frame of the kind: an array, or a table of pandas, polars or Arrow. Other
            columns of a table stand before those of the answer.
        kind: Point and frame of the positions, as for ``workspace``.
        tool_length: Distance from P to the tool end, mm.
        phi1: Inclination of the tool in the part frame, degrees. Only kind ``part`` uses it.
        phi2: Azimuth of the tool in the part frame, degrees. Only kind ``part`` uses it.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: An array does not have these columns.
        Problem: The service refused the request.
    """
    options = given(
        kind=kind,
        tool_length=tool_length,
        phi1=phi1,
        phi2=phi2,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine if isinstance(machine, str) else json.dumps(machine),
    )
    return (yield from _batch(session, "workspace/contains", points, (POSITION,), options, Membership))


def _batch(
    session: Session,
    path: str,
    rows: Rows,
    layouts: tuple[tuple[str, ...], ...],
    options: dict[str, Any],
    kind: type[T],
    *,
    is_divisible: bool = True,
) -> Operation[T]:
    table = to_arrow(rows, *layouts)
    # The service says what is wrong with the columns of a row. The others stay here.
    others = [name for name in table.column_names if name not in ROW_COLUMNS[path]]
    own = table.drop_columns(others)
    step = ROWS_PER_REQUEST if is_divisible else max(len(own), 1)
    parts = []
    for first in range(0, max(len(own), 1), step):
        content = write_stream(own.slice(first, step))
        response = yield from session.send(session.post_bytes(path, content, MEDIA_TYPE, **options))
        parts.append(read_stream(response.content))
    answer = pyarrow.concat_tables(parts).unify_dictionaries()
    for name in reversed(others):
        # A column of the answer replaces one of its name, as in the service.
        if name not in answer.column_names:
            answer = answer.add_column(0, table.schema.field(name), table.column(name))
    # The metadata contains the index of a data frame of pandas.
    return kind(answer.replace_schema_metadata(table.schema.metadata))
