// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::fit {

/// Holds the points that a plan with [adaptive] should compute next.
struct Proposal {
  std::optional<md::Plan> next;    ///< empty: the campaign is complete
  std::string end;                 ///< reason for the end
  std::vector<std::string> lines;  ///< state of the campaign, for the user
  double spent = 0.0;              ///< atom-steps spent in the database
  /// Holds the outcome and its standard errors, SI; absent before the first fit.
  struct Standing {
    double value = 0.0, error = 0.0, noise = 0.0;
    double expected_error = 0.0;  ///< with the points of `next`
  };
  std::optional<Standing> standing;
};

/// Proposes the points with the largest reduction of the error of the outcome per cost (docs/theory/fit.md, section 8).
/// @param plan    with [adaptive]
/// @param points  of the database; may be empty
/// @param count   points to compute at once; a new isochore may add up to two more
/// @throws InputError if the database holds too few points for a fit although the initial points are complete;
/// StateError if the fit or the outcome does not exist
Proposal propose(const md::Plan& plan, std::span<const md::PointRecord> points, int count,
                 const std::string& store_name);

}  // namespace whipple::fit
