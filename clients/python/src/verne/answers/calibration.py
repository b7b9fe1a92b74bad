"""The parameters of a machine as measurements determine them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verne.answers.machine import Machine, MachineId


@dataclass(frozen=True, slots=True)
class ParameterEstimate:
    """A parameter as measurements determine it."""

    name: str
    unit: str
    """``mm`` or ``deg``."""
    start: float
    """Value at the start."""
    value: float
    """Value. A parameter that nothing determines stays as near to the start as it can."""
    identifiable: bool
    """Whether the measurements determine the parameter by themselves."""
    at_bound: bool
    """Whether a bound keeps it from a value that fits better."""
    sigma: float | None = None
    """Standard deviation of the value. None if neither the measurements nor a prior determine it, or at a bound."""


@dataclass(frozen=True, slots=True)
class DeviceFrame:
    """Place of a measuring device's frame: its origin in the base frame, mm, and rotations about x, then y, then z."""

    x: float
    y: float
    z: float
    a: float
    b: float
    c: float


@dataclass(frozen=True, slots=True)
class MeasurementOutlier:
    """A measurement that its error does not explain."""

    measurement: int
    """The measurement, from 0."""
    residual: float
    """Length of its residual, mm."""
    ratio: float
    """Greatest ratio of a number of the residual to its standard deviation."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """The parameters of a machine as measurements determine them.

    The model takes the rods of each leg as equal, guideways as straight and vertical, and joints as points. Standard
    deviations hold if the errors of the measurements are normal and independent, and the model is right.
    """

    machine: Machine
    """The machine, ready for requests. Its sliders are at what the control indicates plus ``slider_offsets``."""
    hash: str
    start: MachineId
    """The machine with which the search began."""
    slider_offsets: NDArray[np.float64]
    """What to add to the positions that the control indicates, for joints in requests with ``machine``, mm."""
    tool_length: float
    parameters: list[ParameterEstimate]
    """The parameters that were determined."""
    unknowns: int
    """Number of parameters and coordinates of the measuring device that were determined together."""
    rank: int
    """Number of independent combinations of them that the measurements determine."""
    singular_values: NDArray[np.float64]
    unidentifiable: list[dict[str, float]]
    """Combinations that the measurements do not determine: unknowns with the amounts by which they change together."""
    residuals: NDArray[np.float64]
    """Model less measured value, mm: a row of x, y, z or of one length for each measurement."""
    outliers: list[MeasurementOutlier]
    """Measurements that their errors do not explain, the worst first."""
    next: NDArray[np.float64]
    """Poses to measure next: rows rho1, rho2, rho3 in mm; with kind ``part`` also theta1, theta2 in degrees."""
    sigma: float | None = None
    """Standard deviation of a measured number, mm."""
    rms: float | None = None
    """Root of the mean square of all numbers of ``residuals``, mm. None without measured values."""
    frame: DeviceFrame | None = None
    """Only kind ``tracker`` has it."""
    centre: NDArray[np.float64] | None = None
    """Centre of the ball in the base frame, mm. Only kind ``ballbar`` has it."""
