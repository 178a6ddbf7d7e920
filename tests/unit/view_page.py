#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page of `whipple view` of a small run: what it holds, what it needs, how it is asked for.

Usage: view_page.py WHIPPLE CASE.toml SOURCE_FOLDER
"""
import base64
import gzip
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from checks import require

WHIPPLE, CASE, SOURCE = sys.argv[1:]
PAGE_CHECK = pathlib.Path(SOURCE) / "web" / "viewer" / "tests" / "page_check.js"


def whipple(*arguments, code=0):
    done = subprocess.run([WHIPPLE, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    require(done.returncode == code, f"{arguments}: exit code {done.returncode}, {done.stdout} {done.stderr}")
    return done.stdout + done.stderr


def cloud_of(data):
    """Header and planes of a `.wpv` file."""
    require(data[:4] == b"WPV1", "no WPV1")
    at = 8 + struct.unpack_from("<I", data, 4)[0]
    head, planes = json.loads(data[8:at]), {}
    types = {"u8": "<u1", "u16": "<u2", "u32": "<u4"}
    for name, kind in [("x", "u16"), ("y", "u16"), ("z", "u16"), *((f["name"], f["type"]) for f in head["fields"])]:
        planes[name] = np.frombuffer(data, types[kind], head["n"], at)
        at += -(-planes[name].nbytes // 4) * 4
    require(at == len(data), "a cloud of another length")
    return head, planes


def clouds_of(html):
    return [cloud_of(gzip.decompress(base64.b64decode(text))) for text in re.findall(r'class="cloud"[^>]*>([^<]*)<', html)]


def equals_the_snapshot(head, planes, snapshot):
    with h5py.File(snapshot) as file:
        data, points = file["VTKHDF/PointData"], file["VTKHDF/Points"][:].astype(float)
        order = np.argsort(data["id"][:])
        require(np.array_equal(np.cumsum(planes["id"]), data["id"][:][order]), "numbers of the particles")
        require(np.array_equal(planes["body"], data["body"][:][order]), "bodies")
        for axis, name in enumerate("xyz"):
            size = head["upper"][axis] - head["lower"][axis]
            error = np.abs(head["lower"][axis] + size * planes[name] / 65535.0 - points[order, axis]).max()
            require(error <= 0.501 * size / 65535.0, f"{name} by {error} m")
        for field in head["fields"]:
            if field["name"] in data and "unit" in data[field["name"]].attrs:
                require(data[field["name"]].attrs["unit"] == field["unit"], f"unit of {field['name']}")
            if field["name"] in data and "lo" in field:
                size = field["hi"] - field["lo"]
                error = np.abs(field["lo"] + size * planes[field["name"]] / 65534.0 - data[field["name"]][:].astype(float)[order]).max()
                require(error <= 0.501 * size / 65534.0 + 1e-7 * abs(field["hi"]), f"{field['name']} by {error}")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run = folder / "run of äöü"
        whipple("run", CASE, "-o", run, "--quiet")
        series = json.loads(next(run.glob("*.particles.hdf.series")).read_text())["files"]

        # The default: twelve times with all particles and fields, in the folder of the report.
        whipple("view", run)
        page = run / "report" / "view.html"
        html = page.read_text(encoding="utf-8")
        clouds = clouds_of(html)
        require(len(clouds) == 12, f"{len(clouds)} times")
        require(clouds[0][0]["time"] == series[0]["time"] and clouds[-1][0]["time"] == series[-1]["time"], "first and last time")
        for head, planes in (clouds[0], clouds[-1]):
            entry = next(e for e in series if e["time"] == head["time"])
            equals_the_snapshot(head, planes, run / entry["name"])
        head = clouds[-1][0]
        require([b["name"] for b in head["bodies"]] == ["ball", "plate"] and head["n"] == head["of"], "bodies, all particles")
        require({"speed", "velocity_z", "mass", "pressure", "temperature", "phase", "failed"} <= {f["name"] for f in head["fields"]}, "fields")
        # It loads nothing: no addresses, and a policy that forbids any.
        require("default-src 'none'" in html, "no policy")
        require(not re.search(r"https?:|src=|href=\"|import ", html), "the page names another file")
        whipple("view", run, "-o", folder / "same.html")
        require((folder / "same.html").read_text(encoding="utf-8") == html, "two pages of one run differ")

        # Fewer times and fields; a limit that leaves particles out, the same ones at all times.
        whipple("view", run, "-o", folder / "small.html", "--times", 3, "--fields", "speed,phase")
        small = clouds_of((folder / "small.html").read_text(encoding="utf-8"))
        require([f["name"] for f in small[0][0]["fields"]] == ["id", "body", "speed", "phase"], f"{small[0][0]['fields']}")
        require(len(small) == 3, f"{len(small)} times")
        whipple("view", run, "-o", folder / "coarse.html", "--megabytes", 0.13)
        require((folder / "coarse.html").stat().st_size <= 130000, "beyond the limit")
        coarse = clouds_of((folder / "coarse.html").read_text(encoding="utf-8"))
        require(coarse[0][0]["one_of"] > 1 and coarse[0][0]["n"] < coarse[0][0]["of"], "no level of detail")
        require(set(np.cumsum(coarse[-1][1]["id"])) <= set(np.cumsum(coarse[0][1]["id"])), "other particles at other times")
        whipple("view", run, "--wpv", folder / "clouds")
        files = sorted((folder / "clouds").glob("*.wpv.gz"))
        require(len(files) == len(series), f"{len(files)} files of clouds")
        require(cloud_of(gzip.decompress(files[-1].read_bytes()))[0]["time"] == series[-1]["time"], "time of a file")

        # The bodies of a case before it runs.
        whipple("check", CASE, "--preview", folder / "start.html")
        start = clouds_of((folder / "start.html").read_text(encoding="utf-8"))
        require(len(start) == 1 and start[0][0]["time"] == 0, "one time, the start")
        require(start[0][0]["n"] == clouds[0][0]["n"] and np.array_equal(start[0][1]["x"], clouds[0][1]["x"]), "the same bodies")
        require("--force overwrites it" in whipple("check", CASE, "--preview", folder / "start.html", code=2), "a preview is overwritten")

        # What is asked for wrongly.
        require("did you mean \"pressure\"" in whipple("view", run, "--fields", "presure", code=2), "unknown field")
        require("--force overwrites it" in whipple("view", run, "-o", folder / "same.html", code=2), "a page is overwritten")
        whipple("view", run, "-o", folder / "same.html", "--force")
        require("run.toml" in whipple("view", folder, code=2), "no run")
        require("megabytes" in whipple("view", run, "--megabytes", 0, code=2), "no size")
        require("Example" in whipple("view", "--help"), "help")

        if shutil.which("node") is None:
            print("SKIPPED: node is absent: the page was not opened")
            return
        opened = subprocess.run(["node", PAGE_CHECK, page], capture_output=True, text=True, timeout=300)
        require(opened.returncode == 0, opened.stdout + opened.stderr)
        print(opened.stdout)


if __name__ == "__main__":
    main()
