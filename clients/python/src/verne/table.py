"""Rows as columns: Arrow underneath, numpy, pandas and polars outside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, cast

import numpy as np
import pyarrow
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import pandas
    import polars


class ArrowStream(Protocol):
    """A table of pandas, polars, pyarrow or another library with Arrow's PyCapsule interface."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Returns the table's data as a stream of Arrow."""
        ...


Rows: TypeAlias = ArrowStream | Mapping[str, ArrayLike] | Sequence[Sequence[float]] | NDArray[Any]
"""Rows as a table with named columns, as a mapping from names to columns, or as an array."""


def to_arrow(rows: Rows, *layouts: tuple[str, ...]) -> pyarrow.Table:
    """Rows as a table of Arrow.

    Args:
        rows: A table with named columns, or an array that is as wide as a layout.
        layouts: The possible names of an array's columns.

    Raises:
        ValueError: The array has none of these layouts.
    """
    if hasattr(rows, "__arrow_c_stream__"):
        return pyarrow.table(rows)
    if isinstance(rows, Mapping):
        return pyarrow.table({name: np.asarray(column) for name, column in rows.items()})
    array = np.asarray(rows, dtype=np.float64)
    for layout in layouts:
        if array.ndim == 2 and array.shape[1] == len(layout):
            return pyarrow.table({name: array[:, i] for i, name in enumerate(layout)})
    names = " or ".join(", ".join(layout) for layout in layouts)
    raise ValueError(f"expected an array with the columns {names}; found the shape {array.shape}")


class Table:
    """Columns of equal length. ``len`` is the number of rows; ``table["x"]`` is a column as an array of numpy."""

    def __init__(self, arrow: pyarrow.Table) -> None:
        """Takes the table of Arrow."""
        self._arrow = arrow

    def __len__(self) -> int:
        """Number of rows."""
        return cast("int", self._arrow.num_rows)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A column. In a column of numbers NaN is in place of a missing value, in a column of texts None."""
        column = self._arrow.column(name)
        if pyarrow.types.is_dictionary(column.type):
            column = column.cast(column.type.value_type)
        return cast("NDArray[Any]", column.to_numpy())

    def __repr__(self) -> str:
        """Type, rows and columns."""
        return f"<{type(self).__name__}: {len(self)} rows of {', '.join(self.columns)}>"

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return cast("list[str]", self._arrow.column_names)

    def to_numpy(self, *names: str) -> NDArray[np.float64]:
        """Columns of numbers side by side: a row for each row. NaN is in place of a missing value."""
        return np.column_stack([self[name].astype(np.float64) for name in names])

    def to_arrow(self) -> pyarrow.Table:
        """The table of pyarrow."""
        return self._arrow

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame of pandas."""
        return self._arrow.to_pandas()

    def to_polars(self) -> polars.DataFrame:
        """A data frame of polars."""
        import polars

        return cast("polars.DataFrame", polars.from_arrow(self._arrow))

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The table's data as a stream of Arrow."""
        return self._arrow.__arrow_c_stream__(requested_schema)
