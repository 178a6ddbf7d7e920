// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/core/base/catalogue.hpp"
#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Describes one failure criterion of the catalogue.
struct CriterionEntry : CatalogueEntry<const Criterion> {
  Code code = intact;  ///< code of points that fail by it
  std::string cause;   ///< cause of failure, in the words of the output
};

/// Returns all failure criteria.
const Catalogue<CriterionEntry>& catalogue();

/// Returns the largest code that a criterion assigns to failed points.
Code greatest_code();

/// Returns the meanings of the codes of failed points: "0 intact; failed by 1 tension, 2 plastic strain, ...".
const std::string& code_meanings();

}  // namespace whipple::failure
