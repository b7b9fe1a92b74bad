"""The asynchronous client."""

from __future__ import annotations

from types import TracebackType
from typing import Self

import httpx

from verne.async_job import (
    AsyncDexterityJob,
    AsyncErrorMapJob,
    AsyncFamilyJob,
    AsyncOriginsJob,
    AsyncPlacementJob,
    AsyncToolpathJob,
    AsyncWindowJob,
    AsyncWorkspaceJob,
)
from verne.operations import (
    atlases,
    batches,
    calibration,
    error_budgets,
    fitting,
    kinematics,
    publications,
    toolpaths,
    workspaces,
)
from verne.runners import Awaiting, awaiting, awaiting_job
from verne.session import DEFAULT_RETRIES, DEFAULT_URL, TIMEOUT, Session


class AsyncClient(Awaiting[Session]):
    """A client of a verne service for asyncio, with the operations of ``Client``.

    Use it as an asynchronous context manager, or close it at the end.
    """

    def __init__(
        self,
        url: str = DEFAULT_URL,
        *,
        api_key: str | None = None,
        retries: int = DEFAULT_RETRIES,
        http: httpx.AsyncClient | None = None,
    ) -> None:
        """Connects at the first request. The arguments are those of ``Client``."""
        super().__init__(Session(url, api_key, retries), httpx.AsyncClient(timeout=TIMEOUT) if http is None else http)

    @property
    def url(self) -> str:
        """Address of the service."""
        return str(self._subject.base).removesuffix("/")

    async def aclose(self) -> None:
        """Closes the connections."""
        await self._http.aclose()

    async def __aenter__(self) -> Self:
        """Returns the client."""
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Closes the connections."""
        await self.aclose()

    fk = awaiting(kinematics.fk)
    ik = awaiting(kinematics.ik)
    fk_batch = awaiting(batches.fk_batch)
    ik_batch = awaiting(batches.ik_batch)
    contains = awaiting(batches.contains)
    error_budget = awaiting(error_budgets.error_budget)
    atlas = awaiting(atlases.atlas)
    atlas_drawing = awaiting(atlases.atlas_drawing)
    workspace = awaiting_job(workspaces.workspace, AsyncWorkspaceJob)
    family = awaiting_job(workspaces.family, AsyncFamilyJob)
    dexterity = awaiting_job(workspaces.dexterity, AsyncDexterityJob)
    error_map = awaiting_job(error_budgets.error_map, AsyncErrorMapJob)
    program = awaiting(toolpaths.program)
    toolpath = awaiting_job(toolpaths.toolpath, AsyncToolpathJob)
    window = awaiting_job(fitting.window, AsyncWindowJob)
    placement = awaiting_job(fitting.placement, AsyncPlacementJob)
    origins = awaiting_job(fitting.origins, AsyncOriginsJob)
    machines = awaiting(publications.machines)
    machine = awaiting(publications.machine)
    calibrate = awaiting(calibration.calibrate)
