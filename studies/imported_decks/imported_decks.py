#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of decks of MPM3D-F90: imported, checked and, with --run, run to their end, or the physics that is missing.
Prints the table of docs/manual/import.md.

usage: imported_decks.py [--run] WHIPPLE FOLDER DECK.mpm...
"""
import json
import pathlib
import re
import subprocess
import sys
import time


def whipple(program: str, *arguments: object) -> subprocess.CompletedProcess:
    """Runs the program and waits for it."""
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


def missing(report: str) -> list[str]:
    """Returns what a report of an import lists as missing, each once."""
    lines = report.partition("\nmissing (")[2].splitlines()[1:]
    found = [re.sub(r"^  line \d+\s+", "", line) for line in lines if line.startswith("  line ")]
    return list(dict.fromkeys(re.sub(r"\s{2,}", ": ", line) for line in found))


def row_of(program: str, deck: pathlib.Path, folder: pathlib.Path, runs: bool) -> list[str]:
    """Imports, checks and, if wanted, runs a deck. Returns its row of the table."""
    case = folder / deck.stem
    options: list[str] = []
    done = whipple(program, "import", deck, "-o", case)
    if done.returncode and "--old-mass takes it" in done.stdout:
        options = ["--old-mass"]
        done = whipple(program, "import", deck, "-o", case, *options)
    name = f"`{deck.name}`" + (f" {options[0]}" if options else "")
    if done.returncode:
        return [name, "missing: " + "; ".join(missing(done.stdout) or [done.stderr.splitlines()[0]]), "", ""]
    checked = whipple(program, "check", case / "case.toml")
    if checked.returncode:
        return [name, f"refused: {checked.stderr.splitlines()[0]}", "", ""]
    if not runs:
        return [name, "can run: " + (re.search(r"(?m)^particles: (\d+)", checked.stdout) or ["", "?"])[1] + " particles", "", ""]
    run = folder / f"{deck.stem}.run"
    begin = time.monotonic()
    done = whipple(program, "run", case / "case.toml", "-o", run, "--quiet", "--threads", "1", "--force")
    seconds = time.monotonic() - begin
    if done.returncode:
        return [name, f"ends with exit code {done.returncode}: {(done.stderr or done.stdout).splitlines()[-1]}", "", ""]
    status = json.loads((run / "status.json").read_text())
    return [name, "runs to its end", f"{1e6 * status['time']:.4g} µs, {status['step']} steps", f"{seconds:.0f} s"]


def main(words: list[str]) -> int:
    """Prints the table. Returns the exit code."""
    runs = "--run" in words
    words = [word for word in words if word != "--run"]
    if len(words) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    program, folder, decks = words[0], pathlib.Path(words[1]), [pathlib.Path(word) for word in words[2:]]
    folder.mkdir(parents=True, exist_ok=True)
    print("| deck | outcome | until | one core |\n| --- | --- | --- | --- |", flush=True)
    for deck in decks:
        print("| " + " | ".join(row_of(program, deck, folder, runs)) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
