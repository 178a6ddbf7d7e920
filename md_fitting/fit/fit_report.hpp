// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// A fit under the name that its row carries.
struct NamedFit {
  std::string name;
  Fit fit;
};

/// The model's chief constants (GRAY: V0, C, S, gamma0, a, g, T_m0, Delta S) with errors (1 sigma: total,
/// noise in brackets) of all fits, which are of one model, and below those of GRAY the published rows of
/// their elements.
std::string constants_table(std::span<const NamedFit> fits);

/// Every constant with its value, its error, and where it comes from: MD, measured, default or given.
std::string sources_table(const Fit& fit);

/// Everything else about one fit: chi^2 per kind of data with the inflation of its model error, correlations,
/// information of the data, leave-one-out check, bootstrap, windows, gamma of the isochores, defaults, what the
/// simulations cannot know, the complete model against them.
std::string fit_details(const Fit& fit);

/// The data of scripts/plot_fit.py as JSON.
std::string plot_data(const NamedFit& fit);

}  // namespace whipple::fit
