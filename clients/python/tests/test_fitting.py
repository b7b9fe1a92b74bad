"""Windows of parameters, placements of programs, and regions of origins."""

from __future__ import annotations

import asyncio
from pathlib import Path

import verne


def test_a_placement_is_no_worse_than_the_given_set_up(client: verne.Client, dome: Path) -> None:
    reserve = {"stroke": 20.0, "slider_joint": 2.0}
    best = client.placement(
        dome,
        free={"setup.x": (-100.0, 100.0), "setup.z": (300.0, 700.0)},
        reserve=reserve,
        tool_length=120,
        setup={"z": 560},
    ).result()
    assert best.verdict == "ok"
    assert best.t is not None
    assert best.given.t is not None
    assert best.t >= best.given.t
    assert best.guarantee.starts > 0
    report = client.toolpath(dome, tool_length=120, setup={"x": best.setup.x, "z": best.setup.z}).result()
    assert report.verdict == "ok"
    least = min(margin.margin / reserve[margin.constraint] for margin in report.margins if margin.constraint in reserve)
    assert least == best.t


def test_the_ends_of_a_window_are_those_of_the_verdict(client: verne.Client, dome: Path) -> None:
    found = client.window(dome, "tool_length", (0.0, 900.0), setup={"z": 560}).result()
    (interval,) = found.intervals
    assert interval.ends[1].kind == "limit"
    assert interval.ends[1].constraint is not None
    verdicts = [
        client.toolpath(dome, tool_length=length, setup={"z": 560}).result().verdict
        for length in (interval.from_, interval.to, interval.to + found.precision)
    ]
    assert verdicts == ["ok", "ok", "fails"]


def test_a_region_of_origins_has_a_mesh(client: verne.Client, dome: Path) -> None:
    job = client.origins(dome, cell=60, tool_length=120)
    summary = job.result()
    assert summary.volume > summary.volume_error > 0
    assert summary.bounds is not None
    assert summary.bounds.min[2] < 560 < summary.bounds.max[2]
    assert job.to_trimesh().is_watertight
    assert job.mesh().startswith(b"glTF")


def test_the_asynchronous_client_has_both(client: verne.Client, dome: Path) -> None:
    async def ask() -> float | None:
        async with verne.AsyncClient(client.url) as asynchronous:
            job = await asynchronous.placement(
                dome, free={"setup.z": (300.0, 700.0)}, reserve={"stroke": 20.0}, tool_length=120
            )
            return (await job.result()).t

    assert asyncio.run(ask()) is not None
