"""Dataclasses from decoded JSON.

Fields that a dataclass does not have are ignored, because a newer service may add some.
"""

from __future__ import annotations

import dataclasses
import functools
import types
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints, overload

import numpy as np

T = TypeVar("T")


class DecodingError(ValueError):
    """An answer of the service does not have the expected form."""


@overload
def decode(kind: type[T], value: Any) -> T: ...
@overload
def decode(kind: Any, value: Any) -> Any: ...
def decode(kind: Any, value: Any) -> Any:
    """Decodes a value as a type: a dataclass, list, tuple, dict, numpy array, union with None, or a plain type.

    Raises:
        DecodingError: The value does not have this type.
    """
    try:
        return _decoder(kind)(value)
    except (KeyError, TypeError, ValueError) as error:
        raise DecodingError(
            f"the answer is no {kind.__name__ if isinstance(kind, type) else kind}: {error!r}"
        ) from error


@functools.cache
def _decoder(kind: Any) -> Any:
    """The function that decodes a type."""
    origin, arguments = get_origin(kind), get_args(kind)
    if dataclasses.is_dataclass(kind):
        return _dataclass_decoder(kind)
    if origin in (Union, types.UnionType):
        return _optional_decoder(arguments)
    if origin is list:
        item = _decoder(arguments[0])
        return lambda value: [item(entry) for entry in value]
    if origin is dict:
        item = _decoder(arguments[1])
        return lambda value: {key: item(entry) for key, entry in value.items()}
    if origin is tuple:
        return _tuple_decoder(arguments)
    if origin is np.ndarray:
        dtype = get_args(arguments[1])[0]
        return lambda value: np.asarray(value, dtype=dtype)
    if kind is float:
        return float
    if kind in (str, int, bool):
        return functools.partial(_plain, kind)
    return lambda value: value


def _dataclass_decoder(kind: Any) -> Any:
    # The types of the fields are read at the first use: a dataclass may contain itself.
    @functools.cache
    def fields() -> list[tuple[str, bool, Any]]:
        hints = get_type_hints(kind)
        return [
            (
                field.name,
                field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING,
                _decoder(hints[field.name]),
            )
            for field in dataclasses.fields(kind)
        ]

    def decoded(value: Any) -> Any:
        # A field that would be a keyword of Python, such as "from", ends with an underscore.
        keys = ((name, name.removesuffix("_"), required, item) for name, required, item in fields())
        return kind(**{name: item(value[key]) for name, key, required, item in keys if required or key in value})

    return decoded


def _optional_decoder(arguments: tuple[Any, ...]) -> Any:
    (kind,) = (argument for argument in arguments if argument is not types.NoneType)
    item = _decoder(kind)
    return lambda value: None if value is None else item(value)


def _tuple_decoder(arguments: tuple[Any, ...]) -> Any:
    items = [_decoder(argument) for argument in arguments]
    return lambda value: tuple(item(entry) for item, entry in zip(items, value, strict=True))


def _plain(kind: type, value: Any) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"expected {kind.__name__}, found {value!r}")
    return value
