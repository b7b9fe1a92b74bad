"""Client of the verne service: kinematics, workspaces and tool paths of a five-axis machine tool.

Lengths are millimetres and angles degrees.
"""

from verne.answers.atlas import Atlas
from verne.answers.calibration import Calibration, ParameterEstimate
from verne.answers.error_budget import ErrorBudget, ErrorBudgetResult, ErrorMapSummary
from verne.answers.fitting import OriginsSummary, Placement, Window
from verne.answers.machine import Machine, MachineEntry, MachineId
from verne.answers.solution import ForwardResult, InverseResult, Joints, Limit, PartPose, PlatformPose, Solution
from verne.answers.toolpath import ProgramSummary, ToolpathFailure, ToolpathReport
from verne.answers.workspace import DexteritySummary, FamilySummary, Slice, WorkspaceSummary
from verne.async_client import AsyncClient
from verne.async_job import (
    AsyncDexterityJob,
    AsyncErrorMapJob,
    AsyncFamilyJob,
    AsyncJob,
    AsyncOriginsJob,
    AsyncPlacementJob,
    AsyncToolpathJob,
    AsyncWindowJob,
    AsyncWorkspaceJob,
)
from verne.batch import JointBatch, Membership, PoseBatch
from verne.client import Client
from verne.decoding import DecodingError
from verne.job import (
    DexterityJob,
    ErrorMapJob,
    FamilyJob,
    Job,
    OriginsJob,
    PlacementJob,
    ToolpathJob,
    WindowJob,
    WorkspaceJob,
)
from verne.local_service import LocalService, find_binary, local
from verne.problem import Problem, ProblemError
from verne.table import Table

__all__ = [
    "AsyncClient",
    "AsyncDexterityJob",
    "AsyncErrorMapJob",
    "AsyncFamilyJob",
    "AsyncJob",
    "AsyncOriginsJob",
    "AsyncPlacementJob",
    "AsyncToolpathJob",
    "AsyncWindowJob",
    "AsyncWorkspaceJob",
    "Atlas",
    "Calibration",
    "Client",
    "DecodingError",
    "DexterityJob",
    "DexteritySummary",
    "ErrorBudget",
    "ErrorBudgetResult",
    "ErrorMapJob",
    "ErrorMapSummary",
    "FamilyJob",
    "FamilySummary",
    "ForwardResult",
    "InverseResult",
    "Job",
    "JointBatch",
    "Joints",
    "Limit",
    "LocalService",
    "Machine",
    "MachineEntry",
    "MachineId",
    "Membership",
    "OriginsJob",
    "OriginsSummary",
    "ParameterEstimate",
    "PartPose",
    "Placement",
    "PlacementJob",
    "PlatformPose",
    "PoseBatch",
    "Problem",
    "ProblemError",
    "ProgramSummary",
    "Slice",
    "Solution",
    "Table",
    "ToolpathFailure",
    "ToolpathJob",
    "ToolpathReport",
    "Window",
    "WindowJob",
    "WorkspaceJob",
    "WorkspaceSummary",
    "find_binary",
    "local",
]
