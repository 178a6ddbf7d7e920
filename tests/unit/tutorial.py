# SPDX-License-Identifier: BSD-3-Clause
"""A tutorial does what it says: its blocks run in their order in an empty folder, and print what it shows.

Usage: tutorial.py PAGE.md FOLDER [--pictures]

A block with a file name after its language (```toml impact.toml) is written to that file; ```sh runs, and ```python runs
as a program; ```text shows lines of the output of the block before it, with "…" for what differs from run to run. Other
blocks are shown only. With --pictures the picture after a comment <!-- picture: PATH --> is renewed from that file.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from checks import require

PAGE, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"<!-- picture: (\S+) -->\n!\[[^\]]*\]\((\S+)\)")
COMMANDS = {"sh": ["bash", "-euo", "pipefail", "-c"], "python": ["/usr/bin/python3", "-c"]}


def main():
    text = PAGE.read_text(encoding="utf-8")
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    said, shown, ran = "", 0, 0
    for language, file, content in BLOCK.findall(text):
        if file:
            (FOLDER / file).parent.mkdir(parents=True, exist_ok=True)
            (FOLDER / file).write_text(content, encoding="utf-8")
        elif language in COMMANDS:
            done = subprocess.run([*COMMANDS[language], content], cwd=FOLDER, text=True, check=False, timeout=600,
                                  env=os.environ | {"MPLCONFIGDIR": str(FOLDER.resolve())},
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            said, ran = done.stdout, ran + 1
            require(done.returncode == 0, f"{PAGE.name}: exit code {done.returncode} of\n{content}\n{said}")
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


main()
