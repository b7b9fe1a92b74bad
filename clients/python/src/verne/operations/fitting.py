"""Windows of parameters, placements of programs, and regions of origins."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, TypeAlias, TypedDict, Unpack

from verne.answers.fitting import OriginsSummary, Placement, Window
from verne.answers.machine import Machine
from verne.answers.toolpath import ProgramSummary
from verne.operations.jobs import Submission, submit
from verne.operations.start import Start, joints_of
from verne.operations.toolpaths import ProgramFormat, Setup, Source, Tolerance, lengths_of, program
from verne.session import Operation, Session, given

WindowParameter = Literal["tool_length", "setup.x", "setup.y", "setup.z", "setup.a", "setup.b", "setup.c"]
FreeParameter = Literal["setup.x", "setup.y", "setup.z", "setup.c", "tool_length"]
Bounds: TypeAlias = tuple[float, float]
"""Least and greatest value."""


class ToolpathOptions(TypedDict, total=False):
    """The arguments of ``toolpath`` that say how the machine follows a program."""

    tool_length: float | Mapping[int, float] | None
    length_before: int | None
    setup: Setup | None
    offsets: Mapping[str, Setup] | None
    tip: Literal["end", "centre"]
    tool_radius: float
    orientation: Literal["vector", "rotary"] | None
    tolerance: Tolerance | None
    pole: float | None
    rapids: Literal["linear", "joint"]
    hold_rotary: bool
    start: Start | None
    table_clearance: float | None
    on_limit: Literal["fail", "retract"]
    clearance: float | None
    retract_z: float | None
    machine: str | Machine


def placement(
    session: Session,
    source: Source | ProgramSummary,
    *,
    free: Mapping[FreeParameter, Bounds],
    reserve: Mapping[str, float],
    format: ProgramFormat | None = None,
    **options: Unpack[ToolpathOptions],
) -> Operation[Submission[Placement]]:
    """Submits the search for the set-up in which a program keeps the greatest distance from the limits.

    Args:
        source: A program as for ``toolpath``.
        free: The parameters that may change, each with its least and its greatest value, mm and degrees.
        reserve: The distance to keep from the limit of a constraint, such as ``{"stroke": 20}``: mm, degrees or none.
        format: Format of the file, as for ``program``.
        **options: As for ``toolpath``. ``setup`` and ``tool_length`` are where the search begins.

    Raises:
        Problem: The program has faults, or the service refused the request.
    """
    source = yield from _stored(session, source, format)
    ranges = {name: list(bounds) for name, bounds in free.items()}
    body = _body(source, options) | {"free": ranges, "reserve": dict(reserve)}
    return (yield from submit(session, "toolpath/placement", body, Placement))


def window(
    session: Session,
    source: Source | ProgramSummary,
    parameter: WindowParameter,
    between: Bounds,
    *,
    format: ProgramFormat | None = None,
    **options: Unpack[ToolpathOptions],
) -> Operation[Submission[Window]]:
    """Submits the search for the values of a parameter with which the machine can run a program.

    Args:
        source: A program as for ``toolpath``.
        parameter: ``tool_length``, or a number of the set-up such as ``setup.x``. Its own value takes no part.
        between: The least and the greatest value, mm or degrees.
        format: Format of the file, as for ``program``.
        **options: As for ``toolpath``.

    Raises:
        Problem: The program has faults, or the service refused the request.
    """
    source = yield from _stored(session, source, format)
    least, greatest = between
    body = _body(source, options) | {"parameter": parameter, "from": least, "to": greatest}
    return (yield from submit(session, "toolpath/window", body, Window))


def origins(
    session: Session,
    source: Source | ProgramSummary,
    *,
    cell: float = 20.0,
    format: ProgramFormat | None = None,
    **options: Unpack[ToolpathOptions],
) -> Operation[Submission[OriginsSummary]]:
    """Submits the computation of all origins of ``setup`` at which the machine can follow a program: their region.

    Args:
        source: A program as for ``toolpath``.
        cell: Step of the grid from which the surface is made, mm.
        format: Format of the file, as for ``program``.
        **options: As for ``toolpath``; x, y and z of ``setup`` have no effect.

    Raises:
        Problem: The program has faults, or the service refused the request.
    """
    source = yield from _stored(session, source, format)
    return (yield from submit(session, "toolpath/origins", _body(source, options) | {"cell": cell}, OriginsSummary))


def _stored(
    session: Session, source: Source | ProgramSummary, format: ProgramFormat | None
) -> Operation[ProgramSummary]:
    if isinstance(source, ProgramSummary):
        return source
    return (yield from program(session, source, format=format))


def _body(source: ProgramSummary, options: ToolpathOptions) -> dict[str, Any]:
    fields: dict[str, Any] = dict(options)
    fields["tool_length"] = lengths_of(options.get("tool_length"))
    fields["start"] = joints_of(options.get("start"))
    return given(program=source.id, **fields)
