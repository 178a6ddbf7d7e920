# SPDX-License-Identifier: BSD-3-Clause
"""Measures of a run, as `whipple analyse` wrote them into analysis.h5 (docs/manual/output.md). SI."""
import pathlib
from dataclasses import dataclass

import numpy as np

from report.errors import NotARun
from report.files import open_hdf5
from report.geometry import AXES, Geometry
from report.views import Views

DEFINITIONS = [
    ("axis", "the direction in which the bodies approach each other; through the symmetry planes, or the centre of "
             "mass of the projectile where there are none"),
    ("impact speed", "magnitude of the initial relative velocity of the fastest and the slowest body; the fastest is "
                     "the projectile"),
    ("debris, ejecta", "particles whose axial velocity exceeds 5% of the impact speed forward, backward"),
    ("front, rear", "axial coordinate beyond, below which 0.1% of the debris mass lies"),
    ("radius", "distance from the axis beyond which 0.1% of the debris mass lies"),
    ("front, rear, expansion speed", "change of front, rear, radius from snapshot to snapshot; at the end the "
                                     "least-squares slope over the last third of the snapshots, unknown if the "
                                     "debris has reached the border of the domain"),
    ("radial speed", "component of the velocity away from the axis that 0.1% of the debris mass exceeds"),
    ("half angle", "of the cone about the axis whose directions hold 95% of the kinetic energy of the debris"),
    ("residual velocity", "mean axial velocity of what is left of a body (momentum over mass)"),
    ("perforated", "a path leads through the body that no connected, unfailed material of it closes"),
    ("fragment", "at least four particles of a body that have not failed, connected by links of the linking length, by default "
                 "1.5 cells, and the failed particles within that distance of them"),
]


OF_ALL_RUNS = ("axis", "impact speed", "residual velocity", "perforated")


def definitions(with_debris: bool) -> list[tuple[str, str]]:
    """Returns the definitions of the measures that a page shows."""
    return [entry for entry in DEFINITIONS if with_debris or entry[0] in OF_ALL_RUNS]


@dataclass
class Picture:
    """Synthetic radiograph: areal density of all bodies (kg/m^2) and transmission, rows from below."""
    time: float
    extent: tuple      # axial from, to, up from, to (m)
    areal_density: np.ndarray
    transmission: np.ndarray


class Analysis:
    """Holds analysis.h5: the case, final values, a row per snapshot, tables, radiographs.

    Raises NotARun if the file is missing, or is not one of `whipple analyse`.
    """

    def __init__(self, path: pathlib.Path):
        try:
            with open_hdf5(path) as file:
                self._read(file)
        except (OSError, KeyError) as error:
            raise NotARun(f"{path}: {error}; made by `whipple analyse`") from None

    def _read(self, file):
        self.title, self.cell_size = str(file.attrs["title"]), float(file.attrs["cell_size"])
        self.body_names = str(file.attrs["bodies"]).split("\n")
        frame = file["frame"].attrs
        self.geometry = Geometry(int(frame["axis"]), float(frame["sign"]), int(frame["up"]), int(frame["sight"]),
                                 np.array([frame[f"centre_{a}"] for a in AXES]), float(frame["impact_speed"]),
                                 str(frame["projectile"]), float(frame["impact_angle"]), int(frame["copies"]),
                                 {i: float(frame[f"plane_{a}"]) for i, a in enumerate(AXES) if f"plane_{a}" in frame},
                                 str(frame["dimension"]))
        self.final = {name: float(value) for name, value in file["quantities"].attrs.items()}
        self.tables = {name: {column: data[:] for column, data in file[name].items()}
                       for name in file if name not in ("frame", "quantities", "radiographs", "views")}
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
        self.views = Views(file["views"], self.geometry) if "views" in file else None

    @staticmethod
    def _picture(group, pixel):
        total = sum(data[:] for name, data in group.items() if name.startswith("areal_density."))
        left, below = float(group.attrs["lower_axial"]), float(group.attrs["lower_up"])
        return Picture(float(group.attrs["time"]),
                       (left, left + pixel * total.shape[1], below, below + pixel * total.shape[0]),
                       total, group["transmission"][:])

    @property
    def has_debris(self) -> bool:
        """Tells whether any snapshot has material that flies on: debris."""
        return bool(np.isfinite(self.series["mean_velocity"]).any())

    @property
    def is_impact(self) -> bool:
        """Tells whether a body flies at the start and debris flies on."""
        return self.has_debris and self.geometry.impact_speed > 0

    def quantity(self, name: str) -> float:
        """Returns a final value, NaN if there is none."""
        return self.final.get(name, float("nan"))
