"""Studies that outgrow a machine."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _linkwork
from ._progress import Bar, Progress, bar

if TYPE_CHECKING:
    from . import Mechanism

Value = Union[float, str]
Wrench = Union[str, Sequence[float]]
Rows = dict[str, npt.NDArray[np.float64]]

#: The shards of a study that others work at.
SHARDS = 64


def study(
    m: Mechanism,
    vary: Mapping[str, tuple[Value, Value]] | Sequence[str],
    quantities: str | Sequence[str] = (),
    *,
    samples: int | npt.ArrayLike | None = None,
    latin: bool = False,
    grid: int | Sequence[int] | None = None,
    executor: Executor | None = None,
    shards: int | None = None,
    keep: str | os.PathLike[str] | None = None,
    progress: bool | Progress | None = None,
    **given: Any,
) -> Rows:
    """Quantities at many points of parameters and coordinates, as a mapping of arrays with a row for each point.

    ``vary={"l2": (3, 5), "theta1": ("0 deg", "360 deg")}`` with ``samples=1000`` takes as many points of Sobol's
    sequence, with ``latin=True`` of a Latin hypercube, with ``grid=[20, 36]`` every combination; ``vary=["l2"]`` with
    an array of ``samples`` takes its rows. ``quantities`` are those that ``sweep(report=...)`` takes, and
    ``"assemblies"``, the number of real ones. All else is given as to :meth:`Mechanism.solve`, with ``rate``,
    ``wrench`` and ``load``.

    The study is worked out on all cores of this machine, or in ``shards`` by anything that follows
    :class:`concurrent.futures.Executor`: processes, ``dask.distributed.Client.get_executor()``, ``mpi4py.futures``.
    The rows are the same, to the bit. What is finished is kept in the folder ``keep`` and not worked out again.
    """
    names = list(vary)
    rows = None if samples is None or isinstance(samples, (int, np.integer)) else np.asarray(samples, dtype=np.float64)
    if rows is not None and rows.ndim == 1:
        rows = rows.reshape(-1, 1)
    if rows is None and not isinstance(vary, Mapping):
        raise TypeError("give the rows of values as an array: samples=...")
    if (samples is None) == (grid is None):
        raise TypeError("give either samples or a grid")
    options: dict[str, Any] = {"report": [quantities] if isinstance(quantities, str) else list(quantities)}
    options["wrench"] = wrenches(given.pop("wrench", None))
    options.update((name, given.pop(name, None)) for name in ("rate", "load"))
    put = m._given("study", given, options)
    ends = vary if isinstance(vary, Mapping) else dict.fromkeys(names, (0.0, 1.0))
    ranges: list[tuple[str, tuple[Value, ...]]] = [(name, tuple(ends[name])) for name in names]
    nodes = [grid] * len(names) if isinstance(grid, (int, np.integer)) else list(grid or [])
    kind = "given" if rows is not None else "grid" if nodes else "latin" if latin else "sobol"
    counts = nodes or ([] if rows is not None else [int(np.asarray(samples))])
    of = shards or (SHARDS if executor or keep else 1)
    if rows is not None:
        of = max(1, min(of, len(rows)))
    folder = None if keep is None else Path(keep)
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    told = bar(progress)
    waiting: dict[int, Future[Rows]] = {}
    found: dict[int, Rows] = {}
    try:
        for shard in range(of):
            part = None if rows is None else _part(rows, shard, of)
            asked = (m, put, ranges, kind, counts, part, shard, of)
            kept = None if folder is None else folder / f"{_digest(asked)}.npz"
            if kept is not None and kept.exists():
                with np.load(kept) as known:
                    found[shard] = dict(known)
            elif executor is not None:
                waiting[shard] = executor.submit(_shard, *asked)
                if kept is not None:
                    waiting[shard].add_done_callback(_Keep(kept))
            else:
                found[shard] = _shard(*asked, progress=told if of == 1 else None)
                if kept is not None:
                    _save(kept, found[shard])
            if executor is None and of > 1:
                told("shards", shard + 1, of)
        for shard, future in waiting.items():
            found[shard] = future.result()
            told("shards", len(found), of)
    except BaseException:
        for future in waiting.values():
            future.cancel()
        raise
    finally:
        if isinstance(told, Bar):
            told.close()
    whole = {name: np.concatenate([found[shard][name] for shard in range(of)]) for name in found[0]}
    whole["row"] = np.arange(len(whole["row"]), dtype=np.float64)
    return whole


def wrenches(given: Mapping[str, Wrench] | None) -> dict[str, str] | None:
    """Wrenches as the command line takes them."""
    if given is None:
        return None
    return {
        frame: wrench if isinstance(wrench, str) else ",".join(repr(float(part)) for part in wrench)
        for frame, wrench in given.items()
    }


def _part(rows: npt.NDArray[np.float64], shard: int, of: int) -> npt.NDArray[np.float64]:
    return np.ascontiguousarray(rows[len(rows) * shard // of : len(rows) * (shard + 1) // of])


def _shard(
    m: Mechanism,
    put: dict[str, Any],
    ranges: list[tuple[str, tuple[Value, ...]]],
    kind: str,
    counts: list[int],
    rows: npt.NDArray[np.float64] | None,
    shard: int,
    of: int,
    progress: Progress | Bar | None = None,
) -> Rows:
    """The rows of a shard: a function of what it is given, whoever calls it."""
    # an array has its part only
    part = (1, 1) if kind == "given" else (shard + 1, of)
    columns = m._core.study(put, ranges, kind, counts, rows, part, progress)
    return {title.partition(" (")[0]: values for title, values in columns}


def _digest(asked: tuple[Any, ...]) -> str:
    m, *rest = asked
    rows = [part.tobytes() if isinstance(part, np.ndarray) else part for part in rest]
    said = repr((_linkwork.__version__, m._made_of, rows))
    return hashlib.sha256(said.encode()).hexdigest()[:32]


class _Keep:
    def __init__(self, path: Path) -> None:
        self._path = path

    def __call__(self, done: Future[Rows]) -> None:
        if not done.cancelled() and done.exception() is None:
            _save(self._path, done.result())


def _save(path: Path, rows: Rows) -> None:
    """Whole or not at all."""
    part = path.with_suffix(f".{os.getpid()}.part")
    with open(part, "wb") as file:
        np.savez(file, **rows)  # type: ignore[arg-type, unused-ignore]
    os.replace(part, path)
