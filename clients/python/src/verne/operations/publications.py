"""Published machines."""

from __future__ import annotations

from typing import cast

from verne.answers.machine import Machine, MachineEntry
from verne.decoding import decode
from verne.session import Operation, Session


def machines(session: Session) -> Operation[list[MachineEntry]]:
    """The machines that the service publishes."""
    response = yield from session.send(session.get("machines"))
    return decode(list[MachineEntry], response.json()["machines"])


def machine(session: Session, name: str) -> Operation[Machine]:
    """A published machine. Other operations take it, or a changed copy of it, as ``machine``."""
    response = yield from session.send(session.get(f"machines/{name}"))
    return cast("Machine", response.json()["definition"])
