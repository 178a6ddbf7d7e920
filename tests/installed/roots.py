# SPDX-License-Identifier: BSD-3-Clause
"""What tests in Debians of their own share: whether one is asked for and can be made here, commands that must succeed, and a small impact
by two builds of the program."""
import csv
import os
import pathlib
import shutil
import subprocess
import sys

from debian_root import obstacle

MIRROR = "WHIPPLE_DEBIAN_MIRROR"
CASE = "tests/data/small_impact.toml"
ROUND_OFF = 1e-12  # of the largest magnitude of a column of history.csv, after the steps of that impact
# Not of the simulation, or round-off themselves: errors, and the momenta that are zero because the ball meets the plate's middle.
LEFT_OUT = ("wall_time", "energy_error", "momentum_error", "momentum_x", "momentum_y", "angular_momentum")
# A process of its own, which needs no launcher of MPI.
MPI_ALONE = {"OMP_NUM_THREADS": "1", "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
             "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def mirror_or_skip(what, *programs):
    """Return the address of the mirror, None for the default one; end the test as skipped where it is not asked for or a program is missing."""
    missing = [program for program in programs if not shutil.which(program)]
    why = f"{MIRROR} is not set" if MIRROR not in os.environ else obstacle() or \
        (f"missing: {', '.join(missing)} (scripts/install_deps.sh --roots)" if missing else "")
    if why:
        print(f"SKIPPED: {what}: {why}")
        sys.exit(77)
    return None if os.environ[MIRROR] == "default" else os.environ[MIRROR]


def call(*command, **options):
    """Run a command, whose output is shown only if it fails. Return the output."""
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    if done.returncode != 0:
        raise SystemExit(f"FAILED: {' '.join(map(str, command))}: {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def columns(run):
    """Return the numbers of history.csv by column."""
    with (pathlib.Path(run) / "history.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[place]) for row in rows[1:]] for place, name in enumerate(rows[0]) if not name.startswith(LEFT_OUT)}


def largest_difference(here, there):
    """Return the largest difference of a column, over its largest magnitude, and its name."""
    if here.keys() != there.keys():
        raise SystemExit(f"FAILED: other columns: {here.keys() ^ there.keys()}")
    worst = (0.0, "none")
    for name, numbers in here.items():
        if len(numbers) != len(there[name]):
            raise SystemExit(f"FAILED: {name}: {len(there[name])} steps instead of {len(numbers)}")
        scale = max(map(abs, numbers))
        difference = max(abs(a - b) for a, b in zip(numbers, there[name]))
        if difference > 0.0:
            worst = max(worst, (difference / scale if scale > 0.0 else float("inf"), name))
    return worst


def same_impact(sources, here, there, folder, there_sources=None, root=None):
    """Require that two programs compute the same impact but for round-off, and print the figure.

    here, there: words that start them; there_sources, root: the folder of the sources as the second one sees it, and its own root.
    """
    runs = {"here": folder / "impact_here", "there": (root or folder) / "impact_there"}
    seen = {"here": runs["here"], "there": "/impact_there" if root else runs["there"]}
    for name, program, place in (("here", here, sources), ("there", there, there_sources or sources)):
        shutil.rmtree(runs[name], ignore_errors=True)
        call(*program, "run", f"{place}/{CASE}", "-o", seen[name], "--threads", "1", "--quiet", env=os.environ | MPI_ALONE)
    one, other = (columns(run) for run in runs.values())
    figure, column = largest_difference(one, other)
    if not figure < ROUND_OFF:
        raise SystemExit(f"FAILED: {column} differs by {figure:.1e} of its largest value")
    print(f"small impact: {len(next(iter(one.values())))} rows of {len(one)} columns, largest difference {figure:.1e} ({column})", flush=True)


def verdict(told):
    """Return what GoogleTest said in the end."""
    return ", ".join(" ".join(line.split()) for line in told.splitlines() if line.startswith(("[  PASSED", "[  SKIPPED")))
