# SPDX-License-Identifier: BSD-3-Clause
"""Side views of a run, drawn by `whipple analyse --views` (docs/manual/output.md, analysis.h5): pixels without colours."""
from dataclasses import dataclass

import numpy as np

from report.geometry import Geometry

PHASES = ("solid", "melting", "liquid", "vapour")  # numbers of the field "phase"


@dataclass
class Picture:
    """What is seen in each pixel, rows from below: number of an item (-1: nothing), its light, and the fields of items
    (SI) by their names."""
    seen: np.ndarray
    light: np.ndarray
    fields: dict[str, np.ndarray]


@dataclass
class View:
    """One time: the section, and the picture from outside (None of a model in a plane)."""
    time: float
    items: int  # particles, bars and elements
    section: Picture
    outside: Picture | None


class Views:
    """Holds the views of all times: their common limits (m from the axis) and scales, the ends of those of each field."""

    def __init__(self, group, geo: Geometry):
        self.geo = geo
        self.limits = tuple(float(group.attrs[name]) for name in ("lower_axial", "upper_axial", "lower_up", "upper_up"))
        self.scales = {name: tuple(map(float, ends[:])) for name, ends in group["scales"].items()}
        self.times = [View(float(at.attrs["time"]), int(at.attrs["items"]), self._picture(at["section"]),
                           self._picture(at["outside"]) if "outside" in at else None)
                      for at in group["times"].values()]

    @staticmethod
    def _picture(group):
        fields = {name: data[:] for name, data in group.items() if name not in ("seen", "light")}
        return Picture(group["seen"][:].astype(np.int64) - 1, group["light"][:].astype(float), fields)

    def aspect(self) -> float:
        """Computes height over width of a picture."""
        left, right, below, above = self.limits
        return (above - below) / (right - left)

    def highest_body(self) -> int:
        """Finds the largest number of a body in the pictures, -1 if there is none."""
        return max((int(view.section.fields["body"].max(initial=-1)) for view in self.times), default=-1)
