"""Workspaces, families of workspaces, dexterity maps and slices."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verne.answers.machine import MachineId


@dataclass(frozen=True, slots=True)
class Bounds:
    """Least and greatest coordinates, mm."""

    min: tuple[float, float, float]
    max: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class WorkspaceLinks:
    """Paths of a workspace."""

    self: str
    mesh: str


@dataclass(frozen=True, slots=True)
class WorkspaceSummary:
    """Summary of a workspace."""

    id: str
    kind: str
    frame: str
    """Frame of the bounds, the mesh and the slices: ``base`` or ``part``."""
    machine: MachineId
    request: dict[str, Any]
    """The request with its defaults."""
    area: float
    """Area of the plane domain of the platform positions, mm²."""
    area_error: float
    folded: bool
    """Whether two platform positions reach the same position of the workspace."""
    triangles: int
    vertices: int
    not_checked: list[str]
    links: WorkspaceLinks
    volume: float | None = None
    """Volume, mm³; None if the workspace folds."""
    volume_error: float | None = None
    """The true volume lies within volume ± this, mm³."""
    bounds: Bounds | None = None
    explanation: str | None = None
    """The reason why there is no volume or no mesh."""


@dataclass(frozen=True, slots=True)
class FamilyMember:
    """A workspace of a family. The figures are None if its computation failed; ``failure`` says why."""

    id: str
    request: dict[str, Any]
    failure: str | None = None
    area: float | None = None
    folded: bool | None = None
    triangles: int | None = None
    vertices: int | None = None
    volume: float | None = None
    volume_error: float | None = None
    bounds: Bounds | None = None


@dataclass(frozen=True, slots=True)
class FamilySummary:
    """Summary of a family of workspaces."""

    id: str
    machine: MachineId
    request: dict[str, Any]
    members: list[FamilyMember]
    not_checked: list[str]


@dataclass(frozen=True, slots=True)
class PointGrid:
    """The grid of a dexterity map, or of a region of origins."""

    origin: tuple[float, float, float]
    """First point, mm."""
    counts: tuple[int, int, int]
    step: float
    """Distance between neighbouring points, mm."""
    turn: float
    """Angle from the part frame's X axis to the grid's first axis, degrees."""


@dataclass(frozen=True, slots=True)
class PointSetFigures:
    """Figures of the points that some, or all, inclinations reach."""

    triangles: int
    vertices: int
    volume: float | None = None
    """Volume, mm³."""
    volume_error: float | None = None
    bounds: Bounds | None = None


@dataclass(frozen=True, slots=True)
class DexterityLinks:
    """Paths of a dexterity map."""

    self: str
    cells: str
    reachable: str
    dexterous: str


@dataclass(frozen=True, slots=True)
class DexteritySummary:
    """Summary of a dexterity map."""

    id: str
    machine: MachineId
    request: dict[str, Any]
    grid: PointGrid
    reached: int
    """Number of points of the grid that some inclination reaches."""
    reachable: PointSetFigures
    dexterous: PointSetFigures
    not_checked: list[str]
    links: DexterityLinks


@dataclass(frozen=True, slots=True)
class Polygon:
    """A polygon with holes, mm."""

    area: float
    outer: NDArray[np.float64]
    """Corners (x, y), one in each row."""
    holes: list[NDArray[np.float64]]


@dataclass(frozen=True, slots=True)
class AlphaLine:
    """A line of constant inclination of the platform within a slice."""

    alpha: float
    """Degrees."""
    points: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Slice:
    """The cut of a workspace with a plane of constant z."""

    id: str
    z: float
    frame: str
    area: float
    """mm²."""
    tolerance: float
    polygons: list[Polygon]
    not_checked: list[str]
    contours: list[AlphaLine] = field(default_factory=list)
