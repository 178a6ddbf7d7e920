// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "md_fitting/fit/fit_result.hpp"

namespace whipple::fit {

/// Holds a fit with the name of its row.
struct NamedFit {
  std::string name;
  Fit fit;
};

/// Formats the main constants of the model (GRAY: V0, C, S, gamma0, a, g, T_m0, Delta S) with errors (1 sigma: total,
/// noise in brackets) for all fits, which must be of one model; for GRAY the published rows of the elements follow.
std::string constants_table(std::span<const NamedFit> fits);

/// Formats every constant with its value, error and origin: MD, measured, default or given.
std::string sources_table(const Fit& fit);

/// Formats the remaining information on one fit: chi^2 per kind of data with the inflation of its model error,
/// correlations, information content of the data, leave-one-out check, bootstrap, windows, gamma of the isochores,
/// defaults, quantities that the simulations cannot determine, and the complete model compared with them.
std::string fit_details(const Fit& fit);

/// Returns the data of scripts/plot_fit.py as JSON.
std::string plot_data(const NamedFit& fit);

}  // namespace whipple::fit
