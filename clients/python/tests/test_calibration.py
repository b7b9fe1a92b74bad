"""Calibration: a known machine is found again."""

from __future__ import annotations

import asyncio
import copy
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import polars
import pyarrow
import pytest
from numpy.typing import NDArray

import verne

TOOL_LENGTH = 100.0
SLIDERS = ["rho1", "rho2", "rho3"]


def readings(count: int, seed: int) -> NDArray[np.float64]:
    return np.random.default_rng(seed).uniform(330, 560, (count, 3))


def tips(client: verne.Client, machine: str | verne.Machine, rho: NDArray[np.float64]) -> NDArray[np.float64]:
    ends = [client.fk(row, tool_length=TOOL_LENGTH, machine=machine).solutions[0].tool for row in rho]
    return np.array([[end.x, end.y, end.z] for end in ends])


@pytest.fixture(scope="module")
def actual(client: verne.Client) -> verne.Machine:
    machine = copy.deepcopy(client.machine("verne"))
    machine["geometry"]["L1"] += 0.3
    machine["geometry"]["R1"] -= 0.2
    return machine


@pytest.fixture(scope="module")
def measured(client: verne.Client, actual: verne.Machine) -> NDArray[np.float64]:
    rho = readings(30, seed=1)
    return np.column_stack([rho, tips(client, actual, rho)])


def test_a_known_machine_is_found_again(
    client: verne.Client, actual: verne.Machine, measured: NDArray[np.float64]
) -> None:
    found = client.calibrate(measured, tool_length=TOOL_LENGTH, sigma=0.002)
    assert (found.rank, found.unidentifiable) == (13, [])
    assert found.machine["geometry"]["L1"] == pytest.approx(1050.3, abs=1e-5)
    assert found.machine["geometry"]["R1"] == pytest.approx(274.8, abs=1e-5)
    assert all(estimate.sigma is not None for estimate in found.parameters)
    assert found.residuals.shape == (30, 3)
    assert found.next.shape == (5, 3)
    rho = readings(5, seed=2)
    again = tips(client, found.machine, rho + found.slider_offsets)
    np.testing.assert_allclose(again, tips(client, actual, rho), atol=1e-4)


@pytest.mark.parametrize("library", [pandas.DataFrame, polars.DataFrame, pyarrow.table, dict])
def test_tables_have_the_answer_of_the_array(client: verne.Client, measured: NDArray[np.float64], library: Any) -> None:
    columns = dict(zip([*SLIDERS, "x", "y", "z"], measured.T, strict=True)) | {"label": ["a"] * len(measured)}
    of_table = client.calibrate(library(columns), tool_length=TOOL_LENGTH, sigma=0.002, next_poses=0)
    of_array = client.calibrate(measured, tool_length=TOOL_LENGTH, sigma=0.002, next_poses=0)
    assert of_table.machine == of_array.machine
    assert of_table.next.shape == (0,)


def test_what_is_known_beside_the_measurements_counts(client: verne.Client, measured: NDArray[np.float64]) -> None:
    found = client.calibrate(
        measured,
        tool_length=TOOL_LENGTH,
        sigma=0.002,
        fixed=["tool_length", "R2"],
        priors={"L1": {"value": 1050.3, "sigma": 1e-4}},
        bounds={"R1": (274.9, 275.1)},
    )
    by_name = {estimate.name: estimate for estimate in found.parameters}
    assert not {"tool_length", "R2"} & set(by_name)
    assert by_name["L1"].sigma is not None
    assert by_name["L1"].sigma <= 1e-4
    assert by_name["R1"].at_bound
    assert by_name["R1"].value == pytest.approx(274.9)


def test_a_ball_bar_and_distances_have_lengths(
    client: verne.Client, actual: verne.Machine, measured: NDArray[np.float64]
) -> None:
    centre = np.array([0.0, 0.0, 900.0])
    lengths = np.linalg.norm(measured[:, 3:] - centre, axis=1)
    bar = np.column_stack([measured[:, :3], lengths])
    known = client.calibrate(bar, "ballbar", tool_length=TOOL_LENGTH, centre=centre, sigma=0.002)
    assert known.rank == known.unknowns == 13
    assert known.centre is not None
    unknown = client.calibrate(bar, "ballbar", tool_length=TOOL_LENGTH, sigma=0.002)
    assert (unknown.rank, unknown.unknowns) == (14, 16)
    distances = np.linalg.norm(measured[1:, 3:] - measured[:-1, 3:], axis=1)
    pairs = np.column_stack([measured[:-1, :3], measured[1:, :3], distances])
    found = client.calibrate(pairs, "distances", tool_length=TOOL_LENGTH, sigma=0.002)
    assert (found.rank, found.unknowns, found.residuals.shape) == (11, 13, (29, 1))


def test_poses_alone_are_a_plan(client: verne.Client) -> None:
    plan = client.calibrate(readings(20, seed=3), "tracker", tool_length=TOOL_LENGTH, sigma=0.002)
    assert (plan.rank, plan.unknowns) == (17, 19)
    assert [set(combination) for combination in plan.unidentifiable] == [
        {"e1", "e2", "frame.x"},
        {"o1", "o2", "o3", "frame.z"},
    ]
    assert plan.rms is None
    assert plan.frame is None
    assert plan.machine == client.machine("verne")


def test_a_gross_error_is_an_outlier(client: verne.Client) -> None:
    measurements = pandas.read_csv(Path(__file__).parents[3] / "examples" / "measurements.csv")
    found = client.calibrate(measurements, tool_length=TOOL_LENGTH, loss="huber")
    assert [outlier.measurement for outlier in found.outliers] == [17]
    assert found.sigma == pytest.approx(0.002, rel=0.5)


def test_a_row_that_cannot_be_used_is_a_problem(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.calibrate([[500, 500, 500, 0, 0, float("nan")]])
    assert caught.value.code == "invalid_request"
    assert caught.value.errors[0].pointer == "/columns/z"
    with pytest.raises(ValueError, match="expected"):
        client.calibrate(np.zeros((2, 4)))


def test_the_asynchronous_client_has_the_same_answer(client: verne.Client, measured: NDArray[np.float64]) -> None:
    async def ask() -> verne.Calibration:
        async with verne.AsyncClient(client.url) as asynchronous:
            return await asynchronous.calibrate(measured, tool_length=TOOL_LENGTH)

    assert asyncio.run(ask()).machine == client.calibrate(measured, tool_length=TOOL_LENGTH).machine
