"""Atlases of solutions."""

from __future__ import annotations

import asyncio

import numpy as np
import pytest

import verne


def area(corners: np.ndarray) -> float:
    x, y = corners.T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def test_regions_are_the_window(client: verne.Client) -> None:
    atlas = client.atlas("joints", u=(-400, 300), tolerance=2)
    assert atlas.window.u == (-400, 300)
    assert atlas.tolerance == 2
    (left, right), (low, high) = atlas.window.u, atlas.window.v
    total = sum(region.area for region in atlas.regions)
    assert total == pytest.approx((right - left) * (high - low), rel=1e-4)
    for region in atlas.regions:
        polygon = area(region.outer) + sum(area(hole) for hole in region.holes)
        assert polygon == pytest.approx(region.area, rel=0.05, abs=50)


def test_a_region_has_the_number_of_solutions_of_fk_and_ik(client: verne.Client) -> None:
    for region in client.atlas("joints").regions:
        u, v = region.label
        assert len(client.fk([400, 400 + u, 400 + v], solutions="all").solutions) == region.solutions
    for region in client.atlas("platform", machine=client.machine("linear-delta")).regions:
        x, y = region.label
        found = client.ik(x, y, 1200, frame="platform", solutions="all", machine="linear-delta")
        assert len(found.solutions) == region.solutions


def test_drawings_are_files(client: verne.Client) -> None:
    assert client.atlas_drawing(tolerance=20).startswith(b"<svg")
    assert b"AC1015" in client.atlas_drawing("joints", tolerance=20, format="dxf")


def test_an_empty_window_is_refused(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.atlas(u=(5, 5))
    assert [error.pointer for error in caught.value.errors] == ["/u_max"]


def test_the_asynchronous_client_has_the_same_answers(client: verne.Client) -> None:
    async def ask() -> tuple[verne.Atlas, bytes]:
        async with verne.AsyncClient(client.url) as asynchronous:
            return await asynchronous.atlas(tolerance=20), await asynchronous.atlas_drawing(tolerance=20)

    atlas, drawing = asyncio.run(ask())
    assert atlas.regions[0].area == client.atlas(tolerance=20).regions[0].area
    assert drawing == client.atlas_drawing(tolerance=20)
