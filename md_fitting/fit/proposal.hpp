// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::fit {

/// Holds the points that a plan with [adaptive] should measure next.
struct Proposal {
  std::optional<md::Plan> next;    ///< nothing: the work is at its end
  std::string end;                 ///< why
  std::vector<std::string> lines;  ///< where the work stands, for people
  double spent = 0.0;              ///< atom-steps of the store
  /// The outcome and its standard errors, SI; before the first fit nothing.
  struct Standing {
    double value = 0.0, error = 0.0, noise = 0.0;
    double expected_error = 0.0;  ///< with the points of `next`
  };
  std::optional<Standing> standing;
};

/// The points that lower the error of the outcome most for what they cost (docs/theory/fit.md, section 8).
/// @param plan    with [adaptive]
/// @param points  of the store; may be none
/// @param count   points to be computed at once; a new isochore may bring up to two more
/// @throws InputError if the store holds too few points for a fit although none of the start is missing;
/// StateError if the fit or the outcome does not exist
Proposal propose(const md::Plan& plan, std::span<const md::PointRecord> points, int count,
                 const std::string& store_name);

}  // namespace whipple::fit
