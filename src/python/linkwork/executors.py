"""Ray and Spark as executors of studies.

All else that works at shards follows :class:`concurrent.futures.Executor` itself. A task is tried again where the
worker that had it dies: by Ray three times, by Spark as often as its master says, ``local[2,4]`` four times.
"""

from __future__ import annotations

from concurrent.futures import Executor, Future, ThreadPoolExecutor
from typing import Any, Callable


class Ray(Executor):
    """The cluster to which ``ray.init()`` has connected."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """A task of Ray for each call."""
        import ray  # type: ignore[import-untyped, import-not-found, unused-ignore]

        future: Future[Any] = ray.remote(fn).remote(*args, **kwargs).future()
        return future


class Spark(ThreadPoolExecutor):
    """The cluster of a ``SparkContext``, with as many jobs at a time as it has cores."""

    def __init__(self, context: Any) -> None:
        super().__init__(context.defaultParallelism)
        self._context = context

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """A job of Spark for each call."""

        def call(_: Any) -> Any:
            return fn(*args, **kwargs)

        return super().submit(lambda: self._context.parallelize([0], 1).map(call).first())
