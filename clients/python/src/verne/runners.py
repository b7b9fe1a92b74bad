"""Runs operations on the calling thread or on asyncio's event loop, and makes methods of them."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import inspect
import time
from collections.abc import Callable, Coroutine
from typing import Any, Concatenate, Generic, ParamSpec, TypeVar

import httpx

from verne.session import Operation, Pause, Request

P = ParamSpec("P")
R = TypeVar("R")
C = TypeVar("C")
"""The subject of an operation: a session or a job."""
M = TypeVar("M")
J = TypeVar("J")


def _arguments(request: Request) -> dict[str, Any]:
    """The arguments of httpx's function ``request``."""
    return {
        "method": request.method,
        "url": request.url,
        "headers": request.headers,
        "content": request.content,
    }


class Blocking(Generic[C]):
    """Something whose operations run on the calling thread."""

    def __init__(self, subject: C, http: httpx.Client) -> None:
        """Takes the subject of the operations, and the client that sends their requests."""
        self._subject = subject
        self._http = http

    def _run(self, operation: Operation[R]) -> R:
        response = None
        with contextlib.closing(operation):
            while True:
                try:
                    step = operation.send(response)
                except StopIteration as end:
                    result: R = end.value
                    return result
                if isinstance(step, Pause):
                    time.sleep(step.seconds)
                    response = None
                else:
                    response = self._http.request(**_arguments(step))


class Awaiting(Generic[C]):
    """Something whose operations run on asyncio's event loop."""

    def __init__(self, subject: C, http: httpx.AsyncClient) -> None:
        """Takes the subject of the operations, and the client that sends their requests."""
        self._subject = subject
        self._http = http

    async def _run(self, operation: Operation[R]) -> R:
        response = None
        with contextlib.closing(operation):
            while True:
                try:
                    step = operation.send(response)
                except StopIteration as end:
                    result: R = end.value
                    return result
                if isinstance(step, Pause):
                    await asyncio.sleep(step.seconds)
                    response = None
                else:
                    response = await self._http.request(**_arguments(step))


def _describe(method: Any, operation: Callable[..., Any], result: Callable[..., Any] | None = None) -> None:
    """Gives a method the documentation of its operation, and the type of its own result."""
    functools.update_wrapper(method, operation)
    signature = inspect.signature(operation)
    returns = str(signature.return_annotation).removeprefix("Operation[").removesuffix("]")
    method.__signature__ = signature.replace(return_annotation=returns if result is None else result)


def blocking(operation: Callable[Concatenate[C, P], Operation[R]]) -> Callable[Concatenate[Blocking[C], P], R]:
    """The method that runs an operation on the calling thread."""

    def method(self: Blocking[C], /, *args: P.args, **kwargs: P.kwargs) -> R:
        return self._run(operation(self._subject, *args, **kwargs))

    _describe(method, operation)
    return method


def awaiting(
    operation: Callable[Concatenate[C, P], Operation[R]],
) -> Callable[Concatenate[Awaiting[C], P], Coroutine[Any, Any, R]]:
    """The method that runs an operation on asyncio's event loop."""

    async def method(self: Awaiting[C], /, *args: P.args, **kwargs: P.kwargs) -> R:
        return await self._run(operation(self._subject, *args, **kwargs))

    _describe(method, operation)
    return method


def blocking_job(
    operation: Callable[Concatenate[C, P], Operation[M]], job: Callable[[M, httpx.Client], J]
) -> Callable[Concatenate[Blocking[C], P], J]:
    """The method that runs an operation on the calling thread and makes a job of its result."""

    def method(self: Blocking[C], /, *args: P.args, **kwargs: P.kwargs) -> J:
        return job(self._run(operation(self._subject, *args, **kwargs)), self._http)

    _describe(method, operation, job)
    return method


def awaiting_job(
    operation: Callable[Concatenate[C, P], Operation[M]], job: Callable[[M, httpx.AsyncClient], J]
) -> Callable[Concatenate[Awaiting[C], P], Coroutine[Any, Any, J]]:
    """The method that runs an operation on asyncio's event loop and makes a job of its result."""

    async def method(self: Awaiting[C], /, *args: P.args, **kwargs: P.kwargs) -> J:
        return job(await self._run(operation(self._subject, *args, **kwargs)), self._http)

    _describe(method, operation, job)
    return method
