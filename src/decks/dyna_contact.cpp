// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_contact.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace whipple::decks::dyna {
namespace {

/// Lists the contact types in which bodies press against each other and can separate.
constexpr std::array pressing = {"AUTOMATIC_SURFACE_TO_SURFACE",
                                 "AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE",
                                 "AUTOMATIC_NODES_TO_SURFACE",
                                 "AUTOMATIC_SINGLE_SURFACE",
                                 "AUTOMATIC_GENERAL",
                                 "AUTOMATIC_SURFACE_TO_SURFACE_MORTAR",
                                 "AUTOMATIC_SINGLE_SURFACE_MORTAR",
                                 "SURFACE_TO_SURFACE",
                                 "ONE_WAY_SURFACE_TO_SURFACE",
                                 "NODES_TO_SURFACE",
                                 "SINGLE_SURFACE",
                                 "ERODING_SURFACE_TO_SURFACE",
                                 "ERODING_NODES_TO_SURFACE",
                                 "ERODING_SINGLE_SURFACE"};

}  // namespace

ContactType contact_type(const Block& block) {
  constexpr std::string_view contact = "CONTACT_";
  std::string_view name = std::string_view(block.keyword).substr(contact.size());
  const auto take = [&](std::string_view option) {
    if (!name.ends_with(option)) return false;
    name.remove_suffix(option.size());
    return true;
  };
  bool parallel = take("_MPP");
  ContactType type{.first_card = take("_ID") ? 1U : 0U};
  parallel = take("_MPP") || parallel;
  if (parallel) {
    ++type.first_card;
    const bool second =
        type.first_card < block.cards.size() && trimmed(block.cards[type.first_card].text).starts_with('&');
    if (second) ++type.first_card;
  }
  const auto has = [&](std::string_view word) { return name.find(word) != std::string_view::npos; };
  if (std::ranges::find(pressing, name) != pressing.end()) {
    type.kind = ContactKind::pressing;
  } else if (name.starts_with("FORCE_TRANSDUCER")) {
    type.kind = ContactKind::output;
  } else if (has("TIED") || has("TIEBREAK") || has("SPOTWELD")) {
    type.kind = ContactKind::tied;
  }
  return type;
}

}  // namespace whipple::decks::dyna
