"""Atlases of solutions."""

from __future__ import annotations

from typing import Any, Literal

from verne.answers.atlas import Atlas
from verne.answers.machine import Machine
from verne.decoding import decode
from verne.operations.meshes import DrawingFormat
from verne.session import Operation, Session, given

AtlasSpace = Literal["platform", "joints"]


def atlas(
    session: Session,
    space: AtlasSpace = "platform",
    *,
    u: tuple[float, float] | None = None,
    v: tuple[float, float] | None = None,
    tolerance: float | None = None,
    machine: str | Machine = "verne",
) -> Operation[Atlas]:
    """Computes an atlas: in which parts of a plane the parallel module has how many solutions.

    Args:
        space: ``platform``: u and v are x and y of the point P, and the inverse solutions count; ``joints``: they are
            rho2 - rho1 and rho3 - rho1, and the forward solutions count.
        u: Least and greatest u, mm. By default ± L1, or ± the greatest stroke of the sliders.
        v: Least and greatest v, mm.
        tolerance: Greatest distance of a line from the true curve, mm. By default a thousandth of the window's longer
            side, at most 1 mm.
        machine: Name of a published machine, or a machine.

    Raises:
        Problem: The service refused the request, or the curves lie too close together.
    """
    body = _body(space, u, v, tolerance, machine)
    response = yield from session.send(session.post("atlas", body))
    return decode(Atlas, response.json())


def atlas_drawing(
    session: Session,
    space: AtlasSpace = "platform",
    *,
    u: tuple[float, float] | None = None,
    v: tuple[float, float] | None = None,
    tolerance: float | None = None,
    machine: str | Machine = "verne",
    format: DrawingFormat = "svg",
) -> Operation[bytes]:
    """Computes an atlas as the bytes of a drawing.

    Args:
        space: The plane, as for ``atlas``.
        u: Least and greatest u, mm, as for ``atlas``.
        v: Least and greatest v, mm.
        tolerance: Greatest distance of a line from the true curve, mm, as for ``atlas``.
        machine: Name of a published machine, or a machine.
        format: ``svg``, or ``dxf`` (AutoCAD 2000, mm).

    Raises:
        Problem: The service refused the request, or the curves lie too close together.
    """
    body = _body(space, u, v, tolerance, machine)
    response = yield from session.send(session.post(f"atlas.{format}", body))
    return response.content


def _body(
    space: AtlasSpace,
    u: tuple[float, float] | None,
    v: tuple[float, float] | None,
    tolerance: float | None,
    machine: str | Machine,
) -> dict[str, Any]:
    u_min, u_max = (None, None) if u is None else u
    v_min, v_max = (None, None) if v is None else v
    return given(space=space, u_min=u_min, u_max=u_max, v_min=v_min, v_max=v_max, tolerance=tolerance, machine=machine)
