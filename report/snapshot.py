# SPDX-License-Identifier: BSD-3-Clause
"""Particles and finite elements of a run at one time, from its VTKHDF files."""
import pathlib

import h5py
import numpy as np

from report.errors import NotARun

PHASES = ("solid", "melting", "liquid", "vapour")  # numbers of the field "phase"
VTK_LINE = 3  # type of the cells that are bars


class Snapshot:
    """Holds what pictures show at one time: particles and bars, then the finite elements with `connectivity` to the
    places of their `nodes`. Arrays by the names of the fields, as they are in the files, and `position`; None if not
    written. Measures come from `whipple analyse`, which counts an element as particles. SI."""

    def __init__(self, path: pathlib.Path, time: float):
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
            for name, values in self.fields.items():
                more = self.nodes[at].mean(axis=1) if name == "position" else vtk["CellData"][name][:][cells]
                self.fields[name] = np.concatenate([values, more])
            if at.shape[1] == 2:
                self.particles += len(at)
            else:
                self.connectivity = at

    def __getattr__(self, name):
        return self.__dict__.get("fields", {}).get(name)

    def __len__(self):
        return len(self.fields["mass"])
