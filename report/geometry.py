# SPDX-License-Identifier: BSD-3-Clause
"""Frame of an impact, as `whipple analyse` found it."""
import math
from dataclasses import dataclass, field

import numpy as np

from report import units

AXES = "xyz"
OBLIQUE = 0.01  # tangent of the angle of impact above which a picture has no direction of flight


@dataclass
class Geometry:
    """Frame of the impact in the coordinates of the model."""
    axis: int          # 0, 1, 2: direction of flight
    sign: float        # +1: the projectile flies upward along the axis
    up: int            # transverse direction that pictures show upward
    sight: int         # transverse direction of sight
    centre: np.ndarray  # a point of the axis of the impact
    impact_speed: float
    projectile: str
    impact_angle: float = 0.0  # of the relative velocity with the axis, rad
    copies: int = 1    # of the model, in the full problem
    planes: dict[int, float] = field(default_factory=dict)  # position of the symmetry planes by axis
    dimension: str = "3d"  # or "axisymmetric": particles are rings; "plane_strain": bars of 1 m

    def axis_name(self) -> str:
        """Writes the direction of flight: "z", "-z"."""
        return ("" if self.sign > 0 else "-") + AXES[self.axis]

    @property
    def planar(self) -> bool:
        """Whether the model is a plane section."""
        return self.dimension != "3d"

    @property
    def oblique(self) -> bool:
        """Whether the flight has no single axis of the model."""
        return self.impact_speed > 0 and math.tan(self.impact_angle) > OBLIQUE

    @property
    def labels(self) -> tuple[str, str]:
        """Labels of the axes of pictures."""
        across, up = self.axis_name(), AXES[self.up]
        if self.oblique:
            return f"{across} (mm)", f"{up} (mm)"
        return f"along the {'flight' if self.impact_speed > 0 else 'axis'}, {across} (mm)", f"across, {up} (mm)"

    def extent(self, limits: tuple) -> list[float]:
        """Converts the limits of a picture from the axis (m) into coordinates of the model, mm."""
        return [units.MILLIMETRES * (limit + offset)
                for limit, offset in zip(limits, (0.0, 0.0, self.centre[self.up], self.centre[self.up]))]
