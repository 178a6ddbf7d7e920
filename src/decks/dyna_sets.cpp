// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_sets.hpp"

#include <fmt/format.h>

#include "src/core/base/words.hpp"
#include "src/decks/dyna_mesh.hpp"

namespace whipple::decks::dyna {
namespace {

enum class Selection { all, nodes, parts, boxes };
constexpr std::array<Word<Selection>, 4> words(Selection /*of*/) {
  return {{{Selection::all, "ALL"},
           {Selection::nodes, "NODE"},
           {Selection::parts, "PART"},
           {Selection::boxes, "BOX"}}};
}

}  // namespace

std::set<Id> listed_members(const Deck& deck, const Block& block) {
  const bool generated = block.keyword.ends_with("_GENERATE");
  std::set<Id> members;
  for (std::size_t i = 1; i < block.cards.size(); ++i) {
    const Fields fields(deck, block, block.cards[i]);
    for (std::size_t k = 0; k < fields.size(); k += generated ? 2 : 1) {
      const Id from = fields.id(k), to = generated ? fields.id(k + 1) : from;
      if (from == 0) continue;
      constexpr Id most = 5'000'000;  // maximum number of members of a set, limited by memory
      if (to < from || to - from + static_cast<Id>(members.size()) > most) {
        fail(block, fmt::format("the range {} to {} is none", from, to));
      }
      for (Id member = from; member <= to; ++member) members.insert(member);
    }
  }
  return members;
}

std::optional<std::set<Id>> general_nodes(const Deck& deck, const Block& block, const Model& model,
                                          const std::map<Id, DeckBox>& boxes) {
  std::set<Id> chosen;
  const auto choose = [&](auto&& condition) {
    for (const auto& [node, x] : model.nodes) {
      if (condition(x)) chosen.insert(node);
    }
  };
  for (std::size_t i = 1; i < block.cards.size(); ++i) {
    const Fields fields(deck, block, block.cards[i]);
    const std::optional<Selection> selection = value_of<Selection>(capitals(std::string(fields.text(0))));
    if (!selection) return std::nullopt;
    if (*selection == Selection::all) choose([](const Vector3&) { return true; });
    for (std::size_t k = 1; k < fields.size() && *selection != Selection::all; ++k) {
      const Id number = fields.id(k);
      if (number == 0) continue;
      if (*selection == Selection::nodes) {
        chosen.insert(number);
      } else if (*selection == Selection::parts) {
        const auto part = model.parts.find(number);
        if (part == model.parts.end()) fail(block, fmt::format("there is no part {}", number));
        for (const Id node : nodes_of(part->second)) chosen.insert(node);
      } else {
        const auto box = boxes.find(number);
        if (box == boxes.end()) fail(block, fmt::format("there is no box {}", number));
        choose([&](const Vector3& x) {
          return (x.array() >= box->second.lower.array()).all() &&
                 (x.array() <= box->second.upper.array()).all();
        });
      }
    }
  }
  return chosen;
}

}  // namespace whipple::decks::dyna
