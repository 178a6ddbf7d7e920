// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// Describes the state from which on the simulated crystal is no longer the stable structure of its potential.
struct StructureLimit {
  std::string structure;  ///< structure of lower energy from there on: "hcp"
  double volume = 0.0;    ///< m^3/kg
  double pressure = 0.0;  ///< Pa, of the simulated crystal at 0 K
};

/// Returns the lowest pressure at which another structure of the points `cold_curve` has less energy than the
/// simulated one at the same volume (to first order the difference of enthalpies at the same pressure),
/// interpolated linearly between the volumes; none without such points, or if the crystal is stable at all of them.
std::optional<StructureLimit> structure_limit(std::span<const md::PointRecord> points);

/// Adds remarks with that limit, the validity of the potential stated in the database, and the number of data
/// beyond each.
void add_structure_remark(Fit& fit, std::span<const md::PointRecord> points, const Observations& data);

}  // namespace whipple::fit
