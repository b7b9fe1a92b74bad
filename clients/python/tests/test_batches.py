"""Batches: arrays and tables in, columns out."""

from __future__ import annotations

import asyncio
from typing import Any

import numpy as np
import pandas
import polars
import pyarrow
import pytest
from poses import TOOL_LENGTH, feasible_poses

import verne

NAMES = ["x", "y", "z", "phi1", "phi2"]
JOINTS = ["rho1", "rho2", "rho3", "theta1", "theta2"]


def test_forward_of_inverse_are_the_poses(client: verne.Client) -> None:
    poses = feasible_poses(1000, seed=3)
    inverse = client.ik_batch(poses, tool_length=TOOL_LENGTH)
    assert inverse.ok.all()
    assert (inverse.margin > 0).all()
    forward = client.fk_batch(inverse.joints, tool_length=TOOL_LENGTH)
    np.testing.assert_allclose(forward.part, poses, atol=1e-8)
    np.testing.assert_allclose(forward.margin, inverse.margin, atol=1e-8)


def test_a_batch_has_the_joints_of_single_requests(client: verne.Client) -> None:
    poses = feasible_poses(10, seed=4)
    batch = client.ik_batch(poses, tool_length=TOOL_LENGTH)
    for pose, joints in zip(poses, batch.joints, strict=True):
        single = client.ik(*pose, tool_length=TOOL_LENGTH, near_joints=joints).solutions[0].joints
        assert single is not None
        np.testing.assert_allclose(single.to_numpy(), joints, atol=1e-9)


@pytest.mark.parametrize("frame", ["tool", "platform"])
def test_other_frames_have_positions_alone(client: verne.Client, frame: Any) -> None:
    batch = client.ik_batch([[0, 0, 1300], [10, 20, 1250]], frame=frame)
    assert batch.ok.all()
    assert batch.joints.shape == (2, 3)
    assert not np.isnan(batch.joints).any()


def test_axes_and_angles_state_the_same_poses(client: verne.Client) -> None:
    x, y, z, phi1, phi2 = feasible_poses(50, seed=5).T
    a, b = np.radians(phi1), np.radians(phi2)
    axes = np.column_stack([x, y, z, np.sin(a) * np.sin(b), -np.sin(a) * np.cos(b), np.cos(a)])
    by_axis = client.ik_batch(axes, tool_length=TOOL_LENGTH)
    part = client.fk_batch(by_axis.joints, tool_length=TOOL_LENGTH).part
    np.testing.assert_allclose(part[:, :3], axes[:, :3], atol=1e-8)
    c, d = np.radians(part[:, 3:]).T
    np.testing.assert_allclose(
        np.column_stack([np.sin(c) * np.sin(d), -np.sin(c) * np.cos(d), np.cos(c)]), axes[:, 3:], atol=1e-9
    )


def tables() -> list[Any]:
    columns = dict(zip(NAMES, feasible_poses(5, seed=6).T, strict=True)) | {"label": np.array(list("abcde"))}
    return [columns, pandas.DataFrame(columns), polars.DataFrame(columns), pyarrow.table(columns)]


@pytest.mark.parametrize("table", tables(), ids=["mapping", "pandas", "polars", "pyarrow"])
def test_tables_have_the_answer_of_the_array_and_keep_their_other_columns(client: verne.Client, table: Any) -> None:
    answer = client.ik_batch(table, tool_length=TOOL_LENGTH)
    assert answer["label"].tolist() == list("abcde")
    expected = client.ik_batch(feasible_poses(5, seed=6), tool_length=TOOL_LENGTH)
    np.testing.assert_array_equal(answer.joints, expected.joints)


def test_an_answer_is_a_table_of_pandas_polars_and_arrow(client: verne.Client) -> None:
    answer = client.ik_batch(feasible_poses(5, seed=7), tool_length=TOOL_LENGTH)
    np.testing.assert_array_equal(answer.to_pandas()[JOINTS].to_numpy(), answer.joints)
    np.testing.assert_array_equal(answer.to_polars().select(JOINTS).to_numpy(), answer.joints)
    assert answer.to_arrow().num_rows == len(answer) == 5
    assert polars.DataFrame(answer)["status"].to_list() == ["ok"] * 5


def test_a_data_frame_keeps_its_index(client: verne.Client) -> None:
    frame = pandas.DataFrame(feasible_poses(6, seed=8), columns=NAMES)
    some = frame[[True, False, True, False, False, True]]
    answer = client.ik_batch(some, tool_length=TOOL_LENGTH).to_pandas()
    assert answer.index.tolist() == [0, 2, 5]


def test_rows_without_solution_have_nan_and_a_status(client: verne.Client) -> None:
    batch = client.ik_batch([[0, 0, 400, 0, 0], [np.nan, 0, 400, 0, 0], [600, 0, 400, 0, 0]], tool_length=50)
    assert batch.status.tolist() == ["ok", "invalid", "unreachable"]
    assert np.isnan(batch.joints).all(axis=1).tolist() == [False, True, True]
    assert np.isnan(batch.margin).tolist() == [False, True, False]
    assert batch.constraint[1] is None
    assert batch.element[1] is None
    assert [detail is None for detail in batch.detail] == [True, False, True]


def test_continuous_rows_pass_half_a_turn(client: verne.Client) -> None:
    poses = [[60, 20, 300, 20, phi2] for phi2 in (170, 180, -170)]
    start = [400, 450, 450, -20, -170]
    batch = client.ik_batch(poses, tool_length=100, continuous=True, start=start)
    np.testing.assert_allclose(batch.joints[:, 4], [-170, -180, -190], atol=1e-9)
    assert not batch.jump.any()


def test_points_are_inside_where_the_inverse_problem_is_feasible(client: verne.Client) -> None:
    points = np.random.default_rng(9).uniform([-600, -900, 100], [600, 900, 900], (2000, 3))
    inside = client.contains(points, "part", tool_length=50)
    poses = np.column_stack([points, np.zeros((len(points), 2))])
    batch = client.ik_batch(poses, tool_length=50)
    np.testing.assert_array_equal(inside.inside, batch.ok)
    assert 100 < inside.inside.sum() < 1900
    assert ((inside.margin >= 0) == inside.inside).all()


def test_an_invalid_point_is_not_inside(client: verne.Client) -> None:
    answer = client.contains([[0, 0, 1300], [np.nan, 0, 0]])
    assert answer.inside.tolist() == [True, False]
    assert np.isnan(answer.margin[1])


@pytest.mark.parametrize("rows", [np.zeros((2, 4)), np.zeros(5)])
def test_an_array_of_another_width_is_refused(client: verne.Client, rows: Any) -> None:
    with pytest.raises(ValueError, match="expected"):
        client.ik_batch(rows)


@pytest.mark.parametrize(
    ("names", "wrong"),
    [(["x", "y"], "z"), (["x", "y", "z", "phi1"], "phi2"), ([*NAMES, "i", "j", "k"], "i"), (["x", "y", "z"], "phi1")],
)
def test_a_table_with_other_columns_is_refused(client: verne.Client, names: list[str], wrong: str) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.ik_batch({name: [1.0] for name in names})
    assert f"/columns/{wrong}" in [error.pointer for error in caught.value.errors]


def test_a_column_of_the_answer_replaces_one_of_its_name(client: verne.Client) -> None:
    answer = client.contains({"x": [0.0], "y": [0.0], "z": [1300.0], "inside": ["unknown"]}).to_pandas()
    assert list(answer["inside"]) == [True]


def test_a_batch_takes_a_machine(client: verne.Client) -> None:
    machine = client.machine("verne")
    for leg in ("L1", "L2", "L3"):
        machine["geometry"][leg] += 50
    batch = client.ik_batch([[0, 0, 1300]], frame="platform", machine=machine)
    single = client.ik(0, 0, 1300, frame="platform", machine=machine).solutions[0].joints
    assert single is not None
    np.testing.assert_allclose(batch.joints[0], single.rho, atol=1e-9)


def test_columns_of_any_type_are_kept(client: verne.Client) -> None:
    frame = pandas.DataFrame(feasible_poses(3, seed=11), columns=NAMES)
    frame["time"] = pandas.date_range("2026-01-01", periods=3)
    frame["kind"] = pandas.Categorical(["a", "b", "a"])
    frame["list"] = [[1], [], [2, 3]]
    answer = client.ik_batch(frame, tool_length=TOOL_LENGTH).to_pandas()
    pandas.testing.assert_frame_equal(answer[["time", "kind"]], frame[["time", "kind"]])
    assert [list(numbers) for numbers in answer["list"]] == [[1], [], [2, 3]]


def test_integers_and_single_precision_are_numbers(client: verne.Client) -> None:
    columns = {"x": np.array([1, 2]), "y": np.array([3, 4], dtype=np.float32), "z": np.array([1300.0, 1310.0])}
    assert client.contains(columns).inside.all()


def test_many_rows_travel_in_several_requests(client: verne.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    poses = feasible_poses(1000, seed=12)
    at_once = client.ik_batch(poses, tool_length=TOOL_LENGTH)
    monkeypatch.setattr("verne.operations.batches.ROWS_PER_REQUEST", 300)
    in_parts = client.ik_batch(poses, tool_length=TOOL_LENGTH)
    np.testing.assert_array_equal(in_parts.joints, at_once.joints)
    assert in_parts.to_pandas().equals(at_once.to_pandas())


def test_no_rows_have_no_answers(client: verne.Client) -> None:
    answer = client.ik_batch(np.zeros((0, 5)))
    assert len(answer) == 0
    assert answer.joints.shape == (0, 5)


def test_the_asynchronous_client_has_the_same_answers(client: verne.Client) -> None:
    poses = feasible_poses(100, seed=10)

    async def ask() -> verne.JointBatch:
        async with verne.AsyncClient(client.url) as asynchronous:
            return await asynchronous.ik_batch(poses, tool_length=TOOL_LENGTH)

    assert asyncio.run(ask()).to_arrow() == client.ik_batch(poses, tool_length=TOOL_LENGTH).to_arrow()
