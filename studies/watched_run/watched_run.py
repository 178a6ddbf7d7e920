#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What does watching cost a run? The same run alternately alone and with `whipple monitor` and a client that asks for what its
page asks for once a second: runs, run, curves, every new snapshot. Compares the processor time of the run, which other
programs disturb least, and the time of its steps.

usage: watched_run.py WHIPPLE CASE.toml FOLDER [PAIRS] [KEY=VALUE...]
"""
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import threading
import urllib.parse
import urllib.request

PARTICLES = 200000  # of a snapshot, as the page asks for
COLUMNS = ("kinetic_energy", "internal_energy", "unresolved_energy", "total_energy", "momentum_x", "momentum_y", "momentum_z",
           "mass_solid", "mass_melting", "mass_liquid", "mass_vapour", "failed_mass")


class Watcher:
    """A monitor of a folder, and a thread that asks it as a page does."""

    def __init__(self, program: str, folder: pathlib.Path):
        self.process = subprocess.Popen([program, "monitor", str(folder)], stdout=subprocess.PIPE, text=True)
        self.address, self.key = re.search(r"(http://[0-9.:]+)/#([0-9a-f]+) ", self.process.stdout.readline()).groups()
        self.ended, self.questions, self.seen = threading.Event(), 0, 0
        self.thread = threading.Thread(target=self.watch, daemon=True)
        self.thread.start()

    def ask(self, path: str, **keys: object) -> bytes:
        """Asks a question."""
        query = urllib.parse.urlencode(keys, doseq=True)
        request = urllib.request.Request(f"{self.address}{path}?{query}", headers={"X-Whipple-Token": self.key})
        self.questions += 1
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.read()

    def look(self) -> None:
        """Asks for all that is new of the first run that goes on."""
        runs = json.loads(self.ask("/runs"))["runs"]
        name = next((run["name"] for run in runs if run["goes_on"]), None)
        if name is None:
            return
        run = json.loads(self.ask("/run", run=name))
        heads = run["tables"]["history"]
        wanted = [head for head in heads if re.sub(r" \[.*", "", head) in COLUMNS]
        time = next((head for head in heads if head.startswith("time ")), None)
        if time and wanted:
            self.ask("/curves", run=name, table="history", x=time, y=wanted, points=1600)
        for index in range(self.seen, len(run["snapshots"])):
            self.ask("/cloud", run=name, index=index, particles=PARTICLES)
        self.seen = len(run["snapshots"])

    def watch(self) -> None:
        """Looks once a second."""
        while not self.ended.wait(1.0):
            try:
                self.look()
            except (OSError, ValueError, KeyError) as error:  # a file in the making, say
                print(f"watching: {error}", file=sys.stderr)

    def end(self) -> int:
        """Ends the monitor. Returns the number of questions that it answered."""
        self.ended.set()
        self.thread.join()
        self.process.terminate()
        self.process.wait()
        return self.questions


def run_once(program: str, case: str, folder: pathlib.Path, sets: list[str]) -> tuple[float, float]:
    """Runs a case. Returns the processor time of the run and the time of its steps, s."""
    words = [program, "run", case, "-o", str(folder), "--quiet", "--threads", "1"]
    for each in sets:
        words += ["--set", each]
    process = subprocess.Popen(words)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status:
        raise SystemExit(f"the run ended with status {status}")
    wall = json.loads((folder / "status.json").read_text())["wall_time"]
    return usage.ru_utime + usage.ru_stime, wall


def main(words: list[str]) -> int:
    """Measures and prints. Returns the exit code."""
    if len(words) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    program, case, folder = words[0], words[1], pathlib.Path(words[2])
    pairs = int(words[3]) if len(words) > 3 else 6
    if folder.exists() and any(folder.iterdir()):
        raise SystemExit(f"{folder} is not empty: name a new folder, which the runs are written to and removed from")
    folder.mkdir(parents=True, exist_ok=True)
    times: dict[str, list[tuple[float, float]]] = {"alone": [], "watched": []}
    questions = 0
    for pair in range(pairs):
        for kind in ("alone", "watched") if pair % 2 == 0 else ("watched", "alone"):
            watcher = Watcher(program, folder) if kind == "watched" else None
            run = folder / f"{kind}_{pair}"
            times[kind].append(run_once(program, case, run, words[4:]))
            questions += watcher.end() if watcher else 0
            shutil.rmtree(run)
    print(f"{pairs} pairs, {questions} questions to the monitor")
    for place, what in enumerate(("processor time", "time of the steps")):
        alone, watched = ([each[place] for each in times[kind]] for kind in ("alone", "watched"))
        ratios = [b / a for a, b in zip(alone, watched)]
        error = statistics.stdev(ratios) / len(ratios) ** 0.5 if len(ratios) > 1 else float("nan")
        print(f"{what}: alone {statistics.median(alone):.2f} s, watched {statistics.median(watched):.2f} s (medians); "
              f"ratio {statistics.mean(ratios):.4f} ± {error:.4f}, least over least {min(watched) / min(alone):.4f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
