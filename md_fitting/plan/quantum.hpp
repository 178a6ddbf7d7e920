// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/parameter_table.hpp"

namespace whipple::md {

/// What quantum nuclei add to the classical ones of the simulations.
struct QuantumPlan {
  std::vector<double> volume_ratio;
  std::vector<double> temperature;
  std::int64_t cells = 6;       ///< of the crystal whose vibrations count
  double displacement = 5e-13;  ///< m, of the atom whose force constants are measured

  static ParameterTable<QuantumPlan> parameters();
};

}  // namespace whipple::md
