"""Where the machine stands before the first row of a batch or the first move of a program."""

from __future__ import annotations

from typing import Any, TypeAlias

from verne.answers.solution import Joints
from verne.session import Numbers

Start: TypeAlias = Joints | Numbers
"""The joints of an answer, or rho1, rho2, rho3 in mm and theta1, theta2 in degrees."""


def joints_of(start: Start | None) -> dict[str, Any] | None:
    """The joints as the service reads them.

    Raises:
        ValueError: There are not five joints.
    """
    if start is None:
        return None
    values = [float(value) for value in (start.to_numpy() if isinstance(start, Joints) else start)]
    if len(values) != 5:
        raise ValueError(f"start needs rho1, rho2, rho3, theta1 and theta2, not {len(values)} numbers")
    return {"rho": values[:3], "theta1": values[3], "theta2": values[4]}
