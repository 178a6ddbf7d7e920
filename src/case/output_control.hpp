// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "src/case/section.hpp"
#include "src/case/time_control.hpp"

namespace whipple::cases {

struct OutputControl {
  double snapshot_every = 0.0;                                            ///< s, simulated
  double checkpoint_every = 600.0;                                        ///< s, wall clock
  std::int64_t history_every = 1;                                         ///< steps
  std::int64_t gauges_every = 1;                                          ///< steps
  double maximum_energy_error = std::numeric_limits<double>::infinity();  ///< infinite: default of the scheme
  double maximum_speed_factor =
      10.0;  ///< relative to the initial speeds and those attainable from released energy
  std::vector<std::string> fields = default_fields();

  /// Returns the energy error at which a run stops. Schemes that do not conserve energy have no default limit.
  [[nodiscard]] double energy_error_limit(Scheme scheme) const {
    constexpr double of_exact_energy = 0.01;
    if (std::isfinite(maximum_energy_error) || scheme != Scheme::symplectic) return maximum_energy_error;
    return of_exact_energy;
  }

  /// Limits the number of snapshots: a shorter interval is treated as a mistake, as it would shorten the time steps and
  /// fill the disk.
  static constexpr double most_snapshots = 1e6;

  static std::vector<std::string> default_fields();
  static ParameterTable<OutputControl> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
