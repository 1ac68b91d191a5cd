"""The parts of a mechanism file by their names in the file.

>>> from linkwork.parts import Actuated, Chain, Revolute, Tx
>>> Tx("l2")
Tx("l2")
>>> Chain(rows=[{"theta": "theta1"}, {"a": 2, "theta": "phi2"}], tip=[Tx(4)])
Chain(rows: [(theta: "theta1"), (a: 2, theta: "phi2")], tip: [Tx(4)])

``from linkwork.parts import *`` has those of joints, chains and closures. Every name can be imported; the reader of
files knows which there are, and refuses the others with a suggestion.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Callable

#: The names of parts that files have.
_NAMES = (
    ("Actuated", "Passive", "Modified", "Standard", "Chain", "Platform", "Rx", "Ry", "Rz", "Tx", "Ty", "Tz")
    + ("Revolute", "Prismatic", "Helical", "Spherical", "Universal", "Cylindrical", "Planar", "Rigid", "Fixed")
    + ("Distance", "Coupling")
)


class Part:
    """A name with what stands in parentheses behind it."""

    def __init__(self, name: str, /, *parts: Any, **fields: Any) -> None:
        self.name = name
        self.parts = parts
        self.fields = fields

    def __repr__(self) -> str:
        return written(self)


def __getattr__(name: str) -> Callable[..., Part]:
    if not name[:1].isupper():
        raise AttributeError(f"a part begins with a capital letter: there is no `{name}`")

    def part(*parts: Any, **fields: Any) -> Part:
        return Part(name, *parts, **fields)

    return part


__all__ = [*_NAMES]


def __dir__() -> list[str]:
    return sorted(["Part", "written", *_NAMES])


def written(value: Any, lines: int = 0) -> str:
    """A value as a mechanism file writes it; ``lines`` levels of fields stand on lines of their own.

    Mappings in lists are rows and other structures with fields; other mappings name things.

    >>> written({"a": 0.5, "b": "30 deg"})
    '{"a": 0.5, "b": "30 deg"}'
    >>> written([{"a": 2, "theta": "phi2"}, (0, 0, 1), Part("Tx", 4)])
    '[(a: 2, theta: "phi2"), (0, 0, 1), Tx(4)]'
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
        value = tuple(value) if isinstance(value, list) else value
    if isinstance(value, Part):
        fields = [f"{name}: {written(part, lines - 1)}" for name, part in value.fields.items() if part is not None]
        parts = [written(part) for part in value.parts] + fields
        return value.name + (_among("(", parts, ")", lines) if parts else "")
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{escaped}"'
    if isinstance(value, Mapping):
        named = [f"{written(str(name))}: {written(part, lines - 1)}" for name, part in value.items()]
        return _among("{", named, "}", lines)
    if isinstance(value, tuple):
        return _among("(", [written(part) for part in value], ")", 0)
    if isinstance(value, list):
        return _among("[", [_row(part) for part in value], "]", 0)
    return repr(value)


def _row(value: Any) -> str:
    return written(Part("", **value)) if isinstance(value, Mapping) else written(value)


def _among(opening: str, parts: list[str], closing: str, lines: int) -> str:
    if lines <= 0 or not parts:
        return opening + ", ".join(parts) + closing
    inner = "".join(f"{part},\n" for part in parts)
    indented = "".join(f"    {line}\n" for line in inner.splitlines())
    return f"{opening}\n{indented}{closing}"
