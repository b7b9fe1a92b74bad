"""Workspaces, families of workspaces and dexterity maps."""

from __future__ import annotations

from typing import Literal

from verne.answers.machine import Machine
from verne.answers.workspace import DexteritySummary, FamilySummary, WorkspaceSummary
from verne.operations.jobs import Submission, submit
from verne.session import Numbers, Operation, Session, given

WorkspaceKind = Literal["platform", "tool", "part"]


def workspace(
    session: Session,
    kind: WorkspaceKind = "platform",
    *,
    tool_length: float = 0.0,
    phi1: float = 0.0,
    phi2: float = 0.0,
    tolerance: float = 1.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[Submission[WorkspaceSummary]]:
    """Submits the computation of a workspace. The job's result has its volume; the job has its mesh and slices.

    Args:
        kind: ``platform``: the platform's point P in the base frame; ``tool``: the tool end in the base frame;
            ``part``: the tool end in the part frame, with a fixed orientation of the tool.
        tool_length: Distance from P to the tool end, mm. Kind ``platform`` ignores it.
        phi1: Inclination of the tool in the part frame, degrees. Only kind ``part`` uses it.
        phi2: Azimuth of the tool in the part frame, degrees. Only kind ``part`` uses it.
        tolerance: Greatest distance between the mesh and the true surface, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.
    """
    body = given(
        kind=kind,
        tool_length=tool_length,
        phi1=phi1,
        phi2=phi2,
        tolerance=tolerance,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
    )
    return (yield from submit(session, "workspace", body, WorkspaceSummary))


def family(
    session: Session,
    kind: WorkspaceKind = "part",
    *,
    tool_length: float | Numbers = 0.0,
    phi1: float | Numbers = 0.0,
    phi2: float | Numbers = 0.0,
    tolerance: float = 1.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[Submission[FamilySummary]]:
    """Submits the computation of workspaces for the values of one or two parameters.

    Args:
        kind: Point and frame of the positions, as for ``workspace``.
        tool_length: Distance from P to the tool end, mm: one value or several.
        phi1: Inclination of the tool in the part frame, degrees: one value or several.
        phi2: Azimuth of the tool in the part frame, degrees: one value or several.
        tolerance: Greatest distance between each mesh and the true surface, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.

    Raises:
        ValueError: No parameter has several values.
    """
    values = {"tool_length": tool_length, "phi1": phi1, "phi2": phi2}
    if all(isinstance(value, float | int) for value in values.values()):
        raise ValueError("a family needs a list of tool_length, phi1 or phi2")
    body = given(
        kind=kind,
        **values,
        tolerance=tolerance,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
    )
    return (yield from submit(session, "workspace", body, FamilySummary))


def dexterity(
    session: Session,
    phi1: tuple[float, float],
    *,
    phi2: float = 0.0,
    tool_length: float = 0.0,
    cell: float = 20.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    machine: str | Machine = "verne",
) -> Operation[Submission[DexteritySummary]]:
    """Submits the computation of a dexterity map: the inclinations that reach each point of a grid on the part.

    Args:
        phi1: Least and greatest inclination of the tool, degrees.
        phi2: Azimuth of the tool in the part frame, degrees.
        tool_length: Distance from P to the tool end, mm.
        cell: Distance between neighbouring points of the grid, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        machine: Name of a published machine, or a machine.
    """
    least, greatest = phi1
    body = given(
        phi1={"from": least, "to": greatest},
        phi2=phi2,
        tool_length=tool_length,
        cell=cell,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        machine=machine,
    )
    return (yield from submit(session, "workspace/dexterity", body, DexteritySummary))
