#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cases, compares them with their expected.toml, and writes the tables of docs/results.md.

usage: results.py [CASE[:RUN]]... [--resolution coarse|normal|fine] [--run] [--threads N] [--write] [--list]

Without --run, runs that are there are compared. A run lies in run/results/CASE/RUN.RESOLUTION and is repeated only if
its command line changed (after a change of case.toml or of a material, remove its folder). --write renews the part of
docs/results.md between the markers: everything that has been run, in any resolution, is in it; cases that have no run
here keep their tables. Format of expected.toml: docs/how_to/expected_results.md.
Exit code 1 if a run failed, 2 for bad input; a quantity outside of its tolerance is a result, not an error.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import time

import results_table
from results_data import Case, BadExpectation

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "run" / "results"
MARKERS = ("<!-- begin of the part that scripts/results.py writes -->", "<!-- end of that part -->")


def up_to_date(folder, command):
    stamp = folder / "finished.txt"
    return stamp.is_file() and stamp.read_text() == " ".join(command)


def environment(threads):
    """Idle threads sleep: the machine may be shared."""
    return os.environ | {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}


def folder_of(case, run, resolution):
    return RESULTS / case.name / f"{run.name}.{resolution}"


def command_of(case, run, resolution, folder=None, more=()):
    """Command line of a run, in its folder of run/results or another one, with more assignments."""
    folder = folder or folder_of(case, run, resolution)
    command = ["whipple", "run", str(case.file.relative_to(ROOT)), "-o", str(folder.relative_to(ROOT)), "--force"]
    for assignment in [*run.assignments(resolution), *more]:
        command += ["--set", assignment]
    return command


def execute(whipple, case, run, resolution, threads):
    """Runs the case unless it is there; returns whether it is there now."""
    folder, command = folder_of(case, run, resolution), command_of(case, run, resolution)
    if up_to_date(folder, command):
        return True
    (folder / "finished.txt").unlink(missing_ok=True)
    print(f"{time.strftime('%H:%M:%S')} {' '.join(command)}", flush=True)
    done = subprocess.run([whipple, *command[1:], "--quiet", "--threads", str(threads)], cwd=ROOT,
                          env=environment(threads))
    if done.returncode != 0:
        print(f"  failed with exit code {done.returncode}", flush=True)
        return False
    (folder / "finished.txt").write_text(" ".join(command))
    return True


def analyse(whipple, folder, run, threads):
    """Measures of a run; repeated if the run or the program is newer."""
    product = folder / "report" / "quantities.csv"
    newest = max((folder / "finished.txt").stat().st_mtime, pathlib.Path(whipple).stat().st_mtime)
    if product.is_file() and product.stat().st_mtime > newest:
        return True
    done = subprocess.run([whipple, "analyse", str(folder), "--quiet", *run.analyse],
                          env=environment(threads))
    return done.returncode == 0


def sections(text):
    """The tables of the cases by their headings, in order."""
    parts = text.split("\n### ")
    return {part.split("\n", 1)[0]: "### " + part.strip("\n") for part in parts[1:]}


def write_document(compared):
    path = ROOT / "docs" / "results.md"
    old = path.read_text()
    if not all(marker in old for marker in MARKERS):
        raise BadExpectation(f"{path}: the markers of the generated part are missing")
    head, rest = old.split(MARKERS[0])
    former, tail = rest.split(MARKERS[1])
    titles = [Case(case).title for case in sorted((ROOT / "cases").glob("*/expected.toml"))]
    known = sections(former) | sections("\n" + results_table.as_markdown(compared))
    body = "\n\n".join(known[title] for title in titles if title in known)
    passed, failed = body.count(" pass |"), body.count("**FAIL** |")
    summary = (f"{passed} of {passed + failed} compared quantities pass. Coarse runs are there to show the convergence; "
               f"failures are named with what is known of their cause.")
    path.write_text(f"{head}{MARKERS[0]}\n\n{summary}\n\n{body}\n\n{MARKERS[1]}{tail}")
    print(f"wrote {path}")


def select(words):
    """The cases and runs that the words name, all without words."""
    cases = {path.parent.name: Case(path) for path in sorted((ROOT / "cases").glob("*/expected.toml"))}
    if not words:
        return [(case, run) for case in cases.values() for run in case.runs]
    chosen = []
    for word in words:
        name, _, run_name = word.partition(":")
        if name not in cases:
            raise BadExpectation(f"no case {name!r} with an expected.toml; there are {', '.join(cases)}")
        runs = [run for run in cases[name].runs if not run_name or run.name == run_name]
        if not runs:
            raise BadExpectation(f"{name} has no run {run_name!r}: {', '.join(r.name for r in cases[name].runs)}")
        chosen += [(cases[name], run) for run in runs]
    return chosen


def main():
    parser = argparse.ArgumentParser(prog="results.py", description="Runs the cases and compares them with expectations.",
                                     epilog="example: results.py taylor_bar --resolution coarse --run")
    parser.add_argument("cases", nargs="*", metavar="CASE[:RUN]")
    parser.add_argument("--resolution", default="normal", choices=("coarse", "normal", "fine"))
    parser.add_argument("--run", action="store_true", help="run what is missing or out of date")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--write", action="store_true", help="renew docs/results.md")
    parser.add_argument("--list", action="store_true", help="list cases and runs")
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"), help="the executable")
    arguments = parser.parse_args()
    try:
        chosen = select(arguments.cases)
        if arguments.list:
            for case, run in chosen:
                print(f"{case.name}:{run.name}  {' '.join(run.assignments(arguments.resolution))}")
            return 0
        failed = 0
        if arguments.run:
            failed = sum(not execute(arguments.whipple, case, run, arguments.resolution, arguments.threads)
                         for case, run in chosen)
        compared = []
        for case, run in chosen:
            for resolution in case.resolutions:
                folder = folder_of(case, run, resolution)
                if not up_to_date(folder, command_of(case, run, resolution)):
                    continue
                if not analyse(arguments.whipple, folder, run, arguments.threads):
                    failed += 1
                    continue
                compared.append(results_table.compare(case, run, resolution, folder))
        print(results_table.as_text(compared))
        if arguments.write:
            write_document(compared)
    except BadExpectation as error:
        print(f"results.py: error: {error}", file=sys.stderr)
        return 2
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
