// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/reaction/catalogue.hpp"

#include <memory>

#include "src/material/reaction/ignition_and_growth.hpp"
#include "src/material/reaction/jwl_plus_plus.hpp"

namespace whipple::reaction {
namespace {

/// Returns the entry of a law. `Law` has name, summary, theory and parameters(); the rate law is constructed from it.
template <class Law>
ReactionEntry entry() {
  return catalogue_entry<ReactionEntry>(
      Law::name, Law::summary, Law::theory, &Law::parameters,
      [](const Law& law) { return std::make_unique<const ReactionModel<Law>>(law); });
}

}  // namespace

const Catalogue<ReactionEntry>& catalogue() {
  static const Catalogue<ReactionEntry> all("rate law", {
                                                            entry<JwlPlusPlus>(),
                                                            entry<IgnitionAndGrowth>(),
                                                        });
  return all;
}

}  // namespace whipple::reaction
