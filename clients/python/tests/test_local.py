"""Services that the package starts."""

from __future__ import annotations

import json
from pathlib import Path

import httpx
import numpy as np
import pytest

import verne


def test_two_services_run_at_once_and_stop() -> None:
    first = verne.local()
    with verne.local() as second:
        assert first.url not in second.url
        assert first.client.machines() == second.machines()
    first.close()
    with pytest.raises(httpx.ConnectError):
        httpx.get(f"{first.url}/livez")


def test_machines_of_a_directory_are_published(client: verne.Client, tmp_path: Path) -> None:
    machine = client.machine("verne")
    machine["name"] = "longer"
    machine["geometry"]["L1"] += 50
    (tmp_path / "longer.json").write_text(json.dumps(machine))
    with verne.local(machines=tmp_path) as own:
        position = {"x": [0.0], "y": [0.0], "z": [1300.0]}
        joints = own.ik_batch(position, frame="platform", machine="longer").joints
        single = own.ik(0, 0, 1300, frame="platform", machine=machine).solutions[0].joints
        assert single is not None
        np.testing.assert_allclose(joints[0], single.rho, atol=1e-9)
        other = own.ik_batch(position, frame="platform").joints
        assert not np.allclose(joints, other)


def test_a_proxy_is_not_asked_for_a_local_service(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HTTP_PROXY", "http://127.0.0.1:1")
    with verne.local() as client:
        assert client.machines()


def test_a_program_that_does_not_start_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VERNE_QUEUE", "many")
    with pytest.raises(RuntimeError, match="many"):
        verne.local()
    broken = tmp_path / "verne"
    broken.write_text("no program")
    with pytest.raises(FileNotFoundError):
        verne.local(broken)


def test_the_binary_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def program(path: Path) -> Path:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)
        return path

    monkeypatch.delenv("VERNE", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    below = tmp_path / "repository" / "examples"
    below.mkdir(parents=True)
    monkeypatch.chdir(below)
    with pytest.raises(FileNotFoundError):
        verne.find_binary()
    debug = program(tmp_path / "repository" / "target" / "debug" / "verne")
    assert verne.find_binary() == debug
    release = program(tmp_path / "repository" / "target" / "release" / "verne")
    assert verne.find_binary() == release
    in_path = program(tmp_path / "bin" / "verne")
    assert verne.find_binary() == in_path
    monkeypatch.setenv("VERNE", str(debug))
    assert verne.find_binary() == debug
    assert verne.find_binary(release) == release
