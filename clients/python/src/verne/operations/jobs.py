"""Jobs: they are submitted, watched and cancelled, and their results are read."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from typing import Any, Generic, TypeAlias, TypeVar

import httpx

from verne.answers.job import JobStatus
from verne.decoding import decode
from verne.problem import Problem
from verne.session import Operation, Pause, Request, Session

T = TypeVar("T")

FIRST_PAUSE = 0.05
LONGEST_PAUSE = 1.0
"""Seconds between two looks at a job. The pauses grow, so that short jobs end soon and long ones are asked seldom."""
ENDED = ("succeeded", "failed", "cancelled")

Progress: TypeAlias = bool | Callable[[float], object]
"""True for a bar of tqdm, or a function that is called with the fraction of the work that is done."""


class Submission(Generic[T]):
    """A request for a result of type T that a job computes, and the last known status of this job."""

    def __init__(self, session: Session, request: Request, kind: type[T], answer: httpx.Response) -> None:
        """Takes the request that asks for the result, and its first answer."""
        self.session = session
        self.error: Problem | None = None
        self._request = request
        self._kind = kind
        self._accept(answer)

    def _accept(self, answer: httpx.Response) -> None:
        """Takes the answer to the request: the job, or the result."""
        if answer.status_code == httpx.codes.ACCEPTED:
            self._take(decode(JobStatus, answer.json()))
        else:
            self.id: str = answer.json()["id"]
            self.state, self.progress = "succeeded", 1.0
            self.path = f"jobs/{self.id}"

    def _take(self, status: JobStatus) -> None:
        self.id, self.state, self.progress = status.id, status.state, status.progress
        self.path = status.links.self
        self.error = None if status.error is None else Problem.from_document(status.error)

    def refresh(self) -> Operation[None]:
        """Reads the job's status. The request is sent again if the service has forgotten a job that had not ended."""
        if self.state in ENDED:
            return
        try:
            response = yield from self.session.send(self.session.get(self.path))
        except Problem as problem:
            if problem.code != "job_not_found":
                raise
            self._accept((yield from self.session.send(self._request)))
        else:
            self._take(decode(JobStatus, response.json()))

    def cancel(self) -> Operation[None]:
        """Cancels the job. A job that has ended stays as it is."""
        if self.state in ENDED:
            return
        response = yield from self.session.send(self.session.delete(self.path))
        self._take(decode(JobStatus, response.json()))

    def wait(self, timeout: float | None = None, progress: Progress = False) -> Operation[None]:
        """Waits until the job has ended.

        Raises:
            TimeoutError: The job has not ended within the time. It continues.
        """
        deadline = None if timeout is None else time.monotonic() + timeout
        pause = FIRST_PAUSE
        with _reporter(progress) as report:
            report(self.progress)
            while self.state not in ENDED:
                if deadline is not None:
                    pause = min(pause, deadline - time.monotonic())
                    if pause <= 0:
                        raise TimeoutError(f"job {self.id} has not ended within {timeout} s")
                yield Pause(pause)
                pause = min(pause * 1.5, LONGEST_PAUSE)
                yield from self.refresh()
                report(self.progress)

    def check(self) -> None:
        """Raises the problem of a job that failed or was cancelled."""
        if self.error is not None:
            raise self.error
        if self.state == "cancelled":
            raise Problem("job_cancelled", 409, "The job was cancelled.")

    def result(self, timeout: float | None = None, progress: Progress = False) -> Operation[T]:
        """Waits until the job has ended, and reads the result.

        Raises:
            Problem: The job failed or was cancelled.
            TimeoutError: The job has not ended within the time. It continues.
        """
        yield from self.wait(timeout, progress)
        self.check()
        # The same request again: it also computes a result that the service has removed meanwhile.
        response = yield from fetch(self.session, self._request)
        return decode(self._kind, response.json())


def submit(session: Session, path: str, body: dict[str, Any], kind: type[T]) -> Operation[Submission[T]]:
    """Asks for a result, without waiting for it."""
    request = session.post(path, body, prefer="respond-async")
    response = yield from session.send(request)
    return Submission(session, request, kind, response)


def fetch(session: Session, request: Request) -> Operation[httpx.Response]:
    """The answer to a request that the service may answer with a job first."""
    while True:
        response = yield from session.send(request)
        if response.status_code != httpx.codes.ACCEPTED:
            return response
        job: Submission[Any] = Submission(session, request, object, response)
        yield from job.wait()
        job.check()


@contextlib.contextmanager
def _reporter(progress: Progress) -> Iterator[Callable[[float], object]]:
    """The function that reports the fraction of the work that is done."""
    if callable(progress):
        yield progress
    elif progress:
        from tqdm.auto import tqdm

        with tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:
            yield lambda fraction: bar.update(100 * fraction - bar.n)
    else:
        yield lambda fraction: None
