// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "src/device/material/strength_point.hpp"
#include "src/device/points.hpp"
#include "src/device/reduction.hpp"
#include "src/particles/phases.hpp"

/// What history.csv shows of the particles beside the totals.
namespace whipple::device {

/// Holds sums and maxima over the particles of a body.
struct BodyFigures : Reduction<7, 3> {
  enum Sum : std::size_t {
    solid,  ///< masses by phase (particles/phases.hpp), kg
    melting,
    liquid,
    vapour,
    failed_mass,  ///< kg
    elastic,      ///< energy of the deviator, J
    stored        ///< by cold work, J
  };
  enum Maximum : std::size_t { squared_speed, highest_pressure, highest_temperature };
  /// Begins below every value: pressures may all be negative.
  WHIPPLE_POINT BodyFigures() {
    for (double& value : largest) value = -std::numeric_limits<double>::infinity();
  }
};

/// Sums those of a body.
struct SumFigures {
  using Result = BodyFigures;
  Points points;
  const MaterialConstants* materials;  ///< of each body
  std::uint32_t body;

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    if (points.body[p] != body) return;
    const double m = points.at(mass, p);
    const Phase in = phase(points.at(melted, p), points.at(vaporised, p));
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == static_cast<std::size_t>(in)) result.sum[BodyFigures::solid + k] += m;
    }
    if (points.at(failed, p) != 0.0) result.sum[BodyFigures::failed_mass] += m;
    result.sum[BodyFigures::elastic] += m * elastic_energy(p, m);
    if (materials[body].stores_cold_work) result.sum[BodyFigures::stored] += m * points.at(cold_work, p);
    const Triple<double> v = points.vector(velocity, p);
    result.raise(BodyFigures::squared_speed, dot(v, v));
    result.raise(BodyFigures::highest_pressure, points.at(pressure, p));
    result.raise(BodyFigures::highest_temperature, points.at(temperature, p));
  }

 private:
  /// Returns s:s / (4 G rho) of intact solid material, J/kg (material::EosStrength::divide_energy).
  [[nodiscard]] WHIPPLE_POINT double elastic_energy(std::size_t p, double m) const {
    if (points.at(failed, p) != 0.0) return 0.0;
    const double density = m / points.at(volume, p);
    const double stiffness =
        shear_bearing_fraction(points.at(melted, p), points.at(vaporised, p)) *
        modulus_of(materials[body], density, points.at(pressure, p), points.at(temperature, p));
    if (!(stiffness > 0.0)) return 0.0;
    return material::formulas::squared_norm(points.symmetric(deviator, p)) / (4.0 * stiffness * density);
  }
  static WHIPPLE_POINT double modulus_of(const MaterialConstants& material, double density, double pressure,
                                         double temperature) {
    switch (material.strength) {
      case StrengthKind::none:
        return 0.0;
      case StrengthKind::steinberg_guinan:
        return solid_modulus_of<StrengthKind::steinberg_guinan>(material, density, pressure, temperature);
      default:
        return material.shear_modulus;
    }
  }
};

/// Returns the figures of each body.
template <class Space>
std::vector<BodyFigures> figures_of_bodies(Space& space, const Points& points,
                                           const MaterialConstants* materials, std::uint32_t bodies) {
  std::vector<BodyFigures> figures;
  for (std::uint32_t b = 0; b < bodies; ++b) {
    figures.push_back(space.reduce(points.size, SumFigures{points, materials, b}));
  }
  return figures;
}

}  // namespace whipple::device
