#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The report of a made-up run whose masses, momenta and speeds are known, and of folders that are none.

usage: synthetic_cloud.py RUN_DIR WHIPPLE whole | several
"""
import contextlib
import csv
import html.parser
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types

import h5py
import numpy as np

REPORT = pathlib.Path(__file__).resolve().parents[1]
CLOUD = pathlib.Path(sys.argv[1]).resolve()
WHIPPLE = pathlib.Path(sys.argv[2]).resolve()
sys.path[0] = str(REPORT.parent)


def require(condition, message):
    if not condition:
        raise SystemExit(f"FAILED: {message}")


def near(value, expected, tolerance, name):
    require(abs(value - expected) <= tolerance * abs(expected), f"{name}: {value}, expected {expected}")


def run(*arguments):
    """The report in this process: starting Python and its libraries is most of the time of a small report."""
    from report.command import main
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        code = main([str(argument) for argument in arguments] + ["--dpi", "50"])
    return types.SimpleNamespace(returncode=code, stdout=output.getvalue(), stderr=errors.getvalue())


def analyse(folder, output, views=1):
    done = subprocess.run([WHIPPLE, "analyse", folder, "--output", output, "--witness", "200 mm", "--views", str(views)],
                          capture_output=True, text=True)
    require(done.returncode == 0, done.stderr)


class Checker(html.parser.HTMLParser):
    """Elements are closed in order, and nothing is fetched from elsewhere."""
    VOID = {"meta", "img", "br"}

    def __init__(self):
        super().__init__()
        self.open, self.images, self.foreign = [], 0, []

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("src", "href"):
                self.images += value.startswith("data:image/png;base64,")
                if not value.startswith("data:"):
                    self.foreign.append(value)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        require(self.open and self.open.pop() == tag, f"</{tag}> closes nothing")


def report_of_the_cloud(work):
    figure = work / "hugoniot.png"
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.figure().savefig(figure)
    analyse(CLOUD, work / "report", views=3)
    state = {"density": 8600.0, "temperature": 1003.6, "melted_fraction": 0.0, "vaporised_fraction": 0.0}
    (work / "report" / "planar_impact.json").write_text(json.dumps([{
        "projectile": "disk", "target": "plate", "velocity": 5550.0, "pressure": 105.7e9, "interface_velocity": 3760.0,
        "free_surface_velocity": 7820.0, "states": [{"body": "disk", "material": "copper", "shocked": state,
                                                     "released": None}]}]))
    result = run(CLOUD, "--output", work / "report", "--figure", f"Hugoniot of <copper>={figure}")
    require(result.returncode == 0, result.stderr)
    text = (work / "report" / "report.html").read_text()
    checker = Checker()
    checker.feed(text)
    require(not checker.open, f"elements left open: {checker.open}")
    require(not checker.foreign, f"not self-contained: {checker.foreign}")
    pictures = list((work / "report").glob("*.png"))
    require(checker.images == len(pictures) == 17, f"{checker.images} images, {len(pictures)} files")
    for word in ("Synthetic cloud", "Hugoniot of &lt;copper&gt;", "copper_gray_md.toml", "full problem",
                 "residual velocity of disk", "cells across the projectile", "Expected of a planar impact", "105.7",
                 "7.82 km/s"):
        require(word in text, f"{word!r} is not in the page")

    with h5py.File(work / "report" / "analysis.h5") as file:  # what the page takes from there instead of run.toml
        require(str(file.attrs["title"]) == "Synthetic cloud: copper disk on aluminium plate", "title")
        require(str(file.attrs["bodies"]) == "disk\nplate", "bodies")
        cells = file["quantities"].attrs["projectile_size"] / file.attrs["cell_size"]
    require(f"This run: {cells:.3g} cells across the projectile." in text, f"{cells} cells across the projectile")
    with (CLOUD / "history.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    last = {name.split(" [")[0]: float(value) for name, value in rows[-1].items()}
    metrics = json.loads((work / "report" / "metrics.json").read_text())
    table = {(b["body"], b["part"]): b for b in metrics["bodies"]}
    require(metrics["multiplicity"] == 4, "a quarter model stands for four")
    near(metrics["impact_speed"], 5550.0, 1e-12, "impact speed")
    require(metrics["projectile"] == "disk" and metrics["axis"] == "z", "projectile and axis")
    whole = table["all", "whole"]
    near(whole["mass"], 4 * last["mass"], 1e-6, "mass")
    near(whole["axial_momentum"], 4 * last["momentum_z"], 1e-6, "axial momentum")
    near(whole["kinetic_energy"], 4 * last["kinetic_energy"], 1e-6, "kinetic energy")
    near(whole["internal_energy"], 4 * last["internal_energy"], 1e-6, "internal energy")
    for body in ("disk", "plate"):
        mass = table[body, "whole"]["mass"]
        for phase in ("solid", "melting", "liquid", "vapour"):
            expected = 4 * last[f"mass_{phase}.{body}"] / mass
            require(abs(table[body, "whole"][f"{phase}_fraction"] - expected) < 1e-6, f"{phase} of {body}")
    parts = sum(table[body, "debris"]["mass"] for body in ("disk", "plate"))
    near(table["all", "debris"]["mass"], parts, 1e-9, "debris of all bodies")

    # Every particle flies freely, hence the residual velocity is that of the launch.
    index = json.loads(next(CLOUD.glob("*.series")).read_text())["files"]
    with h5py.File(CLOUD / index[0]["name"]) as file:
        data = file["VTKHDF/PointData"]
        disk = data["body"][:] == 0
        mass, velocity = data["mass"][:].astype(float), data["velocity"][:].astype(float)
    near(metrics["residual_velocity"], np.average(velocity[disk, 2], weights=mass[disk]), 1e-6, "residual velocity")

    # Front and half angle by the definitions, computed here once more.
    with h5py.File(CLOUD / index[-1]["name"]) as file:
        data = file["VTKHDF/PointData"]
        place, velocity = file["VTKHDF/Points"][:].astype(float), data["velocity"][:].astype(float)
        mass = data["mass"][:].astype(float)
    debris = velocity[:, 2] > 0.05 * 5550
    order = np.argsort(place[debris, 2])
    fraction = np.cumsum(mass[debris][order]) / mass[debris].sum()
    front = place[debris, 2][order][np.searchsorted(fraction, 0.999)]
    near(metrics["cloud"]["front"], front, 1e-6, "front")
    outward = place[debris, :2] / np.linalg.norm(place[debris, :2], axis=1)[:, None]
    angle = np.arctan2(abs((outward * velocity[debris, :2]).sum(axis=1)), velocity[debris, 2])
    order = np.argsort(angle)
    energy = np.cumsum((mass[debris] * (velocity[debris]**2).sum(axis=1))[order])
    near(metrics["cloud"]["half_angle"], angle[order][np.searchsorted(energy, 0.95 * energy[-1])], 1e-6, "half angle")
    near(metrics["cloud"]["witness_mass"], table["all", "debris"]["mass"], 1e-9, "mass on the witness plate")


def page_is_small(work):
    """The whole page as the program makes it, with the view in three dimensions, within the size that the manual states."""
    limit = float(re.search(r"below (\d+) MB", (REPORT.parent / "docs/manual/output.md").read_text(encoding="utf-8"))[1])
    folder, cloud = work / "whole", work / "cloud"
    shutil.copytree(CLOUD, cloud, ignore=shutil.ignore_patterns("checkpoint", "report"))
    toml = (cloud / "run.toml").read_text()  # names materials that are nowhere; those of the library know planar impacts
    (cloud / "run.toml").write_text(toml.replace("copper_gray_md.toml", "copper.toml").replace("aluminium_gray_md.toml", "aluminium.toml"))
    done = subprocess.run([WHIPPLE, "report", cloud, "-o", folder, "--dpi", "150", "--quiet"], capture_output=True, text=True)
    require(done.returncode == 0, done.stderr)
    text = (folder / "report.html").read_text()
    require("<iframe class=view" in text, "no view in three dimensions")
    require(len(text) < 1e6 * limit, f"the page has {len(text) / 1e6:.3g} MB, the manual says below {limit} MB")
    files = sum(path.stat().st_size for path in folder.glob("*.png"))
    embedded = sum(map(len, re.findall(r"data:image/png;base64,([^\"]*)", text)))
    require(embedded < 0.75 * files, f"pictures: {embedded} bytes in the page, {files} in files")


def several_runs_are_compared(work):
    """Two runs that differ in one key and in their masses: the page says so, on common scales."""
    copies = []
    for name in ("one", "another"):
        folder = work / name
        shutil.copytree(CLOUD, folder, ignore=shutil.ignore_patterns("checkpoint", "report"))
        copies.append(folder)
    toml = (copies[1] / "run.toml").read_text()
    (copies[1] / "run.toml").write_text(toml.replace('title = "', 'title = "Other: ', 1).replace("courant = 0.5", "courant = 0.25", 1))
    require((copies[1] / "run.toml").read_text().count("courant = 0.25") == 1, "the other run")
    for path in copies[1].glob("*.particles.*.hdf"):
        with h5py.File(path, "r+") as file:
            file["VTKHDF/PointData/mass"][...] = 2 * file["VTKHDF/PointData/mass"][:]
    for folder in copies:
        analyse(folder, folder / "report")
    result = run(*copies, "--output", work / "compared")
    require(result.returncode == 0, result.stderr)
    text = (work / "compared" / "comparison.html").read_text()
    checker = Checker()
    checker.feed(text)
    require(not checker.open and not checker.foreign, "the page of several runs is not whole")
    pictures = {path.name for path in (work / "compared").glob("*.png")}
    require({"compare_history.png", "compare_debris.png", "compare_temperature.png", "compare_speed.png"} <= pictures, pictures)
    require(re.search(r"time.courant</td><td class=text>0.5</td><td class=text>0.25</td>", text), "the key in which they differ")
    values = json.loads((work / "compared" / "comparison.json").read_text())["quantities"]["debris_mass"]
    near(values[1], 2 * values[0], 1e-6, "masses of the runs")
    for name in ("report.html", "metrics.json"):
        require(not (work / "compared" / name).exists(), f"{name} of one run")
    result = run(copies[0], work / "none")
    require(result.returncode == 2 and "no such folder" in result.stderr, result.stderr)


def incomplete_runs_give_reports(work):
    """No history, no symmetry, few fields, no particles: what is there is reported."""
    def copy(name):
        folder = work / name
        shutil.copytree(CLOUD, folder, ignore=shutil.ignore_patterns("checkpoint", "report"))
        return folder
    folder = copy("no_history")
    (folder / "history.csv").unlink()
    analyse(folder, folder / "report")
    result = run(folder)
    require(result.returncode == 0 and "no history.csv" in (folder / "report/report.html").read_text(), result.stderr)

    folder = copy("few_fields")
    for path in folder.glob("*.particles.*.hdf"):
        with h5py.File(path, "r+") as file:
            for name in ("phase", "temperature", "density", "internal_energy", "failed", "pressure", "plastic_strain"):
                del file["VTKHDF/PointData"][name]
    toml = (folder / "run.toml").read_text()
    (folder / "run.toml").write_text(toml.replace('"symmetry"', '"outflow"'))
    analyse(folder, folder / "report")
    result = run(folder)
    require(result.returncode == 0, result.stderr)
    metrics = json.loads((folder / "report/metrics.json").read_text())
    require(metrics["multiplicity"] == 1, "no symmetry, one copy")
    require("solid_fraction" not in metrics["bodies"][0], "a phase that was not written")

    # A symmetric pair that flies apart: the planes are those of the analysis, on the page as in the tables. Its history is cut
    # within a row, as that of a run that was killed.
    folder = copy("oblique")
    text = (folder / "history.csv").read_text()
    (folder / "history.csv").write_text(text[:len(text) // 2])
    toml = (folder / "run.toml").read_text()
    turned = re.sub(r'velocity = \["0 m/s", "0 m/s"', 'velocity = ["-1 km/s", "0 m/s"', toml, count=1)
    (folder / "run.toml").write_text(turned)
    require((folder / "run.toml").read_text() != toml, "the oblique run")
    analyse(folder, folder / "report")
    require(run(folder).returncode == 0, "an oblique run whose history is cut")
    with h5py.File(folder / "report/analysis.h5") as file:
        copies = file["frame"].attrs["copies"]
    metrics = json.loads((folder / "report/metrics.json").read_text())
    require(metrics["multiplicity"] == copies == 4,
            f"{metrics['multiplicity']} copies on the page, {copies} in the tables")

    folder = copy("snapshots_only_of_nothing")
    for path in folder.glob("*.particles.*.hdf"):
        with h5py.File(path, "r+") as file:
            vtk = file["VTKHDF"]
            for name in list(vtk["PointData"]):
                shape = (0,) + vtk["PointData"][name].shape[1:]
                kind = vtk["PointData"][name].dtype
                del vtk["PointData"][name]
                vtk["PointData"].create_dataset(name, shape, kind)
            del vtk["Points"]
            vtk.create_dataset("Points", (0, 3), "float32")
    analyse(folder, folder / "report")
    result = run(folder)
    text = (folder / "report/report.html").read_text()
    require(result.returncode == 0 and "no particles and no elements" in text, result.stderr)


def other_folders_are_refused(work):
    def refused(folder, reason):
        result = run(folder)
        require(result.returncode == 2, f"{folder}: exit code {result.returncode}, expected 2\n{result.stderr}")
        require(reason in result.stderr and "Traceback" not in result.stderr, result.stderr)
    refused(work / "none", "no such folder")
    alone = subprocess.run([sys.executable, REPORT, work / "none"], capture_output=True, text=True)
    require(alone.returncode == 2 and "no such folder" in alone.stderr, f"as a program: {alone}")
    folder = work / "other"
    folder.mkdir()
    refused(folder, "contains no run.toml")
    (folder / "run.toml").write_text("title = \n")
    refused(folder, "run.toml")
    (folder / "run.toml").write_text('title = "x"\n')
    refused(folder, "neither snapshots nor a history.csv")
    (folder / "x.particles.hdf.series").write_text("{")
    refused(folder, "is not the index of a series")
    (folder / "x.particles.hdf.series").write_text('{"files": [{"name": "x.particles.000000.hdf", "time": 0}]}')
    refused(folder, "analysis.h5")
    (folder / "x.particles.hdf.series").unlink()
    (folder / "history.csv").write_text("step,time [s]\n0,zero\n")
    refused(folder, "history.csv")


PARTS = {"whole": (report_of_the_cloud, page_is_small, other_folders_are_refused),
         "several": (several_runs_are_compared, incomplete_runs_give_reports)}
with tempfile.TemporaryDirectory() as temporary:
    for check in PARTS[sys.argv[3]]:
        check(pathlib.Path(temporary))
print("report: all checks passed")
