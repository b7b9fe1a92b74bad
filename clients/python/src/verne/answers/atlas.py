"""Atlases of solutions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verne.answers.machine import MachineId


@dataclass(frozen=True, slots=True)
class AtlasWindow:
    """The part of the plane: least and greatest u and v, mm."""

    u: tuple[float, float]
    v: tuple[float, float]


@dataclass(frozen=True, slots=True)
class AtlasCurve:
    """A curve on which solutions merge."""

    kind: str
    """``leg_1``, ``leg_2``, ``leg_3``, ``parallel`` or ``constraint``."""
    closed: bool
    """Whether the last point joins the first."""
    points: NDArray[np.float64]
    """Points (u, v) on the true curve, one in each row, mm."""


@dataclass(frozen=True, slots=True)
class AtlasPoint:
    """A point at which a curve is special."""

    kind: str
    """``cusp``, ``crossing``, ``corner``, ``tangency``, ``isolated`` or ``self_motion``."""
    at: tuple[float, float]
    """(u, v), mm."""


@dataclass(frozen=True, slots=True)
class AtlasFace:
    """A polygon with holes."""

    area: float
    """Area within the true curves, mm²."""
    area_error: float
    """An estimate of the area's error, mm²."""
    label: tuple[float, float]
    """A point inside, far from the sides."""
    outer: NDArray[np.float64]
    """Corners (u, v), one in each row, counter-clockwise, mm."""
    holes: list[NDArray[np.float64]]


@dataclass(frozen=True, slots=True)
class AtlasRegion(AtlasFace):
    """A region in which the number of solutions is constant."""

    solutions: int


@dataclass(frozen=True, slots=True)
class AtlasWorkingDomain:
    """The part of the window with a solution in the working mode."""

    area: float
    """mm²."""
    regions: list[AtlasFace]


@dataclass(frozen=True, slots=True)
class Atlas:
    """A plane divided into regions with equal numbers of solutions, and the curves between them."""

    space: str
    """``platform`` or ``joints``."""
    machine: MachineId
    coordinates: list[str]
    """The meanings of u and v."""
    window: AtlasWindow
    tolerance: float
    """Greatest distance of a line from the true curve, mm."""
    curves: list[AtlasCurve]
    points: list[AtlasPoint]
    regions: list[AtlasRegion]
    """Together they are the window."""
    working: AtlasWorkingDomain
    checked_points: int
    """Number of points at which the service compared the number of solutions with its own solutions."""
