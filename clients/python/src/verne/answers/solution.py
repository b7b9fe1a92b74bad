"""Solutions of the forward and the inverse problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from verne.answers.machine import MachineId


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit and the signed distance to it: positive inside, negative outside."""

    constraint: str
    value: float
    unit: str
    """``mm``, ``deg`` or ``1``."""
    element: str
    """The part of the machine, such as ``slider3.max``."""


@dataclass(frozen=True, slots=True)
class Joints:
    """Positions of the joints. The table's angles are None if the pose does not determine them."""

    rho: tuple[float, float, float]
    """The three sliders, mm."""
    theta1: float | None = None
    """Tilting angle of the table, degrees."""
    theta2: float | None = None
    """Rotary angle of the table, degrees."""

    def to_numpy(self) -> NDArray[np.float64]:
        """``[rho1, rho2, rho3, theta1, theta2]``, or the sliders alone if the table's angles are None."""
        table = () if self.theta1 is None or self.theta2 is None else (self.theta1, self.theta2)
        return np.array([*self.rho, *table])


@dataclass(frozen=True, slots=True)
class PlatformPose:
    """The platform's point P in the base frame, mm, and its inclination, degrees."""

    x: float
    y: float
    z: float
    alpha: float


@dataclass(frozen=True, slots=True)
class Point:
    """The tool end in the base frame, mm."""

    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class PartPose:
    """The tool end, mm, and the tool's orientation, degrees, in the part frame."""

    x: float
    y: float
    z: float
    phi1: float
    phi2: float
    axis: tuple[float, float, float]
    """Unit vector from the tool end to the holder."""

    def to_numpy(self) -> NDArray[np.float64]:
        """``[x, y, z, phi1, phi2]``."""
        return np.array([self.x, self.y, self.z, self.phi1, self.phi2])


@dataclass(frozen=True, slots=True)
class Mode:
    """Label of a solution."""

    leg1: str
    leg2: str
    leg3: str
    crossed: bool
    index: int


@dataclass(frozen=True, slots=True)
class Conditioning:
    """Distance from singularities."""

    det: float
    serial: list[float]
    condition_number: float | None = None


@dataclass(frozen=True, slots=True)
class Rate:
    """A rate with its unit, ``mm/s`` or ``rad/s``."""

    name: str
    unit: str


@dataclass(frozen=True, slots=True)
class GreatestSpeed:
    """The greatest speed in one direction, mm/s, and the joint whose drive limits it."""

    speed: float
    joint: str


@dataclass(frozen=True, slots=True)
class GreatestSpeeds:
    """Greatest speeds of the tool end along x, y and z of the part frame, while the rest stands still."""

    x: GreatestSpeed
    y: GreatestSpeed
    z: GreatestSpeed


@dataclass(frozen=True, slots=True)
class ErrorAmplification:
    """How far the tool end moves, µm, if a slider is off by 1 µm or an axis by 1 arcsecond."""

    rho1: float
    rho2: float
    rho3: float
    theta1: float
    theta2: float


@dataclass(frozen=True, slots=True)
class Jacobian:
    """From the rates of the joints to those of the tool in the part frame."""

    rows: list[Rate]
    columns: list[Rate]
    characteristic_length: float
    """Length by which lengths are divided before the singular values are computed, mm."""
    singularities: list[str]
    """Why ``condition_number`` is None: ``parallel_singularity``, ``pole`` or ``inverse_singularity``."""
    det_p: float
    matrix: list[list[float]] | None = None
    """None at a parallel singularity."""
    singular_values: list[float] | None = None
    condition_number: float | None = None
    greatest_speeds: GreatestSpeeds | None = None
    """Only a machine with drives has them; None at a singularity other than the pole."""
    error_amplification: ErrorAmplification | None = None

    def to_numpy(self) -> NDArray[np.float64]:
        """The matrix.

        Raises:
            ValueError: The posture is a parallel singularity and has no matrix.
        """
        if self.matrix is None:
            raise ValueError("a parallel singularity has no Jacobian")
        return np.array(self.matrix)


@dataclass(frozen=True, slots=True)
class Margins:
    """Signed distances to all limits: positive inside, negative outside; mm, degrees or a number without unit."""

    worst: Limit
    """The least margin as a fraction of its limit's own range."""
    stroke: list[list[float]]
    leg_length: list[float]
    serial_singularity: list[float]
    parallel_singularity: float
    slider_joint: list[float]
    platform_joint: list[float]
    rod_interference: float
    rod_crossing: float | None = None
    """None where R1 = r1 and the platform does not turn."""
    tilt: list[float] | None = None
    rotary: list[float] | None = None
    table_clearance: Limit | None = None


@dataclass(frozen=True, slots=True)
class SolutionBox:
    """Bounds of each coordinate, ``[low, high]``: the equations have exactly one solution within them."""

    x: list[float]
    """Of the platform, mm."""
    y: list[float]
    z: list[float]
    alpha: list[float]
    """Degrees. A bound may exceed 180."""
    rho: list[list[float]] | None = None
    """The sliders. Only the inverse problem has them."""


@dataclass(frozen=True, slots=True)
class Certificate:
    """The proof of a solution."""

    proved: bool
    box: SolutionBox | None = None
    """Only of a proved solution."""
    reason: str | None = None
    """Why it is not proved: ``merged`` or ``near_singularity``."""


@dataclass(frozen=True, slots=True)
class Completeness:
    """Whether it is proved that there are no other solutions."""

    complete: bool
    reason: str | None = None
    """Why it is not proved: ``unproved_solution``, ``undecided``, ``undecided_mode``, ``self_motion`` or
    ``free_phi2``."""


@dataclass(frozen=True, slots=True)
class Solution:
    """A posture that satisfies the equations."""

    platform: PlatformPose
    tool: Point
    mode: Mode
    working: bool
    """Whether the solution is in the working mode."""
    feasible: bool
    """Whether no margin is negative."""
    merged: bool
    residual: float
    """Largest error of a rod's length, mm, when the service puts the solution back into the equations."""
    margins: Margins
    conditioning: Conditioning
    jacobian: Jacobian | None = None
    """Only with ``jacobian=True``."""
    certificate: Certificate | None = None
    """Only with ``certified=True``."""
    joints: Joints | None = None
    part: PartPose | None = None
    windings: int | None = None
    """Number of values theta2 + 360 n that the rotary range admits."""


@dataclass(frozen=True, slots=True)
class ForwardResult:
    """Solutions of the forward problem."""

    machine: MachineId
    solutions: list[Solution]
    not_checked: list[str]
    """Names of conditions that no margin covers."""
    reason: str | None = None
    """The reason why there is no solution: ``unreachable``, ``infeasible`` or ``self_motion``."""
    constraint: Limit | None = None
    """The limit that prevents a solution."""
    completeness: Completeness | None = None
    """Only with ``certified=True``."""


@dataclass(frozen=True, slots=True)
class InverseResult:
    """Solutions of the inverse problem."""

    machine: MachineId
    solutions: list[Solution]
    not_checked: list[str]
    """Names of conditions that no margin covers."""
    reason: str | None = None
    """The reason why there is no solution: ``unreachable``, ``infeasible`` or ``self_motion``."""
    constraint: Limit | None = None
    """The limit that prevents a solution."""
    completeness: Completeness | None = None
    """Only with ``certified=True``."""
    free: list[str] | None = None
    """``["phi2"]`` if the tool is parallel to the table's own axis."""
