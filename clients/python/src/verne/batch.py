"""Answers to batches: columns with an entry for each row of the request."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from verne.table import Table

JOINTS = ("rho1", "rho2", "rho3", "theta1", "theta2")


class Batch(Table):
    """Solutions of the working mode."""

    @property
    def status(self) -> NDArray[np.object_]:
        """``ok``, ``infeasible``, ``unreachable`` or ``invalid`` for each row."""
        return self["status"]

    @property
    def ok(self) -> NDArray[np.bool_]:
        """True where the row is solved within every limit."""
        return cast("NDArray[np.bool_]", self.status == "ok")

    @property
    def margin(self) -> NDArray[np.float64]:
        """Distance to the limit in ``constraint``: negative outside. NaN if the row is invalid."""
        return self["margin"]

    @property
    def constraint(self) -> NDArray[np.object_]:
        """The nearest limit, or the broken one. None if the row is invalid."""
        return self["constraint"]

    @property
    def element(self) -> NDArray[np.object_]:
        """The part of the machine that the limit belongs to. None if the row is invalid."""
        return self["element"]

    @property
    def detail(self) -> NDArray[np.object_]:
        """The reason why a row is invalid, for people. None for other rows."""
        return self["detail"]

    @property
    def condition_number(self) -> NDArray[np.float64]:
        """Condition number of the Jacobian. NaN without a solution and at a singularity.

        Raises:
            KeyError: The batch was asked for without ``jacobian``.
        """
        return self["condition_number"]

    @property
    def jacobian(self) -> NDArray[np.float64]:
        """A matrix of five rows and columns for each row: see ``Jacobian``. NaN without a solution.

        Raises:
            KeyError: The batch was asked for without ``jacobian="matrix"``.
        """
        entries = (f"j{row}{column}" for row in range(1, 6) for column in range(1, 6))
        return self.to_numpy(*entries).reshape(-1, 5, 5)


class JointBatch(Batch):
    """Solutions of the inverse problem."""

    @property
    def joints(self) -> NDArray[np.float64]:
        """A row ``[rho1, rho2, rho3, theta1, theta2]`` for each row, mm and degrees. NaN without a solution.

        Other frames than ``part`` do not determine the table: a row is then ``[rho1, rho2, rho3]``.
        """
        return self.to_numpy(*(name for name in JOINTS if name in self.columns))

    @property
    def jump(self) -> NDArray[Any]:
        """True where a row does not continue from the row before. Only batches with ``continuous`` have it."""
        return self["jump"]


class PoseBatch(Batch):
    """Solutions of the forward problem."""

    @property
    def platform(self) -> NDArray[np.float64]:
        """A row ``[x, y, z, alpha]`` of the platform in the base frame for each row, mm and degrees."""
        return self.to_numpy("platform_x", "platform_y", "platform_z", "alpha")

    @property
    def part(self) -> NDArray[np.float64]:
        """A row ``[x, y, z, phi1, phi2]`` of the tool in the part frame for each row, mm and degrees.

        Raises:
            KeyError: The joints had no theta1 and theta2.
        """
        return self.to_numpy("x", "y", "z", "phi1", "phi2")


class Membership(Table):
    """Whether points are inside a workspace."""

    @property
    def inside(self) -> NDArray[np.bool_]:
        """True where the point is inside. It is False where the point is outside or invalid."""
        return cast("NDArray[np.bool_]", np.equal(self["inside"], True))

    @property
    def margin(self) -> NDArray[np.float64]:
        """Distance to the limit in ``constraint``: negative outside. NaN if the point is invalid."""
        return self["margin"]

    @property
    def unit(self) -> NDArray[np.object_]:
        """Unit of the margin: ``mm``, ``deg`` or ``1``."""
        return self["unit"]

    @property
    def constraint(self) -> NDArray[np.object_]:
        """The nearest limit, or the broken one. None if the point is invalid."""
        return self["constraint"]
