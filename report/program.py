# SPDX-License-Identifier: BSD-3-Clause
"""The program `whipple`, which takes the measures that a page shows."""
import functools
import json
import math
import os
import pathlib
import shutil
import subprocess

from report.expectations import BadExpectation

BUILT = pathlib.Path(__file__).resolve().parents[1] / "build/release/bin/whipple"


def program() -> str:
    """Returns $WHIPPLE_PROGRAM, which `whipple report` sets, else the program built in this tree, else that of the search path."""
    named = os.environ.get("WHIPPLE_PROGRAM") or (str(BUILT) if BUILT.is_file() else shutil.which("whipple"))
    if named is None:
        raise BadExpectation(f"the program whipple is neither {BUILT} nor in PATH: set WHIPPLE_PROGRAM")
    return named


def measure(folder: pathlib.Path, text: str) -> float:
    """Takes a measure of a run by `whipple measure`, e.g. "jet_speed.liner fraction=0.01" (SI). NaN where there is none."""
    history = folder / "history.csv"
    return _measure(folder, text, history.stat().st_mtime_ns if history.is_file() else 0)


@functools.lru_cache(maxsize=None)
def _measure(folder: pathlib.Path, text: str, _computed_at: int) -> float:
    """A folder may be computed again while this process lives: its measure is that of the time of its history."""
    try:
        done = subprocess.run([program(), "measure", str(folder), text], capture_output=True, text=True)
    except OSError as error:
        raise BadExpectation(f"the program {program()} cannot be started: {error.strerror}") from None
    if done.returncode != 0:
        raise BadExpectation(f"{folder}: {done.stderr.strip() or done.stdout.strip()}")
    value = json.loads(done.stdout)[text]["value"]
    return math.nan if value is None else value
