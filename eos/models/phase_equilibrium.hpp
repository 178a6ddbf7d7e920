// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "eos/hermite_table.hpp"
#include "eos/models/gray_free_energy.hpp"

namespace whipple::eos {

/// Evaluates one phase at (V, T), stable or not. SI per unit mass.
using PhaseSurfaceFunction = std::function<GrayPoint(double V, double T)>;

/// Holds two phases in equilibrium at one temperature - the common tangent of their free energies - with the derivatives
/// along the curve. SI per unit mass.
struct CommonTangent {
  double T = 0, dense = 0, thin = 0, P = 0, g = 0;  ///< volumes of both phases, pressure, Gibbs energy
  double dense1 = 0, thin1 = 0;                     ///< dV/dT
  double P1 = 0, P2 = 0;                            ///< dP/dT, d^2P/dT^2
  double g1 = 0, g2 = 0;
};

/// Limits the volumes of a search.
struct VolumeRange {
  double least = 0, greatest = 0;
};

/// Solves P and G of both phases to be equal by Newton's method from a close guess; nothing if it leaves the stable
/// branches or the range.
std::optional<CommonTangent> common_tangent(const PhaseSurfaceFunction& dense,
                                            const PhaseSurfaceFunction& thin, double T, double dense_volume,
                                            double thin_volume, const VolumeRange& range);

/// Computes curvatures of nodes with exact slopes on a uniform grid, by fourth-order differences.
void add_curvatures(std::vector<HermiteTable::Node>& nodes, double step);

/// Holds a mixture of two phases in equilibrium at (V, T).
struct PhaseMixture {
  double pressure = 0, energy = 0, entropy = 0;
  double heat_capacity = 0;            ///< at constant volume
  double pressure_by_temperature = 0;  ///< dP/dT; (dP/dV)_T = 0
};

/// Returns the mixture whose free energy is F = g(T) - P(T) V: S = P' V - g', E = F + T S, C_v = T S'  (G35).
inline PhaseMixture phase_mixture(const HermiteTable::Node& P, const HermiteTable::Node& g, double V,
                                  double T) {
  const double entropy = V * P.slope - g.slope;
  return {P.value, g.value - V * P.value + T * entropy, entropy, T * (V * P.curvature - g.curvature),
          P.slope};
}

}  // namespace whipple::eos
