"""Machines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NotRequired, TypedDict


class Geometry(TypedDict):
    """Dimensions of the parallel module: lengths in mm."""

    D1: float
    d1: float
    D2: float
    d2: float
    R1: float
    r1: float
    R2: float
    r4: float
    L1: float
    L2: float
    L3: float
    parallelogram_half_width: float
    parallelogram_direction: NotRequired[float]
    """Direction of leg II's parallelogram, degrees; 0 unless R1 = r1."""
    rod_radius: float


class Table(TypedDict):
    """Place of the table, mm."""

    da: float
    dt: float


class Limits(TypedDict):
    """Limits of a machine: strokes and clearances in mm, cones and table angles in degrees."""

    stroke: list[list[float]]
    slider_cone: float
    platform_cone: float
    serial_margin: float
    parallel_margin: float
    tilt: list[float]
    rotary: list[float] | None
    """Range of the rotary axis; None: it turns without a limit."""
    slider_axes: NotRequired[list[list[float]] | None]
    platform_axes: NotRequired[list[list[float]] | None]
    table_clearance: NotRequired[float | None]


class Drive(TypedDict):
    """Greatest velocity and acceleration of a joint: mm or degrees, and seconds."""

    velocity: float
    acceleration: NotRequired[float | None]


class Drives(TypedDict):
    """The drives of a machine."""

    slider: Drive
    tilt: Drive
    rotary: Drive


class Machine(TypedDict):
    """A machine as JSON. ``GET /machines/schema`` describes each field."""

    name: str
    geometry: Geometry
    table: Table
    limits: Limits
    description: NotRequired[str]
    drives: NotRequired[Drives | None]


@dataclass(frozen=True, slots=True)
class MachineId:
    """Identity of a machine."""

    name: str
    hash: str
    """Hash of the machine's dimensions, table and limits."""


@dataclass(frozen=True, slots=True)
class MachineEntry:
    """A published machine."""

    name: str
    hash: str
    description: str
