#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A restart that cannot read what an earlier part of the run wrote ends with the file and the reason, and leaves it as it is:
an error of the disk is not the end of a file.

usage: restart_read_errors.py WHIPPLE FAILING_CALLS.so CASE.toml FOLDER
"""
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "unit"))
from checks import require  # noqa: E402


def main():
    whipple, library, case, folder = sys.argv[1:4] + [pathlib.Path(sys.argv[4])]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    stopped = folder / "stopped"
    subprocess.run([whipple, "run", case, "-o", stopped, "--threads", "1", "--quiet", "--set", "time.end='0.1 us'"], check=True)
    for name in ("history.csv", ".series", "run.toml"):
        for advice in ([], ["--force"]):
            run = folder / f"of_{name.strip('.')}{len(advice)}"
            shutil.copytree(stopped, run)
            before = {path.name: path.read_bytes() for path in run.iterdir() if path.name.endswith(name)}
            require(before, f"{name} is not there")
            fault = dict(os.environ, LD_PRELOAD=library, FAULT_CALL="read", FAULT_PATH=name, FAULT_NUMBER="1", FAULT_ERRNO="5",
                         FAULT_LASTS="1", OMP_NUM_THREADS="1")
            done = subprocess.run([whipple, "run", "--restart", run, "--threads", "1", "--quiet", "--set", "time.end='0.2 us'",
                                   *advice], env=fault, capture_output=True, text=True, timeout=120)
            said = f"{name} {advice}: exit code {done.returncode}: {done.stderr}"
            require(done.returncode == 2 and "Input/output error" in done.stderr and name in done.stderr, said)
            after = {path.name: path.read_bytes() for path in run.iterdir() if path.name.endswith(name)}
            require(after == before, f"{name} {advice}: the file has changed")
    shutil.rmtree(folder)


main()
