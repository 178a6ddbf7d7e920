// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/failure/catalogue.hpp"

#include <fmt/format.h>

#include <array>

#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/tensile_pressure.hpp"

namespace whipple::failure {
namespace {

/// `Constants` has name, summary, theory and parameters(); the criterion is made from them.
template <class Constants, class Model>
ModelEntry entry() {
  const auto describe = [] {
    return fmt::format("{}: {}\n{}\n{}", Constants::name, Constants::summary, Constants::theory,
                       describe_table(Constants::parameters()));
  };
  const auto declare =
      [](const ParameterReader& reader) -> std::function<std::unique_ptr<const Criterion>()> {
    Constants constants;
    const auto bound = whipple::bind(Constants::parameters(), constants);
    reader(bound);
    return [constants] { return std::make_unique<const Model>(constants); };
  };
  return {Constants::name, Constants::summary, describe, declare};
}

}  // namespace

std::span<const ModelEntry> catalogue() {
  static const std::array entries = {
      entry<TensilePressure, TensilePressureCriterion>(),
      entry<PlasticStrain, PlasticStrainCriterion>(),
  };
  return entries;
}

}  // namespace whipple::failure
