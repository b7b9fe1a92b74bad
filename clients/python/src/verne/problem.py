"""Problem documents (RFC 9457) as exceptions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from verne.decoding import decode

if TYPE_CHECKING:
    import httpx


@dataclass(frozen=True, slots=True)
class ProblemError:
    """One entry of the list of errors: a bad field of the request, or a fault of a program."""

    detail: str
    """The requirement that is not met."""
    pointer: str | None = None
    """JSON Pointer into the body of the request, such as ``/pose/x``, or ``/query/`` and a parameter's name."""
    line: int | None = None
    """Line of the program, from 1."""
    column: int | None = None
    """Column of the line, from 1."""
    word: str | None = None
    """The word of the program that is wrong."""

    def __str__(self) -> str:
        """The place and the requirement."""
        if self.pointer is not None:
            return f"{self.pointer}: {self.detail}"
        return f"line {self.line}, column {self.column}, {self.word!r}: {self.detail}"


class Problem(Exception):
    """The service refused a request, or a job failed.

    Attributes:
        code: Stable name of the problem, such as ``invalid_request``. The service's ``docs/api.md`` lists all. It is
            None if the answer is no problem document, because a proxy answered instead of the service.
        status: HTTP status.
        detail: Explanation for people.
        errors: The bad fields of the request, or the faults of the program.
        request_id: The id under which the service's log mentions the request, or None.
    """

    def __init__(
        self,
        code: str | None,
        status: int,
        detail: str,
        errors: list[ProblemError] | None = None,
        request_id: str | None = None,
    ) -> None:
        """Makes the exception from the fields of the problem document."""
        self.code = code
        self.status = status
        self.detail = detail
        self.errors = errors or []
        self.request_id = request_id
        super().__init__(code, status, detail)

    def __str__(self) -> str:
        """Code, detail, and one line for each further error."""
        lines = [f"{self.status} {self.code or 'no problem document'}: {self.detail}"]
        if len(self.errors) > 1:
            lines += [f"  {error}" for error in self.errors]
        return "\n".join(lines)

    @classmethod
    def from_document(cls, document: dict[str, Any], request_id: str | None = None) -> Problem:
        """Makes the exception from a problem document."""
        errors = decode(list[ProblemError], document.get("errors", []))
        return cls(document["code"], document["status"], document["detail"], errors, request_id)

    @classmethod
    def from_response(cls, response: httpx.Response) -> Problem:
        """Makes the exception from an answer whose status is an error. The body must have been read."""
        request_id = response.headers.get("x-request-id")
        if response.headers.get("content-type", "").startswith("application/problem+json"):
            return cls.from_document(response.json(), request_id)
        return cls(None, response.status_code, response.text[:1000] or response.reason_phrase, None, request_id)
