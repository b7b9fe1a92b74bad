"""Placements of programs, and regions of origins."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from verne.answers.machine import MachineId
from verne.answers.toolpath import ToolpathMargin
from verne.answers.workspace import Bounds, PointGrid


@dataclass(frozen=True, slots=True)
class FrameSetup:
    """A program's frame in the part frame: an origin, mm, and rotations about x, then y, then z, degrees."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    a: float = 0.0
    b: float = 0.0
    c: float = 0.0


@dataclass(frozen=True, slots=True)
class GivenSetup:
    """The own set-up of the request."""

    verdict: str
    within_bounds: bool
    t: float | None = None


@dataclass(frozen=True, slots=True)
class PlacementGuarantee:
    """How sure it is that no other set-up within the bounds is better."""

    kind: str
    """``best_of_starts``: the best that searches from many set-ups found."""
    starts: int
    """Number of searches."""


@dataclass(frozen=True, slots=True)
class ActiveMargin:
    """A margin that limits the placement."""

    line: int
    constraint: str
    element: str
    margin: float
    unit: str
    reserve: float | None = None
    """The reserve of the constraint; None if the margin is only to be at least zero."""


@dataclass(frozen=True, slots=True)
class WindowEnd:
    """The end of an interval of a window."""

    kind: str
    """``limit``: the limit that breaks first outside; ``bound``: the range of the request."""
    constraint: str | None = None
    element: str | None = None
    line: int | None = None


@dataclass(frozen=True, slots=True)
class WindowInterval:
    """An interval of values. The verdict of a tool path is ``ok`` with both of its ends."""

    from_: float
    """The least value."""
    to: float
    """The greatest value."""
    ends: tuple[WindowEnd, WindowEnd]
    step: float
    """Greatest distance of two values, one after the other, with which the whole program was planned."""


@dataclass(frozen=True, slots=True)
class NearestToWindow:
    """The examined value that comes nearest to a window."""

    value: float
    margin: ToolpathMargin | None = None


@dataclass(frozen=True, slots=True)
class WindowLinks:
    """Paths of a window."""

    self: str


@dataclass(frozen=True, slots=True)
class Window:
    """The values of a parameter with which the machine can run a program."""

    id: str
    machine: MachineId
    program: str
    request: dict[str, Any]
    unit: str
    """``mm`` or ``deg``."""
    intervals: list[WindowInterval]
    precision: float
    """Greatest distance between an end and the nearest value with which the machine cannot run the program."""
    resolution: float
    """Width of the intervals, and of the gaps between them, that the search may have missed."""
    plans: int
    not_checked: list[str]
    links: WindowLinks
    nearest: NearestToWindow | None = None
    """Only a window without an interval has it."""


@dataclass(frozen=True, slots=True)
class PlacementLinks:
    """Paths of a placement."""

    self: str


@dataclass(frozen=True, slots=True)
class Placement:
    """The set-up with the greatest reserve."""

    id: str
    machine: MachineId
    program: str
    request: dict[str, Any]
    verdict: str
    """``ok`` if the machine can run the program in this set-up, otherwise ``fails``."""
    setup: FrameSetup
    given: GivenSetup
    guarantee: PlacementGuarantee
    active: list[ActiveMargin]
    margins: list[ToolpathMargin]
    """The least margin of each constraint."""
    rows: int
    not_checked: list[str]
    links: PlacementLinks
    t: float | None = None
    """Least ratio of a margin to its reserve; None if the machine does not reach all of the program."""
    tool_length: float | None = None


@dataclass(frozen=True, slots=True)
class OriginsLinks:
    """Paths of a region of origins."""

    self: str
    mesh: str
    slice: str


@dataclass(frozen=True, slots=True)
class OriginsSummary:
    """Summary of a region of origins."""

    id: str
    machine: MachineId
    program: str
    request: dict[str, Any]
    volume: float
    """mm³."""
    volume_error: float
    """By how much the volume differs at most, if the mesh is within ``boundary_error`` of the boundary, mm³."""
    vertices: int
    triangles: int
    grid: PointGrid
    places: int
    """Number of places of the program."""
    limiting_places: int
    """Number of the places that limit the region."""
    place_tolerance: float
    boundary_error: float
    """Greatest distance between the mesh and the boundary of the region, as measured at ``samples`` origins, mm."""
    samples: int
    not_checked: list[str]
    links: OriginsLinks
    bounds: Bounds | None = None
