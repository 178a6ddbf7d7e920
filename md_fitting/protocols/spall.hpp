// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/spall.hpp"

namespace whipple::md {

struct SpallResult {
  Estimate strength;         ///< Pa, largest tension
  Estimate temperature;      ///< K, at the largest tension
  Estimate specific_volume;  ///< m^3/kg, at the largest tension
  double initial_specific_volume = 0.0;
  std::string transcript;
};

/// The largest tension of a crystal that expands uniformly and without exchange of heat, from zero pressure.
/// Mean over independent runs with its standard error.
/// @throws StateError if the crystal melted before the tension, or if a run did not fail.
SpallResult measure_spall(const Potential& potential, double temperature, const SpallPlan& section,
                          std::int64_t seed);

/// The largest mean over `window` neighbouring samples and where its window begins.
struct Peak {
  double value = 0.0;
  std::size_t first = 0;
};
Peak largest_mean(std::span<const double> series, std::size_t window);

}  // namespace whipple::md
