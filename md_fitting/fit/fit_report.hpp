// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "md_fitting/fit/gray_fit.hpp"

namespace whipple::fit {

/// A fit under the name that its row carries.
struct NamedFit {
  std::string name;
  GrayFit fit;
};

/// Rows V0, C, S, gamma0, a, g, T_m0 with errors (1 sigma: total, noise in brackets) of all fits, and below
/// them the published rows of their elements.
std::string constants_table(std::span<const NamedFit> fits);

/// Everything else about one fit: chi^2 per kind of data, correlations, windows, gamma of the isochores,
/// defaults, the complete model against the simulations.
std::string fit_details(const GrayFit& fit);

/// The data of scripts/plot_fit.py as JSON.
std::string plot_data(const NamedFit& fit);

}  // namespace whipple::fit
