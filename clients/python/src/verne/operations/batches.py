"""Batches: many rows in one request."""

from __future__ import annotations

from typing import Any, TypeVar

from verne.answers.machine import Machine
from verne.batch import JOINTS, JointBatch, Membership, PoseBatch
from verne.operations.kinematics import Frame
from verne.operations.workspaces import WorkspaceKind
from verne.session import Numbers, Operation, Session, given
from verne.table import Rows, Table, to_arrow
from verne.transport import batch_answer, batch_request

T = TypeVar("T", bound=Table)

POSITION = ("x", "y", "z")
POSE = (*POSITION, "phi1", "phi2")
POSE_WITH_AXIS = (*POSITION, "i", "j", "k")


def ik_batch(
    session: Session,
    poses: Rows,
    *,
    frame: Frame = "part",
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    continuous: bool = False,
    start: Numbers | None = None,
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
        continuous: Whether each row continues from the row before.
        start: Joints from which the first row continues: rho1, rho2, rho3 in mm, theta1, theta2 in degrees.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: The rows do not have these columns.
        Problem: The service refused the request. An invalid row is no problem: ``status`` says so.
    """
    options = given(
        frame=frame,
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        continuous=continuous or None,
        start=start,
        machine=machine,
    )
    layouts = (POSE, POSE_WITH_AXIS) if frame == "part" else (POSITION,)
    return (yield from _batch(session, "ik/batch", poses, layouts, options, JointBatch))


def fk_batch(
    session: Session,
    joints: Rows,
    *,
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[PoseBatch]:
    """Solves the forward problem for many joints: one solution in the working mode for each row.

    Args:
        joints: Columns rho1, rho2, rho3 in mm, and perhaps theta1, theta2 in degrees: an array, or a table of pandas,
            polars or Arrow. Other columns of a table stand before those of the answer.
        tool_length: Distance from P to the tool end, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: The rows do not have these columns.
        Problem: The service refused the request. An invalid row is no problem: ``status`` says so.
    """
    options = given(
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
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
        ValueError: The rows do not have these columns.
        Problem: The service refused the request.
    """
    options = given(
        kind=kind,
        tool_length=tool_length,
        phi1=phi1,
        phi2=phi2,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
    )
    return (yield from _batch(session, "workspace/contains", points, (POSITION,), options, Membership))


def _batch(
    session: Session,
    path: str,
    rows: Rows,
    layouts: tuple[tuple[str, ...], ...],
    options: dict[str, Any],
    kind: type[T],
) -> Operation[T]:
    table, layout = to_arrow(rows, *layouts)
    response = yield from session.send(batch_request(session, path, table, layout, options))
    return kind(batch_answer(response, table, layout))
