#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Gate against drift: coarse cases compared with stored numbers, quantity by quantity.

usage: drift.py [CASE]... [--renew | --same-as EXE [--within X]] [--threads N] [--whipple EXE] [--work DIR]

Cases: tests/data/drift/cases.toml; numbers and tolerances: tests/data/drift/baseline.toml. Any number outside its tolerance
fails; the table shows old and new. --renew stores the numbers of now and prints what changed, for the changelog.
A run is the same to the last bit on one machine with one compiler; others round differently, and what breaks or melts
amplifies that. The tolerance of a number is therefore 10 times its change under a perturbation of the Courant number by
2e-6, far above round-off, and at least 0.1 %; --renew measures it.
--same-as compares with another executable, digit by digit, as after a change that computes nothing new: if all cases agree,
docs/generated/same_results.json notes it, and tables that the other one computed stay current. --within takes a relative
difference for the same, as after code that is compiled in another order rounds differently; quantities that only one of both
writes, and cases whose input the other does not read, are named and left out.
Exit code 1 if a number drifted or a run failed, 2 for bad input.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tomllib

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from studies.validation.cases import ROOT, BadExpectation, Measures  # noqa: E402
from studies.validation import provenance  # noqa: E402
from studies.validation.execution import environment  # noqa: E402

DATA = ROOT / "tests" / "data" / "drift"
LEAST, GREATEST, FACTOR = 1e-3, 0.2, 10.0  # tolerance, over the change by the perturbation
PERTURBATION = "time.courant=0.500001"
# Not numbers of the simulation, or round-off.
LEFT_OUT = ("dt", "energy_error", "momentum_error", "momentum_x", "momentum_y", "momentum_z", "wall_impulse", "outflow")
SUMMED = ("maximum_speed", "maximum_pressure", "maximum_temperature")  # the greatest of the run, not the last


def cases():
    return tomllib.loads((DATA / "cases.toml").read_text())["case"]


def baseline(path=DATA / "baseline.toml"):
    return tomllib.loads(path.read_text()) if path.is_file() else {}


def numbers(folder, measures):
    """Numbers of a run: last row of history.csv, greatest values, measures."""
    with (folder / "history.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = {}
    for head in rows[-1]:
        name = head.split(" [")[0]
        if not name.startswith(LEFT_OUT):
            found[name] = max(float(row[head]) for row in rows) if name in SUMMED else float(rows[-1][head])
    if measures:
        analysed = Measures(folder)
        found |= {name: analysed.single.get(name, math.nan) for name in measures}
    return found


def run(whipple, case, folder, more=()):
    """Runs a case and returns its numbers; None if it failed."""
    command = [whipple, "run", case["file"], "-o", str(folder), "--force", "--quiet", "--threads", "1"]
    for assignment in [*case["set"], *more]:
        command += ["--set", assignment]
    steps = [command] + ([[whipple, "analyse", str(folder), "--quiet"]] if case["measures"] else [])
    for step in steps:
        done = subprocess.run(step, cwd=ROOT, env=environment(1), capture_output=True, text=True)
        if done.returncode != 0:
            print(f"{case['name']}: exit code {done.returncode}: {' '.join(step)}\n{done.stderr}", file=sys.stderr)
            return None
    return numbers(folder, case["measures"])


def scale_of(name, old):
    """What a difference is relative to: the number, but at least a thousandth of the whole (masses, energies), or of the
    largest component (vectors): what vanishes by symmetry is round-off."""
    value = abs(old[name]["value"])
    stem, _, axis = name.rpartition("_")
    if axis in "xyz" and stem:
        return max([value, *(1e-3 * abs(old[f"{stem}_{a}"]["value"]) for a in "xyz" if f"{stem}_{a}" in old)])
    for words, whole in ((("mass",), "mass"), (("energy", "work", "heat", "unresolved"), "total_energy")):
        if any(word in name for word in words) and whole in old:
            return max(value, 1e-3 * abs(old[whole]["value"]))
    return value


def difference(name, old, new):
    """Relative; infinite where one of both is missing or nothing."""
    if name not in old or name not in new:
        return math.inf
    a, b = old[name]["value"], new[name]
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0.0
    scale = scale_of(name, old)
    return abs(b - a) / scale if scale > 0.0 and math.isfinite(b) else math.inf


def drifted(old, new):
    """Rows (name, old, new, relative difference, tolerance) of what is outside its tolerance."""
    rows = []
    for name in [*old, *(n for n in new if n not in old)]:
        change, tolerance = difference(name, old, new), old.get(name, {}).get("tolerance", 0.0)
        if not change <= tolerance:
            rows.append((name, old.get(name, {}).get("value", math.nan), new.get(name, math.nan), change, tolerance))
    return rows


def tolerances(values, perturbed):
    """Numbers with tolerances, from a run and a perturbed one."""
    plain = {name: {"value": value} for name, value in values.items()}
    return {name: {"value": value,
                   "tolerance": min(max(LEAST, FACTOR * difference(name, plain, perturbed)), GREATEST)}
            for name, value in values.items()}


def table(name, rows):
    lines = [f"| {name} | old | new | change | tolerance |", "| --- | --- | --- | --- | --- |"]
    lines += [f"| {what} | {a:.6g} | {b:.6g} | {change:.2g} | {tolerance:.2g} |" for what, a, b, change, tolerance in rows]
    return "\n".join(lines)


def as_toml(stored):
    lines = ["# Numbers of the drift gate and their tolerances; written by scripts/drift.py --renew.", ""]
    for case, values in stored.items():
        lines.append(f"[{case}]")
        lines += [f'"{name}" = {{ value = {entry["value"]!r}, tolerance = {entry["tolerance"]:.2g} }}'
                  for name, entry in values.items()]
        lines.append("")
    return "\n".join(lines)


def note_same(whipple, other):
    """Notes that two executables give the same digits, by the digests of the sources that they were built from."""
    new, old = (provenance.digest_of_revision(re.search(r"revision ([0-9a-f]+)", provenance.program(exe)["program"])[1])
                for exe in (whipple, other))
    if new != old:
        same = provenance.known_same() | {new: old}
        provenance.SAME_RESULTS.write_text(json.dumps(same, indent=1) + "\n")
    print(f"drift: {new} computes what {old} does")


def unlike(name, old, new, within=0.0):
    """Rows of the numbers that differ by more than a relative difference, by default in any digit; with a difference only of those that
    both have."""
    plain = {key: {"value": value} for key, value in old.items()}
    keys = sorted({*old, *new} if within == 0.0 else {*old} & {*new})
    return [f"{name}: {key}: {old.get(key)!r}, {new.get(key)!r}" for key in keys
            if old.get(key) != new.get(key) and not (math.isnan(old.get(key, 0.0)) and math.isnan(new.get(key, 0.0)))
            and not (within > 0.0 and difference(key, plain, new) <= within)]


def main():
    parser = argparse.ArgumentParser(prog="drift.py", description="Compares coarse runs with stored numbers.",
                                     epilog="example: drift.py --renew")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--renew", action="store_true", help="store the numbers of now; prints what changed")
    parser.add_argument("--same-as", metavar="EXE", help="compare every digit with those of another executable")
    parser.add_argument("--within", metavar="X", type=float, default=0.0, help="relative difference that counts as the same; default: none")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="runs at once, one thread each")
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"), help="the executable")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "run" / "drift", help="folder of the runs")
    arguments = parser.parse_args()
    try:
        known = {case["name"]: case for case in cases()}
        if set(arguments.cases) - set(known):
            raise BadExpectation(f"no case {sorted(set(arguments.cases) - set(known))}: {', '.join(known)}")
        chosen = [case for name, case in known.items() if not arguments.cases or name in arguments.cases]
        whipple, work, old = str(pathlib.Path(arguments.whipple).resolve()), arguments.work.resolve(), baseline()
        jobs = [(case, work / case["name"], ()) for case in chosen]
        if arguments.renew:
            jobs += [(case, work / f"{case['name']}.perturbed", (PERTURBATION,)) for case in chosen]
        of_other = [(case, work / f"{case['name']}.other", ()) for case in chosen] if arguments.same_as else []
        with concurrent.futures.ThreadPoolExecutor(arguments.threads) as pool:
            results = list(pool.map(lambda job: run(whipple, *job), jobs))
            others = list(pool.map(lambda job: run(str(pathlib.Path(arguments.same_as).resolve()), *job), of_other))
    except (BadExpectation, OSError) as error:
        print(f"drift.py: error: {error}", file=sys.stderr)
        return 2
    failed = sum(result is None for result in [*results, *others])
    if arguments.same_as:
        rows = [row for case, one, other in zip(chosen, results, others) if one and other
                for row in unlike(case["name"], other, one, arguments.within)]
        print("\n".join(rows))
        if arguments.within > 0.0:
            apart = [case["name"] for case, other in zip(chosen, others) if other is None]
            failed -= len(apart)
            print("".join(f"drift: {name} is no case of the other executable\n" for name in apart), end="")
        if failed or rows or arguments.cases:
            print(f"drift: not the same: {len(rows)} numbers differ, {failed} runs failed" if failed or rows else
                  "drift: the same; not noted, as not all cases were run")
            return 1 if failed or rows else 0
        note_same(whipple, arguments.same_as)
        return 0
    changed = 0
    for case, new in zip(chosen, results):
        if new is None:
            continue
        if rows := drifted(old.get(case["name"], {}), new):
            changed += 1
            print(table(case["name"], rows) + "\n")
    if arguments.renew:
        for case, new, perturbed in zip(chosen, results, results[len(chosen):]):
            if new is not None and perturbed is not None:
                old[case["name"]] = tolerances(new, perturbed)
        (DATA / "baseline.toml").write_text(as_toml({name: old[name] for name in known if name in old}))
        print(f"renewed {DATA / 'baseline.toml'}")
        return 1 if failed else 0
    print(f"drift: {len(chosen)} cases, {changed} drifted, {failed} failed")
    return 1 if failed or changed else 0


if __name__ == "__main__":
    sys.exit(main())
