// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Holds the results of a run at constant volume and temperature; SI, per unit mass.
struct State {
  Estimate pressure;                  ///< Pa
  Estimate specific_internal_energy;  ///< J/kg
  Estimate mean_square_displacement;  ///< m^2, from the lattice sites
  double correlation = 0.0;           ///< correlation of the errors of pressure and energy, -1 ... 1
  double crystal_share = 1.0;         ///< fraction of the atoms, in the nearest minimum of the energy
  bool solid = true;                  ///< judged by displacement and by structure
  /// Means of pressure and energy over equal parts of the averaged time; empty for a formula.
  std::vector<double> pressure_blocks{};
  std::vector<double> energy_blocks{};
};

/// Provides the state at a volume and a temperature: molecular dynamics, or a formula in tests.
class StateSource {
 public:
  enum class Effort { search, final };

  virtual ~StateSource() = default;
  /// Returns the state at a volume and a temperature.
  /// @param specific_volume m^3/kg
  /// @param temperature     K
  /// @param effort          a short run while searching for a root, a long one for the result
  /// @throws LammpsError, StateError if the state cannot be computed
  virtual State state(double specific_volume, double temperature, Effort effort) = 0;
};

}  // namespace whipple::md
