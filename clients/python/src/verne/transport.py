"""How the rows of a batch travel: as JSON. This module alone knows the media type."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import httpx
import numpy as np
import pyarrow

from verne.session import Request, Session

# For each list of rows in an answer, the names of its columns.
LISTS = {
    "joints": ("rho1", "rho2", "rho3", "theta1", "theta2"),
    "poses": ("platform_x", "platform_y", "platform_z", "alpha"),
    "parts": ("x", "y", "z", "phi1", "phi2"),
}
COLUMNS = ("status", "inside", "jump", "margin", "unit", "constraint", "element")


def batch_request(
    session: Session, path: str, rows: pyarrow.Table, layout: tuple[str, ...], options: Mapping[str, Any]
) -> Request:
    """The request with the columns of a layout."""
    numbers = np.column_stack([rows.column(name).to_numpy().astype(np.float64) for name in layout])
    missing = np.isnan(numbers).any(axis=1)
    lists = [None if absent else row for row, absent in zip(numbers.tolist(), missing, strict=True)]
    name = {"ik/batch": "poses", "fk/batch": "joints"}.get(path, "points")
    return session.post(path, {name: lists, **options})


def batch_answer(response: httpx.Response, rows: pyarrow.Table, layout: tuple[str, ...]) -> pyarrow.Table:
    """The columns of an answer after those of the request that are not in the layout."""
    answer = response.json()
    columns = {name: rows.column(name) for name in rows.column_names if name not in layout}
    for name, parts in LISTS.items():
        if name in answer:
            # Frames without the part's have no angles of the table.
            filled = [[*(row or ()), *[None] * len(parts)] for row in answer[name]]
            columns |= {
                part: pyarrow.array([row[i] for row in filled], pyarrow.float64()) for i, part in enumerate(parts)
            }
    columns |= {name: answer[name] for name in COLUMNS if name in answer}
    # The metadata contains the index of a data frame of pandas.
    return pyarrow.table(columns).replace_schema_metadata(rows.schema.metadata)
