"""Error budgets of poses and of workspaces."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from verne.answers.machine import MachineId
from verne.answers.workspace import Bounds, PointGrid


@dataclass(frozen=True, slots=True)
class ParameterTolerance:
    """A parameter with its tolerance."""

    name: str
    unit: str
    """Unit of its numbers: ``mm`` or ``deg``."""
    nominal: float
    """Value in the machine; 0 for a parameter that a machine has no field for."""
    tolerance: float


@dataclass(frozen=True, slots=True)
class ErrorFigure:
    """An error, to the first order: mm, or degrees. Its lists have the order of ``parameters``."""

    rms: float
    """Root of the mean square of the error, for independent parameters whose standard deviations are the tolerances."""
    standard_deviations: tuple[float, float, float]
    """Along x, y and z of the frame; for the axis those of its unit vector, as angles."""
    worst: float
    """Greatest error with every parameter within its tolerance."""
    worst_changes: list[float]
    """Changes of the parameters with which ``worst`` is attained. The opposite changes are as bad."""
    contributions: list[float]
    """The error with one parameter alone off by its tolerance, for each."""
    worst_exact: float | None = None
    """The error with ``worst_changes`` in the exact model; None if no posture is near with them."""


@dataclass(frozen=True, slots=True)
class ErrorBudget:
    """The error budget of a pose."""

    tip: ErrorFigure
    """Displacement of the tool end, mm."""
    axis: ErrorFigure
    """Angle of the tool's axis, degrees."""


@dataclass(frozen=True, slots=True)
class Counts:
    """Number of rows with each status."""

    ok: int
    unreachable: int
    infeasible: int
    invalid: int


@dataclass(frozen=True, slots=True)
class RowError:
    """The reason why a row is invalid, for people."""

    row: int
    detail: str


@dataclass(frozen=True, slots=True)
class ErrorBudgetResult:
    """The error budgets of all poses. The lists have an entry for each row, except ``parameters`` and ``errors``."""

    machine: MachineId
    parameters: list[ParameterTolerance]
    """The parameters with a tolerance."""
    joints: list[list[float] | None]
    """``[rho1, rho2, rho3]``, in frame ``part`` with theta1 and theta2, mm and degrees; None without a solution."""
    budgets: list[ErrorBudget | None]
    """None for a row without a solution, and at a parallel singularity, where errors have no bound."""
    status: list[str]
    """``ok``, ``infeasible``, ``unreachable`` or ``invalid``."""
    margin: list[float | None]
    """Distance to the limit in ``constraint``: negative outside. None if the row is invalid."""
    constraint: list[str | None]
    """The nearest limit, or the broken one. None if the row is invalid."""
    element: list[str | None]
    """The part of the machine that the limit belongs to. None if the row is invalid."""
    counts: Counts
    not_checked: list[str]
    """Names of conditions that no margin covers."""
    errors: list[RowError] = field(default_factory=list)
    """Errors of the first hundred invalid rows."""


@dataclass(frozen=True, slots=True)
class ErrorRange:
    """The range of an error over a workspace: mm, or degrees."""

    least: float
    """The least error at the examined points: those of the grid and the vertices of the mesh."""
    largest: float
    """The largest error that was found. The true maximum is at least this."""
    at: tuple[float, float, float]
    """Where it is, mm."""


@dataclass(frozen=True, slots=True)
class ErrorRanges:
    """The range of each error over a workspace."""

    tip_rms: ErrorRange
    """Root mean square displacement of the tool end, mm."""
    tip_worst: ErrorRange
    """Greatest displacement of the tool end, mm."""
    axis_rms: ErrorRange
    """Root mean square angle of the tool's axis, degrees."""
    axis_worst: ErrorRange
    """Greatest angle of the tool's axis, degrees."""


@dataclass(frozen=True, slots=True)
class ErrorMapLinks:
    """Paths of an error map."""

    self: str
    mesh: str
    cells: str


@dataclass(frozen=True, slots=True)
class ErrorMapSummary:
    """Summary of an error map."""

    id: str
    machine: MachineId
    request: dict[str, Any]
    """The request with its defaults."""
    frame: str
    """Frame of the grid, the mesh and the errors: ``base`` or ``part``."""
    grid: PointGrid
    inside: int
    """Number of grid points inside the workspace."""
    triangles: int
    vertices: int
    unbounded: int
    """Vertices of the mesh at a parallel singularity, where errors have no bound."""
    not_checked: list[str]
    links: ErrorMapLinks
    errors: ErrorRanges | None = None
    """None if the workspace has no points."""
    bounds: Bounds | None = None
