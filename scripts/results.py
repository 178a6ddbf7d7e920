#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the cases, gives every number a band, compares with expected.toml, and writes docs/generated/results.

usage: results.py [CASE[:RUN]]... [--resolution coarse|normal|fine | --band] [--run] [--any-source] [--threads N]
                  [--write] [--list] [--cost] [--check-fresh] [--queue MINUTES [--jobs N]]

Without --run, runs that are there are compared. A run lies in run/results/CASE/RUN.VARIANT; a variant is a resolution,
a position of the lattice or a moving frame. --band takes all variants of a run: three grids and what [band] of
expected.toml declares of a headline, two grids of others. A run is repeated if its command, case, a material or the C++
that computes it (studies/validation/provenance.py) has changed since; --any-source lets the last pass. --write renews
docs/generated/results/<case>.json with the runs that are there, and from them the pages beside, the overview
docs/generated/results.md, the gallery docs/generated/gallery.md and report/grid_sensitivity.json, each only where it changes; runs that are not here keep their
tables, marked where they are out of date. --check-fresh runs nothing: exit code 1 if a table belongs to another case or
material, or a page to other data.
--queue computes what is left of all tables for so many minutes, by value, N runs at a time, and writes the results as they
come; called again it goes on (studies/validation/queue.py). With --list it names what is left, in order, with its cost.
Format of expected.toml: docs/manual/expected_results.md; bands and marks: docs/theory/uncertainty.md.
Exit code 1 if a run failed, 2 for bad input; a difference from an experiment is a result, not an error.
"""
import argparse
import json
import os
import pathlib
import sys

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from studies.validation import comparison, execution, gallery, page, provenance, queue, store  # noqa: E402
from studies.validation.cases import ROOT, BadExpectation, all_cases  # noqa: E402
from studies.validation.variants import variants_of  # noqa: E402


def renewed(results, chosen):
    """The stored results with those variants of runs replaced that are here."""
    for case in dict.fromkeys(case for case, _ in chosen):
        former = {run["name"]: run for run in results["cases"].get(case.name, {}).get("runs", [])}
        study = comparison.case_study(case, [run for of, run in chosen if of is case], former)
        if not study["runs"]:
            continue
        former |= {run["name"]: run for run in study["runs"]}
        study["runs"] = [former[run.name] for run in case.runs if run.name in former]
        results["cases"][case.name] = study
    results["cases"] = dict(sorted(results["cases"].items()))
    return results


def write(chosen):
    results = renewed(store.load(), chosen)
    paths = store.save(results)
    stale, _, expectations = page.outdated(results, all_cases())
    paths += page.write(results, stale + expectations, provenance.digest_of_sources())
    paths += gallery.write(results)
    sensitivities = json.dumps(comparison.sensitivities(results), indent=1) + "\n"
    paths += [page.SENSITIVITIES] if store.write_if_changed(page.SENSITIVITIES, sensitivities) else []
    print("wrote " + (", ".join(str(path.relative_to(ROOT)) for path in paths) or "nothing: all is as it was"))


def check_fresh():
    """Prints what is out of date; returns the exit code."""
    results = store.load()
    stale, older, expectations = page.outdated(results, all_cases())
    for name, run in stale:
        print(f"stale: {name}:{run}: its case or a material has changed; repeat with --band --run --write")
    for name, run in older:
        print(f"older source: {name}:{run}")
    for name, run in expectations:
        print(f"expectations changed: {name}:{run}; renew its marks with --write, or measure it again with --run")
    unlike = page.unlike(results) + gallery.unlike(results)
    if unlike:
        path, row = unlike[0]
        print(f"pages do not say what is stored: {len(unlike)} rows, the first, of {path.name}:\n  {row}")
    return 1 if stale or unlike else 0


def listed(chosen, arguments):
    """Prints the runs and, with --cost, what `whipple check` says of each."""
    work = 0.0
    for case, run in chosen:
        flags = " ".join(word for word, on in (("headline", run.headline), ("sensitivity", run.sensitivity)) if on)
        print(f"{case.name}:{run.name}  {flags}")
        for variant in variants(run, arguments):
            line = f"    {variant.name:9} {' '.join([*run.assignments(variant.resolution), *variant.assignments])}"
            if arguments.cost:
                found = execution.cost(arguments.whipple, case, run, variant)
                if "error" in found:
                    line += f"\n              {found['error']}"
                else:
                    work += found["seconds"]
                    line += (f"\n              {found['points']} points, {found['steps']} steps, "
                             f"about {found['seconds']:.0f} s, {found['state']}")
                    line += f", took {found['wall_time']} s" if found["wall_time"] is not None else ""
            print(line, flush=True)
    if arguments.cost:
        print(f"all together about {work / 3600:.1f} h on {os.cpu_count()} threads")


def queued(chosen, arguments):
    """Works the queue off, or lists it; returns the exit code."""
    jobs = queue.plan(store.load(), chosen, provenance.source_of(arguments.whipple))
    if arguments.list:
        for job in jobs:
            print(f"{job.cost:7.0f} s  {job.name}")
        print(f"{len(jobs)} left, about {sum(job.cost for job in jobs) / 60:.0f} minutes on one thread")
        return 0
    failed, left = queue.work_off(jobs, arguments.whipple, arguments.queue or 0.0, arguments.jobs, write)
    for word, of in (("failed", failed), ("left for another call", left)):
        if of:
            print(f"{word}: {', '.join(job.name for job in of)}")
    return 1 if failed else 0


def variants(run, arguments):
    if arguments.band:
        return variants_of(run, band=True)
    if arguments.resolution in run.cell_size:
        return [execution.variant_named(run, arguments.resolution)]
    return []


def main():
    parser = argparse.ArgumentParser(prog="results.py", description="Runs the cases and compares them with expectations.",
                                     epilog="example: results.py taylor_bar:symplectic --band --run")
    parser.add_argument("cases", nargs="*", metavar="CASE[:RUN]")
    parser.add_argument("--resolution", default="normal", choices=("coarse", "normal", "fine"))
    parser.add_argument("--band", action="store_true", help="all grids, lattice positions and the moving frame")
    parser.add_argument("--run", action="store_true", help="run what is missing or out of date")
    parser.add_argument("--any-source", action="store_true", help="keep runs of an older source")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--write", action="store_true", help="renew docs/generated/results and its overview")
    parser.add_argument("--list", action="store_true", help="list cases and runs")
    parser.add_argument("--cost", action="store_true", help="with --list: particles and steps by `whipple check`")
    parser.add_argument("--queue", type=float, metavar="MINUTES", help="compute what is left of all tables, by value")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="of the queue: runs at a time")
    parser.add_argument("--check-fresh", action="store_true", help="whether the written tables belong to the cases")
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"), help="the executable")
    arguments = parser.parse_args()
    os.environ["WHIPPLE_PROGRAM"] = arguments.whipple  # which takes the measures, too
    try:
        if arguments.check_fresh:
            return check_fresh()
        chosen = execution.select(arguments.cases)
        if arguments.queue is not None:
            return queued(chosen, arguments)
        if arguments.list:
            listed(chosen, arguments)
            return 0
        program = provenance.source_of(arguments.whipple)
        if arguments.run and not provenance.is_same_program(program, provenance.digest_of_sources()):
            print(f"{arguments.whipple}: built from other sources than these; its runs count as such", file=sys.stderr)
        failed = 0
        for case, run in chosen if arguments.run else ():
            for variant in variants(run, arguments):
                failed += not execution.execute(arguments.whipple, case, run, variant, arguments.threads,
                                                   any_source=arguments.any_source)
        for case, run in chosen:
            for folder in execution.folders_there(case, run):
                failed += not execution.analyse(arguments.whipple, folder, run, arguments.threads)
        print(page.as_text(renewed({"cases": {}}, chosen)))
        if arguments.write:
            write(chosen)
    except BadExpectation as error:
        print(f"results.py: error: {error}", file=sys.stderr)
        return 2
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
