#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Melting on release from measurements, without an equation of state of the liquid: cases/release_melting/README.md.

usage: release_thresholds.py     prints result.txt

Entropy on the measured Hugoniot, T dS = dE + P dV with E = P (V0 - V)/2, against the entropy that calorimetry gives to solid and
liquid at the melting point. The temperature follows from S and V: Debye crystal, theta = theta0 (V/V0)^-(gamma0 - a) exp(a (1 - V/V0))
of gamma = gamma0 - a (1 - V/V0), and electrons, g (V/V0)^(2/3) T. Needs numpy.
"""
import argparse
import dataclasses

import numpy as np

R = 8.314462  # J/(mol K)
AMBIENT = 298.15  # K


@dataclasses.dataclass
class Metal:
    """Constants of the solid. Shock curve, gamma, electronic heat: the library; of copper gamma is Steinberg's and the
    electronic heat Kittel's. Debye temperature: Kittel. Heat capacity of the solid a + b T: Kelley (1960), heat of fusion:
    CRC Handbook, both from memory, but for cadmium's heat of fusion: Stolen and Gronvold, Thermochim. Acta 391 (2002) 169.
    """
    molar_mass: float  # kg/mol
    density: float  # kg/m^3
    intercept: float  # m/s
    slopes: tuple  # Us = C + (s1 + s2 x + s3 x^2) up, x = up/Us
    gamma: tuple  # gamma0, a
    debye: float  # K
    electronic: float  # J/(mol K^2)
    heat_capacity: tuple  # J/(mol K), J/(mol K^2)
    melting_point: float  # K
    fusion: float  # J/mol
    published: tuple  # onset and completion, GPa


METALS = {
    "aluminium": Metal(26.98e-3, 2707, 5386, (1.339, 0, 0), (1.97, 1.5), 428, 1.35e-3, (20.67, 12.38e-3), 933.47, 10710, (61, 85)),
    "copper": Metal(63.55e-3, 8930, 3940, (1.489, 0, 0), (2.02, 1.55), 343, 0.695e-3, (22.64, 6.28e-3), 1357.77, 13260, (140, 184)),
    "lead": Metal(207.2e-3, 11340, 2006, (1.429, 0.8506, -1.64), (2.74, 2.2), 105, 2.98e-3, (23.56, 9.75e-3), 600.61, 4780, (25, 35)),
    "cadmium": Metal(112.41e-3, 8639, 2480, (1.64, 0, 0), (2.5, 1.95), 209, 0.688e-3, (22.22, 12.3e-3), 594.22, 6166, (33, 43)),
}
CADMIUM_GAMMAS = ((1.5, 1.5), (2.0, 2.0), (2.3, 1.95), (2.4, 1.95), (2.5, 2.5), (2.5, 0.0), (3.0, 1.95))


def debye_entropy():
    """Tables of T/theta and of the entropy of a Debye crystal, J/(mol K)."""
    x = np.geomspace(1e-3, 60, 4001)  # theta/T
    integrand = x**3 / np.expm1(x)
    integral = x[0]**3 / 3 + np.concatenate(([0], np.cumsum(np.diff(x) * (integrand[1:] + integrand[:-1]) / 2)))
    entropy = 3 * R * (4 * integral / x**3 - np.log(-np.expm1(-x)))
    return 1 / x[::-1], entropy[::-1]


RATIO, DEBYE = debye_entropy()


def entropy_of(temperature, theta, electronic):
    return np.interp(temperature / theta, RATIO, DEBYE) + electronic * temperature


def temperature_of(entropy, theta, electronic):
    low, high = 20.0, 60000.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if entropy_of(middle, theta, electronic) < entropy else (low, middle)
    return (low + high) / 2


def hugoniot(metal, gamma, highest):
    """Pressure (GPa), entropy above that at rest (J/(mol K)) and temperature (K) along the Hugoniot of the solid."""
    gamma0, a = gamma
    x = np.linspace(0, 0.45, 1501)
    s1, s2, s3 = metal.slopes
    velocity = metal.intercept / (1 - s1 * x - s2 * x**2 - s3 * x**3)
    pressure = metal.density * x * velocity**2
    keep = (pressure < highest * 1e9) & (velocity > 0)
    x, pressure = x[keep], pressure[keep]
    volume = (1 - x) / metal.density
    energy = pressure * x / metal.density / 2
    heat = metal.molar_mass * (np.diff(energy) + (pressure[1:] + pressure[:-1]) / 2 * np.diff(volume))
    theta = metal.debye * (1 - x)**-(gamma0 - a) * np.exp(a * x)
    electronic = metal.electronic * (1 - x)**(2 / 3)
    entropy, temperature = [entropy_of(AMBIENT, theta[0], electronic[0])], [AMBIENT]
    for i, q in enumerate(heat, start=1):
        mean = temperature[-1]
        for _ in range(2):
            s = entropy[-1] + q / mean
            t = temperature_of(s, theta[i], electronic[i])
            mean = (t + temperature[-1]) / 2
        entropy.append(s)
        temperature.append(t)
    return pressure * 1e-9, np.array(entropy) - entropy[0], np.array(temperature)


def report(name, metal, gamma):
    pressure, entropy, temperature = hugoniot(metal, gamma, 3 * metal.published[1])
    a, b = metal.heat_capacity
    solid = a * np.log(metal.melting_point / AMBIENT) + b * (metal.melting_point - AMBIENT)
    fusion = metal.fusion / metal.melting_point
    at_published = np.interp(metal.published, pressure, entropy)
    onset, completion = np.interp((solid, solid + fusion), entropy, pressure)
    from_onset = np.interp(at_published[0] + fusion, entropy, pressure)
    published = "{}/{}".format(*metal.published)
    shocked = "{:.0f}/{:.0f}".format(*np.interp(metal.published, pressure, temperature))
    share = (at_published[1] - at_published[0]) / fusion
    print(f"{name:10} {gamma[0]:5.2f} {gamma[1]:5.2f}  {published:>8} {onset:6.1f}/{completion:<6.1f} {solid:6.2f} {fusion:6.2f} {share:7.2f} "
          f"{from_onset:7.1f}  {shocked:>9}")


def main():
    print("metal     gamma0     a  published calorimetry    S_s  fusion   share    from    T there\n"
          "                             GPa       GPa         J/(mol K)           onset          K\n")
    for name, metal in METALS.items():
        report(name, metal, metal.gamma)
    for gamma in CADMIUM_GAMMAS:
        report("cadmium", METALS["cadmium"], gamma)
    print("\nshare: entropy between the two published shocks over that of fusion; from onset: completion that follows from the published onset")


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    main()
