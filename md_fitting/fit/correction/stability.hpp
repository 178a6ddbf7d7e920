// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "eos/models/gray_free_energy.hpp"
#include "md_fitting/fit/correction/correction_prior.hpp"

/// Keeps corrected phases stable: positive heat capacities and bulk moduli (docs/theory/fit.md, section 10).
namespace whipple::fit {

/// Requires row c >= least for the coefficients c: the change of a heat capacity or a bulk modulus at one state, in
/// units of that of GRAY.
struct StabilityLimit {
  double volume = 0.0, temperature = 0.0;
  Eigen::RowVectorXd row;
  double least = 0.0;
};

/// Returns the limits on a grid of states: solid to above its melting temperature, liquid, vapour. The loop of the
/// vapour and stretched metal near its spinodal have no limit of the bulk modulus.
std::vector<StabilityLimit> stability_limits(const eos::GrayFreeEnergy& gray, const CorrectionGrids& grids);

/// Returns the indices of the most violated limits; none if all hold.
std::vector<std::size_t> worst_violations(const std::vector<StabilityLimit>& limits, const Eigen::VectorXd& c,
                                          std::size_t most);

}  // namespace whipple::fit
