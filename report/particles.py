# SPDX-License-Identifier: BSD-3-Clause
"""Particles of a body at a snapshot of a run."""
import json
import math
import tomllib


def snapshot_at(folder, time=math.inf):
    """Name of the file with the particles at the last snapshot of a run until a time (s), and its time; None without any."""
    series = sorted(folder.glob("*.particles.hdf.series"))
    files = json.loads(series[0].read_text())["files"] if series else []
    until = [(float(entry["time"]), entry["name"]) for entry in files if float(entry["time"]) <= time * (1.0 + 1e-6)]
    if not until:
        return None
    newest, name = max(until)
    return name, newest


def particles_of(folder, body, time=math.inf):
    """Fields of the particles of a body at the last snapshot until a time (s) and, as "position" and "x", their places (m); None
    without any.
    """
    from report.files import open_hdf5

    newest = snapshot_at(folder, time)
    if newest is None or not (folder / "run.toml").is_file():
        return None
    bodies = [entry["name"] for entry in tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["body"]]
    if body not in bodies:
        return None
    with open_hdf5(folder / newest[0]) as file:
        data = file["VTKHDF"]["PointData"]
        own = data["body"][:] == bodies.index(body)
        places = file["VTKHDF"]["Points"][:][own]
        return {name: data[name][:][own] for name in data} | {"position": places, "x": places[:, 0]}
