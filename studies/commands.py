# SPDX-License-Identifier: BSD-3-Clause
"""Commands that studies run."""
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]


def call(command, allowed=(0,)):
    """Runs a command from the root of the project and returns what it printed; ends the study if its code is not allowed."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=ROOT, check=False)
    if result.returncode not in allowed:
        sys.exit(f"{' '.join(map(str, command))}\nfailed with code {result.returncode}:\n{result.stdout}{result.stderr}")
    return result


def timed_run(arguments, folder, prepare):
    """Runs and analyses a case on one thread unless a run of the same program is there. prepare() returns case file and settings;
    with arguments.table nothing is run. @returns code, user time (s) and largest memory (bytes) of the run, or None"""
    record = folder.with_suffix(".json")
    if record.exists():
        kept = json.loads(record.read_text(encoding="utf-8"))
        if arguments.table or kept["program"] == str(arguments.whipple.stat().st_mtime_ns):
            return kept
    if arguments.table:
        return None
    folder.parent.mkdir(parents=True, exist_ok=True)
    case, settings = prepare()
    command = [str(arguments.whipple), "run", str(case), "-o", str(folder), "--force", "--quiet", "--threads", "1",
               *[word for setting in settings for word in ("--set", setting)]]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = code = os.waitstatus_to_exitcode(status)
    if code == 0:
        code = subprocess.run([str(arguments.whipple), "analyse", str(folder), "--quiet"], check=False, stdout=subprocess.DEVNULL).returncode
    kept = {"program": str(arguments.whipple.stat().st_mtime_ns), "code": code, "seconds": usage.ru_utime, "memory": 1024 * usage.ru_maxrss}
    record.write_text(json.dumps(kept), encoding="utf-8")
    return kept


def digest(file):
    """SHA-256 of a file."""
    return hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()


@functools.cache
def program(whipple):
    """Version and revision of the program; the digest too where it was built from changed sources, which a revision does not name."""
    version = call([whipple, "version"]).stdout.splitlines()[0]
    return f"{version} {digest(shutil.which(whipple))}" if "+changes" in version else version


RECORD = "study.json"  # beside a run: what computed it
LIBRARY = ROOT / "eos" / "materials"


def library_materials(folder):
    """Digests of the files of the library, and of those that they are based on, that a run has copies of."""
    found = {}
    waiting = [path.name for path in folder.glob("materials/*.toml")]
    while waiting:
        file = LIBRARY / waiting.pop()
        if file.name not in found and file.is_file():
            found[file.name] = digest(file)
            base = tomllib.loads(file.read_text(encoding="utf-8")).get("base", "")
            waiting.append(base if base.endswith(".toml") else f"{base}.toml")
    return dict(sorted(found.items()))


def compute(whipple, folder, commands, inputs=(), allowed=(0,)):
    """Runs commands of the program whose results are in the folder, unless that was done before: by the same program, with the same
    words, with the same bytes in the files `inputs` and in the materials of the library that the run read. Ends the study if a code is not
    allowed."""
    words = [[str(word).replace(str(folder), "RUN").replace(f"{ROOT}/", "") for word in command] for command in commands]
    record = {"program": program(whipple), "commands": words, "inputs": {pathlib.Path(file).name: digest(file) for file in inputs}}
    path = folder / RECORD
    if path.is_file() and json.loads(path.read_text(encoding="utf-8")) == record | {"materials": library_materials(folder)}:
        return
    path.unlink(missing_ok=True)
    for command in commands:
        call([whipple, *command], allowed)
    record["materials"] = library_materials(folder)
    path.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def cell_size(folder):
    """Cell size of a run (m)."""
    return float(tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["domain"]["cell_size"].split()[0])
