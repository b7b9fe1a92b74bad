"""A service for all tests. The environment variable VERNE names its binary, or it is found below ``target``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import verne

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def client() -> Iterator[verne.Client]:
    with verne.local() as client:
        yield client


@pytest.fixture(scope="session")
def dome() -> Path:
    return ROOT / "examples" / "dome.cls"
