#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The programs in surroundings that are not as they should be: a full device for the output, libraries and modules of
others in the present folder, limits on processors.

Usage: app_surroundings.py BUILD_FOLDER CASE.toml
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from checks import require

BUILD, CASE = pathlib.Path(sys.argv[1]), sys.argv[2]
WHIPPLE = BUILD / "bin" / "whipple"
FULL = [["--help"], ["--version"], ["version"], ["units"], ["materials"], ["describe", "eos", "gray"], ["check", CASE],
        ["compare", "copper", "--with", "cu_hugoniot_marsh1980"], ["eos", "audit", "copper"], ["eos", "hugoniot", "copper", "--to", "10 GPa"],
        ["eos", "state", "copper", "--density", "9 g/cm^3", "--temperature", "300 K"],
        ["eos", "match", "copper", "aluminium", "--velocity", "1 km/s"], ["fit", "--help"]]


def output_into_a_full_device():
    with open("/dev/full", "w") as full:
        calls = [(arguments, subprocess.Popen([WHIPPLE, *arguments], stdout=full, stderr=subprocess.PIPE, text=True))
                 for arguments in FULL]
        for arguments, call in calls:
            message = call.communicate(timeout=120)[1]
            require(call.returncode == 2 and "cannot write to the standard output" in message,
                    f"{arguments} > /dev/full: {call.returncode}, {message}")


def search_paths(folder):
    """An empty element is the present folder, from which foreign code would run."""
    subprocess.run(["cmake", "--install", BUILD, "--prefix", folder], check=True, stdout=subprocess.DEVNULL)
    programs = [*BUILD.glob("bin/whipple*"), *folder.glob("bin/whipple*")]
    require(len(programs) == 6, f"expected three programs, built and installed: {programs}")
    for program in programs:
        dynamic = subprocess.run(["readelf", "-d", program], check=True, capture_output=True, text=True).stdout
        for path in re.findall(r"R(?:UN)?PATH.*\[(.*)\]", dynamic):
            require(all(element.startswith(("/", "$ORIGIN")) for element in path.split(":")), f"{program}: {path}")


def modules_of_others(folder):
    """The interpreter of the report, asked where it finds a module that the present folder and PYTHONPATH offer too."""
    (folder / "json.py").write_text("raise SystemExit('the json.py of the folder ran')\n")
    (folder / "run.toml").write_text(pathlib.Path(CASE).read_text())
    python = folder / "python"
    python.write_text('#!/bin/sh\nexec /usr/bin/python3 "$1" -c "import json; print(json.__file__)"\n')
    python.chmod(0o755)
    # The shell of `-c` looks into its folder, as no script of the project does: it is another one.
    found = subprocess.run([WHIPPLE, "report", folder], capture_output=True, text=True, cwd="/",
                           env={**os.environ, "WHIPPLE_PYTHON": str(python), "PYTHONPATH": f"{folder}:"})
    require(found.returncode == 0 and "/usr/lib/python3" in found.stdout, f"{found.stdout} {found.stderr}")
    # The report itself, of a run that has a history alone, built and installed, in a folder of such modules.
    for name in ("numpy", "matplotlib", "report", "os"):
        (folder / f"{name}.py").write_text(f"raise SystemExit('the {name}.py of the folder ran')\n")
    (folder / "history.csv").write_text("time [s]\n0\n")
    subprocess.run(["cmake", "--install", BUILD, "--prefix", folder / "installed"], check=True, stdout=subprocess.DEVNULL)
    for program in (WHIPPLE, folder / "installed" / "bin" / "whipple"):
        (folder / "report" / "report.html").unlink(missing_ok=True)
        found = subprocess.run([program, "report", folder], capture_output=True, text=True, cwd=folder,
                               env={**os.environ, "PYTHONPATH": f"{folder}:"})
        require(found.returncode == 0 and (folder / "report" / "report.html").is_file(), f"{found.stdout} {found.stderr}")
    alone = subprocess.run(["/usr/bin/python3", "-E", folder / "installed" / "share" / "whipple" / "report", folder],
                           capture_output=True, text=True, cwd=folder)
    require(alone.returncode == 0, alone.stderr)


def threads():
    clean = {name: value for name, value in os.environ.items() if name not in ("OMP_NUM_THREADS", "SLURM_CPUS_PER_TASK")}
    some = str(min(os.sched_getaffinity(0)))
    expected = [({}, [], len(os.sched_getaffinity(0))), ({}, ["taskset", "-c", some], 1), ({"OMP_NUM_THREADS": "3"}, [], 3),
                ({"OMP_NUM_THREADS": "5,2"}, [], 5), ({"SLURM_CPUS_PER_TASK": "3"}, [], 3),
                ({"OMP_NUM_THREADS": "abc"}, ["taskset", "-c", some], 1), ({"OMP_NUM_THREADS": "0"}, ["taskset", "-c", some], 1)]
    for variables, prefix, number in expected:
        done = subprocess.run([*prefix, WHIPPLE, "check", CASE], capture_output=True, text=True, env={**clean, **variables})
        require(done.returncode == 0 and f"on {number} thread" + ("" if number == 1 else "s") + " (" in done.stdout, f"{variables} {prefix}: {done.stdout}")
        ignored = variables.get("OMP_NUM_THREADS") in ("abc", "0")
        require(("expected a number from 1 to 4096: ignored" in done.stderr) == ignored, f"{variables}: {done.stderr}")


def limits():
    """Streams that are closed, small limits, no search path: exit codes as documented, and nothing of what is printed lands
    in a file."""
    expected = [("exec 0<&- 1>&- 2>&-", [], (0,)), ("unset PATH", [], (0,)), ("PATH=/nonexistent", [], (0,)),
                ("unset PATH", ["--ranks", "2"], (0,)), ("PATH=/nonexistent", ["--ranks", "2"], (2,)),
                ("ulimit -n 16", [], (3,)), ("ulimit -n 6", [], (3,)), ("ulimit -s 64", [], (3,)), ("ulimit -f 8", [], (2, 3)),
                ("ulimit -f 8", ["--ranks", "2"], (3,))]
    for before, options, codes in expected:
        with tempfile.TemporaryDirectory() as folder:
            run = [str(WHIPPLE), "run", CASE, "-o", f"{folder}/run", "--threads", "1", "--set", "time.end='0.02 us'", *options]
            call = subprocess.run(["/bin/bash", "-c", before + '; "$@"', "bash", *run], capture_output=True, text=True, timeout=120)
            require(call.returncode in codes, f"{before} {options}: {call.returncode}, {call.stderr}")
            if call.returncode == 0:
                first = next(pathlib.Path(folder).glob("run/*.particles.000000.hdf")).read_bytes()
                require(first.startswith(b"\x89HDF") and b"steps to t" not in first, f"{before}: what a snapshot holds")


def names(folder):
    """Names of cases and folders are bytes: a run, its restart and its report take them."""
    case, run = os.fsencode(folder) + b"/c\xe4.toml", os.fsencode(folder) + b"/o\xe4"
    pathlib.Path(os.fsdecode(case)).write_bytes(pathlib.Path(CASE).read_bytes())
    for arguments in ([b"run", case, b"-o", run, b"--set", b"time.end='0.02 us'"],
                      [b"run", b"--restart", run, b"--set", b"time.end='0.03 us'"],
                      [b"report", run, b"--dpi", b"20", b"--times", b"1", b"--view-megabytes", b"0"]):
        done = subprocess.run([os.fsencode(WHIPPLE), *arguments], capture_output=True, timeout=120)
        require(done.returncode == 0, f"{arguments}: {done.returncode} {done.stderr}")
    index = next(pathlib.Path(os.fsdecode(run)).glob("*.series")).read_text(encoding="utf-8")
    require('"c_.particles.000000.hdf"' in index, f"names in the index: {index}")


def main():
    output_into_a_full_device()
    threads()
    limits()
    for look in (search_paths, modules_of_others, names):
        with tempfile.TemporaryDirectory() as folder:
            look(pathlib.Path(folder))


if __name__ == "__main__":
    main()
