"""Error budgets of poses, and error maps."""

from __future__ import annotations

import asyncio

import numpy as np
import polars
import pytest
from poses import TOOL_LENGTH, feasible_poses

import verne
from verne.operations.error_budgets import ParameterTolerances

TOLERANCES: ParameterTolerances = {"L1": 0.02, "L2": 0.02, "o3": 0.01, "tilt_zero": 0.001}


def test_the_rms_is_the_root_of_the_squares_of_the_contributions(client: verne.Client) -> None:
    answer = client.error_budget(feasible_poses(20, seed=3), TOLERANCES, tool_length=TOOL_LENGTH)
    assert [parameter.name for parameter in answer.parameters] == list(TOLERANCES)
    assert (answer.status, answer.counts.ok) == (["ok"] * 20, 20)
    for budget in answer.budgets:
        assert budget is not None
        for figure in (budget.tip, budget.axis):
            assert figure.rms == pytest.approx(np.linalg.norm(figure.contributions))
            assert figure.rms == pytest.approx(np.linalg.norm(figure.standard_deviations))
            assert max(figure.contributions) <= figure.worst <= sum(figure.contributions) + 1e-12


def test_a_contribution_is_the_way_of_the_tool_end(client: verne.Client) -> None:
    """The oracle is the forward problem of a machine with another rod length."""
    joints = client.ik(100, 50, 300, phi1=10, phi2=30, tool_length=50).solutions[0].joints
    assert joints is not None
    deviating = client.machine("verne")
    step = 1e-4
    deviating["geometry"]["L2"] += step
    place = client.fk(joints.to_numpy(), tool_length=50, machine=deviating).solutions[0].part
    assert place is not None
    answer = client.error_budget([[100, 50, 300, 10, 30]], {"L2": step}, tool_length=50)
    assert answer.budgets[0] is not None
    way = np.linalg.norm(place.to_numpy()[:3] - [100, 50, 300])
    assert answer.budgets[0].tip.contributions[0] == pytest.approx(way, rel=1e-4)


def test_rows_without_a_budget_have_a_status(client: verne.Client) -> None:
    poses = np.array([[0, 0, 400, 0, 0], [600, 0, 400, 0, 0], [np.nan, 0, 400, 0, 0]])
    answer = client.error_budget(poses, {"L1": 0.02}, tool_length=50)
    assert answer.status == ["ok", "unreachable", "invalid"]
    assert [budget is None for budget in answer.budgets] == [False, True, True]
    assert [error.row for error in answer.errors] == [2]


def test_tables_have_the_budgets_of_arrays(client: verne.Client) -> None:
    poses = feasible_poses(5, seed=4)
    frame = polars.DataFrame({"name": list("abcde")} | dict(zip(["x", "y", "z", "phi1", "phi2"], poses.T, strict=True)))
    assert client.error_budget(frame, TOLERANCES) == client.error_budget(poses, TOLERANCES)
    with pytest.raises(ValueError, match="found name, x"):
        client.error_budget(frame.select("name", "x"), TOLERANCES)


def test_a_tolerance_that_cannot_be_used_has_a_pointer(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.error_budget([[0, 0, 400, 0, 0]], {"L1": -1})
    assert [error.pointer for error in caught.value.errors] == ["/parameter_tolerances/L1"]


@pytest.fixture(scope="module")
def error_map(client: verne.Client) -> verne.ErrorMapJob:
    return client.error_map(TOLERANCES, "part", tool_length=50, cell=80, tolerance=10)


def test_the_cells_of_a_map_have_the_budgets_of_their_poses(client: verne.Client, error_map: verne.ErrorMapJob) -> None:
    summary, cells = error_map.result(), error_map.cells()
    assert len(cells) == summary.inside > 0
    some = slice(None, None, 20)
    positions = cells.to_numpy("x", "y", "z")[some]
    poses = np.column_stack([positions, np.zeros((len(positions), 2))])
    budgets = client.error_budget(poses, TOLERANCES, tool_length=50).budgets
    expected = [[b.tip.rms, b.tip.worst, b.axis.rms, b.axis.worst] for b in budgets if b is not None]
    found = cells.to_numpy("tip_rms", "tip_worst", "axis_rms", "axis_worst")
    np.testing.assert_allclose(found[some], expected, rtol=1e-9)
    assert summary.errors is not None
    assert summary.errors.tip_worst.least <= found[:, 1].min()
    assert summary.errors.tip_worst.largest >= found[:, 1].max()


def test_a_map_has_a_mesh_for_each_error(error_map: verne.ErrorMapJob) -> None:
    assert error_map.mesh().startswith(b"glTF")
    assert error_map.mesh("axis_rms") != error_map.mesh()
    mesh = error_map.to_trimesh("axis_worst")
    assert mesh.is_watertight
    assert len(mesh.faces) == error_map.result().triangles


def test_the_asynchronous_client_has_the_same_answers(client: verne.Client, error_map: verne.ErrorMapJob) -> None:
    poses = feasible_poses(5, seed=5)

    async def ask() -> tuple[verne.ErrorBudgetResult, verne.ErrorMapSummary, bytes]:
        async with verne.AsyncClient(client.url) as asynchronous:
            job = await asynchronous.error_map(TOLERANCES, "part", tool_length=50, cell=80, tolerance=10)
            return await asynchronous.error_budget(poses, TOLERANCES), await job.result(), await job.mesh()

    assert asyncio.run(ask()) == (client.error_budget(poses, TOLERANCES), error_map.result(), error_map.mesh())
