"""The forward and the inverse problem, one pose at a time."""

from __future__ import annotations

import asyncio
import copy

import numpy as np
import pytest
from poses import TOOL_LENGTH, feasible_poses

import verne


@pytest.mark.parametrize("pose", feasible_poses(10, seed=1))
def test_forward_of_inverse_is_the_pose(client: verne.Client, pose: np.ndarray) -> None:
    inverse = client.ik(*pose, tool_length=TOOL_LENGTH)
    solution = inverse.solutions[0]
    assert solution.feasible
    assert solution.residual < 1e-9
    assert solution.joints is not None
    forward = client.fk(solution.joints.to_numpy(), tool_length=TOOL_LENGTH, near_joints=solution.joints.to_numpy())
    part = forward.solutions[0].part
    assert part is not None
    np.testing.assert_allclose(part.to_numpy(), pose, atol=1e-8)


def test_an_axis_states_the_same_pose_as_the_angles(client: verne.Client) -> None:
    by_angles = client.ik(10, 20, 350, 8, 30, tool_length=TOOL_LENGTH).solutions[0]
    assert by_angles.part is not None
    by_axis = client.ik(10, 20, 350, axis=by_angles.part.axis, tool_length=TOOL_LENGTH, solutions="feasible")
    joints = [solution.joints.to_numpy() for solution in by_axis.solutions if solution.joints is not None]
    assert by_angles.joints is not None
    expected = by_angles.joints.to_numpy()
    assert min(np.abs(found - expected).max() for found in joints) < 1e-8


def test_no_solution_has_a_reason_and_a_constraint(client: verne.Client) -> None:
    result = client.ik(0, 0, 2000, frame="platform", solutions="feasible")
    assert result.solutions == []
    assert result.reason == "infeasible"
    assert result.constraint is not None
    assert result.constraint.value < 0


def test_sliders_alone_have_no_pose_in_the_part_frame(client: verne.Client) -> None:
    solution = client.fk([600, 500, 500]).solutions[0]
    assert solution.part is None
    assert solution.joints is None or solution.joints.to_numpy().shape == (3,)


def test_solutions_are_sorted_by_distance_from_a_pose(client: verne.Client) -> None:
    every = client.fk([674, 685, 250], solutions="all").solutions
    assert len(every) > 1
    for solution in every:
        pose = solution.platform
        nearest = client.fk([674, 685, 250], solutions="all", near_pose=[pose.x, pose.y, pose.z, pose.alpha])
        assert nearest.solutions[0].platform.z == pytest.approx(pose.z, abs=1e-9)


def test_a_changed_machine_has_other_joints(client: verne.Client) -> None:
    machine = copy.deepcopy(client.machine("verne"))
    machine["name"] = "longer legs"
    for leg in ("L1", "L2", "L3"):
        machine["geometry"][leg] += 50
    own = client.ik(0, 0, 1300, frame="platform", machine=machine)
    assert own.machine.name == "longer legs"
    published = client.ik(0, 0, 1300, frame="platform")
    assert own.machine.hash != published.machine.hash
    joints = own.solutions[0].joints
    assert joints is not None
    back = client.fk(joints.rho, machine=machine).solutions[0].platform
    np.testing.assert_allclose([back.x, back.y, back.z], [0, 0, 1300], atol=1e-8)


def test_published_machines_include_the_built_in_one(client: verne.Client) -> None:
    assert "verne" in [machine.name for machine in client.machines()]


def test_the_asynchronous_client_has_the_same_answers(client: verne.Client) -> None:
    poses = feasible_poses(20, seed=2)

    async def ask() -> list[verne.InverseResult]:
        async with verne.AsyncClient(client.url) as asynchronous:
            return await asyncio.gather(*(asynchronous.ik(*pose, tool_length=TOOL_LENGTH) for pose in poses))

    assert asyncio.run(ask()) == [client.ik(*pose, tool_length=TOOL_LENGTH) for pose in poses]


@pytest.mark.parametrize("count", [0, 2, 4, 6])
def test_joints_are_three_or_five_numbers(client: verne.Client, count: int) -> None:
    with pytest.raises(ValueError, match="found"):
        client.fk([500.0] * count)
