# SPDX-License-Identifier: BSD-3-Clause
"""What `report.py` reads: the folder of a run (docs/manual/output.md). SI throughout."""
import csv
import json
import pathlib
import re
import tomllib

import h5py
import numpy as np

AXES = "xyz"
PHASES = ("solid", "melting", "liquid", "vapour")  # numbers of the field "phase"
LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}
SPEEDS = {"m/s": 1.0, "km/s": 1e3, "mm/us": 1e3, "cm/us": 1e4}


class NotARun(Exception):
    """The folder is not that of a run, or something in it cannot be read."""


def quantity(text, units):
    """"40 mm" or a number in the first of the units, which is that of the SI."""
    if isinstance(text, (int, float)):
        return float(text)
    number, _, unit = str(text).strip().partition(" ")
    try:
        return float(number) * units[unit.strip() or next(iter(units))]
    except (ValueError, KeyError):
        raise NotARun(f"run.toml: {text!r} is not a number with one of the units {', '.join(units)}") from None


class History:
    """history.csv: columns by their name without unit. Columns that a run does not write are absent."""

    def __init__(self, path):
        self.columns = {}
        self.units = {}
        if not path.is_file():
            return
        with path.open(newline="") as stream:
            rows = list(csv.reader(stream))
        if not rows:
            return
        data = [row for row in rows[1:] if len(row) == len(rows[0])]  # a row in the making may be incomplete
        try:
            values = np.array([[float(cell) for cell in row] for row in data]).reshape(len(data), len(rows[0]))
        except ValueError as error:
            raise NotARun(f"{path}: {error}") from None
        for i, head in enumerate(rows[0]):
            match = re.fullmatch(r"(.*?)(?: \[([^\]]*)\])?", head)
            self.columns[match[1]] = values[:, i]
            self.units[match[1]] = match[2] or ""

    def __contains__(self, name):
        return name in self.columns and len(self.columns[name]) > 0

    def __getitem__(self, name):
        return self.columns[name]

    def last(self, name):
        return float(self.columns[name][-1]) if name in self else None


VTK_LINE = 3  # type of the cells that are bars


class Snapshot:
    """The particles (and bars) at one time, then the finite elements: arrays by the names of the fields, `position`
    included; None if not written. The elements have `connectivity` to the places of their `nodes`."""

    def __init__(self, path, time):
        self.path, self.time = path, time
        self.nodes, self.connectivity = np.zeros((0, 3)), np.zeros((0, 8), int)
        try:
            with h5py.File(path, "r") as file:
                vtk = file["VTKHDF"]
                self.fields = {name: vtk["PointData"][name][:] for name in vtk["PointData"]}
                self.fields["position"] = vtk["Points"][:].astype(float)
            self.particles = len(self.fields["position"])
            of_elements = path.with_name(path.name.replace(".particles.", ".elements."))
            if of_elements != path and of_elements.is_file():
                with h5py.File(of_elements, "r") as file:
                    self._append_elements(file["VTKHDF"])
        except (OSError, KeyError) as error:
            raise NotARun(f"{path}: {error}") from None
        for name in ("velocity", "mass"):
            if name not in self.fields:
                raise NotARun(f"{path}: the field {name!r} is missing")
        self.fields["velocity"] = self.fields["velocity"].astype(float)
        self.fields["mass"] = self.fields["mass"].astype(float)

    def _append_elements(self, vtk):
        self.nodes = vtk["Points"][:].astype(float)
        # The corners of each rank count from its first point; a node that ranks share is one of them from here on.
        points, cells = vtk["NumberOfPoints"][:], vtk["NumberOfCells"][:]
        corners = np.where(vtk["Types"][:] == VTK_LINE, 2, 8)
        first = np.repeat(np.repeat(np.cumsum(points) - points, cells), corners)
        _, same, place = np.unique(vtk["PointData"]["node_id"][:], return_index=True, return_inverse=True)
        nodes = same[place][vtk["Connectivity"][:] + first]
        is_bar = np.repeat(corners == 2, corners)
        # Bars are drawn as particles are, so they stand before the elements.
        for cells, at in ((corners == 2, nodes[is_bar].reshape(-1, 2)), (corners == 8, nodes[~is_bar].reshape(-1, 8))):
            own = {"position": self.nodes[at].mean(axis=1), "velocity": vtk["PointData"]["velocity"][:][at].mean(axis=1)}
            for name, values in self.fields.items():
                more = own[name] if name in own else vtk["CellData"][name][:][cells]
                self.fields[name] = np.concatenate([values, more])
            if at.shape[1] == 2:
                self.particles += len(at)
            else:
                self.connectivity = at

    def __getattr__(self, name):
        return self.__dict__.get("fields", {}).get(name)

    def __len__(self):
        return len(self.fields["mass"])


class Run:
    """The folder of a run."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise NotARun(f"{folder}: there is no such folder")
        path = self.folder / "run.toml"
        if not path.is_file():
            raise NotARun(f"{folder}: is not the folder of a run: it holds no run.toml")
        self.input_text = path.read_text(encoding="utf-8", errors="replace")
        try:
            self.input = tomllib.loads(self.input_text)
        except tomllib.TOMLDecodeError as error:
            raise NotARun(f"{path}: {error}") from None
        self.history = History(self.folder / "history.csv")
        # Position (m) of the symmetry plane normal to an axis, {0: 0.0, 1: 0.0} for a quarter model; of the analysis.
        self.symmetry_planes = {}
        self.entries = self._read_index()
        if not self.entries and not self.history.columns:
            raise NotARun(f"{folder}: the run has neither snapshots nor a history.csv yet")

    def _read_index(self):
        indices = sorted(self.folder.glob("*.particles.hdf.series"))
        if not indices:
            return []
        if len(indices) > 1:
            raise NotARun(f"{self.folder}: more than one series: {', '.join(p.name for p in indices)}")
        try:
            files = json.loads(indices[0].read_text())["files"]
            return [(self.folder / entry["name"], float(entry["time"])) for entry in files]
        except (ValueError, KeyError, TypeError) as error:
            raise NotARun(f"{indices[0]}: is not the index of a series: {error}") from None

    def spread(self, at_most):
        """Indices of at most so many snapshots, the first and the last among them, closer together at the beginning: the
        shock is over soon."""
        n = len(self.entries)
        if n == 0:
            return []
        times = np.array([time for _, time in self.entries])
        wanted = times[0] + (times[-1] - times[0]) * np.linspace(0, 1, min(n, at_most))**1.5
        return sorted({int(np.abs(times - time).argmin()) for time in wanted})

    @property
    def title(self):
        return str(self.input.get("title", self.folder.name))

    @property
    def bodies(self):
        """Names of the bodies, by number."""
        return [str(body.get("name", f"body {i}")) for i, body in enumerate(self.input.get("body", []))]

    @property
    def body_velocities(self):
        """Initial velocities (m/s) of the bodies as the input gives them; None if one of them does not say."""
        given = [body.get("velocity") for body in self.input.get("body", [])]
        if not given or not all(isinstance(v, list) and len(v) == 3 for v in given):
            return None
        return np.array([[quantity(component, SPEEDS) for component in v] for v in given])

    def body_names(self, snapshot):
        """Names of the bodies that occur, also of those the input does not name."""
        names = self.bodies
        count = int(snapshot.body.max()) + 1 if snapshot.body is not None and len(snapshot) else 0
        return names + [f"body {i}" for i in range(len(names), max(count, len(names), 1))]

    @property
    def domain(self):
        """Lower and upper corner and cell size (m), or None if the input does not say."""
        domain = self.input.get("domain", {})
        try:
            lower, upper = ([quantity(v, LENGTHS) for v in domain[side]] for side in ("lower", "upper"))
            return np.array(lower), np.array(upper), quantity(domain["cell_size"], LENGTHS)
        except (KeyError, TypeError):
            return None

    @property
    def multiplicity(self):
        """Of how many copies of the model the full problem consists: 4 for a quarter model."""
        return 2 ** len(self.symmetry_planes)
