// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/failure/catalogue.hpp"

#include <fmt/format.h>

#include <array>

#include "src/material/failure/grady_kipp.hpp"
#include "src/material/failure/gurson.hpp"
#include "src/material/failure/johnson_cook_damage.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/principal_strain.hpp"
#include "src/material/failure/principal_stress.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/failure/tuler_butcher.hpp"
#include "src/material/failure/viscous_void_growth.hpp"

namespace whipple::failure {
namespace {

/// `Law` has name, summary, theory and parameters(); the criterion is made from it.
template <class Law>
ModelEntry entry() {
  const auto describe = [] {
    return fmt::format("{}: {}\n{}\n{}", Law::name, Law::summary, Law::theory,
                       describe_table(Law::parameters()));
  };
  const auto declare =
      [](const ParameterReader& reader) -> std::function<std::unique_ptr<const Criterion>()> {
    Law law;
    const auto bound = whipple::bind(Law::parameters(), law);
    reader(bound);
    return [law] { return std::make_unique<const CriterionModel<Law>>(law); };
  };
  return {Law::name, Law::summary, describe, declare};
}

}  // namespace

std::span<const ModelEntry> catalogue() {
  static const std::array entries = {
      entry<TensilePressure>(),   entry<TulerButcher>(),    entry<ViscousVoidGrowth>(),
      entry<PlasticStrain>(),     entry<PrincipalStress>(), entry<PrincipalStrain>(),
      entry<JohnsonCookDamage>(), entry<GradyKipp>(),       entry<Gurson>(),
  };
  return entries;
}

}  // namespace whipple::failure
