#!/usr/bin/env python3
"""The same bytes on every machine: answers of the program built for other targets, against those of this one.

JSON of `solve`, `assemblies`, `mobility` and a sweep of every shipped file is compared byte by byte. The program itself takes
no function from the platform's library, but the decompositions of nalgebra take the length of a pair of numbers (hypot) from
it, which libraries round differently: numbers that differ in their last digits only are listed and are no failure. A target
that cannot be built or run here is named and left out. With names of files as arguments only these are asked about; PROGRAM is the program
of this machine, TARGETS the folder the others are built in.
"""

import concurrent.futures
import glob
import json
import os
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.environ.get("PROGRAM", os.path.join(ROOT, "target/debug/linkwork"))
TARGETS = os.environ.get("TARGETS", os.path.join(ROOT, "target/targets"))
# seconds for one question; one that takes longer is left out on both sides
LONGEST = 300
# relative to the larger of a number and one
LAST_DIGITS = 1e-12


def target(name, environment=None, runners=None, needs=()):
    return {"name": name, "environment": environment or {}, "runners": runners, "needs": needs}


ALL = [
    target("x86_64-unknown-linux-musl"),
    target(
        "aarch64-unknown-linux-musl",
        {
            "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_LINKER": "rust-lld",
            "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_RUSTFLAGS": "-Clinker-flavor=ld.lld",
        },
        runners=["qemu-aarch64", "qemu-aarch64-static"],
    ),
]


def said(*command):
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stdout


def left_out(of):
    """The reason for which a target is left out; none if it can be built and run."""
    library = os.path.join(said("rustc", "--print", "sysroot").strip(), "lib/rustlib", of["name"])
    if not os.path.isdir(library):
        return "its standard library is not here (rustup target add)"
    if of["runners"] and not any(map(shutil.which, of["runners"])):
        return "no " + " or ".join(of["runners"]) + " is here (Debian's qemu-user)"
    return None


def built(of):
    """The command that runs the program of a target."""
    print(f"building for {of['name']}", flush=True)
    command = ["cargo", "build", "--locked", "--quiet", "--bin", "linkwork"]
    command += ["--target", of["name"], "--target-dir", TARGETS]
    subprocess.run(command, cwd=ROOT, check=True, env={**os.environ, **of["environment"]})
    program = os.path.join(TARGETS, of["name"], "debug/linkwork")
    return [path for path in map(shutil.which, of["runners"] or []) if path][:1] + [program]


def questions(file):
    """What is asked about a file: its motion too, from home, of its first actuated joint if more than one can be chosen."""
    overview = json.loads(said(PROGRAM, "check", file, "--format", "json"))
    sweep = ["sweep", file, "--follow", "--steps", "24"]
    driven = [joint for joint in overview["joints"] if joint["role"] == "Actuated"]
    if len(driven) > 1:
        joint = driven[0]
        low, high = joint["limits"] or [joint["home"] - 1, joint["home"] + 1]
        from_, to = joint["home"], max(low, min(high, joint["home"] + 0.1))
        to = to if to != from_ else max(low, from_ - 0.1)
        sweep = ["sweep", file, "--input", f"{joint['name']}={from_!r}..{to!r}", "--steps", "24"]
    return [["solve", file], ["assemblies", file], ["mobility", file], sweep]


def answer(program, question):
    """Exit code and text, or none if it takes too long."""
    command = [*program, *question, "--format", "json"]
    try:
        run = subprocess.run(command, capture_output=True, cwd=ROOT, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return None
    return run.returncode, run.stdout


def alike(a, b):
    """True if two values of JSON are the same but for the last digits of numbers."""
    if all(isinstance(x, (int, float)) for x in (a, b)):
        return abs(a - b) <= LAST_DIGITS * max(1.0, abs(a), abs(b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(alike(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(alike, a, b))
    return a == b


def differs(pair):
    """A sentence on the first difference between two answers, and true if it is more than that of last digits; none if they
    are the same bytes."""
    (program, question), known = pair
    found = answer(program, question)
    if known is None or found is None or known == found:
        return None
    lines = zip(*[text.decode(errors="replace").splitlines() for _, text in (known, found)])
    line = next(((a.strip(), b.strip()) for a, b in lines if a != b), ("", ""))
    same = known[0] == found[0] and alike(*[json.loads(text or "null") for _, text in (known, found)])
    return f"{' '.join(question)}: exit {known[0]} and {found[0]}, `{line[0]}` and `{line[1]}`", not same


def main():
    found = glob.glob(os.path.join(ROOT, "mechanisms/*.ron")) + glob.glob(os.path.join(ROOT, "mechanisms/axes/*.ron"))
    files = sys.argv[1:] or [os.path.relpath(file, ROOT) for file in sorted(found)]
    here = []
    for of in ALL:
        reason = left_out(of)
        if reason:
            print(f"note: answers are not compared with {of['name']}: {reason}")
        else:
            here.append(of)
    if not here:
        return 0
    programs = [(of["name"], built(of)) for of in here]
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        asked = [question for file in files for question in questions(file)]
        known = list(pool.map(lambda question: answer([PROGRAM], question), asked))
        for name, program in programs:
            pairs = zip([(program, question) for question in asked], known)
            differences = [found for found in pool.map(differs, pairs) if found]
            wrong += sum(failed for _, failed in differences)
            print(f"{name}: {len(asked) - len(differences)} of {len(asked)} answers have the same bytes")
            for text, failed in differences:
                print(f"  {'DIFFERENT' if failed else 'last digits'}: {text}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
