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
  double maximum_energy_error = std::numeric_limits<double>::infinity();  ///< infinite: that of the scheme
  double maximum_speed_factor =
      10.0;  ///< of the speed that bodies bring along and can reach by what they set free
  std::vector<std::string> fields = default_fields();

  /// Returns the error at which a run with a scheme stops. Schemes that do not conserve energy have no limit of their own.
  [[nodiscard]] double energy_error_limit(Scheme scheme) const {
    constexpr double of_exact_energy = 0.01;
    if (std::isfinite(maximum_energy_error) || scheme != Scheme::symplectic) return maximum_energy_error;
    return of_exact_energy;
  }

  /// Snapshots of a run beyond which their interval is taken for a mistake: steps would be cut to it, and the disk full.
  static constexpr double most_snapshots = 1e6;

  static std::vector<std::string> default_fields();
  static ParameterTable<OutputControl> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
