#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Calls to the system fail, one at a time, while each command runs: the disk is full, broken or gone, a transfer is cut or
interrupted. The command must end, with a documented exit code and the reason; nothing that was there before may be lost;
without the fault it must then come to its end.

Usage: injected_faults.py WHIPPLE FAILING_CALLS.so CASE.toml FOLDER [--faults 500] [--seed 1] [--only NAME,...]
"""
import argparse
import collections
import csv
import errno
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

WALL = 240.0  # s; a machine may be shared
DEFECTS = ("internal error", "Traceback", "terminate called", "Segmentation fault", "signal 6", "signal 11")
LASTING = [errno.ENOSPC, errno.EIO, errno.EDQUOT, errno.EROFS]
ERRORS = {"open": [*LASTING, errno.EACCES, errno.EMFILE], "open_to_read": [errno.EIO, errno.EACCES, errno.EMFILE, errno.ENOENT],
          "write": [*LASTING, errno.EINTR, 0], "read": [errno.EIO, errno.EINTR, 0], "sync": [errno.EIO, errno.ENOSPC],
          "close": [errno.EIO, errno.ENOSPC, errno.EDQUOT], "rename": [*LASTING, errno.EACCES],
          "truncate": [errno.EIO, errno.ENOSPC], "remove": [errno.EIO, errno.EACCES], "folder": [*LASTING, errno.EACCES],
          "lock": [errno.EIO]}
TOLERATED = (errno.EINTR, 0)  # these are no errors: the call is to be repeated

NAMES = ["run", "restart", "run on ranks", "restart on ranks", "analyse", "report", "fit", "md", "md on ranks"]

PLAN = pathlib.Path(__file__).resolve().parents[1] / "data" / "small_plan.toml"


class Setting:
    """What all trials share: the program, a run that was stopped in its middle, its end, a store for a fit."""

    def __init__(self, options, names):
        self.whipple, self.library, self.folder = str(options.whipple), str(options.library), options.folder
        self.case = str(options.case)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.small = ["--threads", "1", "--quiet", "--set", "output.snapshot_every='0.1 us'"]
        self.call("run", self.case, "-o", "whole", *self.small)
        if any("restart" in name for name in names):
            self.call("run", self.case, "-o", "stopped", *self.small, "--wall-time", "0.2 s", codes=(0, 124))
        shutil.copy(PLAN, self.folder / "plan.toml")
        if "fit" in names:
            self.call("md", "plan.toml", "-o", "half.md.h5", "--ranks", "1", "--quiet")

    def call(self, *arguments, codes=(0,)):
        result = subprocess.run([self.whipple, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                                timeout=WALL)
        if result.returncode not in codes:
            raise SystemExit(f"FAILED: without a fault: {arguments}: {result.returncode} {result.stderr}")
        return result


class Command:
    """A command under test. `begin(setting, folder)` prepares, `arguments` start it; `calm(setting, folder, code)` returns
    what is wrong after it, when all is well again."""

    def __init__(self, arguments, begin=None, calm=None, refuses=""):
        """@param refuses  what the command says of its input even without a fault, with exit code 2"""
        self.arguments, self.begin, self.calm = arguments, begin or (lambda *_: None), calm or (lambda *_: [])
        self.refuses = refuses

    def ends_as_without(self, code, words):
        return code == 2 and self.refuses in words if self.refuses else code == 0


def same_history(setting, run):
    expected = (setting.folder / "whole" / "history.csv").read_bytes()
    return [] if (run / "history.csv").read_bytes() == expected else ["the history is not that of an undisturbed run"]


def goes_on(ranks):
    def calm(setting, folder, code):
        run = folder / "run"
        began = list(run.glob("checkpoint/*.h5"))
        if code != 0 or not began:
            call = ["--restart", run] if began else [setting.case, "-o", run, "--force", *setting.small[3:]]
            again = subprocess.run([setting.whipple, "run", *map(str, call), "--threads", "1", "--quiet"],
                                   capture_output=True, text=True, timeout=WALL)
            if again.returncode != 0:
                return [f"does not go on: {again.returncode} {again.stderr}"]
        left = [f"{path.name} is left" for path in run.rglob("*.partial")] if code != 0 else []
        if ranks > 1:
            rows = [len(list(csv.reader((path / "history.csv").open(newline="")))) for path in (run, setting.folder / "whole")]
            return left + ([] if rows[0] == rows[1] else [f"{rows[0]} rows of {rows[1]}"])
        return left + same_history(setting, run)
    return calm


def stopped_run(setting, folder):
    shutil.copytree(setting.folder / "stopped", folder / "run")


def whole_run(setting, folder):
    shutil.copytree(setting.folder / "whole", folder / "run")


def run_is_unchanged(setting, folder, code):
    whole = setting.folder / "whole"
    changed = [path.name for path in whole.glob("*.*") if (folder / "run" / path.name).read_bytes() != path.read_bytes()]
    return [f"changed {changed}"] if changed else []


def copied_store(setting, folder):
    shutil.copy(setting.folder / "half.md.h5", folder / "s.md.h5")
    shutil.copy(setting.folder / "plan.toml", folder / "plan.toml")


def store_is_unchanged(setting, folder, code):
    same = (folder / "s.md.h5").read_bytes() == (setting.folder / "half.md.h5").read_bytes()
    return [] if same else ["the store has changed"]


def only_plan(setting, folder):
    shutil.copy(setting.folder / "plan.toml", folder / "plan.toml")


def store_is_completed(setting, folder, code):
    again = subprocess.run([setting.whipple, "md", "plan.toml", "-o", "s.md.h5", "--ranks", "1", "--retry-failed"], cwd=folder,
                           capture_output=True, text=True, timeout=WALL)
    return [] if again.returncode == 0 else [f"the next call: {again.returncode} {again.stderr}"]


def commands(setting):
    small = setting.small
    md = ["md", "plan.toml", "-o", "s.md.h5", "--quiet", "--ranks"]
    return {
        "run": Command(["run", setting.case, "-o", "run", *small], None, goes_on(1)),
        "restart": Command(["run", "--restart", "run", *small[:3]], stopped_run, goes_on(1)),
        "run on ranks": Command(["run", setting.case, "-o", "run", *small, "--ranks", "2"], None, goes_on(2)),
        "restart on ranks": Command(["run", "--restart", "run", *small[:3], "--ranks", "2"], stopped_run, goes_on(2)),
        "analyse": Command(["analyse", "run", "-o", "out"], whole_run, run_is_unchanged),
        "report": Command(["report", "run", "-o", "out", "--dpi", "20", "--times", "1", "--view-megabytes", "0"], whole_run,
                          run_is_unchanged),
        "fit": Command(["fit", "s.md.h5", "--model", "mie_gruneisen", "-o", "m.toml"], copied_store, store_is_unchanged,
                       refuses="points are missing"),
        "md": Command([*md, "1"], only_plan, store_is_completed),
        "md on ranks": Command([*md, "2"], only_plan, store_is_completed),
    }


def start(setting, command, folder, fault):
    environment = dict(os.environ, LD_PRELOAD=setting.library, OMP_NUM_THREADS="1", FAULT_PATH=str(folder),
                       OMP_WAIT_POLICY="passive", **fault)
    process = subprocess.Popen([setting.whipple, *map(str, command.arguments)], cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment, start_new_session=True)
    try:
        output = process.communicate(timeout=WALL)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output = process.communicate()[0]
        return None, output.decode(errors="replace")
    return process.returncode, output.decode(errors="replace")


def count_calls(setting, name, command, kind):
    """Calls of a kind that the busiest process of a command makes on files of its folder."""
    folder, counts = setting.folder / "counted", setting.folder / "counts"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    counts.unlink(missing_ok=True)
    command.begin(setting, folder)
    code, words = start(setting, command, folder, {"FAULT_CALL": kind, "FAULT_COUNTS": str(counts)})
    if not command.ends_as_without(code, words):
        raise SystemExit(f"FAILED: {name} without a fault: {code} {words}")
    return max(map(int, counts.read_text().split())) if counts.exists() else 0


def trial(setting, name, command, fault, error):
    folder = setting.folder / "trial"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    command.begin(setting, folder)
    begin = time.monotonic()
    code, words = start(setting, command, folder, fault)
    faults = []
    if code is None:
        return None, ["does not end"], words
    if code not in (0, 2, 3):
        faults.append(f"exit code {code}")
    if any(defect in words for defect in DEFECTS):
        faults.append("a defect")
    as_without = command.ends_as_without(code, words)
    reasons = [os.strerror(error)] + (["there is no such file"] if error == errno.ENOENT else [])
    if not as_without and not any(reason in words for reason in reasons):
        faults.append("the message does not name the reason")
    if not as_without and error in TOLERATED:
        faults.append("stopped by what is no error")
    faults += command.calm(setting, folder, code)
    if time.monotonic() - begin > WALL:
        faults.append("takes too long")
    return code, faults, words


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("whipple", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--faults", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    for name in ("whipple", "library", "case", "folder"):
        setattr(options, name, getattr(options, name).resolve())
    names = options.only.split(",") if options.only else NAMES
    setting = Setting(options, names)
    all_commands = commands(setting)
    chosen = random.Random(options.seed)
    calls, codes, bad = {}, collections.Counter(), 0
    for number in range(options.faults):
        name = names[number % len(names)]
        command = all_commands[name]
        kind = chosen.choice([kind for kind in ERRORS if calls.get((name, kind)) != 0])
        if (name, kind) not in calls:
            calls[name, kind] = count_calls(setting, name, command, kind)
        if calls[name, kind] == 0:
            codes["no such call"] += 1
            continue
        error = chosen.choice(ERRORS[kind])
        fault = {"FAULT_CALL": kind, "FAULT_NUMBER": str(chosen.randint(1, calls[name, kind])), "FAULT_ERRNO": str(error)}
        if error not in TOLERATED and chosen.random() < 0.5:
            fault["FAULT_LASTS"] = "1"
        if "ranks" in name and chosen.random() < 0.5:
            fault["FAULT_RANK"] = str(chosen.randrange(2))
        code, faults, words = trial(setting, name, command, fault, error)
        codes[code] += 1
        if faults:
            bad += 1
            what = " ".join(f"{key}={value}" for key, value in fault.items())
            print(f"{number} {name}, {what}: exit code {code}: {'; '.join(faults)}\n{words[-1500:]}\n", flush=True)
    print(f"{options.faults} faults: " + ", ".join(f"exit code {code}: {count}" for code, count in sorted(codes.items(), key=str)) +
          f"; {bad} wrong")
    if bad == 0:
        shutil.rmtree(options.folder)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
