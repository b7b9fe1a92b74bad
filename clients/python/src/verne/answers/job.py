"""The status of a job."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from verne.answers.machine import MachineId


@dataclass(frozen=True, slots=True)
class JobLinks:
    """Paths of a job."""

    self: str
    events: str


@dataclass(frozen=True, slots=True)
class JobStatus:
    """A job as the service describes it."""

    id: str
    kind: str
    state: str
    """``queued``, ``running``, ``succeeded``, ``failed`` or ``cancelled``."""
    progress: float
    """Fraction of the work that is done, 0 to 1."""
    request: dict[str, Any]
    machine: MachineId
    created: str
    links: JobLinks
    started: str | None = None
    finished: str | None = None
    result: str | None = None
    """Path of the result."""
    error: dict[str, Any] | None = None
    """Problem document of a job that failed."""
