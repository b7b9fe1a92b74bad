"""Programs and tool paths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from verne.answers.machine import MachineId
from verne.answers.solution import Joints
from verne.answers.workspace import Bounds


@dataclass(frozen=True, slots=True)
class ProgramWarning:
    """A place where the reader did otherwise than the file may mean."""

    line: int
    word: str
    detail: str
    occurrences: int


@dataclass(frozen=True, slots=True)
class ProgramTool:
    """A tool of a program."""

    line: int
    """The line that loads it first."""
    number: int | None = None
    length: float | None = None
    """Length, mm; None if the program states none."""


@dataclass(frozen=True, slots=True)
class ProgramLinks:
    """Paths of a program."""

    self: str
    source: str


@dataclass(frozen=True, slots=True)
class ProgramSummary:
    """Summary of a program."""

    id: str
    format: str
    units: str
    bytes: int
    lines: int
    moves: int
    events: int
    tools: list[ProgramTool]
    bounds: Bounds
    """Box around the tip's path in the frame of the program, mm."""
    warnings: list[ProgramWarning]
    warning_count: int
    links: ProgramLinks


@dataclass(frozen=True, slots=True)
class FailurePlace:
    """The pose with the worst margin of a failure: mm and degrees, in the part frame."""

    line: int
    x: float
    y: float
    z: float
    phi1: float
    phi2: float
    tool_length: float
    joints: Joints | None = None
    """The joints, for ``fk``; None if the pose has none in the working mode."""


@dataclass(frozen=True, slots=True)
class DwellMark:
    """A place where the tool stands on the part while the table turns: mm and degrees."""

    line: int
    x: float
    y: float
    z: float
    angle: float
    duration: float | None = None
    """How long the turn takes, s; None if neither a feed nor drives determine it."""


@dataclass(frozen=True, slots=True)
class ToolpathChange:
    """The smallest change of one parameter that heals a failure."""

    parameter: str
    """``setup.x``, ``setup.y``, ``setup.z`` or ``tool_length``."""
    delta: float
    """Change of the parameter, mm."""


@dataclass(frozen=True, slots=True)
class ToolpathFailure:
    """Consecutive moves that break the same limit."""

    lines: tuple[int, int]
    """The first and the last line."""
    constraint: str
    element: str
    margin: float
    """The worst margin: negative, as much as is missing."""
    unit: str
    at: FailurePlace
    text: str | None = None
    """The first characters of the first line."""
    change: ToolpathChange | None = None


@dataclass(frozen=True, slots=True)
class ToolpathMargin:
    """The least margin of a constraint over the whole program."""

    constraint: str
    element: str
    margin: float
    unit: str
    line: int


@dataclass(frozen=True, slots=True)
class PathLengths:
    """Lengths of the tip's path, mm."""

    feed: float
    rapid: float


@dataclass(frozen=True, slots=True)
class GovernedTime:
    """Fractions of the time that the feed, each drive and the waits determine."""

    feed: float
    rho1: float
    rho2: float
    rho3: float
    theta1: float
    theta2: float
    wait: float


@dataclass(frozen=True, slots=True)
class ToolpathTime:
    """The duration of a program."""

    seconds: float
    """Sum of the known durations."""
    unknown_rows: int
    """Number of rows without a duration."""
    governed: GovernedTime | None = None


@dataclass(frozen=True, slots=True)
class JointRanges:
    """Least and greatest position of each joint, mm and degrees."""

    rho1: tuple[float, float]
    rho2: tuple[float, float]
    rho3: tuple[float, float]
    theta1: tuple[float, float]
    theta2: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Turning:
    """The angles through which the table turns in total, degrees."""

    theta1: float
    theta2: float


@dataclass(frozen=True, slots=True)
class Deviation:
    """Greatest deviation of the joint motion from the feed moves: mm, degrees."""

    tip: float
    axis: float


@dataclass(frozen=True, slots=True)
class RapidDeparture:
    """A rapid in which the joints move straight."""

    line: int
    distance: float | None = None
    """Greatest distance of the tool end from the line, mm; None if the platform passes a singularity."""
    direction: tuple[float, float, float] | None = None


@dataclass(frozen=True, slots=True)
class ToolpathLinks:
    """Paths of a tool path."""

    self: str
    rows: str
    path: str
    program: str | None = None
    """Path of the joint program; None if there is none."""


@dataclass(frozen=True, slots=True)
class ToolpathReport:
    """The report on a tool path."""

    id: str
    machine: MachineId
    program: str
    """The id of the program."""
    request: dict[str, Any]
    verdict: str
    """``ok`` if the machine can run the program, otherwise ``fails``."""
    failures: list[ToolpathFailure]
    failure_count: int
    rows: int
    """Number of rows of the joint motion."""
    length: PathLengths
    time: ToolpathTime
    margins: list[ToolpathMargin]
    turning: Turning
    deviation: Deviation
    preimage_changes: int
    retracts: int
    dwell_marks: list[DwellMark]
    dwell_mark_count: int
    departures: list[RapidDeparture]
    departure_count: int
    warnings: list[ProgramWarning]
    warning_count: int
    not_checked: list[str]
    links: ToolpathLinks
    ranges: JointRanges | None = None
    pole_distance: float | None = None
    """Least angle between the tool's axis and the table's own axis, degrees."""
