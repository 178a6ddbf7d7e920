# SPDX-License-Identifier: BSD-3-Clause
"""What runs tutorials finds pages that do not hold, and ends what they leave running: after a block that fails, after one
that does not end, and after a page that holds.

Usage: tutorial_pages.py FOLDER
"""
import contextlib
import pathlib
import shutil
import subprocess
import sys

from checks import require, wait_for

FOLDER = pathlib.Path(sys.argv[1]).resolve()
RUNNER = pathlib.Path(__file__).with_name("tutorial.py")
BACKGROUND = "sleep 300 > log 2>&1 &\necho $! > left\n"
PAGES = {  # name: (blocks, seconds, exit code, what is said)
    "holds": ((("sh", BACKGROUND + "echo a run of 17 s"), ("text", "a run of … s")), 60, 0, "1 lines of output as shown"),
    "fails": ((("sh", BACKGROUND), ("sh", "cat nothing")), 60, 1, "exit code 1 of"),
    "says_something_else": ((("sh", BACKGROUND + "echo 17"), ("text", "18")), 60, 1, "not printed: '18'"),
    "does_not_end": ((("sh", BACKGROUND), ("sh", "echo begun; until [[ -f nothing ]]; do sleep 0.1; done")), 1, 1, "not done within 1 s"),
    "deaf": ((("sh", "trap '' TERM; " + BACKGROUND + "sleep 300"),), 1, 1, "not done within 1 s"),
    "leaves": ((("sh", BACKGROUND), ("sh", "mkdir elsewhere\ncd elsewhere")), 60, 1, "a reader's shell is elsewhere"),
    "does_nothing": ((("toml", "a = 1"),), 60, 1, "0 blocks run"),
}


def runs(process):
    with contextlib.suppress(OSError):
        return ") Z" not in pathlib.Path("/proc", process, "stat").read_text(encoding="utf-8")
    return False


def check(name, blocks, seconds, code, said):
    page, folder = FOLDER / f"{name}.md", FOLDER / name
    page.write_text("".join(f"```{language}\n{text}\n```\n" for language, text in blocks), encoding="utf-8")
    done = subprocess.run([sys.executable, RUNNER, page, folder, "--within", str(seconds)], capture_output=True, text=True, check=False, timeout=100)
    require(done.returncode == code and said in done.stdout + done.stderr, f"{name}: {done.returncode}\n{done.stdout}{done.stderr}")
    if (folder / "left").is_file():
        process = (folder / "left").read_text(encoding="utf-8").strip()
        wait_for(lambda: not runs(process), f"the end of what {name} left", 5)
    return (folder / "left").is_file()


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
left = [check(name, *of) for name, of in PAGES.items()]
require(sum(left) == 6, f"{sum(left)} pages left something running")
print(f"{len(PAGES)} pages, nothing goes on")
