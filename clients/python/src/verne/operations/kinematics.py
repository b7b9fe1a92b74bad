"""The forward and the inverse problem."""

from __future__ import annotations

from typing import Any, Literal

from verne.answers.machine import Machine
from verne.answers.solution import ForwardResult, InverseResult
from verne.decoding import decode
from verne.session import Numbers, Operation, Session, given

Frame = Literal["part", "tool", "platform"]
Wanted = Literal["working", "feasible", "all"]


def fk(
    session: Session,
    joints: Numbers,
    *,
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    solutions: Wanted = "working",
    near_joints: Numbers | None = None,
    near_pose: Numbers | None = None,
    jacobian: bool = False,
    characteristic_length: float | None = None,
    certified: bool = False,
    machine: str | Machine = "verne",
) -> Operation[ForwardResult]:
    """Solves the forward problem: from joints to poses.

    Args:
        joints: The sliders rho1, rho2, rho3 in mm, and perhaps the table's angles theta1, theta2 in degrees. Only
            with these angles a solution has a pose in the part frame.
        tool_length: Distance from P to the tool end, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        solutions: ``working``: those in the working mode; ``feasible``: those of them that break no limit; ``all``.
        near_joints: Sorts the solutions by their distance from these joints: three or five numbers as in ``joints``.
        near_pose: Sorts them by their distance from this pose of the platform: x, y, z in mm, and perhaps alpha in
            degrees.
        jacobian: Whether each solution has its ``jacobian``. It needs theta1 and theta2.
        characteristic_length: Length by which the Jacobian's lengths are divided before its singular values are
            computed, mm. By default it is R1 of the machine.
        certified: Whether to prove the solutions: each has its ``certificate``, and the result its ``completeness``.
        machine: Name of a published machine, or a machine.

    Raises:
        Problem: The service refused the request. No solution is no problem: ``reason`` of the result says why.
    """
    body = given(
        joints=_joints(joints),
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        solutions=solutions,
        near=_near(near_joints, near_pose),
        jacobian=jacobian or None,
        characteristic_length=characteristic_length,
        certified=certified or None,
        machine=machine,
    )
    response = yield from session.send(session.post("fk", body))
    return decode(ForwardResult, response.json())


def ik(
    session: Session,
    x: float,
    y: float,
    z: float,
    phi1: float | None = None,
    phi2: float | None = None,
    *,
    axis: Numbers | None = None,
    frame: Frame = "part",
    tool_length: float = 0.0,
    table_clearance: float | None = None,
    tool_radius: float = 0.0,
    solutions: Wanted = "working",
    near_joints: Numbers | None = None,
    near_pose: Numbers | None = None,
    jacobian: bool = False,
    characteristic_length: float | None = None,
    certified: bool = False,
    machine: str | Machine = "verne",
) -> Operation[InverseResult]:
    """Solves the inverse problem: from a pose to joints.

    Args:
        x: Position in the frame, mm.
        y: Position in the frame, mm.
        z: Position in the frame, mm. It points down in the base frame and up from the table in the part frame.
        phi1: Inclination of the tool, degrees. Only frame ``part`` has it; the default is 0.
        phi2: Azimuth of the tool, degrees. Only frame ``part`` has it; the default is 0.
        axis: Tool axis i, j, k from the tool end to the holder, in place of phi1 and phi2.
        frame: ``part``: the tool end in the part frame; ``tool``: the tool end in the base frame; ``platform``: the
            platform's point P in the base frame.
        tool_length: Distance from P to the tool end, mm.
        table_clearance: Least height over the table, mm. By default it is the machine's limit, if it has one.
        tool_radius: Radius of the tool's end circle, mm. Only ``table_clearance`` uses it.
        solutions: ``working``: those in the working mode; ``feasible``: those of them that break no limit; ``all``.
        near_joints: Sorts the solutions by their distance from these joints: rho1, rho2, rho3 in mm, and perhaps
            theta1, theta2 in degrees, which also choose the winding of the table.
        near_pose: Sorts them by their distance from this pose of the platform: x, y, z in mm, and perhaps alpha in
            degrees.
        jacobian: Whether each solution has its ``jacobian``. Only frame ``part`` has it.
        characteristic_length: Length by which the Jacobian's lengths are divided before its singular values are
            computed, mm. By default it is R1 of the machine.
        certified: Whether to prove the solutions: each has its ``certificate``, and the result its ``completeness``.
        machine: Name of a published machine, or a machine.

    Raises:
        Problem: The service refused the request. No solution is no problem: ``reason`` of the result says why.
    """
    body = given(
        pose=given(x=x, y=y, z=z, phi1=phi1, phi2=phi2, axis=axis),
        frame=frame,
        tool_length=tool_length,
        table_clearance=table_clearance,
        tool_radius=tool_radius,
        solutions=solutions,
        near=_near(near_joints, near_pose),
        jacobian=jacobian or None,
        characteristic_length=characteristic_length,
        certified=certified or None,
        machine=machine,
    )
    response = yield from session.send(session.post("ik", body))
    return decode(InverseResult, response.json())


def _joints(joints: Numbers) -> dict[str, Any]:
    if len(joints) not in (3, 5):
        raise ValueError(
            f"joints are rho1, rho2, rho3 or rho1, rho2, rho3, theta1, theta2; found {len(joints)} numbers"
        )
    return {"rho": joints[:3], **dict(zip(("theta1", "theta2"), joints[3:], strict=False))}


def _near(joints: Numbers | None, pose: Numbers | None) -> dict[str, Any] | None:
    if joints is not None and pose is not None:
        raise ValueError("near_joints and near_pose exclude each other")
    if joints is not None:
        return _joints(joints)
    if pose is not None:
        if len(pose) not in (3, 4):
            raise ValueError(f"a pose of the platform is x, y, z or x, y, z, alpha; found {len(pose)} numbers")
        return dict(zip(("x", "y", "z", "alpha"), pose, strict=False))
    return None
