"""The service that the tests of the examples ask: VERNE names the binary."""

import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
sys.path.append(str(ROOT / "tests/load"))
from verne_process import Service  # noqa: E402

_running = []


def address():
    """The address of a service that runs as long as the tests."""
    if not _running:
        data = tempfile.TemporaryDirectory()
        verne = os.environ.get("VERNE", ROOT / "target/debug/verne")
        _running.extend([Service(str(verne), data.name, "--cors-origin", "*").start(), data])
    return f"http://127.0.0.1:{_running[0].port}"


def stop():
    """Ends the service."""
    if _running:
        _running[0].kill()
        _running[1].cleanup()
        _running.clear()
