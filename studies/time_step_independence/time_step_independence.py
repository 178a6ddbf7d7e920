#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far the results of cases depend on the time step: every run with several Courant numbers, and the quantities of its
expected.toml beside each other.

usage: time_step_independence.py [CASE[:RUN]]... [--courant 0.2 0.5 0.8]
                                 [--resolution coarse|normal|fine] [--threads N] [--output FILE.md]
                                 [--whipple EXE]

A run lies in run/time_step/CASE/RUN.COURANT and is repeated if its command, case, materials or the source changed. Exit code 1 if a run failed,
2 for bad input; a dependence is a result, not an error.
"""
import argparse
import math
import os
import pathlib
import sys

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[2])
from studies.validation.cases import ROOT, UNITS, BadExpectation, Measures  # noqa: E402
from studies.validation.execution import analyse, execute, select  # noqa: E402
from studies.validation.variants import Variant  # noqa: E402

DEFAULT_CASES = ["lead_sphere_on_plate:symplectic", "lead_sphere_on_plate_gray:symplectic", "aluminium_crater:6061_t6",
                 "prater_6061:von_mises", "aluminium_sphere_on_plate:6061_t6", "piekutowski_clouds:t_D_0_084",
                 "shock_decay:5_km_s", "whipple_shield:below_limit"]


def run(whipple, case, run_of_case, resolution, courant, threads):
    """Runs and analyses unless it is there; returns the folder, None if it failed."""
    folder = ROOT / "run" / "time_step" / case.name / f"{run_of_case.name}.{courant:g}"
    variant = Variant(resolution, resolution, [f"time.courant={courant:g}"])
    if execute(whipple, case, run_of_case, variant, threads, folder) and analyse(whipple, folder, run_of_case, threads):
        return folder
    return None


def is_error_of_balance(expectation):
    """Errors of energy and momentum are round-off with every step."""
    return "error" in expectation.name


def table_of(case, run_of_case, resolution, courants, measures):
    """Markdown of one run."""
    lines = [f"**{case.title}**, {run_of_case.title or run_of_case.name} "
             f"(`{case.name}:{run_of_case.name}`, cells of {run_of_case.cell_size[resolution]})", "",
             "| quantity | " + " | ".join(f"{c:g}" for c in courants) + " | spread |",
             "| --- |" + " --- |" * (len(courants) + 1)]
    for expectation in run_of_case.expectations:
        values = [of_run.value(expectation) for of_run in measures]
        mean = math.fsum(values) / len(values)
        if is_error_of_balance(expectation) or not math.isfinite(mean) or mean == 0.0:
            continue
        spread = (max(values) - min(values)) / abs(mean)
        shown = " | ".join(f"{v / UNITS[expectation.unit]:.4g} {expectation.unit}".strip() for v in values)
        lines.append(f"| {expectation.name} | {shown} | {100 * spread:.2f} % |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(prog="time_step_independence.py",
                                     description="Runs cases with several Courant numbers and compares their results.",
                                     epilog="example: time_step_independence.py aluminium_crater:6061_t6")
    parser.add_argument("cases", nargs="*", metavar="CASE[:RUN]", help="default: the hypervelocity impacts")
    parser.add_argument("--courant", type=float, nargs="+", default=[0.2, 0.5, 0.8])
    parser.add_argument("--resolution", choices=("coarse", "normal", "fine"), help="default: the coarsest of each run")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--output", type=pathlib.Path, help="write the tables to this file, too")
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"), help="the executable")
    options = parser.parse_args()
    if not all(0.0 < courant <= 1.0 for courant in options.courant):
        parser.error(f"--courant: {options.courant}: accepted are numbers above 0 up to 1")
    tables, failed = [], 0
    try:
        for case, run_of_case in select(options.cases or DEFAULT_CASES):
            resolution = options.resolution or next(iter(run_of_case.cell_size))
            folders = [run(options.whipple, case, run_of_case, resolution, courant, options.threads)
                       for courant in options.courant]
            if None in folders:
                failed += 1
                continue
            measures = [Measures(folder) for folder in folders]
            tables.append(table_of(case, run_of_case, resolution, options.courant, measures))
            print(tables[-1] + "\n", flush=True)
    except BadExpectation as error:
        print(f"time_step_independence.py: error: {error}", file=sys.stderr)
        return 2
    if options.output:
        words = " ".join(["studies/time_step_independence/time_step_independence.py", *options.cases, "--courant", *map(str, options.courant)])
        if options.resolution:
            words += f" --resolution {options.resolution}"
        words += f" --output {options.output}"
        cells = f", {options.resolution} cells" if options.resolution else ""
        head = (f"# Independence of the time step{cells}\n\nGenerated by `{words}`. Columns: Courant "
                "numbers; spread: largest less smallest value over the mean. Errors of energy and momentum are left out "
                "(round-off with every step: results.md). The step follows compression (`time.compression_limit`, 4 %) and "
                "begins small, so that the three take nearly the same steps while the shock is strong: what is shown is that "
                "the result does not depend on the Courant number, given these two.\n\n")
        options.output.write_text(head + "\n\n".join(tables) + "\n")
        print(f"wrote {options.output}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
