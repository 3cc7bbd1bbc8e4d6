#!/usr/bin/env python3
"""Counts the instructions of the most expensive kernels with callgrind (Debian: valgrind), which does not depend on
other work of the machine.

    tools/bench/instructions.py [--write] [BUILD]

BUILD (build/release) has orthodyn_bench (cmake -D ORTHODYN_BENCH=ON). Prints a table beside the counts of
tools/bench/instructions.json; exits with 1 if a kernel needs over 10 % more. --write replaces these counts. Recorded
counts hold for one compiler and one set of vector instructions; without a matching record nothing is compared.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

RECORD = Path(__file__).with_name("instructions.json")
MOST_GROWTH = 1.1
# callgrind's pattern for the functions of tools/bench/kernels.cc that run a kernel. It counts their callees, too.
MEASURED = "*orthodyn::bench::(anonymous namespace)::*(benchmark::State&, orthodyn::bench::BentBeam const&)"
KERNELS = (
    "force/2,700",
    "tangent/2,700",
    "outputs/2,700",
    "force, quadratic elements/6,480",
    "tangent, quadratic elements/6,480",
    "outputs, quadratic elements/6,480",
    "factorisation/4,005 quadratic",
    "factorisation, single precision/4,005 quadratic",
    "solve/4,005 quadratic",
    "solve, single precision/4,005 quadratic",
)


class CountError(Exception):
    pass


def counted(bench, kernel, calls):
    """Instructions of so many calls with their set-up, and the machine as orthodyn_bench tells it."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", f"--toggle-collect={MEASURED}",
                   str(bench), "--filter", f"^{kernel}/", "--repetitions", "1", "--calls", str(calls)]
        done = subprocess.run(command, capture_output=True, text=True)
        found = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or not found:
            raise CountError(f"{kernel}: {' '.join(command)} failed:\n{done.stderr.strip()[-2000:]}")
    return int(found[1]), done.stdout


def instructions(bench, kernel):
    """Per call, without the set-up and the first call."""
    first, _ = counted(bench, kernel, 1)
    third, told = counted(bench, kernel, 3)
    if third <= first:
        raise CountError(f"{kernel}: no instructions were counted in {MEASURED}")
    return (third - first) / 2, told


def key_of(told):
    vectors = re.search(r'"vectors":"([^"]*)"', told)
    compiler = re.search(r"^(\w+ \d+)[.\d]* -", told, re.MULTILINE)
    if not vectors or not compiler:
        raise CountError("orthodyn_bench does not tell vectors and compiler")
    return f"{vectors[1]}, {compiler[1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default="build/release", help="build folder with orthodyn_bench")
    parser.add_argument("--write", action="store_true", help=f"write the counts to {RECORD.name}")
    options = parser.parse_args()
    bench = Path(options.build) / "orthodyn_bench"
    if not bench.exists():
        sys.exit(f"error: {bench} is missing; build it: cmake -D ORTHODYN_BENCH=ON, target orthodyn_bench")
    record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    counts, key, grown = {}, None, []
    try:
        for kernel in KERNELS:
            counts[kernel], told = instructions(bench, kernel)
            if key is None:
                key = key_of(told)
                print(f"{key}\n{'kernel':<52}{'instructions':>14}{'of recorded':>13}")
            before = record.get(key, {}).get(kernel)
            ratio = counts[kernel] / before if before else None
            print(f"{kernel:<52}{counts[kernel]:>14,.0f}{f'{ratio:.3f}' if ratio else '-':>13}", flush=True)
            if ratio and ratio > MOST_GROWTH:
                grown.append(kernel)
    except CountError as error:
        sys.exit(f"error: {error}")
    if options.write:
        record[key] = {kernel: round(count) for kernel, count in counts.items()}
        RECORD.write_text(json.dumps(record, indent=1) + "\n")
        print(f"written to {RECORD}")
    elif key not in record:
        print(f"no counts are recorded for {key}; --write adds them")
    elif grown:
        sys.exit(f"error: over 10 % more instructions: {', '.join(grown)}")


if __name__ == "__main__":
    main()
