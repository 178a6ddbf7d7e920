// SPDX-License-Identifier: BSD-3-Clause
#include "eos/catalogue.hpp"

#include <memory>
#include <utility>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/debye_gruneisen.hpp"
#include "eos/models/gray.hpp"
#include "eos/models/gray_71.hpp"
#include "eos/models/holmquist_johnson_cook.hpp"
#include "eos/models/ideal_gas.hpp"
#include "eos/models/jwl.hpp"
#include "eos/models/jwl_reactant.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "eos/models/murnaghan.hpp"
#include "eos/models/polynomial.hpp"
#include "eos/models/solid_transition.hpp"
#include "eos/models/stiffened_gas.hpp"
#include "eos/models/tait.hpp"
#include "eos/models/three_phase_model.hpp"
#include "eos/models/tillotson.hpp"
#include "eos/modifiers/floor.hpp"
#include "eos/modifiers/p_alpha.hpp"
#include "eos/modifiers/scale.hpp"
#include "eos/modifiers/shift.hpp"

namespace whipple::eos {
namespace {

template <Model M>
ModelEntry entry() {
  using Constants = typename M::Constants;
  return catalogue_entry<ModelEntry>(M::name, M::summary, "", &M::parameters, [](const Constants& constants) {
    return std::make_unique<ModelEquationOfState<M>>(constants);
  });
}

template <class M>
ModifierEntry modifier_entry() {
  using Constants = typename M::Constants;
  return catalogue_entry<ModifierEntry>(
      M::name, M::summary, "", &M::parameters,
      [](const Constants& constants, std::shared_ptr<const EquationOfState> inside) {
        return std::make_unique<M>(std::move(inside), constants);
      });
}

}  // namespace

const Catalogue<ModifierEntry>& modifier_catalogue() {
  static const Catalogue<ModifierEntry> all("modifier", {modifier_entry<Shift>(), modifier_entry<Scale>(),
                                                         modifier_entry<Floor>(), modifier_entry<PAlpha>()});
  return all;
}

const Catalogue<ModelEntry>& catalogue() {
  static const Catalogue<ModelEntry> all("equation of state",
                                         {
                                             // Condensed material with its phases.
                                             entry<Gray>(),
                                             entry<CorrectedGray>(),
                                             entry<WideGray>(),
                                             entry<Gray71>(),
                                             entry<DebyeGruneisen>(),
                                             entry<SolidTransition>(),
                                             entry<Tillotson>(),
                                             // Condensed material without phases.
                                             entry<MieGruneisen>(),
                                             entry<Polynomial>(),
                                             entry<Murnaghan>(),
                                             entry<JwlReactant>(),
                                             // Porous material with a built-in crush curve.
                                             entry<HolmquistJohnsonCook>(),
                                             // Liquids, gases, detonation products.
                                             entry<Tait>(),
                                             entry<StiffenedGas>(),
                                             entry<IdealGas>(),
                                             entry<Jwl>(),
                                         });
  return all;
}

}  // namespace whipple::eos
