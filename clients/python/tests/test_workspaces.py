"""Workspaces, families and dexterity maps: jobs, meshes and slices."""

from __future__ import annotations

import asyncio

import httpx
import numpy as np
import pytest

import verne


@pytest.fixture(scope="module")
def workspace(client: verne.Client) -> verne.WorkspaceJob:
    return client.workspace("part", tool_length=50, tolerance=2)


def test_a_mesh_encloses_the_volume(workspace: verne.WorkspaceJob) -> None:
    summary, mesh = workspace.result(), workspace.to_trimesh()
    assert mesh.is_watertight
    assert len(mesh.faces) == summary.triangles
    assert summary.volume is not None
    # The mesh is within the tolerance of the surface.
    assert abs(mesh.volume - summary.volume) <= 2 * mesh.area
    assert summary.bounds is not None
    np.testing.assert_allclose(mesh.bounds, [summary.bounds.min, summary.bounds.max])


def test_a_mesh_contains_the_points_that_are_inside(client: verne.Client, workspace: verne.WorkspaceJob) -> None:
    vertices = workspace.to_trimesh().vertices
    centre = vertices.mean(axis=0)
    inner, outer = centre + 0.98 * (vertices - centre), centre + 1.5 * (vertices - centre)
    assert client.contains(inner, "part", tool_length=50).inside.mean() > 0.9
    assert client.contains(outer, "part", tool_length=50).inside.mean() < 0.1


def test_meshes_are_files(workspace: verne.WorkspaceJob) -> None:
    assert workspace.mesh().startswith(b"glTF")
    assert workspace.mesh("ply").startswith(b"ply")
    stl = workspace.mesh("stl")
    assert int.from_bytes(stl[80:84], "little") == workspace.result().triangles


def test_a_slice_has_the_area_of_its_polygons(workspace: verne.WorkspaceJob) -> None:
    cut = workspace.slice(300, alpha=[0, 5])
    assert cut.area == pytest.approx(sum(polygon.area for polygon in cut.polygons))
    x, y = cut.polygons[0].outer.T
    assert np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)) > 0
    assert {line.alpha for line in cut.contours} <= {0, 5}
    assert b"<svg" in workspace.drawing(300)
    assert b"AC1015" in workspace.drawing(300, format="dxf")


def test_progress_ends_at_one(client: verne.Client) -> None:
    job = client.dexterity((-20, 20), tool_length=50, cell=80)
    fractions: list[float] = []
    summary = job.result(progress=fractions.append)
    assert fractions == sorted(fractions)
    assert fractions[-1] == job.progress == 1
    assert job.state == "succeeded"
    assert summary.reachable.volume is not None
    assert summary.dexterous.volume is not None
    assert summary.dexterous.volume < summary.reachable.volume


def test_a_dexterity_map_has_two_meshes_and_a_grid(client: verne.Client) -> None:
    job = client.dexterity((-20, 20), tool_length=50, cell=80)
    assert 0 < job.to_trimesh("dexterous").volume < job.to_trimesh().volume
    cells = job.cells()
    assert len(np.unique(cells["point"])) == job.result().reached
    assert (cells["from"] <= cells["to"]).all()
    # The middle of an interval is an inclination that reaches the point.
    phi1 = (cells["from"] + cells["to"]) / 2
    poses = np.column_stack([cells.to_numpy("x", "y", "z"), phi1, np.zeros(len(cells))])
    assert client.ik_batch(poses, tool_length=50).ok.all()


def test_a_bar_shows_the_progress(client: verne.Client, capsys: pytest.CaptureFixture[str]) -> None:
    client.workspace("tool", tool_length=50, tolerance=4).wait(progress=True)
    assert "100%" in capsys.readouterr().err


def test_a_family_has_the_volumes_of_its_members(client: verne.Client) -> None:
    family = client.family("part", tool_length=np.array([50.0, 70.0]), tolerance=4)
    members = family.result().members
    assert [member.request["tool_length"] for member in members] == [50, 70]
    single = client.workspace("part", tool_length=70, tolerance=4).result()
    assert members[1].volume == single.volume
    assert members[1].id == single.id
    assert len(family.to_trimesh(1).faces) == single.triangles


def test_a_family_needs_several_values(client: verne.Client) -> None:
    with pytest.raises(ValueError, match="list"):
        client.family("part", tool_length=50)


def test_a_cancelled_job_has_no_result(client: verne.Client) -> None:
    job = client.dexterity((-40, 40), tool_length=51, cell=5)
    job.cancel()
    with pytest.raises(verne.Problem) as caught:
        job.result()
    assert caught.value.code == "job_cancelled"
    assert job.state == "cancelled"


def test_a_job_that_has_ended_is_not_cancelled(workspace: verne.WorkspaceJob) -> None:
    workspace.wait()
    workspace.cancel()
    assert workspace.state == "succeeded"


def test_a_job_continues_after_a_timeout(client: verne.Client) -> None:
    job = client.dexterity((-40, 40), tool_length=52, cell=5)
    with pytest.raises(TimeoutError):
        job.wait(timeout=0)
    job.refresh()
    assert job.state in ("queued", "running")
    job.cancel()


def test_a_failed_job_raises_its_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VERNE_JOB_LIMIT", "1")
    with verne.local() as limited:
        job = limited.dexterity((-40, 40), tool_length=52, cell=5)
        with pytest.raises(verne.Problem) as caught:
            job.result()
        assert caught.value.code == "job_too_long"
        assert job.state == "failed"
        assert job.error is caught.value


def test_a_job_that_the_service_has_forgotten_is_submitted_again(monkeypatch: pytest.MonkeyPatch) -> None:
    with verne.local() as client:
        job = client.dexterity((-20, 20), tool_length=53, cell=60)
    monkeypatch.setattr("verne.local_service._free_port", lambda: httpx.URL(client.url).port)
    with verne.local(), httpx.Client() as http:
        # After its restart the service has no job.
        restarted = verne.DexterityJob(job._subject, http)
        assert restarted.result().reached > 0


def test_the_asynchronous_client_has_the_same_answers(client: verne.Client, workspace: verne.WorkspaceJob) -> None:
    async def ask() -> tuple[verne.WorkspaceSummary, bytes]:
        async with verne.AsyncClient(client.url) as asynchronous:
            job = await asynchronous.workspace("part", tool_length=50, tolerance=2)
            await job.wait()
            return await job.result(), await job.mesh()

    assert asyncio.run(ask()) == (workspace.result(), workspace.mesh())


def test_the_asynchronous_client_cancels(client: verne.Client) -> None:
    async def cancel() -> str:
        async with verne.AsyncClient(client.url) as asynchronous:
            job = await asynchronous.dexterity((-40, 40), tool_length=54, cell=5)
            await job.cancel()
            await job.wait()
            return job.state

    assert asyncio.run(cancel()) == "cancelled"
