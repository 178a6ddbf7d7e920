// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/core/base/catalogue.hpp"
#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// One failure criterion of the catalogue.
struct CriterionEntry : CatalogueEntry<const Criterion> {
  Code code = intact;  ///< of the points that it makes fail
  std::string cause;   ///< of their failure, in the words of the output
};

/// All failure criteria, one line each.
const Catalogue<CriterionEntry>& catalogue();

/// Returns the greatest code that a criterion gives to its failed points.
Code greatest_code();

/// Returns what the codes of failed points mean: "0 intact; failed by 1 tension, 2 plastic strain, ...".
const std::string& code_meanings();

}  // namespace whipple::failure
