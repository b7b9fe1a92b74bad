"""Jobs of the asynchronous client."""

from __future__ import annotations

from typing import TypeVar

from verne.answers.error_budget import ErrorMapSummary
from verne.answers.fitting import OriginsSummary, Placement, Window
from verne.answers.toolpath import ToolpathReport
from verne.answers.workspace import DexteritySummary, FamilySummary, WorkspaceSummary
from verne.job import JobView
from verne.operations import joint_motion, meshes
from verne.operations.jobs import Progress, Submission
from verne.runners import Awaiting, awaiting

T = TypeVar("T")


class AsyncJob(JobView[T], Awaiting[Submission[T]]):
    """A job with a result of type T."""

    async def refresh(self) -> None:
        """Asks for the job's state and progress."""
        await self._run(self._subject.refresh())

    async def wait(self, *, timeout: float | None = None, progress: Progress = False) -> None:
        """Waits until the job has ended. See ``Job.wait``."""
        await self._run(self._subject.wait(timeout, progress))

    async def result(self, *, timeout: float | None = None, progress: Progress = False) -> T:
        """Waits as ``wait`` does, and returns the result. See ``Job.result``."""
        return await self._run(self._subject.result(timeout, progress))

    async def cancel(self) -> None:
        """Cancels the job. If other API keys requested it too, it continues for them."""
        await self._run(self._subject.cancel())


class AsyncWorkspaceJob(AsyncJob[WorkspaceSummary]):
    """A job that computes a workspace."""

    mesh = awaiting(meshes.mesh)
    to_trimesh = awaiting(meshes.trimesh)
    slice = awaiting(meshes.slice_)
    drawing = awaiting(meshes.drawing)


class AsyncFamilyJob(AsyncJob[FamilySummary]):
    """A job that computes a family of workspaces."""

    mesh = awaiting(meshes.family_mesh)
    to_trimesh = awaiting(meshes.family_trimesh)


class AsyncDexterityJob(AsyncJob[DexteritySummary]):
    """A job that computes a dexterity map."""

    mesh = awaiting(meshes.dexterity_mesh)
    to_trimesh = awaiting(meshes.dexterity_trimesh)
    cells = awaiting(meshes.cells)


class AsyncErrorMapJob(AsyncJob[ErrorMapSummary]):
    """A job that computes an error map."""

    mesh = awaiting(meshes.error_mesh)
    to_trimesh = awaiting(meshes.error_trimesh)
    cells = awaiting(meshes.error_cells)


class AsyncToolpathJob(AsyncJob[ToolpathReport]):
    """A job that computes the joint motion of a program. Its result is the report."""

    rows = awaiting(joint_motion.rows)
    program = awaiting(joint_motion.joint_program)
    path = awaiting(joint_motion.path)


class AsyncWindowJob(AsyncJob[Window]):
    """A job that finds the values of a parameter with which the machine can run a program."""


class AsyncPlacementJob(AsyncJob[Placement]):
    """A job that finds the set-up in which a program keeps the greatest distance from the limits."""


class AsyncOriginsJob(AsyncJob[OriginsSummary]):
    """A job that computes the region of origins of a program."""

    mesh = awaiting(meshes.origins_mesh)
    to_trimesh = awaiting(meshes.origins_trimesh)
