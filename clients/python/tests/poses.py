"""Random poses that the reference machine reaches, for all tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TOOL_LENGTH = 60.0
"""The poses are feasible with this tool length, mm."""


def feasible_poses(count: int, seed: int) -> NDArray[np.float64]:
    """Rows x, y, z (mm), phi1, phi2 (degrees) in the part frame."""
    least = [-100, -100, 300, 2, -90]
    greatest = [100, 100, 420, 12, 90]
    return np.random.default_rng(seed).uniform(least, greatest, (count, 5))
