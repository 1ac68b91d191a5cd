"""Answers."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _linkwork

Column = Union[npt.NDArray[np.float64], list[str]]


class Fields:
    """Named values as attributes; :meth:`to_dict` has them as plain Python data."""

    _data: dict[str, Any]

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        data = self.to_dict()
        if name not in data:
            raise AttributeError(f"there is no `{name}`; there are {', '.join(data)}")
        return _fields(data[name])

    def __getitem__(self, name: str) -> Any:
        return _fields(self.to_dict()[name])

    def __iter__(self) -> Iterator[Any]:
        return iter(self.to_dict())

    def __len__(self) -> int:
        return len(self.to_dict())

    def __contains__(self, name: object) -> bool:
        return name in self.to_dict()

    def keys(self) -> Any:
        """The names."""
        return self.to_dict().keys()

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.to_dict()})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fields) and self.to_dict() == other.to_dict()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """The values as plain Python data."""
        return self._data


def _fields(value: Any) -> Any:
    if isinstance(value, dict):
        return Fields(value)
    if isinstance(value, list):
        return [_fields(part) for part in value]
    return value


class _Kept:
    """What a report says, without the report."""

    def __init__(self, core: _linkwork.Report | _Kept) -> None:
        self._said = (core.json(), core.text(), core.html(), core.markdown())
        self.yes: bool = core.yes
        self.warnings: list[str] = core.warnings

    def json(self) -> str:
        return self._said[0]

    def text(self) -> str:
        return self._said[1]

    def html(self) -> str:
        return self._said[2]

    def markdown(self) -> str:
        return self._said[3]


class Report(Fields):
    """An answer.

    Its fields are attributes, named as in the JSON of the command line, in m, rad, N and s. It prints as the command
    line prints it, is true if the answer is yes or at least not no, and shows itself as a page in a notebook.
    """

    def __init__(self, core: _linkwork.Report | _Kept) -> None:
        self._core = core
        self._read: dict[str, Any] | None = None

    def to_dict(self) -> dict[str, Any]:
        """The fields as plain Python data."""
        if self._read is None:
            self._read = json.loads(self._core.json())
        return self._read

    def __bool__(self) -> bool:
        return self._core.yes

    @property
    def complex_count(self) -> int:
        """The number of complex assemblies, of which the real ones are some."""
        return int(self.complex)

    @property
    def warnings(self) -> list[str]:
        """What must not be overlooked."""
        return self._core.warnings

    def __iter__(self) -> Iterator[Any]:
        """The assemblies, where they are asked for; otherwise the names of the fields."""
        data = self.to_dict()
        return iter(self.assemblies) if "assemblies" in data else iter(data)

    def __len__(self) -> int:
        """The number of assemblies, where they are asked for; otherwise of fields."""
        data = self.to_dict()
        return len(data.get("assemblies", data))

    def to_json(self) -> str:
        """The answer as the command line prints it with ``--format json``."""
        return self._core.json()

    def to_markdown(self) -> str:
        """The answer as the command line prints it with ``--format markdown``."""
        return self._core.markdown()

    def __repr__(self) -> str:
        return self._core.text().rstrip("\n")

    def _repr_html_(self) -> str:
        return self._core.html()

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (_Kept(self._core),)


class Rows(Report, dict[str, Column]):
    """An answer with rows: a mapping from names to numpy arrays, which ``pandas.DataFrame`` takes as it is.

    Columns of words are lists of texts. Numbers that are absent are not a number.
    """

    #: The units of the columns; empty for what has none.
    units: dict[str, str]

    def __init__(self, core: _linkwork.Report | _Kept, columns: list[tuple[str, Column]]) -> None:
        Report.__init__(self, core)
        self._columns = columns
        self.units = {}
        for title, values in columns:
            name, _, unit = title.partition(" (")
            dict.__setitem__(self, name, values)
            self.units[name] = unit[:-1]

    __getitem__ = dict.__getitem__
    __iter__ = dict.__iter__
    __len__ = dict.__len__
    __contains__ = dict.__contains__
    keys = dict.keys
    __bool__ = Report.__bool__

    def __eq__(self, other: object) -> bool:
        if not (isinstance(other, Rows) and Report.__eq__(self, other) and list(self) == list(other)):
            return False
        return all(
            one == other[name] if isinstance(one, list) else np.array_equal(one, other[name], equal_nan=True)
            for name, one in self.items()
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (_Kept(self._core), self._columns)

    def __repr__(self) -> str:
        return Report.__repr__(self)


class Many(dict[str, npt.NDArray[Any]]):
    """Configurations for rows of held values: a mapping from names to numpy arrays, which ``pandas.DataFrame`` takes.

    ``"reached"`` is true for rows that were reached; the others are not numbers.
    """

    #: Why rows were not reached, by their numbers.
    reasons: dict[int, str]
    #: The units of the columns; empty for what has none.
    units: dict[str, str]
    #: Names of the rows and columns of each Jacobian; empty unless it was asked for.
    outputs: list[str]
    inputs: list[str]

    def __init__(
        self,
        titles: list[str],
        found: npt.NDArray[np.float64],
        reached: npt.NDArray[np.bool_],
        lost: list[tuple[int, str]],
        quantities: tuple[list[tuple[str, str]], npt.NDArray[np.float64]] | None,
        jacobians: tuple[list[str], list[str], npt.NDArray[np.float64]] | None,
    ) -> None:
        super().__init__({title: found[:, i] for i, title in enumerate(titles)})
        self["reached"] = reached
        self.reasons = dict(lost)
        self.units = {}
        self.outputs, self.inputs = [], []
        if quantities is not None:
            for i, (name, unit) in enumerate(quantities[0]):
                self[name] = quantities[1][:, i]
                self.units[name] = "" if unit == "1" else unit
        if jacobians is not None:
            self.outputs, self.inputs, self["jacobian"] = jacobians

    def __repr__(self) -> str:
        rows, reached = len(self["reached"]), int(self["reached"].sum())
        names = ", ".join(self)
        first = next(iter(self.reasons.items()), None)
        lost = "" if first is None else f"; row {first[0]}: {first[1]}"
        return f"<{reached} of {rows} rows reached{lost}; arrays: {names}>"
