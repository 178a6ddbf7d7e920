# SPDX-License-Identifier: BSD-3-Clause
"""What `whipple analyse` measured of a run (analysis.h5, docs/manual/output.md), as `report.py` shows it. SI."""
from dataclasses import dataclass

import h5py
import numpy as np

from report_data import AXES, NotARun

DEFINITIONS = [
    ("axis", "the direction in which the bodies approach each other; through the symmetry planes, or the centre of "
             "mass of the projectile where there are none"),
    ("impact speed", "difference of the initial axial velocities of the fastest and the slowest body; the fastest is "
                     "the projectile"),
    ("debris, ejecta", "particles whose axial velocity exceeds 5% of the impact speed forward, backward"),
    ("front, rear", "axial coordinate beyond, below which 0.1% of the debris mass lies"),
    ("radius", "distance from the axis beyond which 0.1% of the debris mass lies"),
    ("front, rear, expansion speed", "change of front, rear, radius from snapshot to snapshot; at the end the "
                                     "least-squares slope over the last third of the snapshots (of those before the debris "
                                     "reached the border of the domain)"),
    ("radial speed", "component of the velocity away from the axis that 0.1% of the debris mass exceeds"),
    ("half angle", "of the cone about the axis whose directions hold 95% of the kinetic energy of the debris"),
    ("residual velocity", "mean axial velocity of what is left of a body (momentum over mass)"),
    ("fragment", "particles of condensed matter connected by links of the linking length, by default a cell"),
]


@dataclass
class Geometry:
    """Axis of the impact in the frame of the model."""
    axis: int          # 0, 1, 2: direction of flight
    sign: float        # +1: the projectile flies upward along the axis
    up: int            # transverse direction that pictures show upward
    depth: int         # transverse direction of sight
    centre: np.ndarray  # a point of the axis of the impact
    impact_speed: float
    projectile: str

    def axis_name(self):
        return ("" if self.sign > 0 else "-") + AXES[self.axis]


@dataclass
class Picture:
    """A synthetic radiograph: areal density of all bodies (kg/m^2) and transmission, rows from below."""
    time: float
    extent: tuple      # axial from, to, up from, to (m)
    areal_density: np.ndarray
    transmission: np.ndarray


def symmetry_planes(path):
    """Position (m) of the planes that cut the model out of the full problem, by the number of their axis."""
    if not path.is_file():
        return {}
    try:
        with h5py.File(path, "r") as file:
            frame = file["frame"].attrs
            return {i: float(frame[f"plane_{a}"]) for i, a in enumerate(AXES) if f"plane_{a}" in frame}
    except (OSError, KeyError) as error:
        raise NotARun(f"{path}: {error}; made by `whipple analyse`") from None


class Analysis:
    """analysis.h5: final values, a row per snapshot, tables, radiographs."""

    def __init__(self, path):
        try:
            with h5py.File(path, "r") as file:
                self._read(file)
        except (OSError, KeyError) as error:
            raise NotARun(f"{path}: {error}; made by `whipple analyse`") from None

    def _read(self, file):
        frame = file["frame"].attrs
        self.geometry = Geometry(int(frame["axis"]), float(frame["sign"]), int(frame["up"]), int(frame["sight"]),
                                 np.array([frame[f"centre_{a}"] for a in AXES]), float(frame["impact_speed"]),
                                 str(frame["projectile"]))
        self.final = {name: float(value) for name, value in file["quantities"].attrs.items()
                      if name not in ("meaning", "label", "labels")}
        self.tables = {name: {column: data[:] for column, data in file[name].items()}
                       for name in file if name not in ("frame", "quantities", "radiographs")}
        self.units = {name: {column: data.attrs["unit"] for column, data in file[name].items()}
                      for name in self.tables}
        self.series = self.tables["series"]
        labels = str(file["bodies"].attrs["labels"]).split("\n")
        self.bodies = [(*label.rsplit(" ", 1), {column: float(values[i])
                                                for column, values in self.tables["bodies"].items()})
                       for i, label in enumerate(labels)]
        self.pictures = [self._picture(group, float(file["radiographs"].attrs["pixel"]))
                         for group in file["radiographs"].values()]
        self.spot = float(file["radiographs"].attrs["spot"])

    @staticmethod
    def _picture(group, pixel):
        total = sum(data[:] for name, data in group.items() if name.startswith("areal_density."))
        left, below = float(group.attrs["lower_axial"]), float(group.attrs["lower_up"])
        return Picture(float(group.attrs["time"]),
                       (left, left + pixel * total.shape[1], below, below + pixel * total.shape[0]),
                       total, group["transmission"][:])

    def quantity(self, name):
        return self.final.get(name, float("nan"))


def quantile(values, weights, share):
    """The value below which `share` of the weight lies."""
    if len(values) == 0:
        return np.nan
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    return float(values[order[min(np.searchsorted(cumulative, share * cumulative[-1]), len(values) - 1)]])
