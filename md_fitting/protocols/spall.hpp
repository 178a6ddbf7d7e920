// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/spall.hpp"
#include "md_fitting/protocols/replicas.hpp"

namespace whipple::md {

/// The largest tension of a crystal that expands uniformly and without exchange of heat, from zero pressure:
/// spall_strength (Pa), spall_temperature (K) and spall_specific_volume (m^3/kg) where it is reached, and
/// specific_volume before, of independent runs.
/// @throws StateError if too many runs end without a result: the crystal melted before the tension, or did
/// not fail.
ReplicaSet measure_spall(const Potential& potential, double temperature, const SpallPlan& section,
                         std::int64_t seed);

/// The largest mean over `window` neighbouring samples and where its window begins.
struct Peak {
  double value = 0.0;
  std::size_t first = 0;
};
Peak largest_mean(std::span<const double> series, std::size_t window);

}  // namespace whipple::md
