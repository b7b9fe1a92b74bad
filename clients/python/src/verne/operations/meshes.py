"""Meshes, slices and grids of computed workspaces. Each operation waits for its job."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Literal

import httpx

from verne.answers.error_budget import ErrorMapSummary
from verne.answers.fitting import OriginsSummary
from verne.answers.workspace import DexteritySummary, FamilySummary, Slice, WorkspaceSummary
from verne.arrow_stream import read_stream
from verne.decoding import decode
from verne.operations.jobs import Submission, fetch
from verne.session import Numbers, Operation, Session
from verne.table import Table

if TYPE_CHECKING:
    from trimesh import Trimesh

MeshFormat = Literal["glb", "stl", "ply", "json"]
DrawingFormat = Literal["svg", "dxf"]
PointSet = Literal["reachable", "dexterous"]
MeshError = Literal["tip_rms", "tip_worst", "axis_rms", "axis_worst"]


def mesh(job: Submission[WorkspaceSummary], format: MeshFormat = "glb") -> Operation[bytes]:
    """The surface of a workspace as the bytes of a file.

    Args:
        format: ``glb``: binary glTF in metres, Y up, coloured by the limit; ``stl``, ``ply``, ``json``: mm.
    """
    summary = yield from job.result()
    return (yield from _file(job.session, summary.links.mesh, format))


def trimesh(job: Submission[WorkspaceSummary]) -> Operation[Trimesh]:
    """The surface of a workspace as a mesh of trimesh, mm, in the frame of the workspace. Needs trimesh."""
    return _trimesh((yield from mesh(job, "ply")))


def slice_(job: Submission[WorkspaceSummary], z: float, alpha: Numbers | None = None) -> Operation[Slice]:
    """The cut of a workspace with a plane.

    Args:
        z: Height of the plane in the frame of the workspace, mm.
        alpha: Inclinations of the platform, degrees, for which the slice has contours.
    """
    return decode(Slice, (yield from _slice(job, z, alpha, "json")).json())


def drawing(
    job: Submission[WorkspaceSummary],
    z: float,
    alpha: Numbers | None = None,
    *,
    format: DrawingFormat = "svg",
) -> Operation[bytes]:
    """The cut of a workspace with a plane as the bytes of a drawing.

    Args:
        z: Height of the plane in the frame of the workspace, mm.
        alpha: Inclinations of the platform, degrees, for which the drawing has lines.
        format: ``svg``, or ``dxf`` (AutoCAD 2000, mm).
    """
    return (yield from _slice(job, z, alpha, format)).content


def family_mesh(job: Submission[FamilySummary], member: int, format: MeshFormat = "glb") -> Operation[bytes]:
    """The surface of a member of a family as the bytes of a file.

    Args:
        member: Index of the member in ``result().members``.
        format: As for a workspace's mesh.
    """
    summary = yield from job.result()
    return (yield from _file(job.session, f"workspace/{summary.members[member].id}/mesh", format))


def family_trimesh(job: Submission[FamilySummary], member: int) -> Operation[Trimesh]:
    """The surface of a member of a family as a mesh of trimesh, mm. Needs trimesh."""
    return _trimesh((yield from family_mesh(job, member, "ply")))


def dexterity_mesh(
    job: Submission[DexteritySummary], points: PointSet = "reachable", format: MeshFormat = "glb"
) -> Operation[bytes]:
    """The surface of the points that some, or all, inclinations reach, as the bytes of a file.

    Args:
        points: ``reachable``: some inclination reaches them; ``dexterous``: all inclinations do.
        format: As for a workspace's mesh.
    """
    links = (yield from job.result()).links
    return (yield from _file(job.session, links.reachable if points == "reachable" else links.dexterous, format))


def dexterity_trimesh(job: Submission[DexteritySummary], points: PointSet = "reachable") -> Operation[Trimesh]:
    """The surface of the points that some, or all, inclinations reach, as a mesh of trimesh, mm. Needs trimesh."""
    return _trimesh((yield from dexterity_mesh(job, points, "ply")))


def error_mesh(
    job: Submission[ErrorMapSummary], error: MeshError = "tip_worst", format: MeshFormat = "glb"
) -> Operation[bytes]:
    """The surface of the workspace in ten bands of an error, as the bytes of a file.

    Args:
        error: ``tip_rms``, ``tip_worst``: displacement of the tool end; ``axis_rms``, ``axis_worst``: its angle.
        format: As for a workspace's mesh. STL has no bands.
    """
    links = (yield from job.result()).links
    return (yield from fetch(job.session, job.session.get(links.mesh, format=format, error=error))).content


def error_trimesh(job: Submission[ErrorMapSummary], error: MeshError = "tip_worst") -> Operation[Trimesh]:
    """The surface of the workspace in ten bands of an error, as a mesh of trimesh, mm. Needs trimesh."""
    return _trimesh((yield from error_mesh(job, error, "ply")))


def origins_mesh(job: Submission[OriginsSummary], format: MeshFormat = "glb") -> Operation[bytes]:
    """The surface of a region of origins as the bytes of a file.

    Args:
        format: As for a workspace's mesh.
    """
    links = (yield from job.result()).links
    return (yield from _file(job.session, links.mesh, format))


def origins_trimesh(job: Submission[OriginsSummary]) -> Operation[Trimesh]:
    """The surface of a region of origins as a mesh of trimesh, mm. Needs trimesh."""
    return _trimesh((yield from origins_mesh(job, "ply")))


def cells(job: Submission[DexteritySummary]) -> Operation[Table]:
    """The inclinations that reach the points of the grid, as a table with a row for each interval of them.

    Returns:
        A table with the columns point (number of the point), x, y, z (mm), from, to (degrees).
    """
    return (yield from _cells(job.session, (yield from job.result()).links.cells))


def error_cells(job: Submission[ErrorMapSummary]) -> Operation[Table]:
    """The errors at the points of the grid that are inside the workspace, as a table with a row for each point.

    Returns:
        A table with the columns point (number of the point), x, y, z, tip_rms, tip_worst (mm), axis_rms, axis_worst
        (degrees).
    """
    return (yield from _cells(job.session, (yield from job.result()).links.cells))


def _cells(session: Session, path: str) -> Operation[Table]:
    response = yield from fetch(session, session.get(path, format="arrow"))
    return Table(read_stream(response.content))


def _file(session: Session, path: str, format: MeshFormat) -> Operation[bytes]:
    # The link of a dexterity map's mesh has a query already.
    request = session.get(path, format=format)
    return (yield from fetch(session, request)).content


def _slice(
    job: Submission[WorkspaceSummary], z: float, alpha: Numbers | None, format: str
) -> Operation[httpx.Response]:
    summary = yield from job.result()
    request = job.session.get(f"workspace/{summary.id}/slice", z=z, alpha=alpha, format=format)
    return (yield from fetch(job.session, request))


def _trimesh(ply: bytes) -> Trimesh:
    from trimesh import Trimesh
    from trimesh.exchange.ply import load_ply

    return Trimesh(process=False, **load_ply(io.BytesIO(ply)))
