"""Studies that outgrow a machine."""

from __future__ import annotations

import hashlib
import importlib
import math
import os
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Callable

import numpy as np
import numpy.typing as npt

from . import _given, _linkwork
from ._given import Value, wrenches
from ._progress import Bar, Progress, bar
from ._reports import Fields

if TYPE_CHECKING:
    from . import Mechanism

Columns = dict[str, npt.NDArray[np.float64]]

#: The shards of a study that others work at, at least.
SHARDS = 64

#: The rows of a shard, at most.
ROWS = 1 << 15

#: Shards that are worked at before those before them are written.
AHEAD = 256


class Study(dict[str, npt.NDArray[np.float64]]):
    """Rows of a study: a mapping from names to numpy arrays, which ``pandas.DataFrame`` takes as it is.

    What is not determined is not a number.
    """

    #: The units of the columns; empty for what has none.
    units: dict[str, str]

    def __init__(self, columns: Mapping[str, npt.NDArray[np.float64]]) -> None:
        super().__init__()
        self._titles = list(columns)
        self.units = {}
        for title, values in columns.items():
            name, _, unit = title.partition(" (")
            self[name] = values
            self.units[name] = unit[:-1]

    def __reduce__(self) -> tuple[Any, ...]:
        return Study, (dict(zip(self._titles, self.values())),)

    def spread(self) -> dict[str, Fields]:
        """``mean``, ``deviation`` (standard), ``least`` and ``greatest`` of each column over ``rows`` that have it."""
        found = {}
        for name, values in list(self.items())[1:]:
            known = values[~np.isnan(values)]
            figures = (
                (known.mean(), known.std(ddof=min(1, len(known) - 1)), known.min(), known.max()) if len(known) else ()
            )
            named = zip(("mean", "deviation", "least", "greatest"), map(float, figures))
            found[name] = Fields({"rows": len(known), **dict(named)})
        return found

    def regions(self, grid: Sequence[int]) -> npt.NDArray[np.uint32]:
        """The number of the region of each row of a ``grid``, from 1: nodes beside each other where it assembles."""
        return _linkwork.regions(_given.counts("grid", grid), [bool(there) for there in self["assembled"]])

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the rows: to ``.csv`` as the command line does, to ``.parquet`` or ``.arrow`` by pyarrow."""
        _write(Path(_given.path("path", path)), len(self["row"]), iter([dict(zip(self._titles, self.values()))]))


def study(
    m: Mechanism,
    vary: Mapping[str, tuple[Value, Value]] | Sequence[str] = (),
    quantities: str | Sequence[str] = (),
    *,
    samples: int | npt.ArrayLike | None = None,
    latin: bool = False,
    grid: int | Sequence[int] | None = None,
    deviate: Mapping[str, Value] | None = None,
    executor: Executor | None = None,
    shards: int | None = None,
    keep: str | os.PathLike[str] | None = None,
    progress: bool | Progress | None = None,
    **given: Any,
) -> Study:
    """Quantities at many points of parameters and coordinates, as a mapping of arrays with a row for each point.

    ``vary={"l2": (3, 5), "theta1": ("0 deg", "360 deg")}`` with ``samples=1000`` takes as many points of Sobol's
    sequence, with ``latin=True`` of a Latin hypercube, with ``grid=[20, 36]`` every combination; ``vary=["l2"]`` with
    an array of ``samples`` takes its rows. ``deviate={"l2": 0.001}`` lets a parameter or a held coordinate deviate
    normally from its value, by this standard deviation (m or rad). ``quantities`` are those that ``sweep(report=...)``
    takes, and ``"assemblies"``, the number of real ones. All else is given as to :meth:`Mechanism.solve`, with
    ``rate``, ``wrench`` and ``load``.

    The study is worked out on all cores of this machine, or in ``shards`` by anything that follows
    :class:`concurrent.futures.Executor`: processes, ``dask.distributed.Client.get_executor()``, ``mpi4py.futures``,
    :mod:`linkwork.executors` for Ray and Spark. The rows are the same, to the bit. What is finished is kept in the
    folder ``keep`` and not worked out again.
    """
    asked = _Asked(m, vary, quantities, samples, latin, grid, deviate, executor, given)
    whole = _shards(shards) or (asked.shards() if executor or keep else 1)
    parts = list(asked.parts(whole, executor, keep, progress))
    return Study({title: np.concatenate([part[title] for part in parts]) for title in parts[0]})


def study_into(
    path: str | os.PathLike[str],
    m: Mechanism,
    vary: Mapping[str, tuple[Value, Value]] | Sequence[str] = (),
    quantities: str | Sequence[str] = (),
    *,
    samples: int | npt.ArrayLike | None = None,
    latin: bool = False,
    grid: int | Sequence[int] | None = None,
    deviate: Mapping[str, Value] | None = None,
    executor: Executor | None = None,
    shards: int | None = None,
    keep: str | os.PathLike[str] | None = None,
    progress: bool | Progress | None = None,
    **given: Any,
) -> None:
    """A :func:`study` whose rows go to a file shard by shard, so that they need not fit in memory.

    The name says how: ``.csv``, with the bytes of ``linkwork study``; ``.parquet`` or ``.arrow``, where pyarrow is
    installed. The file is there when it is whole.
    """
    asked = _Asked(m, vary, quantities, samples, latin, grid, deviate, executor, given)
    parts = asked.parts(_shards(shards) or asked.shards(), executor, keep, progress)
    file = Path(_given.path("path", path))
    try:
        _write(file, asked.count, parts)
    except KeyboardInterrupt:
        kept = "keep=FOLDER keeps shards as they are finished" if keep is None else f"finished shards are in {keep}"
        said = f"nothing is written to {file}; {kept}, and the same call goes on from there"
        raise KeyboardInterrupt(said) from None


def _shards(given: Any) -> int:
    return 0 if given is None else _given.count("shards", given)


def _mechanism(given: Any) -> Mechanism:
    if not hasattr(given, "_core"):
        raise _given.wrong("m", "a Mechanism", given)
    return given  # type: ignore[no-any-return]


class _Asked:
    """What a study asks."""

    def __init__(
        self,
        m: Mechanism,
        vary: Mapping[str, tuple[Value, Value]] | Sequence[str],
        quantities: str | Sequence[str],
        samples: int | npt.ArrayLike | None,
        latin: bool,
        grid: int | Sequence[int] | None,
        deviate: Mapping[str, Value] | None,
        executor: Executor | None,
        given: dict[str, Any],
    ) -> None:
        m = _mechanism(m)
        names = list(_given.mapping("vary", vary)) if isinstance(vary, Mapping) else _given.names("vary", vary)
        whole = not hasattr(samples, "__len__")
        rows = None if whole else _given.numbers("samples", samples)
        if rows is not None and rows.ndim == 1:
            rows = rows.reshape(-1, 1)
        if rows is None and names and not isinstance(vary, Mapping):
            raise TypeError("give the rows of values as an array: samples=...")
        if executor is not None and not hasattr(executor, "submit"):
            raise _given.wrong("executor", "an executor, which has `submit`", executor)
        if (samples is None) == (grid is None):
            raise TypeError("give either samples or a grid")
        options: dict[str, Any] = {"report": _given.names("quantities", quantities)}
        options["wrench"] = wrenches(given.pop("wrench", None))
        options.update((name, given.pop(name, None)) for name in ("rate", "load"))
        self._m = m
        self._put = m._given("study", given, options)
        ends = vary if isinstance(vary, Mapping) else dict.fromkeys(names, (0.0, 1.0))
        self._ranges: dict[str, Any] = dict(ends)
        self._deviate = _given.mapping("deviate", deviate)
        nodes = [] if grid is None else _given.counts("grid", grid)
        if grid is not None and not hasattr(grid, "__len__"):
            nodes *= len(names)
        latin = _given.flag("latin", latin)
        self._kind = "given" if rows is not None else "grid" if nodes else "latin" if latin else "sobol"
        self._counts = nodes or ([] if rows is not None else [_given.count("samples", samples)])
        self._rows = rows
        self.count = len(rows) if rows is not None else math.prod(self._counts)

    def shards(self) -> int:
        """As many as make the work even and each of them small."""
        return max(1, min(self.count, max(SHARDS, -(-self.count // ROWS))))

    def _part(self, shard: int, of: int) -> tuple[Any, ...]:
        rows = self._rows
        if rows is not None:
            rows = np.ascontiguousarray(rows[len(rows) * shard // of : len(rows) * (shard + 1) // of])
        # an array has its part only
        part = (shard + 1, of) if rows is None else (1, 1)
        return self._m, self._put, self._ranges, self._deviate, self._kind, self._counts, rows, part

    def parts(
        self,
        of: int,
        executor: Executor | None,
        keep: str | os.PathLike[str] | None,
        progress: bool | Progress | None,
    ) -> Iterator[Columns]:
        """The shards in their order."""
        if self._rows is not None:
            of = max(1, min(of, self.count))
        folder = None if keep is None else Path(_given.path("keep", keep))
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
        told = bar(progress)
        waiting: deque[Callable[[], Columns]] = deque()
        futures: deque[Future[Columns]] = deque()
        begun = first = 0
        try:
            for shard in range(of):
                while begun < of and len(waiting) < (AHEAD if executor else 1):
                    asked = self._part(begun, of)
                    kept = None if folder is None else folder / f"{_digest((*asked, begun, of))}.npz"
                    begun += 1
                    if kept is not None and kept.exists():
                        waiting.append(_Kept(kept))
                        first += 1
                    elif executor is not None:
                        future = executor.submit(_shard, *asked)
                        if kept is not None:
                            future.add_done_callback(_Keep(kept))
                        futures.append(future)
                        waiting.append(future.result)
                    else:
                        waiting.append(_Here(asked, told if of == 1 else None, kept))
                if isinstance(told, Bar):
                    told.known = first
                part = waiting.popleft()()
                # where an array was cut, each part counts its rows from the beginning
                row = next(iter(part))
                start = self.count * shard // of
                part[row] = np.arange(start, start + len(part[row]), dtype=np.float64)
                if of > 1:
                    told("shards", shard + 1, of)
                yield part
        finally:
            for future in futures:
                future.cancel()
            if isinstance(told, Bar):
                told.close()


class _Kept:
    """A shard that was finished before."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __call__(self) -> Columns:
        with np.load(self._path) as known:
            return dict(known)


class _Here:
    """A shard that this process works out when its turn comes."""

    def __init__(self, asked: tuple[Any, ...], told: Progress | Bar | None, kept: Path | None) -> None:
        self._asked, self._kept = (*asked, told), kept

    def __call__(self) -> Columns:
        found = _shard(*self._asked)
        if self._kept is not None:
            _save(self._kept, found)
        return found


class _Keep:
    """Keeps a shard as soon as it is finished."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def __call__(self, done: Future[Columns]) -> None:
        if not done.cancelled() and done.exception() is None:
            _save(self._path, done.result())


def _shard(
    m: Mechanism,
    put: dict[str, Any],
    ranges: dict[str, Any],
    deviate: dict[str, Any],
    kind: str,
    counts: list[int],
    rows: npt.NDArray[np.float64] | None,
    part: tuple[int, int],
    progress: Progress | Bar | None = None,
) -> Columns:
    """The rows of a shard: a function of what it is given, whoever calls it."""
    return dict(m._core.study(put, ranges, deviate, kind, counts, rows, part, progress))


def _digest(asked: tuple[Any, ...]) -> str:
    m, *rest = asked
    rows = [part.tobytes() if isinstance(part, np.ndarray) else part for part in rest]
    said = repr((_linkwork.__version__, m._made_of, rows))
    return hashlib.sha256(said.encode()).hexdigest()[:32]


def _save(path: Path, rows: Columns) -> None:
    """Whole or not at all."""
    part = path.with_suffix(f".{os.getpid()}.part")
    with open(part, "wb") as file:
        np.savez(file, **rows)  # type: ignore[arg-type, unused-ignore]
    os.replace(part, path)


def _write(path: Path, count: int, parts: Iterator[Columns]) -> None:
    """Whole or not at all."""
    ways: dict[str, Callable[[IO[bytes], int, Iterator[Columns]], None]] = {
        ".csv": _csv,
        ".parquet": _parquet,
        ".arrow": _arrow,
    }
    way = ways.get(path.suffix)
    if way is None:
        raise ValueError(f"`{path.name}` does not say how rows are written: its name ends with {', '.join(ways)}")
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        with open(part, "wb") as file:
            way(file, count, parts)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def _csv(file: IO[bytes], count: int, parts: Iterator[Columns]) -> None:
    for i, part in enumerate(parts):
        titles = [f"row of {count}", *list(part)[1:]]
        header, _, lines = _linkwork.csv(titles, list(part.values())).partition("\n")
        if i == 0:
            file.write(f"{header}\n".encode())
        file.write(lines.encode())


def _parquet(file: IO[bytes], _count: int, parts: Iterator[Columns]) -> None:
    _tables(parts, lambda _, schema: _pyarrow("pyarrow.parquet").ParquetWriter(file, schema))


def _arrow(file: IO[bytes], _count: int, parts: Iterator[Columns]) -> None:
    _tables(parts, lambda pa, schema: pa.ipc.new_file(file, schema))


def _pyarrow(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError("Parquet and Arrow are written by pyarrow: pip install pyarrow, or write .csv") from error


def _tables(parts: Iterator[Columns], begin: Callable[[Any, Any], Any]) -> None:
    pa = _pyarrow("pyarrow")
    kinds = {"row": pa.int64(), "assembled": pa.bool_()}
    writer: Any = None
    try:
        for part in parts:
            fields, arrays = [], []
            for title, values in part.items():
                name, _, unit = title.partition(" (")
                kind = kinds.get(name, pa.float64())
                fields.append(pa.field(name, kind, metadata={"unit": unit[:-1]} if unit else None))
                # what is not determined is absent
                arrays.append(pa.array(values, from_pandas=True).cast(kind))
            table = pa.Table.from_arrays(arrays, schema=pa.schema(fields))
            writer = writer or begin(pa, table.schema)
            writer.write_table(table)
    finally:
        if writer is not None:
            writer.close()
