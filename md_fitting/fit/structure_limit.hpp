// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// Where the simulated crystal stops being the stable one of its potential.
struct StructureLimit {
  std::string structure;  ///< that has less energy from there on: "hcp"
  double volume = 0.0;    ///< m^3/kg
  double pressure = 0.0;  ///< Pa, of the simulated crystal at 0 K
};

/// Returns the least pressure at which another structure of the points `cold_curve` has less energy than the
/// simulated one at the same volume (to first order the difference of enthalpies at the same pressure),
/// linear between the volumes; none without such points, or if the crystal is the stable one at all of them.
std::optional<StructureLimit> structure_limit(std::span<const md::PointRecord> points);

/// Adds remarks with that limit, with the validity of the potential that the store states, and with the
/// numbers of data beyond each.
void add_structure_remark(Fit& fit, std::span<const md::PointRecord> points, const Observations& data);

}  // namespace whipple::fit
