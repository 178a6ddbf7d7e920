// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Fills bound parameters from wherever they are kept (a table of a material file, a test).
using ParameterReader = std::function<void(std::span<const BoundParameter>)>;

/// One strength model of the catalogue.
struct ModelEntry {
  std::string name;                       ///< the word after `model =` in [strength]
  std::string summary;                    ///< one line
  std::function<std::string()> describe;  ///< equations, source and table of constants
  /// Reads the constants through the reader and returns what builds the model later, after the document has
  /// reported all its errors; building throws InputError for constants that contradict one another.
  std::function<std::function<std::unique_ptr<const Strength>()>(const ParameterReader&)> declare;
};

/// All strength models, one line each.
std::span<const ModelEntry> catalogue();

}  // namespace whipple::strength
