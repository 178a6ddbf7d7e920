#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Feeds every reader with damaged files and counts by kind what became of them: read, refused with a message, stopped
(read, and what was made of it ended with a message). What crashes, hangs or takes memory is named with its trial and
the command that repeats it; the inputs behind it are tried all the same.

Usage: fuzz.py [FUZZ] [--trials 10000] [--first 0] [--jobs 2] [--only FILTER] [--chunk 500]
FUZZ: the executable, default build/fuzz/tests/bin/fuzz, under sanitizers:
    cmake --preset fuzz && cmake --build --preset fuzz --target fuzz
Limits of an input: 60 s of processor time and 1000 MB (tests/fuzz/trials.hpp); of one allocation 1000 MB and of a
process 3000 MB (AddressSanitizer). Exit code 1 if there are faults.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# malloc that asks for too much gives NULL, which libraries in C test; operator new ends the process.
SANITIZER = "detect_leaks=0:max_allocation_size_mb=1000:hard_rss_limit_mb=3000:allocator_may_return_null=1"
# Tests of numbered inputs, and the environment variable that says how many: the others have their own numbers.
NUMBERED = ("CaseFuzz", "MaterialFuzz", "ForeignFiles", "PotentialFuzz", "PlanFuzz", "StoreFuzz.DamagedStores")
COUNTS = re.compile(r"^(.+): (\d+) read, (\d+) refused, (\d+) stopped, (\d+) faulty; slowest: trial (\d+), ([\d.]+) s$",
                    re.MULTILINE)
WALL = 7200.0  # s for a chunk: for what waits without taking processor time


def tests_of(fuzz, only):
    """Names of the tests of the executable, those that the filter selects."""
    listed = subprocess.run([fuzz, "--gtest_list_tests", f"--gtest_filter={only}"], capture_output=True, text=True,
                            check=True, env=environment())
    names, suite = [], ""
    for line in listed.stdout.splitlines():
        if not line.startswith(" "):
            suite = line.strip() if line.rstrip().endswith(".") else ""
        elif suite:
            names.append(suite + line.split()[0])
    return names


def environment(first=0, trials=0):
    return dict(os.environ, WHIPPLE_FUZZ_FIRST=str(first), WHIPPLE_FUZZ_TRIALS=str(trials), WHIPPLE_FUZZ_NAMES="1",
                ASAN_OPTIONS=SANITIZER, UBSAN_OPTIONS="print_stacktrace=1", OMP_NUM_THREADS="1",
                OMP_WAIT_POLICY="passive", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def run_chunk(fuzz, test, first, trials):
    """Runs some trials of a test. Returns the counts by kind and a text for every fault."""
    counts, faults = [], []
    end = first + trials
    while first < end:
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile("w+", errors="replace") as errors:
            try:
                done = subprocess.run([fuzz, f"--gtest_filter={test}", "--gtest_brief=1"], stdout=subprocess.PIPE,
                                      stderr=errors, text=True, errors="replace", timeout=WALL, check=False,
                                      env=environment(first, end - first) | {"TMPDIR": folder})
                code, output = done.returncode, done.stdout
            except subprocess.TimeoutExpired as expired:
                code, output = 124, (expired.stdout or b"").decode(errors="replace")
            errors.seek(0)
            messages = errors.read()
        counts += COUNTS.findall(output)
        if code == 0:
            break
        # A test that failed went on; a process that died did so in the trial that it named last.
        named = re.findall(r"^.+: trial (\d+)$", messages, re.MULTILINE)
        what = "\n".join(line for line in messages.splitlines() if not re.match(r".+: trial \d+$", line))[:4000]
        ended = "[  FAILED  ]" in output
        last = int(named[-1]) if named else first
        faults.append(f"{test}: exit {code}" + ("" if ended else f" in trial {last}") + f"\n{output[:4000]}{what}\n"
                      f"again: WHIPPLE_FUZZ_FIRST={last} WHIPPLE_FUZZ_TRIALS=1 {fuzz} --gtest_filter={test}")
        if ended or not test.startswith(NUMBERED):
            break
        first = last + 1
    return counts, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fuzz", nargs="?", default=ROOT / "build" / "fuzz" / "tests" / "bin" / "fuzz")
    parser.add_argument("--trials", type=int, default=10000, help="inputs of each test (default: 10000)")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2, help="processes at a time (default: 2)")
    parser.add_argument("--only", default="*", help="tests, as GoogleTest selects them")
    parser.add_argument("--chunk", type=int, default=500, help="inputs of a process (default: 500)")
    options = parser.parse_args()

    work = []
    for test in tests_of(options.fuzz, options.only):
        if test.startswith(NUMBERED):
            for first in range(options.first, options.first + options.trials, options.chunk):
                work.append((test, first, min(options.chunk, options.first + options.trials - first)))
        else:
            work.append((test, 0, options.trials))
    total = collections.defaultdict(lambda: [0, 0, 0, 0, 0.0, 0])
    faults = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        running = [pool.submit(run_chunk, options.fuzz, *chunk) for chunk in work]
        for done in concurrent.futures.as_completed(running):
            counts, texts = done.result()
            for kind, *numbers, slowest, seconds in counts:
                row = total[kind]
                for column, number in enumerate(numbers):
                    row[column] += int(number)
                if float(seconds) > row[4]:
                    row[4:] = float(seconds), int(slowest)
            for text in texts:
                faults += 1
                print(text + "\n", flush=True)
    print(f"{'kind':<32}{'inputs':>8}{'read':>8}{'refused':>9}{'stopped':>9}{'faulty':>8}   slowest")
    for kind, (*columns, seconds, slowest) in sorted(total.items()):
        read, refused, stopped, faulty = columns
        print(f"{kind:<32}{sum(columns):>8}{read:>8}{refused:>9}{stopped:>9}{faulty:>8}"
              f"   {seconds:.1f} s (trial {slowest})")
    print(f"{sum(sum(row[:4]) for row in total.values())} inputs, {faults} processes with faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
