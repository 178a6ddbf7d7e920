// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/catalogue.hpp"

#include <fmt/format.h>

#include <array>

#include "src/material/strength/elastic.hpp"
#include "src/material/strength/holmquist_johnson_cook.hpp"
#include "src/material/strength/johnson_cook.hpp"
#include "src/material/strength/johnson_holmquist_2.hpp"
#include "src/material/strength/none.hpp"
#include "src/material/strength/power_law.hpp"
#include "src/material/strength/riedel_hiermaier_thoma.hpp"
#include "src/material/strength/steinberg_guinan.hpp"
#include "src/material/strength/viscous_fluid.hpp"
#include "src/material/strength/voce.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/material/strength/zerilli_armstrong.hpp"

namespace whipple::strength {
namespace {

using Builder = std::function<std::unique_ptr<const Strength>()>;

/// `Constants` has name, summary, theory and parameters(); `build` makes the model from them.
template <class Constants, class Build>
ModelEntry entry(Build build) {
  const auto describe = [] {
    return fmt::format("{}: {}\n{}\n{}", Constants::name, Constants::summary, Constants::theory,
                       describe_table(Constants::parameters()));
  };
  const auto declare = [build](const ParameterReader& reader) -> Builder {
    Constants constants;
    const auto bound = whipple::bind(Constants::parameters(), constants);
    reader(bound);
    return [constants, build] { return build(constants); };
  };
  return {Constants::name, Constants::summary, describe, declare};
}

}  // namespace

std::span<const ModelEntry> catalogue() {
  static const std::array entries = {
      entry<None>([](const None&) { return std::make_unique<const NoneModel>(); }),
      entry<ViscousFluid>([](const ViscousFluid& c) { return std::make_unique<const ViscousFluidModel>(c); }),
      entry<Elastic>([](const Elastic& c) { return std::make_unique<const ElasticModel>(c); }),
      entry<VonMises>([](const VonMises& c) { return std::make_unique<const VonMisesModel>(c); }),
      entry<PowerLaw>([](const PowerLaw& c) { return std::make_unique<const PowerLawModel>(c); }),
      entry<Voce>([](const Voce& c) { return std::make_unique<const VoceModel>(c); }),
      entry<JohnsonCook>([](const JohnsonCook& c) { return std::make_unique<const JohnsonCookModel>(c); }),
      entry<SteinbergGuinan>(
          [](const SteinbergGuinan& c) { return std::make_unique<const SteinbergGuinanModel>(c); }),
      entry<ZerilliArmstrong>(
          [](const ZerilliArmstrong& c) { return std::make_unique<const ZerilliArmstrongModel>(c); }),
      entry<HolmquistJohnsonCook>(
          [](const HolmquistJohnsonCook& c) { return std::make_unique<const HolmquistJohnsonCookModel>(c); }),
      entry<RiedelHiermaierThoma>(
          [](const RiedelHiermaierThoma& c) { return std::make_unique<const RiedelHiermaierThomaModel>(c); }),
      entry<JohnsonHolmquist2>(
          [](const JohnsonHolmquist2& c) { return std::make_unique<const JohnsonHolmquist2Model>(c); }),
  };
  return entries;
}

}  // namespace whipple::strength
