"""`solve_many` of the Python module beside the same call in Rust, in turn on the same rows, on one core and on all.

    pip install linkwork
    cargo bench --bench many --no-run
    python benches/python/paired.py target/release/deps/many-<hash>

Prints the least time on the processor of many calls, and in brackets the least time that passed, which only a quiet
machine tells. The wheel is built with the `rustc-args` of pyproject.toml, the bench with those of a release.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time

import peers


def spent(process: int) -> int:
    """The time that all threads of a process were on a processor, in ns: its clock on Linux."""
    return time.clock_gettime_ns((~process << 3) | 2)


def paired(work: peers.Work, count: int, rounds: int) -> list[float]:
    """The least times of a row in Python and in Rust, on the processor and passed."""
    rows = work.rows(count)
    with tempfile.NamedTemporaryFile() as file:
        rows.tofile(file.name)
        command = [sys.argv[1], str(work.file), file.name, *work.driven]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as rust:
            assert rust.stdin and rust.stdout
            times = []
            for _ in range(rounds):
                begun, here = time.perf_counter_ns(), spent(os.getpid())
                found = work.m.solve_many(rows)
                python, passed = spent(os.getpid()) - here, time.perf_counter_ns() - begun
                assert found["reached"].all()
                del found
                there = spent(rust.pid)
                rust.stdin.write("\n")
                other = int(rust.stdout.readline())
                times.append((python, spent(rust.pid) - there, passed, other))
    return [min(of) / count for of in zip(*times)]


def main(threads: int) -> None:
    """Prints rows of the table in Markdown."""
    os.environ["RAYON_NUM_THREADS"] = str(threads)
    for work in peers.works():
        for count, rounds in ((100_000, 60), (1_000_000, 8)):
            python, rust, passed, other = paired(work, count, rounds)
            times = f"{python:.1f} ns ({passed:.1f}) | {rust:.1f} ns ({other:.1f}) | {python / rust:.3f}"
            print(f"| {work.title} | {count:.0e} | {threads} | {times} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(int(sys.argv[2]))
    else:
        print("| | rows | cores | Python | Rust | ratio |\n|---|---|---|---|---|---|", flush=True)
        for cores in sorted({1, os.cpu_count() or 1}):
            # a pool of threads is for good
            subprocess.run([sys.executable, __file__, sys.argv[1], str(cores)], check=True)
