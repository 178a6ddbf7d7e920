// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// What becomes of the kinetic energy that a step takes from the motion of the grid
/// (docs/theory/dissipation.md): one set of numbers for all cases.
struct Dissipation {
  std::string losses = "unresolved";
  double heat_share = 0.1;           ///< f of eq. 3
  double collision_rate = 1.0;       ///< r of eq. 4
  double affine_gain = 1.5;          ///< a of eq. 6
  double affine_compression = 0.25;  ///< g of eq. 6
  double shock_conduction = 1.0;     ///< 1/Pr of eq. 8
  double conduction_onset = 0.03;    ///< a0 of eq. 8
  double conduction_rise = 0.05;     ///< a1 of eq. 8
  [[nodiscard]] bool keeps_losses() const { return losses == "unresolved"; }
  static ParameterTable<Dissipation> parameters();
};

}  // namespace whipple::cases
