// SPDX-License-Identifier: BSD-3-Clause
#include "eos/catalogue.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>
#include <vector>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/debye_gruneisen.hpp"
#include "eos/models/gray.hpp"
#include "eos/models/gray_71.hpp"
#include "eos/models/holmquist_johnson_cook.hpp"
#include "eos/models/ideal_gas.hpp"
#include "eos/models/jwl.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "eos/models/murnaghan.hpp"
#include "eos/models/polynomial.hpp"
#include "eos/models/stiffened_gas.hpp"
#include "eos/models/tait.hpp"
#include "eos/models/tillotson.hpp"
#include "eos/modifiers/floor.hpp"
#include "eos/modifiers/p_alpha.hpp"
#include "eos/modifiers/scale.hpp"
#include "eos/modifiers/shift.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"

namespace whipple::eos {
namespace {

template <Model M>
ModelEntry entry() {
  using Constants = typename M::Constants;
  return {std::string(M::name), std::string(M::summary), [] { return describe_table(M::parameters()); },
          [](const ParameterReader& read) -> std::function<std::unique_ptr<EquationOfState>()> {
            Constants constants;
            read(whipple::bind(M::parameters(), constants));
            return [constants] { return std::make_unique<ModelEquationOfState<M>>(constants); };
          }};
}

template <class M>
ModifierEntry modifier_entry() {
  using Constants = typename M::Constants;
  return {std::string(M::name), std::string(M::summary), [] { return describe_table(M::parameters()); },
          [](const ParameterReader& read)
              -> std::function<std::unique_ptr<EquationOfState>(ModifierEntry::Base)> {
            Constants constants;
            read(whipple::bind(M::parameters(), constants));
            return [constants](ModifierEntry::Base base) {
              return std::make_unique<M>(std::move(base), constants);
            };
          }};
}

}  // namespace

std::span<const ModifierEntry> modifier_catalogue() {
  static const std::array entries = {
      modifier_entry<Shift>(),
      modifier_entry<Scale>(),
      modifier_entry<Floor>(),
      modifier_entry<PAlpha>(),
  };
  return entries;
}

std::span<const ModelEntry> catalogue() {
  static const std::array entries = {
      // Condensed matter with its phases.
      entry<Gray>(),
      entry<Gray71>(),
      entry<DebyeGruneisen>(),
      entry<Tillotson>(),
      // Condensed matter without phases.
      entry<MieGruneisen>(),
      entry<Polynomial>(),
      entry<Murnaghan>(),
      // Porous matter with a crush curve of its own.
      entry<HolmquistJohnsonCook>(),
      // Liquids, gases, detonation products.
      entry<Tait>(),
      entry<StiffenedGas>(),
      entry<IdealGas>(),
      entry<Jwl>(),
  };
  return entries;
}

const ModelEntry& find_model(std::string_view name) {
  std::vector<std::string> names;
  for (const ModelEntry& candidate : catalogue()) {
    if (candidate.name == name) return candidate;
    names.push_back(candidate.name);
  }
  throw InputError(fmt::format("unknown equation of state {}{}; known: {}", toml_string(name),
                               did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace whipple::eos
