#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures of an impact do not depend on the frame in which its case was written; damaged snapshots are refused by name;
expectations and report have the fragments of the analysis.

usage: analysis_frames.py WHIPPLE
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py

sys.path[0] = str(pathlib.Path(__file__).resolve().parent)
from checks import require  # noqa: E402
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from report.analysis import Analysis  # noqa: E402
from report.expectations import Expectation  # noqa: E402
from report.measured import Measures  # noqa: E402
from report.pieces import masses_of, masses_of_run  # noqa: E402

CASE = """title = "sphere on plate in a frame"
[domain]
dimension = "axisymmetric"
lower = ["-12 mm", "0 mm"]
upper = ["12 mm", "5 mm"]
cell_size = "0.5 mm"
[time]
end = "2 us"
[output]
snapshot_every = "0.5 us"
[[body]]
name = "sphere"
material = "copper"
velocity = ["{of_sphere} km/s", "0 m/s"]
shape = {{ sphere = {{ center = ["-2 mm", "0 mm"], radius = "1.5 mm" }} }}
[[body]]
name = "plate"
material = "copper"
velocity = ["{of_plate} km/s", "0 m/s"]
shape = {{ cylinder = {{ center = ["1 mm", "0 mm"], axis = "x", radius = "4 mm", height = "2 mm" }} }}
"""
# Of the run itself the frame changes a few per cent at this cell size, a fifth of a cell of lengths.
TOLERANCES = {"impact_speed": 1e-6, "penetration_depth.sphere": 0.1, "front_speed_over_impact_speed": 0.1,
              "mean_velocity.plate": 0.05, "mean_velocity.sphere": 0.1}


def quantities(whipple, folder):
    done = subprocess.run([whipple, "analyse", folder, "--quiet"], capture_output=True, text=True, timeout=120)
    require(done.returncode == 0, f"{folder}: {done.stderr}")
    with open(folder / "report" / "quantities.csv", encoding="utf-8") as file:
        return {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}


def require_same_fragments(folder):
    """Fails unless expected.toml, the report and the tables of a run have the same fragments of each body."""
    measures, analysis = Measures(folder), Analysis(folder / "report" / "analysis.h5")
    for body in analysis.body_names:
        of_page, of_table = masses_of(analysis.tables["fragments"], analysis.body_names.index(body)), masses_of_run(folder, body)
        for name, value in (("piece_count", of_page.number), ("piece_mass", of_page.mean)):
            expectation = Expectation({"name": name, "measure": f"{name}.{body}", "source": "this test", "kind": "record"}, body)
            expected = measures.value(expectation)
            require(of_page.number > 0 and math.isclose(expected, value, rel_tol=1e-12), f"{name}.{body}: {expected}, {value}")
        require(sorted(of_page.mass) == sorted(of_table.mass), f"{body}: {of_page}, {of_table}")


def main():
    whipple = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        work, found = pathlib.Path(name), []
        for of_sphere, of_plate in ((2, 0), (1, -1), (3, 1), (0, -2)):
            case, folder = work / "case.toml", work / f"run_{of_sphere}"
            case.write_text(CASE.format(of_sphere=of_sphere, of_plate=of_plate))
            subprocess.run([whipple, "run", case, "-o", folder, "--quiet", "--threads", "1"], check=True, timeout=120)
            found.append(quantities(whipple, folder))
            require(abs(found[-1]["target_velocity"] - 1e3 * of_plate) < 1e-6, f"target_velocity: {found[-1]}")
        for key, tolerance in TOLERANCES.items():
            values = [row[key] for row in found]
            require(all(abs(v - values[0]) <= tolerance * abs(values[0]) for v in values), f"{key}: {values}")

        require_same_fragments(work / "run_2")
        damaged = work / "run_2"
        with h5py.File(sorted(damaged.glob("*.particles.0*.hdf"))[-1], "r+") as file:
            file["VTKHDF/Points"][...] = -1e30
        done = subprocess.run([whipple, "analyse", damaged, "--quiet"], capture_output=True, text=True, timeout=120)
        require(done.returncode == 2 and "far outside of the domain" in done.stderr, f"{done.returncode}: {done.stderr}")


main()
