// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/spall.hpp"
#include "md_fitting/protocols/replicas.hpp"

namespace whipple::md {

/// Measures the maximum tension of a crystal in uniform adiabatic expansion from zero pressure, from independent runs.
/// @throws StateError if too many runs end without a result: the crystal melted before the maximum, or did not fail.
ReplicaSet<SpallPoint> measure_spall(const Potential& potential, double temperature, const SpallPlan& section,
                                     std::int64_t seed);

/// Holds the largest mean over `window` consecutive samples and the first index of its window.
struct Peak {
  double value = 0.0;
  std::size_t first = 0;
};
Peak largest_mean(std::span<const double> series, std::size_t window);

}  // namespace whipple::md
