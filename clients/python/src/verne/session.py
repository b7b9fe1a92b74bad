"""Requests and retries, without input and output.

An operation is a generator. It yields a request and receives the response, or it yields a pause. The synchronous and
the asynchronous client run the same operations; only they send requests and wait.
"""

from __future__ import annotations

import email.utils
import json
import time
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, TypeAlias, TypeVar

import httpx
import numpy as np
from numpy.typing import NDArray

from verne.problem import Problem

R = TypeVar("R")

DEFAULT_URL = "http://127.0.0.1:8080"
DEFAULT_RETRIES = 4
TIMEOUT = 60.0
"""Seconds that the client waits for a connection and for each piece of an answer. The service's limit is 30 s."""
LONGEST_PAUSE = 120.0
"""A request is not repeated if the service asks for a longer pause than this, seconds."""


@dataclass(frozen=True, slots=True)
class Request:
    """An HTTP request."""

    method: str
    url: httpx.URL
    headers: Mapping[str, str]
    content: bytes | None = None


@dataclass(frozen=True, slots=True)
class Pause:
    """A wait of some seconds."""

    seconds: float


Numbers: TypeAlias = Sequence[float] | NDArray[Any]
"""A list of numbers."""

Operation: TypeAlias = Generator[Request | Pause, httpx.Response | None, R]
"""A computation that sends requests and waits. Its result has the type R."""


def given(**fields: Any) -> dict[str, Any]:
    """The fields that are not None."""
    return {name: value for name, value in fields.items() if value is not None}


def _number_or_list(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    raise TypeError(f"{value!r} is neither a number nor a list of numbers")


def to_json(value: Any) -> str:
    """JSON in which numpy's numbers and arrays are numbers and lists."""
    return json.dumps(value, default=_number_or_list, allow_nan=False)


class Session:
    """The address of a service and what every request to it has in common."""

    def __init__(self, url: str, api_key: str | None, retries: int) -> None:
        """Takes the service's address, the key, and how often a request is repeated at most."""
        self.base = httpx.URL(url.rstrip("/") + "/")
        self.retries = retries
        self._headers = {"User-Agent": f"verne-python/{version('verne')}"}
        if api_key is not None:
            self._headers["Authorization"] = f"Bearer {api_key}"

    def get(self, path: str, **params: Any) -> Request:
        """A GET request of a path below the service's address, or of a link from an answer."""
        return self._request("GET", path, params=params)

    def delete(self, path: str) -> Request:
        """A DELETE request."""
        return self._request("DELETE", path)

    def post(self, path: str, body: Any, *, prefer: str | None = None) -> Request:
        """A POST request with a JSON body."""
        headers = given(Prefer=prefer) | {"Content-Type": "application/json"}
        return self._request("POST", path, headers=headers, content=to_json(body).encode())

    def post_bytes(self, path: str, content: bytes, media_type: str, **params: Any) -> Request:
        """A POST request with a body of another media type."""
        return self._request("POST", path, params=params, headers={"Content-Type": media_type}, content=content)

    def _request(
        self,
        method: str,
        path: str,
        *,
        params: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
        content: bytes | None = None,
    ) -> Request:
        # A link begins with a slash and contains the path under which a proxy publishes the service.
        # It may have a query.
        url = self.base.join(path).copy_merge_params(_texts(params or {}))
        return Request(method, url, self._headers | dict(headers or {}), content)

    def send(self, request: Request) -> Operation[httpx.Response]:
        """Sends a request; repeats it after the pause that the service asks for in ``Retry-After``.

        Raises:
            Problem: The service refused the request.
        """
        attempts = 0
        while True:
            response = yield request
            assert response is not None
            if response.is_success:
                return response
            pause = _pause(response)
            if pause is None or attempts == self.retries:
                raise Problem.from_response(response)
            attempts += 1
            yield Pause(pause)


def _texts(params: Mapping[str, Any]) -> dict[str, str]:
    """Query parameters as text. A parameter that is None is left out; lists and objects become JSON."""
    return {name: value if isinstance(value, str) else to_json(value) for name, value in given(**params).items()}


def _pause(response: httpx.Response) -> float | None:
    """The seconds after which the request is worth a repetition, if it is."""
    stated = response.headers.get("retry-after")
    if response.status_code not in (429, 503) or stated is None:
        return None
    if stated.strip().isdigit():
        seconds = float(stated)
    else:
        try:
            seconds = email.utils.parsedate_to_datetime(stated).timestamp() - time.time()
        except ValueError:
            return None
    return max(seconds, 0.0) if seconds <= LONGEST_PAUSE else None
