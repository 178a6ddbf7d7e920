# SPDX-License-Identifier: BSD-3-Clause
"""Mott's statistics of a ring in plane strain that expands and breaks, with the scatter of the case.

N. F. Mott, Proc. R. Soc. A 189 (1947) 300: the ring is rigid-plastic and cracks at once where its strain reaches the limit there;
from a crack unloading spreads to a distance X (in the undeformed ring) with X^2 = 2 P t/(rho d(lambda)/dt), P the nominal stress,
and nothing fails behind its front. Limits: material.md, (23).
"""
import dataclasses
import math

import numpy as np


@dataclasses.dataclass(frozen=True)
class Ring:
    """The case ring.toml of shell_fragmentation. SI."""
    radius: float = 21e-3            # middle of the wall
    thickness: float = 2e-3
    stretch_rate: float = 4.0476e4   # d(lambda)/dt
    density: float = 7830.0
    failure_strain: float = 0.5
    modulus: float = 33.5
    reference_volume: float = 3.925e-4  # of a strip of a metre


def flow_stress(strain, rate=4e4):
    """Flow stress of steel 45 (Pa) at a plastic strain, heated by its own work: constants of steel_45.toml."""
    steps = 200
    temperature, stress = 298.0, 0.0
    for i in range(steps):
        homologous = (temperature - 298.0) / (1793.0 - 298.0)
        stress = (507e6 + 320e6 * (strain * (i + 0.5) / steps)**0.28) * (1.0 + 0.064 * math.log(rate)) * (1.0 - homologous**1.06)
        temperature += stress * strain / steps / (7830.0 * 477.0)
    return stress


def fragments(seed, ring=Ring(), delay=0.0, elements=6000):
    """Number of fragments. delay: time (s) from the limit to the start of the unloading, as a crack crosses the wall."""
    length = 2.0 * math.pi * ring.radius
    generator = np.random.default_rng(seed)
    volume = ring.thickness * length / elements * 1.0
    uniform = generator.random(elements)
    scatter = (-np.log(uniform) * ring.reference_volume / volume)**(1.0 / ring.modulus) / math.gamma(1.0 + 1.0 / ring.modulus)
    # In plane strain the plastic strain is 2/sqrt(3) ln(lambda).
    stretch = np.exp(0.5 * math.sqrt(3.0) * ring.failure_strain * scatter)
    times = (stretch - 1.0) / ring.stretch_rate
    nominal = 2.0 / math.sqrt(3.0) * flow_stress(ring.failure_strain) / stretch
    place = (np.arange(elements) + 0.5) * length / elements
    cracks, begun = np.empty(0), np.empty(0)
    for i in np.argsort(times):
        away = np.abs(place[i] - cracks)
        away = np.minimum(away, length - away)
        front = np.sqrt(2.0 * nominal[i] * np.maximum(times[i] - begun - delay, 0.0) / (ring.density * ring.stretch_rate))
        if not (away < front).any():
            cracks, begun = np.append(cracks, place[i]), np.append(begun, times[i])
    return len(cracks)
