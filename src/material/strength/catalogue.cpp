// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/catalogue.hpp"

#include <memory>

#include "src/material/strength/crushable_foam.hpp"
#include "src/material/strength/deshpande_fleck.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/granular_flow.hpp"
#include "src/material/strength/holmquist_johnson_cook.hpp"
#include "src/material/strength/johnson_cook.hpp"
#include "src/material/strength/johnson_holmquist_2.hpp"
#include "src/material/strength/mechanical_threshold_model.hpp"
#include "src/material/strength/modified_cam_clay.hpp"
#include "src/material/strength/mohr_coulomb.hpp"
#include "src/material/strength/none.hpp"
#include "src/material/strength/power_law.hpp"
#include "src/material/strength/preston_tonks_wallace.hpp"
#include "src/material/strength/riedel_hiermaier_thoma.hpp"
#include "src/material/strength/steinberg_guinan.hpp"
#include "src/material/strength/viscous_fluid.hpp"
#include "src/material/strength/voce.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/material/strength/zerilli_armstrong.hpp"

namespace whipple::strength {
namespace {

/// Returns the entry of a law. `Constants` has name, summary, theory and parameters(); `Law` is constructed from them.
template <class Constants, class Law>
ModelEntry entry() {
  return catalogue_entry<ModelEntry>(
      Constants::name, Constants::summary, Constants::theory, &Constants::parameters,
      [](const Constants& constants) { return std::make_unique<const Law>(constants); });
}

}  // namespace

const Catalogue<ModelEntry>& catalogue() {
  static const Catalogue<ModelEntry> all("strength model",
                                         {
                                             entry<None, NoneModel>(),
                                             entry<ViscousFluid, ViscousFluidModel>(),
                                             entry<Elastic, ElasticModel>(),
                                             entry<VonMises, VonMisesModel>(),
                                             entry<PowerLaw, PowerLawModel>(),
                                             entry<Voce, VoceModel>(),
                                             entry<JohnsonCook, JohnsonCookModel>(),
                                             entry<SteinbergGuinan, SteinbergGuinanModel>(),
                                             entry<ZerilliArmstrong, ZerilliArmstrongModel>(),
                                             entry<PrestonTonksWallace, PrestonTonksWallaceModel>(),
                                             entry<MechanicalThreshold, MechanicalThresholdModel>(),
                                             entry<HolmquistJohnsonCook, HolmquistJohnsonCookModel>(),
                                             entry<RiedelHiermaierThoma, RiedelHiermaierThomaModel>(),
                                             entry<JohnsonHolmquist2, JohnsonHolmquist2Model>(),
                                             entry<DruckerPrager, DruckerPragerModel>(),
                                             entry<MohrCoulomb, MohrCoulombModel>(),
                                             entry<ModifiedCamClay, ModifiedCamClayModel>(),
                                             entry<GranularFlow, GranularFlowModel>(),
                                             entry<DeshpandeFleck, DeshpandeFleckModel>(),
                                             entry<CrushableFoam, CrushableFoamModel>(),
                                         });
  return all;
}

}  // namespace whipple::strength
