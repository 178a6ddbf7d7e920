#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solve the Thomas-Fermi atom at finite temperature and write the series of its free energy that the code evaluates.

Feynman, Metropolis and Teller, Phys. Rev. 75, 1561 (1949): a nucleus of charge Z and its electrons in a sphere of the
volume per atom, the electrons a Fermi gas in their own potential. Volumes, temperatures and energies scale with Z^-1,
Z^(4/3) and Z^(7/3), so that one atom, Z = 1, serves all. Atomic units (bohr^3, hartree, hartree per kelvin) here.

The unknown is b(u) = x eta(x), x = r/R = u^2, eta = (mu + phi)/kT:
    b'' - b'/u = 4 u^4 A I_1/2(b/u^2),  A = 4 sqrt(2) R^2 T^(1/2)/pi,  b(0) = 1/(R T),  b'(1) = 2 b(1),
solved by Newton's method on Chebyshev points. The entropy is the integral of its density (no cancellation in the cold),
the thermal free energy F(V, T) - F(V, 0) = -int S dT; ln(-F) is written as a product of Chebyshev series in ln V and
ln T.

    scripts/thomas_fermi.py > eos/models/thomas_fermi_series.cpp      (about a minute)
    scripts/thomas_fermi.py --check                                   (errors of the series between its points)
    scripts/thomas_fermi.py --state V T                               (one solution: S, pressure)
"""
import argparse
import math
import sys

import numpy as np
from numpy.polynomial import chebyshev

VOLUMES = (20.0, 2e6)  # of the series, bohr^3
TEMPERATURES = (5e-5, 10.0)  # hartree
NODES = (40, 56)
TERMS = (24, 32)
POINTS = 128  # of the solution
LARGE = 40.0  # eta above which Sommerfeld's expansion serves
ZETA = [0.0, math.pi**2 / 6, math.pi**4 / 90, math.pi**6 / 945, math.pi**8 / 9450, math.pi**10 / 93555,
        691 * math.pi**12 / 638512875]


def falling(a, n):
    """Return a (a - 1) ... (a - n + 1)."""
    return math.prod(a - i for i in range(n))


def fermi_integral(j, eta):
    """Return the integral of x^j/(1 + exp(x - eta)) over x from 0, j = -1/2, 1/2 or 3/2."""
    eta = np.asarray(eta, float)
    result = np.empty_like(eta)
    cold = eta > LARGE
    e = eta[cold]
    terms = [2 * (1 - 2.0 ** (1 - 2 * k)) * ZETA[k] * falling(j + 1, 2 * k) * e ** (-2.0 * k) for k in range(1, 7)]
    result[cold] = e ** (j + 1) / (j + 1) * (1 + sum(terms))
    # x = t^2: the integrand is even and analytic within pi/(2 sqrt(eta)), the trapezoidal rule converges exponentially.
    step = 0.04
    t = np.arange(0, 10.5, step)
    weight = np.full(t.size, 2 * step) * t ** (2 * j + 1)
    weight[0] /= 2
    exponent = np.clip(t[None, :] ** 2 - eta[~cold][:, None], -700, 700)
    result[~cold] = (weight[None, :] / (1 + np.exp(exponent))).sum(1)
    return result


def entropy_density(eta):
    """Return 5/3 I_3/2 - eta I_1/2, the entropy density over sqrt(2) T^(3/2)/pi^2."""
    eta = np.asarray(eta, float)
    result = np.empty_like(eta)
    cold = eta > LARGE
    e = eta[cold]
    result[cold] = sum(2 * (1 - 2.0 ** (1 - 2 * k)) * ZETA[k] * 2 / 3 * (falling(2.5, 2 * k) - falling(1.5, 2 * k)) *
                       e ** (2.5 - 2 * k) for k in range(1, 7))
    hot = eta[~cold]
    result[~cold] = 5 / 3 * fermi_integral(1.5, hot) - hot * fermi_integral(0.5, hot)
    return result


def differentiation(n):
    """Return Chebyshev's points from 1 to -1 and the matrix of the derivative."""
    k = np.arange(n + 1)
    x = np.cos(np.pi * k / n)
    c = np.where((k == 0) | (k == n), 2.0, 1.0) * (-1.0) ** k
    matrix = np.outer(c, 1 / c) / (x[:, None] - x[None, :] + np.eye(n + 1))
    return x, matrix - np.diag(matrix.sum(1))


def quadrature(n):
    """Return the weights of Clenshaw and Curtis for even n."""
    angle = np.pi * np.arange(1, n) / n
    inner = 1 - sum(2 * np.cos(2 * k * angle) / (4 * k * k - 1) for k in range(1, n // 2))
    inner -= np.cos(n * angle) / (n * n - 1)
    return np.concatenate(([1 / (n * n - 1)], 2 * inner / n, [1 / (n * n - 1)]))


class Atom:
    """Solve the atom of Z = 1 on n + 1 points."""

    def __init__(self, n=POINTS):
        points, matrix = differentiation(n)
        self.n, self.u, self.slope = n, (1 + points) / 2, 2 * matrix
        self.weights = quadrature(n) / 2
        self.linear = self.slope @ self.slope
        self.linear[1:n] -= self.slope[1:n] / self.u[1:n, None]

    def uniform(self, volume, temperature, radius):
        """Return b for electrons of uniform density, the start in a hot atom."""
        target = math.pi**2 / (math.sqrt(2) * volume * temperature**1.5)
        low, high = -60.0, max(60.0, (2 * target) ** (2 / 3))
        while high - low > 1e-6:
            middle = (low + high) / 2
            low, high = (low, middle) if fermi_integral(0.5, np.array([middle]))[0] > target else (middle, high)
        x = self.u**2
        return x * high + (1 - 1.5 * x + 0.5 * x**3) / (radius * temperature)

    def solve(self, volume, temperature, guess=None):
        """Return b, entropy, pressure and the number of electrons (exact: 1)."""
        n, u = self.n, self.u
        inner = slice(1, n)
        radius = (3 * volume / (4 * math.pi)) ** (1 / 3)
        field = 4 * math.sqrt(2) / math.pi * radius**2 * math.sqrt(temperature)
        centre = 1 / (radius * temperature)
        b = self.uniform(volume, temperature, radius) if guess is None else guess * centre / guess[-1]
        last = math.inf
        for iteration in range(100):
            eta = b[inner] / u[inner] ** 2
            residual, jacobian = self.linear @ b, self.linear.copy()
            residual[inner] -= 4 * field * u[inner] ** 4 * fermi_integral(0.5, eta)
            jacobian[np.arange(1, n), np.arange(1, n)] -= 2 * field * u[inner] ** 2 * fermi_integral(-0.5, eta)
            residual[0], jacobian[0] = self.slope[0] @ b - 2 * b[0], self.slope[0]
            jacobian[0, 0] -= 2
            residual[n], jacobian[n] = b[n] - centre, 0
            jacobian[n, n] = 1
            change = np.linalg.solve(jacobian, -residual)
            worst = np.max(np.abs(change) / (np.abs(b) + u**2 + 1e-12))
            b = b + change * (max(0.2, 1 / worst) if worst > 1 and 3 < iteration < 60 else 1.0)
            size = np.max(np.abs(change)) / (centre + abs(b[0]))
            # The least change is that of round-off in the matrix.
            if size < 1e-11 or (size < 1e-6 and size > 0.5 * last):
                break
            last = size
        else:
            raise RuntimeError(f"no solution at V = {volume:g}, T = {temperature:g}")
        eta = b[:n] / u[:n] ** 2
        density = math.sqrt(2) / math.pi**2 * temperature**1.5
        sphere = 8 * math.pi * radius**3 * density * self.weights[:n] * u[:n] ** 5
        pressure = 2 / 3 * density * temperature * fermi_integral(1.5, eta[:1])[0]
        return b, sphere @ entropy_density(eta), pressure, sphere @ fermi_integral(0.5, eta)


def nodes(count, limits):
    """Return Chebyshev's nodes of the logarithm between limits, the largest first."""
    low, high = map(math.log, limits)
    return (low + high) / 2 + (high - low) / 2 * np.cos(np.pi * (np.arange(count) + 0.5) / count)


def scaled(logarithm, limits):
    """Map the logarithm of a value to [-1, 1]."""
    low, high = map(math.log, limits)
    return (2 * logarithm - low - high) / (high - low)


def free_energy(log_temperatures, entropies):
    """Return ln(-F) on the isochore by integration of its entropies."""
    low, high = map(math.log, TEMPERATURES)
    series = chebyshev.chebfit(scaled(log_temperatures, TEMPERATURES), np.log(entropies), len(entropies) - 1)
    # Below the coldest node S is continued as a power of T.
    power = chebyshev.chebval(-1, chebyshev.chebder(series)) * 2 / (high - low)
    cold = math.exp(chebyshev.chebval(-1, series)) * TEMPERATURES[0] / (1 + power)
    points, weights = np.polynomial.legendre.leggauss(200)
    result = []
    for end in log_temperatures:
        at = low + (end - low) * (points + 1) / 2
        integrand = np.exp(chebyshev.chebval(scaled(at, TEMPERATURES), series) + at)
        result.append(math.log(cold + (end - low) / 2 * weights @ integrand))
    return result


def series():
    """Return the coefficients of ln(-F) and the largest error of the number of electrons."""
    atom, worst = Atom(), 0.0
    log_volumes, log_temperatures = nodes(NODES[0], VOLUMES), nodes(NODES[1], TEMPERATURES)
    values = []
    for v in log_volumes:
        guess, entropies = None, []
        for t in log_temperatures:
            guess, entropy, _, electrons = atom.solve(math.exp(v), math.exp(t), guess)
            entropies.append(entropy)
            worst = max(worst, abs(electrons - 1))
        values.append(free_energy(log_temperatures, entropies))
    first = chebyshev.chebvander(scaled(log_volumes, VOLUMES), NODES[0] - 1)
    second = chebyshev.chebvander(scaled(log_temperatures, TEMPERATURES), NODES[1] - 1)
    all_terms = np.linalg.solve(first, np.array(values)) @ np.linalg.inv(second).T
    return all_terms[:TERMS[0], :TERMS[1]], worst


def write(coefficients):
    """Print the source file of the coefficients."""
    print("// SPDX-License-Identifier: BSD-3-Clause\n// Written by scripts/thomas_fermi.py.\n"
          '#include "eos/models/thomas_fermi.hpp"\n\nnamespace whipple::eos {\n')
    print(f"const ThomasFermiSeries& thomas_fermi_series() {{\n  static const ThomasFermiSeries series{{"
          f"{{{VOLUMES[0]}, {VOLUMES[1]}}}, {{{TEMPERATURES[0]}, {TEMPERATURES[1]}}}, {{")
    flat = [f"{c:.9e}" for c in coefficients.T.ravel()]
    for i in range(0, len(flat), 6):
        print("      " + ", ".join(flat[i:i + 6]) + ("," if i + 6 < len(flat) else "}};"))
    print("  return series;\n}\n\n}  // namespace whipple::eos")


def check():
    """Print the errors of the series halfway between its nodes: entropy, and pressure above that of the coldest."""
    coefficients, electrons = series()
    atom = Atom(POINTS + 32)
    log_volumes, log_temperatures = nodes(NODES[0] // 2, VOLUMES), nodes(NODES[1] // 2, TEMPERATURES)
    rates = [2 / math.log(limits[1] / limits[0]) for limits in (VOLUMES, TEMPERATURES)]
    x, y = scaled(log_volumes, VOLUMES), scaled(log_temperatures, TEMPERATURES)
    free = np.exp(chebyshev.chebgrid2d(x, y, coefficients))
    by_volume = free * chebyshev.chebgrid2d(x, y, chebyshev.chebder(coefficients, axis=0)) * rates[0]
    by_temperature = free * chebyshev.chebgrid2d(x, y, chebyshev.chebder(coefficients, axis=1)) * rates[1]
    entropy, pressure = np.zeros_like(free), np.zeros_like(free)
    for i, v in enumerate(log_volumes):
        guess = None
        for k, t in enumerate(log_temperatures):
            guess, entropy[i, k], pressure[i, k], _ = atom.solve(math.exp(v), math.exp(t), guess)
    volumes, temperatures = np.exp(log_volumes)[:, None], np.exp(log_temperatures)[None, :]
    entropy_error = np.abs(by_temperature / temperatures / entropy - 1)
    rise = by_volume / volumes - (by_volume / volumes)[:, -1:]
    pressure_error = np.abs(rise - (pressure - pressure[:, -1:])) / pressure
    print(f"electrons            {electrons:.1e}")
    for name, error in (("entropy", entropy_error), ("pressure", pressure_error)):
        print(f"{name:<10} largest   {error.max():.1e}   rms {math.sqrt((error**2).mean()):.1e}")
    warm = pressure_error[:, temperatures[0] > 3e-4]
    print(f"pressure above 3e-4  {warm.max():.1e}   rms {math.sqrt((warm**2).mean()):.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="print the errors of the series")
    parser.add_argument("--state", nargs=2, type=float, metavar=("V", "T"),
                        help="print entropy and pressure of one state; bohr^3, hartree, Z = 1")
    arguments = parser.parse_args()
    if arguments.check:
        check()
    elif arguments.state:
        _, entropy, pressure, _ = Atom().solve(*arguments.state)
        print(f"entropy {entropy:.8g}  pressure {pressure:.8g}")
    else:
        write(series()[0])


if __name__ == "__main__":
    sys.exit(main())
