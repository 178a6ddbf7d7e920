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
    """The case ring.toml of shell_fragmentation and its material steel_45_shell.toml (the test compares them). SI."""
    radius: float = 21e-3            # middle of the wall
    thickness: float = 2e-3
    stretch_rate: float = 4.0476e4   # d(lambda)/dt
    failure_strain: float = 0.5
    modulus: float = 33.5
    reference_volume: float = 3.925e-4  # of a strip of a metre
    density: float = 7830.0
    heat_capacity: float = 477.0
    yield_stress: float = 507e6      # Johnson and Cook's A, B, n, C, m
    hardening: float = 320e6
    exponent: float = 0.28
    rate_coefficient: float = 0.064
    softening: float = 1.06
    temperature: float = 298.0       # at the start and of the law
    melting: float = 1793.0


def flow_stress(strain, rate=4e4, steel=Ring()):
    """Flow stress of steel 45 (Pa) at a plastic strain, heated by all of its own work."""
    steps = 200
    temperature, stress = steel.temperature, 0.0
    for i in range(steps):
        homologous = (temperature - steel.temperature) / (steel.melting - steel.temperature)
        stress = ((steel.yield_stress + steel.hardening * (strain * (i + 0.5) / steps)**steel.exponent)
                  * (1.0 + steel.rate_coefficient * math.log(rate)) * (1.0 - homologous**steel.softening))
        temperature += stress * strain / steps / (steel.density * steel.heat_capacity)
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
    nominal = 2.0 / math.sqrt(3.0) * flow_stress(ring.failure_strain, steel=ring) / stretch
    place = (np.arange(elements) + 0.5) * length / elements
    cracks, begun = np.empty(0), np.empty(0)
    for i in np.argsort(times):
        away = np.abs(place[i] - cracks)
        away = np.minimum(away, length - away)
        front = np.sqrt(2.0 * nominal[i] * np.maximum(times[i] - begun - delay, 0.0) / (ring.density * ring.stretch_rate))
        if not (away < front).any():
            cracks, begun = np.append(cracks, place[i]), np.append(begun, times[i])
    return len(cracks)
