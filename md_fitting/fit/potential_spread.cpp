// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/potential_spread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/fit/constant_list.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::fit {

using Eigen::Index;

std::optional<PotentialSpread> potential_spread(std::span<const Fit* const> fits) {
  if (fits.size() < 2) return std::nullopt;
  PotentialSpread spread;
  const Fit& first = *fits.front();
  spread.element = first.element;
  for (const Fit* fit : fits) spread.potentials.push_back(fit->potential);
  for (const std::string& name : first.fitted_names) {
    const bool everywhere = std::ranges::all_of(fits, [&](const Fit* fit) {
      return std::ranges::find(fit->fitted_names, name) != fit->fitted_names.end();
    });
    if (!everywhere) continue;
    spread.names.push_back(name);
    spread.units.push_back(first.constant(name).unit);
  }
  const auto rows = static_cast<Index>(fits.size());
  const auto columns = static_cast<Index>(spread.names.size());
  spread.values.resize(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index k = 0; k < columns; ++k) {
      spread.values(i, k) =
          fits[static_cast<std::size_t>(i)]->value(spread.names[static_cast<std::size_t>(k)]);
    }
  }
  spread.mean = spread.values.colwise().mean();
  const Eigen::MatrixXd off = spread.values.rowwise() - spread.mean.transpose();
  spread.covariance = off.transpose() * off / static_cast<double>(rows - 1);
  return spread;
}

std::string spread_text(const PotentialSpread& spread) {
  std::vector<std::vector<std::string>> rows = {{"potential"}};
  rows.front().insert(rows.front().end(), spread.names.begin(), spread.names.end());
  const auto add = [&](const std::string& title, const Eigen::VectorXd& values) {
    std::vector<std::string> row = {title};
    for (std::size_t k = 0; k < spread.names.size(); ++k) {
      row.push_back(practical_quantity(values[static_cast<Index>(k)], spread.units[k], 5));
    }
    rows.push_back(row);
  };
  for (Index i = 0; i < spread.values.rows(); ++i) {
    add(spread.potentials[static_cast<std::size_t>(i)], spread.values.row(i));
  }
  add("mean", spread.mean);
  add("standard deviation", spread.covariance.diagonal().cwiseSqrt());
  return fmt::format(
      "\nsecond tier: scatter over {} potentials of {}, not part of the errors above (constants that all "
      "determine)\n{}",
      spread.potentials.size(), spread.element, text_table(rows, "lr"));
}

}  // namespace whipple::fit
