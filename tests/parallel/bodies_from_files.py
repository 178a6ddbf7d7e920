#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bodies from a surface and an image through the program: on one rank and two the same history, and a restart after the files
are gone takes the copies of the run.

Usage: bodies_from_files.py WHIPPLE FOLDER
"""
import csv
import pathlib
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "unit"))
from checks import require  # noqa: E402

WHIPPLE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
CASE = """[domain]
lower = ["-4 mm", "-4 mm", "-4 mm"]
upper = ["4 mm", "4 mm", "4 mm"]
cell_size = "0.8 mm"
[time]
end = "0.3 us"
[output]
snapshot_every = "0.15 us"
[[body]]
name = "cube"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "2 km/s"]
shape = { surface = { file = "cube.stl", unit = "1 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { image = { file = "plate.nrrd", unit = "1 mm", values = [1] } }
"""


def cube(lower, edge):
    """A cube as text STL."""
    text = "solid cube\n"
    for axis in range(3):
        for upper in (False, True):
            def at(u, v):
                place = [0, 0, 0]
                place[axis] = int(upper)
                place[(axis + 1) % 3], place[(axis + 2) % 3] = (u, v) if upper else (v, u)
                return " ".join(str(low + edge * x) for low, x in zip(lower, place))
            for corners in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1))):
                lines = "".join(f"vertex {at(*corner)}\n" for corner in corners)
                text += f"facet normal 0 0 0\nouter loop\n{lines}endloop\nendfacet\n"
    return text + "endsolid cube\n"


def run(*arguments, ranks=1):
    more = ["--ranks", str(ranks)] if ranks > 1 else []
    done = subprocess.run([WHIPPLE, "run", *map(str, arguments), "--threads", "1", "--quiet", *more],
                          capture_output=True, text=True, timeout=250)
    require(done.returncode == 0, f"{arguments}: exit code {done.returncode}: {done.stderr}")


def last_row(folder):
    with open(folder / "history.csv", newline="") as file:
        return list(csv.DictReader(file))[-1]


def require_same(one, other, what):
    for name in ("time [s]", "momentum_z [kg m/s]", "kinetic_energy [J]", "internal_energy [J]"):
        a, b = float(one[name]), float(other[name])
        require(abs(a - b) <= 1e-9 * abs(a), f"{what}: {name} is {a} and {b}")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    case = FOLDER / "case.toml"
    case.write_text(CASE)
    (FOLDER / "cube.stl").write_text(cube([-1.0, -1.0, -2.2], 2.0))
    header = ("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 8 8 2\nencoding: raw\nspace units: \"mm\" \"mm\" \"mm\"\n"
              "space directions: (0.8,0,0) (0,0.8,0) (0,0,0.8)\nspace origin: (-2.8,-2.8,0.4)\n\n")
    (FOLDER / "plate.nrrd").write_bytes(header.encode() + b"\1" * 128)
    run(case, "-o", FOLDER / "one")
    run(case, "-o", FOLDER / "two", ranks=2)
    run(case, "-o", FOLDER / "stopped", "--set", "time.end='0.15 us'", ranks=2)
    one = last_row(FOLDER / "one")
    require(float(one["momentum_z [kg m/s]"]) > 0.0, f"nothing moves: {one}")
    require_same(one, last_row(FOLDER / "two"), "two ranks")
    (FOLDER / "cube.stl").unlink()
    (FOLDER / "plate.nrrd").write_text("another file")
    run("--restart", FOLDER / "stopped", "--set", "time.end='0.3 us'", ranks=2)
    require_same(one, last_row(FOLDER / "stopped"), "restart")
    shutil.rmtree(FOLDER)


main()
