"""Sends requests with the clients that openapi-python-client and openapi-generator have made: use_clients.py BASE"""

import sys

import openapi_client as generated
import verne_client
import verne_models
from verne_client.api.kinematics import post_ik, post_ik_batch
from verne_client.api.workspace import get_workspace_mesh_stl, post_workspace
from verne_client.models import IkBatchRequest, IkRequest, Problem, WorkspaceRequest, WorkspaceSummary

BASE = sys.argv[1]
POSE = {"x": 100.0, "y": 50.0, "z": 150.0}
WORKSPACE = {"kind": "part", "tool_length": 50, "tolerance": 20}


def openapi_python_client() -> None:
    client = verne_client.Client(base_url=BASE)
    answer = post_ik.sync(client=client, body=IkRequest.from_dict({"pose": POSE}))
    assert len(answer.solutions) == 1
    rows = post_ik_batch.sync(client=client, body=IkBatchRequest.from_dict({"poses": [[100, 50, 150, 0, 0], None]}))
    assert len(rows.status) == 2
    problem = post_ik.sync(client=client, body=IkRequest.from_dict({"pose": POSE, "tool_length": -1.0}))
    assert isinstance(problem, Problem) and problem.status == 422
    summary = post_workspace.sync(client=client, body=WorkspaceRequest.from_dict(WORKSPACE))
    assert isinstance(summary, WorkspaceSummary)
    mesh = get_workspace_mesh_stl.sync_detailed(summary.id, client=client)
    assert int.from_bytes(mesh.content[80:84], "little") == summary.triangles


def openapi_generator() -> None:
    with generated.ApiClient(generated.Configuration(host=BASE)) as client:
        kinematics, workspaces = generated.KinematicsApi(client), generated.WorkspaceApi(client)
        assert len(kinematics.post_ik(generated.IkRequest.from_dict({"pose": POSE})).solutions) == 1
        assert len(kinematics.get_ik(**POSE).solutions) == 1
        summary = workspaces.post_workspace(generated.WorkspaceRequest.from_dict(WORKSPACE)).actual_instance
        mesh = workspaces.get_workspace_mesh_stl(summary.id)
        assert int.from_bytes(mesh[80:84], "little") == summary.triangles
        geometry = generated.MachinesApi(client).get_machine("verne").definition.geometry
        assert geometry["D1"] != geometry["d1"]


def models() -> None:
    request = verne_models.IkRequest.model_validate({"pose": POSE})
    assert request.model_dump(exclude_none=True, by_alias=True) == {"pose": POSE}


openapi_python_client()
openapi_generator()
models()
