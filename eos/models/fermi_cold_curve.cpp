// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/fermi_cold_curve.hpp"

#include <fmt/core.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "eos/models/atomic_units.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int intervals = 512;

}  // namespace

FermiColdCurve::FermiColdCurve(double Z, double molar_mass, double V0, double least_volume, const Join& join)
    : reference_volume_(V0), join_volume_(join.volume) {
  const double atom = V0 * molar_mass / atomic::avogadro;  // m^3
  const double radius = std::cbrt(3 * atom / (4 * std::numbers::pi));
  const double wave_number = std::cbrt(3 * std::numbers::pi * std::numbers::pi * Z / atom);
  const double fermi_energy = 0.5 * atomic::hartree * std::pow(wave_number * atomic::bohr, 2);
  electron_pressure_ = 0.4 * Z / atom * fermi_energy;
  // Electrons of uniform density around their nucleus, -9/10 Z^2 e^2/R per atom, and their exchange,
  // -3/4 (3/pi)^(1/3) n^(4/3) per volume: P -> P_FG (1 - c1 X) for X -> 0.
  const double density = Z / atom * atomic::bohr * atomic::bohr * atomic::bohr;
  const double nuclei = 0.75 * Z * atomic::hartree * atomic::bohr / (radius * fermi_energy);
  const double exchange = 1.25 * std::cbrt(3 / std::numbers::pi) /
                          (std::pow(3 * std::numbers::pi * std::numbers::pi, 2.0 / 3.0) * std::cbrt(density));
  c_[0] = nuclei + exchange - 1;  // 1 - X gives the last term

  const double V = join.volume, X = std::cbrt(V / V0);
  if (!(join.pressure > 0)) {
    throw InputError(
        fmt::format("cold curve: no pressure at the join to the electron gas, V/V0 = {:.4g}", V / V0));
  }
  // ln(P X^5/(P_FG0 (1 - X))) + c1 X = -(a + b) with a = c2 X^2, b = c3 X^3, and X d/dX of it; X dV/dX = 3 V.
  const double r0 = -(std::log(join.pressure * std::pow(X, 5) / (electron_pressure_ * (1 - X))) + c_[0] * X);
  const double r1 = -(3 * V * join.pressure_by_volume / join.pressure + 5 + X / (1 - X) + c_[0] * X);
  c_[1] = (3 * r0 - r1) / (X * X);
  c_[2] = (r1 - 2 * r0) / (X * X * X);

  const double low = std::log(least_volume), step = (std::log(join.volume) - low) / intervals;
  std::vector<HermiteTable::Node> nodes(intervals + 1);
  double energy = join.energy;
  for (int i = intervals; i >= 0; --i) {
    const double l = low + i * step, volume = std::exp(l);
    const ColdPoint at = without_energy(volume);
    if (!(at.pressure_by_volume < 0)) {
      throw InputError(fmt::format(
          "cold curve: the pressure does not rise beyond the join to the electron gas, V/V0 = {:.4g}; "
          "check cold_join_ratio",
          volume / V0));
    }
    if (i < intervals) {
      energy += boost::math::quadrature::gauss<double, 10>::integrate(
          [&](double x) { return std::exp(x) * without_energy(std::exp(x)).pressure; }, l, l + step);
    }
    nodes[static_cast<std::size_t>(i)] = {energy, -at.pressure * volume,
                                          -volume * (at.pressure + volume * at.pressure_by_volume)};
  }
  energy_ = HermiteTable(low, step, std::move(nodes));
}

ColdPoint FermiColdCurve::without_energy(double V) const {
  const double X = std::cbrt(V / reference_volume_);
  const double exponent = X * (c_[0] + X * (c_[1] + X * c_[2]));
  const double slope = X / (1 - X) + X * (c_[0] + X * (2 * c_[1] + X * 3 * c_[2]));
  const double P = electron_pressure_ * std::pow(X, -5) * (1 - X) * std::exp(-exponent);
  return {0.0, P, -P * (5 + slope) / (3 * V)};
}

ColdPoint FermiColdCurve::operator()(double V) const {
  ColdPoint p = without_energy(V);
  p.energy = energy_(std::log(V));
  return p;
}

}  // namespace whipple::eos
