"""The synchronous client."""

from __future__ import annotations

from types import TracebackType
from typing import Self

import httpx

from verne.job import (
    DexterityJob,
    ErrorMapJob,
    FamilyJob,
    OriginsJob,
    PlacementJob,
    ToolpathJob,
    WindowJob,
    WorkspaceJob,
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
from verne.runners import Blocking, blocking, blocking_job
from verne.session import DEFAULT_RETRIES, DEFAULT_URL, TIMEOUT, Session


class Client(Blocking[Session]):
    """A client of a verne service. Lengths are millimetres and angles degrees.

    Use it as a context manager, or close it at the end. Threads may share it.
    """

    def __init__(
        self,
        url: str = DEFAULT_URL,
        *,
        api_key: str | None = None,
        retries: int = DEFAULT_RETRIES,
        http: httpx.Client | None = None,
    ) -> None:
        """Connects at the first request.

        Args:
            url: Address of the service, with the path under which a proxy publishes it.
            api_key: API key, if the service asks for one.
            retries: How often a request is repeated at most. The client repeats a request that the service answers
                by 429 or 503 with ``Retry-After``, after this time.
            http: Client of httpx that sends the requests: for certificates, proxies and time limits of your own.
        """
        super().__init__(Session(url, api_key, retries), httpx.Client(timeout=TIMEOUT) if http is None else http)

    @property
    def url(self) -> str:
        """Address of the service."""
        return str(self._subject.base).removesuffix("/")

    def close(self) -> None:
        """Closes the connections."""
        self._http.close()

    def __enter__(self) -> Self:
        """Returns the client."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Closes the connections."""
        self.close()

    fk = blocking(kinematics.fk)
    ik = blocking(kinematics.ik)
    fk_batch = blocking(batches.fk_batch)
    ik_batch = blocking(batches.ik_batch)
    contains = blocking(batches.contains)
    error_budget = blocking(error_budgets.error_budget)
    atlas = blocking(atlases.atlas)
    atlas_drawing = blocking(atlases.atlas_drawing)
    workspace = blocking_job(workspaces.workspace, WorkspaceJob)
    family = blocking_job(workspaces.family, FamilyJob)
    dexterity = blocking_job(workspaces.dexterity, DexterityJob)
    error_map = blocking_job(error_budgets.error_map, ErrorMapJob)
    program = blocking(toolpaths.program)
    toolpath = blocking_job(toolpaths.toolpath, ToolpathJob)
    window = blocking_job(fitting.window, WindowJob)
    placement = blocking_job(fitting.placement, PlacementJob)
    origins = blocking_job(fitting.origins, OriginsJob)
    machines = blocking(publications.machines)
    machine = blocking(publications.machine)
    calibrate = blocking(calibration.calibrate)
