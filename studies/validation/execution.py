# SPDX-License-Identifier: BSD-3-Clause
"""Runs of the cases: their folders, command lines, execution and analysis."""
import json
import os
import pathlib
import re
import subprocess
import time

from studies.validation import provenance
from studies.validation.cases import ROOT, BadExpectation, Measures, all_cases
from studies.validation.variants import FRAME_DEPENDENT, Variant, as_simulated, back_to_rest, vector

RESULTS = ROOT / "run" / "results"


def environment(threads):
    """Idle threads sleep: the machine may be shared."""
    return os.environ | {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}


def folder_of(case, run, variant):
    return RESULTS / case.name / f"{run.name}.{variant.name}"


def command_of(case, run, resolution, folder, more=()):
    """Command line of a run in a folder, with more assignments."""
    command = ["whipple", "run", str(case.file.relative_to(ROOT)), "-o", str(folder.relative_to(ROOT)), "--force"]
    for assignment in [*run.assignments(resolution), *more]:
        command += ["--set", assignment]
    return command


def state_of(case, run, variant, folder, more=(), source=None):
    """Record of a run and its state: current, older source, stale or missing. source: digest that a current one has, by default
    that of the working tree."""
    record = provenance.read(folder)
    command = command_of(case, run, variant.resolution, folder, [*variant.assignments, *more])
    program = source or provenance.digest_of_sources()
    return record, provenance.state(record, command, provenance.inputs_of(run),
                                    lambda of: provenance.is_current(of, program, run))


def execute(whipple, case, run, variant, threads, folder=None, more=(), any_source=False):
    """Runs the case unless a current run is there, from its checkpoint if it was stopped; returns whether it is there now."""
    folder = folder or folder_of(case, run, variant)
    _, state = state_of(case, run, variant, folder, more, provenance.source_of(whipple))
    if state == provenance.CURRENT or (any_source and state == provenance.OLDER_SOURCE):
        return True
    (folder / "finished.json").unlink(missing_ok=True)
    command = command_of(case, run, variant.resolution, folder, [*variant.assignments, *more])
    begun = {"command": command, "executable": provenance.digest_of_file(whipple), **provenance.inputs_of(run)}
    earlier = wall_time_of_begun(folder, begun)
    words = command[1:] if earlier is None else ["run", "--restart", str(folder)]
    print(f"{time.strftime('%H:%M:%S')} {' '.join(['whipple', *words])}", flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / BEGUN).write_text(json.dumps(begun | {"wall_time": earlier or 0.0}, indent=1) + "\n")
    begin = time.monotonic()
    done = subprocess.run([whipple, *words, "--quiet", "--threads", str(threads)], cwd=ROOT, env=environment(threads))
    if done.returncode != 0:
        print(f"  failed with exit code {done.returncode}", flush=True)
        return False
    if any(variant.frame):
        table = run.resolved(variant.resolution)
        rest = [vector(body.get("velocity", [0, 0, 0]), run.name) for body in table["body"]]
        back_to_rest(folder, as_simulated(variant.frame, table["domain"]), [as_simulated(v, table["domain"]) for v in rest])
    provenance.write(folder, run, variant, command, whipple, threads, (earlier or 0.0) + time.monotonic() - begin)
    return True


BEGUN = "begun.json"  # in the folder of a run: what it was begun with, and the seconds of the calls before the last


def wall_time_of_begun(folder, begun):
    """Seconds that a run of this command, program and input has taken, which was stopped and has a checkpoint; None if there is none.

    Its program has to be the same file, so that what is resumed is what a run without a break computes, digit by digit.
    """
    try:
        record = json.loads((folder / BEGUN).read_text(encoding="utf-8"))
        status = json.loads((folder / "status.json").read_text(encoding="utf-8"))
        seconds, ended = status["wall_time"], status["state"] == "done"
    except (OSError, ValueError, KeyError):
        return None
    same = not ended and all(record.get(key) == json.loads(json.dumps(value)) for key, value in begun.items())
    return record["wall_time"] + seconds if same and any(folder.glob("checkpoint/*.h5")) else None


def analyse(whipple, folder, run, threads):
    """Measures a run; repeated if the run or the program is newer. Returns whether they are there."""
    product = folder / "report" / "quantities.csv"
    newest = max((folder / "finished.json").stat().st_mtime, pathlib.Path(whipple).stat().st_mtime)
    if product.is_file() and product.stat().st_mtime > newest:
        return True
    done = subprocess.run([whipple, "analyse", str(folder), "--quiet", *run.analyse], env=environment(threads))
    return done.returncode == 0


def folders_there(case, run):
    """Folders of the runs that are finished; an input that brackets another one counts with it."""
    for name in (run.name, *run.input):
        yield from (path.parent for path in sorted((RESULTS / case.name).glob(f"{name}.*/finished.json")))


def measures_of(folder, variant):
    measures = Measures(folder)
    measures.moving = any(variant.frame)
    if measures.moving:
        for name in FRAME_DEPENDENT:
            measures.single.pop(name, None)
    return measures


def select(words):
    """The cases and runs that the words name, all without words."""
    cases = {case.name: case for case in all_cases()}
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


def variant_named(run, resolution):
    return Variant(resolution, resolution)


DURATIONS = {"h": 3600.0, "min": 60.0, "s": 1.0, "ms": 1e-3}


def cost(whipple, case, run, variant):
    """Particles or elements, most steps and seconds of a run by `whipple check`, and its wall time if it was run."""
    command = command_of(case, run, variant.resolution, folder_of(case, run, variant), variant.assignments)
    words = [word for word in command[3:] if word != "--force"]
    done = subprocess.run([whipple, "check", command[2], *words[2:]], cwd=ROOT, capture_output=True, text=True,
                          env=environment(2))
    if done.returncode != 0:
        return {"error": (done.stderr or done.stdout).strip().split("\n")[-1]}
    text = done.stdout + done.stderr
    points = sum(int(n) for n in re.findall(r": (\d+) (?:particles|elements)", text))
    steps = re.search(r"steps: (\d+) to (\d+)", text)
    estimate = re.search(r"estimated time: .* to (.*?) on", text)
    words = re.findall(r"([\d.]+) (\w+)", estimate[1] if estimate else "")
    seconds = sum(float(n) * DURATIONS.get(unit, 0.0) for n, unit in words)
    record, state = state_of(case, run, variant, folder_of(case, run, variant), source=provenance.source_of(whipple))
    return {"points": points, "steps": int(steps[2]) if steps else 0, "seconds": seconds,
            "wall_time": record["wall_time"] if record else None, "state": state}
