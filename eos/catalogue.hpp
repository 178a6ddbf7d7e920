// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "eos/equation_of_state.hpp"
#include "src/core/base/parameter_table.hpp"

/// All equations of state that a material can name. A new model is one line of catalogue.cpp.
namespace whipple::eos {

/// Fills the bound constants of a model (from a material file, a fit, a test). It may leave a constant
/// untouched and report the fault itself: the model is built later.
using ParameterReader = std::function<void(std::span<const BoundParameter>)>;

struct ModelEntry {
  std::string name;
  std::string summary;
  /// Every constant with unit, range, default and meaning, as `whipple describe eos NAME` prints it.
  std::function<std::string()> describe;
  /// Reads the constants through the reader and returns what builds the model afterwards (so that a document
  /// reports all of its errors before any model is built). The builder throws InputError for constants that
  /// contradict each other.
  std::function<std::function<std::unique_ptr<EquationOfState>()>(const ParameterReader&)> declare;
};

std::span<const ModelEntry> catalogue();

/// What can be put around an equation of state (`[[eos.modifier]]` of a material file, applied in order).
struct ModifierEntry {
  using Base = std::shared_ptr<const EquationOfState>;
  std::string name;
  std::string summary;
  std::function<std::string()> describe;
  /// As that of a model; the builder takes the equation of state inside.
  std::function<std::function<std::unique_ptr<EquationOfState>(Base)>(const ParameterReader&)> declare;
};

std::span<const ModifierEntry> modifier_catalogue();

/// Entry by name.
/// @throws InputError with the known names
const ModelEntry& find_model(std::string_view name);

}  // namespace whipple::eos
