"""How the cost of a study grows with its rows, on one core and on all: time per row, and the memory it takes.

    pip install linkwork pyarrow
    python benches/python/growth.py [most rows]

Each study runs in a process of its own, whose largest resident memory is counted when it ends; rows go to a file shard
by shard.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SHIPPED = Path(__file__).parents[2] / "mechanisms"


def one(rows: int) -> None:
    """A study of so many rows in this process."""
    import linkwork

    m = linkwork.load(SHIPPED / "four_bar.ron")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows.parquet"
        begun, worked = time.perf_counter(), time.process_time()
        linkwork.study_into(file, m, {"l2": (3, 5), "theta1": (0, 6.28)}, "phi1, transmission", samples=rows)
        spent, worked = time.perf_counter() - begun, time.process_time() - worked
        size = file.stat().st_size
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(json.dumps({"time": spent, "work": worked, "memory": memory, "size": size / 1e6}))


def main(most: int) -> None:
    """Prints the table in Markdown."""
    print("| rows | cores | time | on processors, per row | most memory | file |\n|---|---|---|---|---|---|")
    cores = sorted({1, os.cpu_count() or 1})
    rows = 1000
    while rows <= most:
        for threads in cores:
            environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
            command = [sys.executable, __file__, "--one", str(rows)]
            found = json.loads(subprocess.run(command, env=environment, capture_output=True, check=True).stdout)
            spent = found["time"]
            print(
                f"| {rows:.0e} | {threads} | {spent:.3g} s | {1e6 * found['work'] / rows:.3g} µs "
                f"| {found['memory']:.0f} MB | {found['size']:.3g} MB |",
                flush=True,
            )
        rows *= 10


if __name__ == "__main__":
    if "--one" in sys.argv:
        one(int(sys.argv[-1]))
    else:
        main(int(float(sys.argv[1])) if len(sys.argv) > 1 else 10_000_000)
