"""What arguments must be, said by their names where they are something else."""

from __future__ import annotations

import operator
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

#: A number in m, rad, N and s, or a text with units such as ``"60 deg"``.
Value = Union[float, str]
Wrench = Union[str, Sequence[float]]


def wrong(name: str, wanted: str, given: Any) -> TypeError:
    """The error of an argument that is something else."""
    kind = "None" if given is None else f"of type {type(given).__name__}"
    return TypeError(f"`{name}` must be {wanted}, not {kind}")


def text(name: str, given: Any) -> str:
    """A text."""
    if not isinstance(given, str):
        raise wrong(name, "a text", given)
    return given


def flag(name: str, given: Any) -> bool:
    """True or False."""
    if not isinstance(given, (bool, np.bool_)):
        raise wrong(name, "True or False", given)
    return bool(given)


def count(name: str, given: Any) -> int:
    """A whole number; those of numpy are too."""
    if isinstance(given, (bool, np.bool_)) or not hasattr(given, "__index__"):
        raise wrong(name, "a whole number", given)
    number = operator.index(given)
    if number < 0:
        raise ValueError(f"`{name}` must be a whole number from 0 on, not {number}")
    if number > sys.maxsize:
        raise ValueError(f"`{name}` is {number}: ask for less")
    return number


def path(name: str, given: Any) -> str:
    """The path of a file. A number is none: it would be a file that the process has open."""
    if not isinstance(given, (str, os.PathLike)):
        raise wrong(name, "the path of a file", given)
    return os.fspath(given)


def mapping(name: str, given: Any) -> dict[str, Any]:
    """A mapping from names; an absent one is empty."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise wrong(name, "a mapping from names", given)
    return {text(f"{name}: the name {key!r}", key): value for key, value in given.items()}


def names(name: str, given: Any) -> list[str]:
    """A name, or several."""
    if isinstance(given, str):
        return [given]
    if isinstance(given, (bytes, Mapping)) or not hasattr(given, "__iter__"):
        raise wrong(name, "a name or a list of names", given)
    return [text(f"{name}[{i}]", one) for i, one in enumerate(given)]


def counts(name: str, given: Any) -> list[int]:
    """Whole numbers; one alone stands for itself."""
    if isinstance(given, (str, bytes, Mapping)) or not hasattr(given, "__iter__"):
        return [count(name, given)]
    return [count(f"{name}[{i}]", one) for i, one in enumerate(given)]


def numbers(name: str, given: Any) -> npt.NDArray[np.float64]:
    """An array of real numbers. What numpy would make of gaps, imaginary parts and texts is refused."""
    wanted = "an array of real numbers"
    if isinstance(given, np.ma.MaskedArray):
        raise TypeError(f"`{name}` must be {wanted}, not a masked one: fill its gaps, `.filled(numpy.nan)`")
    if isinstance(given, (str, bytes, Mapping)) or given is None:
        raise wrong(name, wanted, given)
    try:
        array = np.asarray(given)
    except ValueError as error:
        raise ValueError(f"`{name}` must be {wanted} with rows of the same length: {error}") from None
    if array.dtype.kind == "O":
        for part in array.flat:
            if isinstance(part, (list, tuple)):
                raise ValueError(f"`{name}` must be {wanted} with rows of the same length")
            if isinstance(part, (bool, complex)) or not hasattr(part, "__float__"):
                raise TypeError(f"`{name}` must be {wanted}, not of {part!r}")
        try:
            array = array.astype(np.float64)
        except OverflowError as error:
            raise ValueError(f"`{name}` must be {wanted}: {error}") from None
    if array.dtype.kind not in "iuf":
        raise TypeError(f"`{name}` must be {wanted}, not of {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)


def wrenches(given: Any) -> dict[str, str] | None:
    """Wrenches as the command line takes them."""
    if given is None:
        return None
    return {frame: _wrench(frame, wrench) for frame, wrench in mapping("wrench", given).items()}


def _wrench(frame: str, given: Any) -> str:
    if isinstance(given, str):
        return given
    name = f'wrench["{frame}"]'
    if not hasattr(given, "__iter__"):
        raise wrong(name, "a text or a list of numbers", given)
    return ",".join(repr(float(part)) for part in numbers(name, given).ravel())
