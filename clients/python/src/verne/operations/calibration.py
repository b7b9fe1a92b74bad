"""Calibration: the parameters of a machine from measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NotRequired, TypeAlias, TypedDict

from verne.answers.calibration import Calibration
from verne.answers.machine import Machine
from verne.arrow_stream import MEDIA_TYPE, write_stream
from verne.decoding import decode
from verne.session import Numbers, Operation, Session, to_json
from verne.table import Rows, to_arrow

MeasurementKind = Literal["tips", "tracker", "part", "distances", "ballbar"]
Columns: TypeAlias = tuple[str, ...]

SLIDERS = ("rho1", "rho2", "rho3")
POINT = ("x", "y", "z")
COLUMNS: dict[MeasurementKind, tuple[Columns, Columns]] = {
    "tips": (SLIDERS, POINT),
    "tracker": (SLIDERS, POINT),
    "part": ((*SLIDERS, "theta1", "theta2"), POINT),
    "distances": ((*SLIDERS, "to_rho1", "to_rho2", "to_rho3"), ("distance",)),
    "ballbar": (SLIDERS, ("length",)),
}
"""The columns of each kind: those of a pose, and those of the measured value."""


class Prior(TypedDict):
    """A value of a parameter from another source: mm or degrees."""

    sigma: float
    """Standard deviation of the value."""
    value: NotRequired[float]
    """The value; by default that of the start."""


def calibrate(
    session: Session,
    measurements: Rows,
    kind: MeasurementKind = "tips",
    *,
    tool_length: float = 0.0,
    centre: Numbers | None = None,
    fixed: Sequence[str] = (),
    priors: Mapping[str, Prior] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    sigma: float | None = None,
    loss: Literal["squares", "huber"] = "squares",
    next_poses: int = 5,
    machine: str | Machine = "verne",
) -> Operation[Calibration]:
    """Determines the parameters of a machine from measurements, by least squares.

    Args:
        measurements: Columns rho1, rho2, rho3 that the control indicated, and those of the kind: an array, or a table
            of pandas, polars or Arrow, whose other columns do not matter. Without the columns of the measured value
            the answer says what the poses would identify.
        kind: ``tips``: x, y, z of the tool end in the base frame; ``tracker``: x, y, z of the tool end in the
            measuring device's own frame; ``part``: theta1, theta2, and x, y, z of the tool end in the part frame;
            ``distances``: to_rho1, to_rho2, to_rho3, and the distance between both tool ends; ``ballbar``: the length
            from a ball to the tool end.
        tool_length: Distance from P to the tool end with which the search begins, mm.
        centre: Centre of the ball in the base frame, mm, if it is known. Only kind ``ballbar`` has it.
        fixed: Names of parameters that keep their values, such as ``["tool_length", "R2"]``.
        priors: What is known of parameters from another source, by their names. They need ``sigma``.
        bounds: Least and greatest values of parameters, by their names, mm or degrees.
        sigma: Standard deviation of each measured number, mm. By default it follows from the residuals.
        loss: ``squares``, or ``huber``, with which gross errors hardly count.
        next_poses: Number of poses to propose for the next measurements.
        machine: The machine with which the search begins: name of a published machine, or a machine.

    Raises:
        ValueError: An array does not have these columns.
        Problem: The service refused a column or a row; ``no_fit``: no machine was found that fits.
    """
    of_pose, of_value = COLUMNS[kind]
    table = to_arrow(measurements, of_pose + of_value, of_pose)
    own = table.select([name for name in table.column_names if name in of_pose + of_value])
    options = {
        "kind": kind,
        "tool_length": tool_length,
        "centre": None if centre is None else ",".join(str(float(number)) for number in centre),
        "fixed": ",".join(fixed) or None,
        "priors": None if priors is None else to_json(dict(priors)),
        "bounds": None if bounds is None else to_json(dict(bounds)),
        "sigma": sigma,
        "loss": loss,
        "next": next_poses,
        "machine": machine if isinstance(machine, str) else to_json(machine),
    }
    request = session.post_bytes("machines/calibration", write_stream(own), MEDIA_TYPE, **options)
    response = yield from session.send(request)
    return decode(Calibration, response.json())
