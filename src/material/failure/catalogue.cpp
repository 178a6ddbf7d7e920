// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/failure/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "src/material/failure/fragment_size.hpp"
#include "src/material/failure/grady_kipp.hpp"
#include "src/material/failure/gurson.hpp"
#include "src/material/failure/johnson_cook_damage.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/principal_strain.hpp"
#include "src/material/failure/principal_stress.hpp"
#include "src/material/failure/tearing.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/failure/tuler_butcher.hpp"
#include "src/material/failure/viscous_void_growth.hpp"

namespace whipple::failure {
namespace {

/// Returns the entry of a law. `Law` has name, summary, theory, code, cause and parameters(); the criterion is
/// constructed from it.
template <class Law>
CriterionEntry entry() {
  auto made = catalogue_entry<CriterionEntry>(
      Law::name, Law::summary, Law::theory, &Law::parameters,
      [](const Law& law) { return std::make_unique<const CriterionModel<Law>>(law); });
  made.code = Law::code;
  made.cause = Law::cause;
  return made;
}

CriterionEntry entry_of_fragment_size() {
  return catalogue_entry<CriterionEntry>(FragmentSize::name, FragmentSize::summary, FragmentSize::theory,
                                         &FragmentSize::Constants::parameters,
                                         [](const FragmentSize::Constants& constants) {
                                           return std::make_unique<const FragmentSize>(constants);
                                         });
}

}  // namespace

const Catalogue<CriterionEntry>& catalogue() {
  static const Catalogue<CriterionEntry> all("failure criterion", {
                                                                      entry<TensilePressure>(),
                                                                      entry<TulerButcher>(),
                                                                      entry<ViscousVoidGrowth>(),
                                                                      entry<PlasticStrain>(),
                                                                      entry<Tearing>(),
                                                                      entry<PrincipalStress>(),
                                                                      entry<PrincipalStrain>(),
                                                                      entry<JohnsonCookDamage>(),
                                                                      entry<GradyKipp>(),
                                                                      entry<Gurson>(),
                                                                      entry_of_fragment_size(),
                                                                  });
  return all;
}

Code greatest_code() {
  Code greatest = intact;
  for (const CriterionEntry& entry : catalogue()) greatest = std::max(greatest, entry.code);
  return greatest;
}

const std::string& code_meanings() {
  static const std::string text = [] {
    std::map<int, std::string> causes;  // criteria with the same cause share a code
    for (const CriterionEntry& entry : catalogue()) {
      if (entry.code != intact) causes[entry.code] = entry.cause;
    }
    std::string words;
    for (const auto& [code, cause] : causes)
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", code, cause);
    return fmt::format("{} intact; failed by {}", static_cast<int>(intact), words);
  }();
  return text;
}

}  // namespace whipple::failure
