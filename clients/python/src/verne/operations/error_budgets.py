"""Error budgets of poses, and error maps of workspaces."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal, TypeAlias

from verne.answers.error_budget import ErrorBudgetResult, ErrorMapSummary
from verne.answers.machine import Machine
from verne.decoding import decode
from verne.operations.batches import POSE, POSE_WITH_AXIS, POSITION
from verne.operations.jobs import Submission, submit
from verne.operations.kinematics import Frame
from verne.operations.workspaces import WorkspaceKind
from verne.session import Operation, Session, given
from verne.table import Rows, Table, to_arrow

Parameter = Literal[
    "e1", "e2", "R1", "r1", "R2", "r4", "L1", "L2", "L3", "o1", "o2", "o3", "tool_length", "da", "dt",
    "tilt_axis_y", "rotary_axis_x", "rotary_axis_y", "tilt_axis_b", "tilt_axis_c", "tilt_zero", "rotary_axis_b",
    "rotary_zero",
]  # fmt: skip
"""A number of the machine's geometry, a zero offset, or the tool's length."""

ParameterTolerances: TypeAlias = Mapping[Parameter, float]
"""A tolerance for each parameter, mm or degrees. Parameters without a tolerance are exact."""


def error_budget(
    session: Session,
    poses: Rows,
    parameter_tolerances: ParameterTolerances,
    *,
    frame: Frame = "part",
    tool_length: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[ErrorBudgetResult]:
    """Computes how far the tool may be off at each pose, for tolerances of the machine's parameters.

    Args:
        poses: Columns x, y, z in mm, and in frame ``part`` phi1, phi2 in degrees or the tool axis i, j, k: an array,
            or a table of pandas, polars or Arrow. The service takes at most 10,000 rows.
        parameter_tolerances: The tolerances, such as ``{"L1": 0.02, "tilt_zero": 0.001}``: mm and degrees.
        frame: ``part``: the tool end in the part frame, with the errors of the table; ``tool``: the tool end in the
            base frame; ``platform``: the platform's point P in the base frame.
        tool_length: Distance from P to the tool end, mm.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: The poses do not have these columns.
        Problem: The service refused the request. An invalid row is no problem: ``errors`` says what is wrong with it.
    """
    body = given(
        poses=_rows(poses, (POSE, POSE_WITH_AXIS) if frame == "part" else (POSITION,)),
        parameter_tolerances=dict(parameter_tolerances),
        frame=frame,
        tool_length=tool_length,
        machine=machine,
    )
    response = yield from session.send(session.post("error-budget", body))
    return decode(ErrorBudgetResult, response.json())


def error_map(
    session: Session,
    parameter_tolerances: ParameterTolerances,
    kind: WorkspaceKind = "platform",
    *,
    tool_length: float = 0.0,
    phi1: float = 0.0,
    phi2: float = 0.0,
    cell: float = 20.0,
    tolerance: float = 5.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[Submission[ErrorMapSummary]]:
    """Submits the computation of an error map: how far the tool may be off at the points of a workspace.

    Args:
        parameter_tolerances: The tolerances, such as ``{"L1": 0.02, "tilt_zero": 0.001}``: mm and degrees.
        kind: Point and frame of the positions and of the errors, as for ``workspace``.
        tool_length: Distance from P to the tool end, mm. Kind ``platform`` ignores it.
        phi1: Inclination of the tool in the part frame, degrees. Only kind ``part`` uses it.
        phi2: Azimuth of the tool in the part frame, degrees. Only kind ``part`` uses it.
        cell: Distance between neighbouring points of the grid, mm.
        tolerance: Greatest distance between the mesh and the true surface, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.
    """
    body = given(
        parameter_tolerances=dict(parameter_tolerances),
        kind=kind,
        tool_length=tool_length,
        phi1=phi1,
        phi2=phi2,
        cell=cell,
        tolerance=tolerance,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
    )
    return (yield from submit(session, "workspace/error-budget", body, ErrorMapSummary))


def _rows(poses: Rows, layouts: tuple[tuple[str, ...], ...]) -> list[Any]:
    """The rows as lists of numbers. None is in place of a number that is missing or not finite."""
    table = to_arrow(poses, *layouts)
    layout = next((names for names in layouts if set(names) <= set(table.column_names)), None)
    if layout is None:
        names = " or ".join(", ".join(names) for names in layouts)
        raise ValueError(f"expected the columns {names}; found {', '.join(table.column_names)}")
    rows = Table(table).to_numpy(*layout)
    return [[value if math.isfinite(value) else None for value in row] for row in rows.tolist()]
