// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "src/core/base/parameter_table.hpp"
#include "src/material/failure/criterion.hpp"

namespace whipple::failure {

/// Fills bound parameters from wherever they are kept (a table of a material file, a test).
using ParameterReader = std::function<void(std::span<const BoundParameter>)>;

/// One failure criterion of the catalogue.
struct ModelEntry {
  std::string name;                       ///< the word after `model =` in [[failure]]
  std::string summary;                    ///< one line
  std::function<std::string()> describe;  ///< equations, source and table of constants
  /// Reads the constants through the reader and returns what builds the criterion later.
  std::function<std::function<std::unique_ptr<const Criterion>()>(const ParameterReader&)> declare;
};

/// All failure criteria, one line each.
std::span<const ModelEntry> catalogue();

}  // namespace whipple::failure
