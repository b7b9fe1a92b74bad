"""A service of one's own on this computer, for notebooks and tests."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import tempfile
import time
import weakref
from pathlib import Path
from types import TracebackType

import httpx

from verne.client import Client
from verne.session import TIMEOUT

SECONDS_TO_START = 60.0
SECONDS_TO_STOP = 15.0


class LocalService:
    """A running service. Its jobs and results are in memory and end with it."""

    def __init__(
        self, binary: str | os.PathLike[str] | None = None, machines: str | os.PathLike[str] | None = None
    ) -> None:
        """Starts the service and waits until it is ready. See ``local``."""
        port = _free_port()
        command = [str(find_binary(binary)), "serve", "--listen", f"127.0.0.1:{port}", "--memory-only"]
        if machines is not None:
            command += ["--machines", os.fspath(machines)]
        self.url = f"http://127.0.0.1:{port}"
        """Address of the service."""
        # A proxy that the environment names does not reach this computer's own addresses.
        self.client = Client(self.url, http=httpx.Client(timeout=TIMEOUT, trust_env=False))
        """A client of it."""
        with tempfile.TemporaryFile() as log:
            self._process = subprocess.Popen(
                command, env={"RUST_LOG": "warn", **os.environ}, stdin=subprocess.DEVNULL, stdout=log, stderr=log
            )
            # It also ends when the interpreter does.
            self._stop = weakref.finalize(self, _stop, self._process)
            deadline = time.monotonic() + SECONDS_TO_START
            while not self._is_ready():
                if self._process.poll() is not None or time.monotonic() > deadline:
                    self.close()
                    log.seek(0)
                    raise RuntimeError(f"{command[0]} does not start:\n{log.read().decode(errors='replace')}")
                time.sleep(0.02)

    def _is_ready(self) -> bool:
        try:
            return httpx.get(f"{self.url}/readyz", trust_env=False).is_success
        except httpx.TransportError:
            return False

    def close(self) -> None:
        """Stops the service."""
        self.client.close()
        self._stop()

    def __enter__(self) -> Client:
        """Returns a client of the service."""
        return self.client

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stops the service."""
        self.close()


def local(
    binary: str | os.PathLike[str] | None = None, *, machines: str | os.PathLike[str] | None = None
) -> LocalService:
    """Starts a service on a free port of this computer.

    ``with verne.local() as client:`` stops it at the end of the block. In a notebook, keep the service instead, use its
    ``client``, and ``close`` it; it stops with the interpreter in any case.

    Args:
        binary: Path of the program ``verne``. By default it is found as ``find_binary`` says.
        machines: Directory of JSON files of machines, which the service publishes beside the built-in one.

    Raises:
        FileNotFoundError: There is no such program.
        RuntimeError: It does not start.
    """
    return LocalService(binary, machines)


def find_binary(binary: str | os.PathLike[str] | None = None) -> Path:
    """The path of the program ``verne``.

    It is the given one, or that of the environment variable ``VERNE``, or the first of: ``verne`` in ``PATH``,
    ``target/release/verne`` and ``target/debug/verne`` in the current directory and the directories above it.

    Raises:
        FileNotFoundError: There is no such program.
    """
    stated = binary or os.environ.get("VERNE")
    if stated is not None:
        found = shutil.which(stated)
        if found is None:
            raise FileNotFoundError(f"{stated} is not an executable file")
        return Path(found)
    here = Path.cwd()
    built = [folder / "target" / kind for folder in (here, *here.parents) for kind in ("release", "debug")]
    for path in (None, *built):
        found = shutil.which("verne", path=path)
        if found is not None:
            return Path(found)
    raise FileNotFoundError("no program verne: state its path, or set the environment variable VERNE")


def _stop(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    try:
        process.wait(SECONDS_TO_STOP)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
