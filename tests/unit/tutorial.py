# SPDX-License-Identifier: BSD-3-Clause
"""A tutorial does what it says: its blocks run in their order in an empty folder, and print what it shows.

Usage: tutorial.py PAGE.md FOLDER [--pictures] [--within SECONDS]

A block with a file name after its language (```toml impact.toml) is written to that file; ```sh runs, and ```python runs
as a program; ```text shows lines of the output of the block before it, with "…" for what differs from run to run. Other
blocks are shown only. None leaves the folder, since a reader goes on in the same shell. With --pictures the picture after
a comment <!-- picture: PATH --> is renewed from that file. The blocks have SECONDS (default 240) together; what they leave
running is ended with the page, however that ends.
"""
import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

from checks import require, wait_for

PAGE, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"<!-- picture: (\S+) -->\n!\[[^\]]*\]\((\S+)\)")
WITHIN = float(sys.argv[sys.argv.index("--within") + 1]) if "--within" in sys.argv else 240.0  # less than that of CTest
COMMANDS = {"sh": ["bash", "-euo", "pipefail", "-c"], "python": ["/usr/bin/python3", "-c"]}


def members(group):
    """Return the processes of a group that have not ended."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # ended meanwhile
            state, _, of = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()[:3]
            if int(of) == group and state not in "ZX":
                found.append(int(stat.parent.name))
    return found


def end(group):
    """End a group of processes: asked first, so that mpirun ends its ranks."""
    for sign in (signal.SIGTERM, signal.SIGKILL):
        if not members(group):
            return
        with contextlib.suppress(ProcessLookupError):
            os.killpg(group, sign)
        with contextlib.suppress(SystemExit):
            wait_for(lambda: not members(group), f"the end of {members(group)}", 2)


def run(command, content, deadline, groups):
    """Run a block in a session of its own, whose group is added to the list; return what it said."""
    with subprocess.Popen([*command, content], cwd=FOLDER, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          start_new_session=True, env=os.environ | {"MPLCONFIGDIR": str(FOLDER.resolve())}) as process:
        groups.append(process.pid)
        try:
            said = process.communicate(timeout=max(deadline - time.monotonic(), 0.1))[0]
        except subprocess.TimeoutExpired:
            end(process.pid)
            require(False, f"{PAGE.name}: not done within {WITHIN:g} s:\n{content}\n{process.communicate()[0]}")
    require(process.returncode == 0, f"{PAGE.name}: exit code {process.returncode} of\n{content}\n{said}")
    return said


def main(groups):
    text, deadline = PAGE.read_text(encoding="utf-8"), time.monotonic() + WITHIN
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    said, shown, ran = "", 0, 0
    for language, file, content in BLOCK.findall(text):
        if file:
            (FOLDER / file).parent.mkdir(parents=True, exist_ok=True)
            (FOLDER / file).write_text(content, encoding="utf-8")
        elif language in COMMANDS:
            require(not re.search("^cd ", content, re.MULTILINE), f"{PAGE.name}: a reader's shell is elsewhere then:\n{content}")
            said, ran = run(COMMANDS[language], content, deadline, groups), ran + 1
        elif language == "text":
            for line in filter(None, (line.strip() for line in content.split("\n"))):
                pattern = ".*".join(re.escape(part) for part in line.split("…"))
                require(re.search(pattern, said), f"{PAGE.name}: not printed: '{line}'; but\n{said}")
                shown += 1
    require(ran > 0 and shown > 0, f"{PAGE.name}: {ran} blocks run, {shown} lines of output shown")
    for source, target in PICTURE.findall(text):
        require((FOLDER / source).is_file(), f"{PAGE.name}: no picture {source}")
        if "--pictures" in sys.argv:
            shutil.copyfile(FOLDER / source, PAGE.parent / target)
    print(f"{PAGE.name}: {ran} blocks run, {shown} lines of output as shown")


blocks = []
try:
    main(blocks)
finally:
    for block in blocks:
        end(block)
