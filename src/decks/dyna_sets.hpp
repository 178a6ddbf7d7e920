// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>

#include "src/decks/dyna_model.hpp"

namespace whipple::decks::dyna {

/// Holds a box of *DEFINE_BOX.
struct DeckBox {
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
};

/// Returns the members of *SET_NODE_LIST, *SET_PART_LIST, also with _GENERATE.
/// @throws InputError for invalid ranges
std::set<Id> listed_members(const Deck& deck, const Block& block);

/// Returns the nodes of *SET_NODE_GENERAL by ALL, NODE, PART and BOX; nothing if it has another option.
std::optional<std::set<Id>> general_nodes(const Deck& deck, const Block& block, const Model& model,
                                          const std::map<Id, DeckBox>& boxes);

}  // namespace whipple::decks::dyna
