#!/usr/bin/env python3
"""Compares answers of the program on other processors with those on this one, byte by byte.

JSON of `solve`, `assemblies`, `mobility` and a sweep of every shipped file: every difference is a failure. Compared are this
program on an x86-64 processor without AVX and FMA, and the program built for 64-bit Arm, with another C library (musl), both
emulated by Debian's qemu-user; `tests/page/native.mjs` compares the solver in the page, to 1e-12. What cannot be built or run
here is named and left out. Names of files as arguments ask about these only. PROGRAM is the program of this machine, TARGETS
the folder the other is built in, PROFILE its profile.
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
PROFILE = os.environ.get("PROFILE", "dev")
ARM = "aarch64-unknown-linux-musl"
# seconds of the processor that this machine may take for one question: emulated it takes about ten times as long
LONGEST = 4


def said(*command):
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stdout


def emulator(processor):
    """The path of qemu for a processor, or none."""
    return shutil.which(f"qemu-{processor}") or shutil.which(f"qemu-{processor}-static")


def arm():
    """The path of the program built for Arm, or the reason for which there is none."""
    if not emulator("aarch64"):
        return None, "no qemu-aarch64 is here"
    if not os.path.isdir(os.path.join(said("rustc", "--print", "sysroot").strip(), "lib/rustlib", ARM)):
        return None, "its standard library is not here (rustup target add)"
    linker = "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_LINKER"
    flags = "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_RUSTFLAGS"
    environment = {**os.environ, linker: "rust-lld", flags: "-Clinker-flavor=ld.lld"}
    command = ["cargo", "build", "--locked", "--quiet", "--bin", "linkwork", "--profile", PROFILE]
    command += ["--target", ARM, "--target-dir", TARGETS]
    subprocess.run(command, cwd=ROOT, check=True, env=environment)
    return os.path.join(TARGETS, ARM, "debug" if PROFILE == "dev" else PROFILE, "linkwork"), None


def others():
    """Names of machines, and the commands that run the program as there."""
    found = []
    x86, name = emulator("x86_64"), "an x86-64 without AVX and FMA"
    if x86:
        found.append((name, [x86, "-cpu", "Nehalem", PROGRAM]))
    else:
        print(f"note: answers are not compared with {name}: no qemu-x86_64 is here")
    program, reason = arm()
    if program:
        found.append((ARM, [emulator("aarch64"), program]))
    else:
        print(f"note: answers are not compared with {ARM}: {reason}")
    return found


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


def answer(command, question):
    """Exit code and text."""
    run = subprocess.run([*command, *question, "--format", "json"], capture_output=True, cwd=ROOT)
    return run.returncode, run.stdout


def asked(question):
    """The answer of this machine, or none where it takes long."""
    limit = ["prlimit", f"--cpu={LONGEST}", PROGRAM]
    code, text = answer(limit, question)
    return None if code < 0 else (code, text)


def difference(command, question, known):
    """A sentence on the first difference between two answers; none if they are the same bytes."""
    found = answer(command, question)
    if known == found:
        return None
    lines = zip(*[text.decode(errors="replace").splitlines() for _, text in (known, found)])
    line = next(((a.strip(), b.strip()) for a, b in lines if a != b), ("", ""))
    return f"{' '.join(question)}: exit {known[0]} and {found[0]}, `{line[0]}` and `{line[1]}`"


def main():
    shipped = glob.glob(os.path.join(ROOT, "mechanisms/*.ron")) + glob.glob(os.path.join(ROOT, "mechanisms/axes/*.ron"))
    files = sys.argv[1:] or [os.path.relpath(file, ROOT) for file in sorted(shipped)]
    wrong = 0
    machines = others()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        every = [question for of in pool.map(questions, files) for question in of]
        known = [(question, found) for question, found in zip(every, pool.map(asked, every)) if found]
        if len(known) < len(every):
            print(f"{len(every) - len(known)} of {len(every)} questions take more than {LONGEST} s and are left out")
        for name, command in machines:
            found = [text for text in pool.map(lambda pair: difference(command, *pair), known) if text]
            wrong += len(found)
            print(f"{name}: {len(known) - len(found)} of {len(known)} answers have the same bytes", flush=True)
            for text in found:
                print(f"  {text}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
