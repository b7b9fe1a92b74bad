"""Jobs of the synchronous client."""

from __future__ import annotations

from typing import Generic, TypeVar

from verne.answers.error_budget import ErrorMapSummary
from verne.answers.fitting import OriginsSummary, Placement, Window
from verne.answers.toolpath import ToolpathReport
from verne.answers.workspace import DexteritySummary, FamilySummary, WorkspaceSummary
from verne.operations import joint_motion, meshes
from verne.operations.jobs import Progress, Submission
from verne.problem import Problem
from verne.runners import Blocking, blocking

T = TypeVar("T")


class JobView(Generic[T]):
    """The last known status of a job."""

    _subject: Submission[T]

    @property
    def id(self) -> str:
        """The id of the job and of its result. Equal requests have equal ids."""
        return self._subject.id

    @property
    def state(self) -> str:
        """``queued``, ``running``, ``succeeded``, ``failed`` or ``cancelled``, when the client last asked."""
        return self._subject.state

    @property
    def progress(self) -> float:
        """Fraction of the work that was done when the client last asked, 0 to 1."""
        return self._subject.progress

    @property
    def error(self) -> Problem | None:
        """The problem of a job that failed."""
        return self._subject.error

    def __repr__(self) -> str:
        """Type, id, state and progress."""
        return f"<{type(self).__name__} {self.id[:12]}: {self.state}, {self.progress:.0%}>"


class Job(JobView[T], Blocking[Submission[T]]):
    """A job with a result of type T."""

    def refresh(self) -> None:
        """Asks for the job's state and progress."""
        self._run(self._subject.refresh())

    def wait(self, *, timeout: float | None = None, progress: Progress = False) -> None:
        """Waits until the job has ended.

        Args:
            timeout: The most seconds to wait; None means no limit.
            progress: True for a bar (needs tqdm), or a function that is called with the fraction that is done.

        Raises:
            TimeoutError: The job has not ended within the time. It continues.
        """
        self._run(self._subject.wait(timeout, progress))

    def result(self, *, timeout: float | None = None, progress: Progress = False) -> T:
        """Waits as ``wait`` does, and returns the result.

        Raises:
            Problem: The job failed or was cancelled.
            TimeoutError: The job has not ended within the time. It continues.
        """
        return self._run(self._subject.result(timeout, progress))

    def cancel(self) -> None:
        """Cancels the job. If other API keys requested it too, it continues for them."""
        self._run(self._subject.cancel())


class WorkspaceJob(Job[WorkspaceSummary]):
    """A job that computes a workspace."""

    mesh = blocking(meshes.mesh)
    to_trimesh = blocking(meshes.trimesh)
    slice = blocking(meshes.slice_)
    drawing = blocking(meshes.drawing)


class FamilyJob(Job[FamilySummary]):
    """A job that computes a family of workspaces."""

    mesh = blocking(meshes.family_mesh)
    to_trimesh = blocking(meshes.family_trimesh)


class DexterityJob(Job[DexteritySummary]):
    """A job that computes a dexterity map."""

    mesh = blocking(meshes.dexterity_mesh)
    to_trimesh = blocking(meshes.dexterity_trimesh)
    cells = blocking(meshes.cells)


class ErrorMapJob(Job[ErrorMapSummary]):
    """A job that computes an error map."""

    mesh = blocking(meshes.error_mesh)
    to_trimesh = blocking(meshes.error_trimesh)
    cells = blocking(meshes.error_cells)


class ToolpathJob(Job[ToolpathReport]):
    """A job that computes the joint motion of a program. Its result is the report."""

    rows = blocking(joint_motion.rows)
    program = blocking(joint_motion.joint_program)
    path = blocking(joint_motion.path)


class WindowJob(Job[Window]):
    """A job that finds the values of a parameter with which the machine can run a program."""


class PlacementJob(Job[Placement]):
    """A job that finds the set-up in which a program keeps the greatest distance from the limits."""


class OriginsJob(Job[OriginsSummary]):
    """A job that computes the region of origins of a program."""

    mesh = blocking(meshes.origins_mesh)
    to_trimesh = blocking(meshes.origins_trimesh)
