#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Potential files that are damaged, by a copy that went wrong or by hand: the plan is refused with a message that names the
file, also where only LAMMPS, or the crystal that flies apart, shows the damage.

usage: md_damaged_potential.py WHIPPLE
"""
import pathlib
import subprocess
import sys
import tempfile

sys.path[0] = str(pathlib.Path(__file__).resolve().parent)
from checks import require  # noqa: E402

WHOLE = pathlib.Path("/usr/share/lammps/potentials/Cu_u3.eam")  # 500 numbers of each of three functions, five a line
PLAN = """title = "damaged"
element = "Cu"
potential = "p.eam"
[zero_pressure_volume]
temperature = ["293 K"]
cells = 2
equilibration_steps = 100
steps = 200
"""


def damages(text):
    """Texts of damaged files by name, each with the reason that the message must hold."""
    lines = text.splitlines(keepends=True)

    def with_line(number, line):
        return "".join([*lines[:number], line + "\n", *lines[number + 1:]])

    numbers = lines[100].split()
    # Five lines of the embedding function, from digit to digit, once more within the density.
    at, begin = (sum(map(len, lines[:line])) + 3 * 24 + 12 for line in (293, 90))
    yield "bytes twice", text[:at] + text[begin:begin + 5 * len(lines[90])] + text[at:], "Lost atoms"
    yield "huge attraction", with_line(150, " 1e30" * 5), "Lost atoms"
    yield "no number", with_line(100, " ".join(["nan", *numbers[1:]])), "p.eam:101: error: the potential file has 'nan' for a number"
    yield "a word", with_line(100, " ".join([numbers[0] + "x", *numbers[1:]])), f"p.eam:101: error: the potential file has '{numbers[0]}x'"
    yield "cut off", text[:len(text) // 2], "too few numbers for the effective charge"
    yield "without a line", "".join([*lines[:200], *lines[201:]]), "too few numbers for the density function"
    yield "no density", "".join([*lines[:203], *["0 0 0 0 0\n"] * 100]), "has no energy minimum for lattice constants"
    yield "bytes that are no text", text[:5000] + "\0\xff\x80" * 10 + text[5030:], "characters that are not printable"


def main():
    whipple = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "plan.toml").write_text(PLAN)
        for what, damaged, words in damages(WHOLE.read_text()):
            (folder / "p.eam").write_bytes(damaged.encode("latin-1"))
            done = subprocess.run([whipple, "md", "plan.toml", "-o", "s.md.h5", "--ranks", "1", "--quiet"], cwd=folder,
                                  capture_output=True, text=True, timeout=120)
            said = f"{what}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
            require(done.returncode == 2, said)
            require("p.eam" in done.stderr and words in done.stderr and "internal" not in done.stderr, said)
            require(not list(folder.glob("*.partial")), f"{what}: a store is left half written")
            print(f"{what}: {done.stderr.strip().splitlines()[-1][:150]}")
            (folder / "s.md.h5").unlink(missing_ok=True)


main()
