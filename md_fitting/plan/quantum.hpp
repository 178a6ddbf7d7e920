// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// Requests quantum corrections to the classical nuclei of the simulations.
struct QuantumPlan {
  std::vector<double> volume_ratio;
  std::vector<double> temperature;
  std::int64_t cells = 6;       ///< size of the crystal whose vibrations are evaluated
  double displacement = 5e-13;  ///< m, of the atom in the measurement of force constants

  static ParameterTable<QuantumPlan> parameters();
};

}  // namespace whipple::md
