#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""whipple shield: equations, cases and studies that other commands accept, and what is refused.

Usage: app_shield.py WHIPPLE SHOTS FOLDER
"""
import json
import pathlib
import shutil
import subprocess
import sys

from checks import require

WHIPPLE, SHOTS, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
SHIELD = """name = "{name}"
[projectile]
alloy = "2017-T4"
diameter = "3 mm"
velocity = "5 km/s"
angle = "{angle} degree"
{bumpers}
[shield.wall]
alloy = "{wall}"
thickness = "3 mm"
"""
BUMPER = '[[shield.bumper]]\nalloy = "6061-T6"\nthickness = "{}"\nspacing = "4 cm"\n'


def whipple(*words, code=0):
    done = subprocess.run([WHIPPLE, *map(str, words)], capture_output=True, text=True, timeout=120)
    require(done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout, done.stderr


def shield(name="shield", angle=0, bumpers=1, wall="6061-T6", thickness="1 mm"):
    file = FOLDER / f"{name}.toml"
    file.write_text(SHIELD.format(name=name, angle=angle, wall=wall, bumpers=bumpers * BUMPER.format(thickness)), encoding="utf-8")
    return file


def equations():
    entries = json.loads(whipple("shield", SHOTS, "--json")[0])
    require([entry["result"] for entry in entries] == ["P", "NP", "P", "P"], entries)
    limits = entries[1]["equations"]
    require(abs(limits["nno_1993"]["critical_diameter"] - 4.62e-3) < 1e-5, limits["nno_1993"])  # by hand: 2.508 mm at 3, 5.324 mm at 7 km/s
    require(limits["srl_2008"]["critical_diameter"] is None and "2 bumpers" in limits["srl_2008"]["reason"], limits)
    three = json.loads(whipple("shield", shield("three", bumpers=2), "--json")[0])[0]
    require(three["equations"]["srl_2008"]["critical_diameter"] > 0 and three["equations"]["nno_1993"]["critical_diameter"] is None, three)
    require([sheet["name"] for sheet in three["case"]["sheets"]] == ["bumper_1", "bumper_2", "wall"], three["case"])
    text = whipple("shield", SHOTS, "--shot", "HD9920040")[0]
    require("measured P" in text and "nno_2001" in text and "4 cells across the bumper" in text, text)


def cases():
    out = FOLDER / "all"
    whipple("shield", SHOTS, "-o", out, "--dry-run")
    require(not out.exists(), "--dry-run has written")
    whipple("shield", SHOTS, "-o", out)
    require(len(list(out.glob("*/case.toml"))) == 4, list(out.iterdir()))
    whipple("check", out / "HD9920040" / "case.toml", "--brief")
    require("exists" in whipple("shield", SHOTS, "-o", out, code=2)[1], "a case was overwritten")
    oblique = shield("oblique", angle=45, thickness="0.05 mm")
    for model in ("space", "section"):
        entry = json.loads(whipple("shield", oblique, "--model", model, "--json")[0])[0]["case"]
        require(("refused" in entry) == (model == "section"), entry)
    entry = json.loads(whipple("shield", oblique, "--model", "space", "--json")[0])[0]["case"]
    require(not entry["resolved"] and "cap" in entry["chosen_by"], entry)
    require("--model space" in whipple("shield", oblique, "-o", FOLDER / "oblique", code=2)[1], "a section of an oblique impact")
    whipple("shield", oblique, "--model", "space", "--cell-size", "0.5 mm", "-o", FOLDER / "oblique")
    whipple("check", FOLDER / "oblique" / "case.toml", "--brief")


def limits():
    file, out = shield("limit"), FOLDER / "limit"
    whipple("shield", file, "--limit", "4 km/s", "--limit", "7 km/s", "--cell-size", "0.5 mm", "-o", out)
    text, remarks = whipple("sweep", out / "study.toml", "--dry-run", "-o", FOLDER / "study")
    listed = text.splitlines()
    require("same computation" not in remarks, "positions of the grid do not move it")
    require(len(listed) == 2 * 3 * 6, f"{len(listed)} points: three spheres at two speeds in two cells and three positions of the grid")
    require("-o FOLDER" in whipple("shield", file, "--limit", "4 km/s", code=2)[1], "a study without a folder")
    require("--shot" in whipple("shield", SHOTS, "--limit", "4 km/s", "-o", FOLDER / "none", code=2)[1], "a study of four shots")
    text = whipple("shield", file, "--limit", "4 km/s", "--dry-run", "-o", out, code=2)
    require("exists" in text[1] and "would write" not in text[1] + text[0], f"a dry run into a folder that exists: {text}")
    require("--limit" in whipple("shield", file, "--limit", "4 kg", "-o", FOLDER / "none", code=2)[1], "a mass as a speed")


def faults():
    require("7075-T6" in whipple("shield", shield("alloy", wall="7075-T7"), code=2)[1], "accepted alloys are not listed")
    require("no material" in whipple("shield", shield("soft", wall="3003-H12"), "-o", FOLDER / "soft", code=2)[1], "3003 has no material")
    require("no shot" in whipple("shield", SHOTS, "--shot", "HD992004", code=2)[1], "an unknown shot")
    whipple("shield", FOLDER / "absent.csv", code=2)
    empty = FOLDER / "empty.csv"
    empty.write_text("".join(line for line in SHOTS.read_text(encoding="utf-8").splitlines(True) if line.startswith(("#", "shot"))), encoding="utf-8")
    require("no shots" in whipple("shield", empty, code=2)[1], "a table without shots")
    whipple("shield", FOLDER, "--outcome", code=2)


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for test in (equations, cases, limits, faults):
        test()


if __name__ == "__main__":
    main()
