// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/constitutive_catalogue.hpp"

#include <algorithm>
#include <memory>

#include "src/material/burn_model.hpp"
#include "src/material/eos_strength/eos_strength.hpp"
#include "src/material/hyperelastic/blatz_ko.hpp"
#include "src/material/hyperelastic/model.hpp"
#include "src/material/hyperelastic/mooney_rivlin.hpp"
#include "src/material/hyperelastic/neo_hookean.hpp"
#include "src/material/hyperelastic/ogden.hpp"
#include "src/material/hyperelastic/yeoh.hpp"

namespace whipple::material {
namespace {

/// Returns the entry of a model. `Model` has fields() and Constants, which have name, summary, theory and parameters();
/// it is constructed from them.
template <class Model>
ConstitutiveEntry entry() {
  using Constants = typename Model::Constants;
  auto made = catalogue_entry<ConstitutiveEntry>(
      Constants::name, Constants::summary, Constants::theory, &Constants::parameters,
      [](const Constants& constants) { return std::make_unique<const Model>(constants); });
  made.fields = Model::fields();
  return made;
}

}  // namespace

const Catalogue<ConstitutiveEntry>& catalogue() {
  static const Catalogue<ConstitutiveEntry> all(
      "constitutive model", {entry<HyperelasticModel<NeoHookean>>(), entry<HyperelasticModel<MooneyRivlin>>(),
                             entry<HyperelasticModel<Yeoh>>(), entry<HyperelasticModel<Ogden>>(),
                             entry<HyperelasticModel<BlatzKo>>()});
  return all;
}

const std::vector<HistoryField>& history_fields() {
  static const std::vector<HistoryField> all = [] {
    std::vector<HistoryField> fields = EosStrength::fields();
    std::ranges::move(BurnModel::fields(), std::back_inserter(fields));
    for (const ConstitutiveEntry& model : catalogue()) {
      for (const HistoryField& field : model.fields) {  // models may share a field
        if (std::ranges::find(fields, field.name, &HistoryField::name) == fields.end())
          fields.push_back(field);
      }
    }
    return fields;
  }();
  return all;
}

}  // namespace whipple::material
