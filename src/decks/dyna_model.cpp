// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace whipple::decks::dyna {
namespace {

/// Keywords without influence on the physics of the case.
constexpr std::array harmless = {"KEYWORD",
                                 "END",
                                 "COMMENT",
                                 "CONTROL_ENERGY",
                                 "CONTROL_OUTPUT",
                                 "CONTROL_CPU",
                                 "CONTROL_HOURGLASS",
                                 "HOURGLASS",
                                 "CONTROL_BULK_VISCOSITY",
                                 "CONTROL_SOLUTION",
                                 "CONTROL_TIMESTEP",
                                 "CONTROL_CONTACT",
                                 "CONTROL_SPH",
                                 "CONTROL_ACCURACY",
                                 "CONTROL_SOLID",
                                 "CONTROL_PARALLEL",
                                 "SECTION_SOLID",
                                 "SECTION_SPH"};

class ModelReader {
 public:
  ModelReader(const Deck& deck, Import& import, FaultList& faults)
      : deck_(deck), import_(import), faults_(faults) {
    model_.title = import.deck;
  }

  Model read() {
    collect();
    for (const auto& [block, reader] : starts_) faults_.guarded([&] { (this->*reader)(*block); });
    return std::move(model_);
  }

 private:
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, block.line, "*" + block.keyword, std::move(text));
  }

  void collect() {
    std::map<std::string, std::pair<const Block*, std::size_t>> unknown;
    for (const Block& block : deck_.blocks) {
      faults_.guarded([&] {
        if (read(block)) return;
        auto& [first, count] = unknown[block.keyword];
        if (count++ == 0) first = &block;
      });
    }
    for (const auto& [keyword, entry] : unknown) {
      remark(Outcome::missing, *entry.first,
             fmt::format("not read, {} time{}", entry.second, entry.second == 1 ? "" : "s"));
    }
  }

  using Reader = void (ModelReader::*)(const Block& block);
  using Readers = std::span<const std::pair<std::string_view, Reader>>;
  /// Readers of keywords, and of all keywords with a beginning: the first that fits.
  static Readers of_keywords();
  static Readers of_beginnings();

  /// Reads a keyword; false if it is none of those that are read.
  bool read(const Block& block) {
    const std::string_view key = block.keyword;
    Reader reader =
        std::ranges::find(harmless, key) != harmless.end() || key.empty() ? &ModelReader::dropped : nullptr;
    const auto whole = std::ranges::find(of_keywords(), key, [](const auto& entry) { return entry.first; });
    const auto start = std::ranges::find_if(of_beginnings(),
                                            [&](const auto& entry) { return key.starts_with(entry.first); });
    if (whole != of_keywords().end()) {
      reader = whole->second;
    } else if (reader == nullptr && start != of_beginnings().end()) {
      reader = start->second;
    }
    if (reader == nullptr) return false;
    (this->*reader)(block);
    return true;
  }

  void dropped(const Block& block) {
    remark(Outcome::dropped, block, "of the methods and output of that code");
  }
  void taken(const Block& block) { remark(Outcome::exact, block, "read"); }
  void material(const Block& block) { model_.materials[first_id(block)] = &block; }
  void state(const Block& block) { model_.states[first_id(block)] = &block; }
  void node_set(const Block& block) { set(block, node_sets_); }
  void part_set(const Block& block) { set(block, part_sets_); }
  void title(const Block& block) {
    if (!block.cards.empty()) {
      const std::string& text = block.cards[0].text;
      model_.title = text.substr(0, text.find_last_not_of(" \t\r") + 1);
    }
    remark(Outcome::exact, block, "title");
  }
  void end(const Block& block) {
    model_.end = first(block).required(0, "the end time");
    if (!(model_.end > 0.0)) fail(block, "the end time must be > 0");
    remark(Outcome::exact, block, "time.end");
  }
  void snapshots(const Block& block) {
    model_.snapshots = first(block).real(0);
    remark(Outcome::exact, block, "output.snapshot_every");
  }
  /// A card for each detonator: part, place, delay.
  void detonation(const Block& block) {
    for (const Card& card : block.cards) {
      const Fields fields(deck_, block, card);
      model_.detonators.push_back(
          {&block, Vector3(fields.real(1), fields.real(2), fields.real(3)), fields.real(4)});
    }
  }
  /// Velocities refer to sets, which may come after them.
  void velocity(const Block& block) { starts_.emplace_back(&block, &ModelReader::start_of_set); }
  void velocity_by_nodes(const Block& block) { starts_.emplace_back(&block, &ModelReader::starts_of_nodes); }
  void velocity_by_parts(const Block& block) { starts_.emplace_back(&block, &ModelReader::start_generated); }

  [[nodiscard]] Fields first(const Block& block) const {
    if (block.cards.empty()) fail(block, "has no card");
    return {deck_, block, block.cards[0]};
  }
  [[nodiscard]] Id first_id(const Block& block) const {
    return static_cast<Id>(first(block).required(0, "its number"));
  }

  void nodes(const Block& block) {
    for (const Card& card : block.cards) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, card, node_widths);
        model_.nodes[static_cast<Id>(fields.required(0, "the number of a node"))] =
            Vector3(fields.real(1), fields.real(2), fields.real(3));
      });
    }
    remark(Outcome::exact, block, fmt::format("{} nodes", block.cards.size()));
  }

  void solids(const Block& block) {
    for (std::size_t i = 0; i < block.cards.size(); ++i) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, block.cards[i], solid_widths);
        Solid solid{.line = block.cards[i].line};
        // Element and part stand on a card of their own in the format of ten nodes.
        const bool two_cards = fields.id(2) == 0 && i + 1 < block.cards.size();
        const Fields list = two_cards ? Fields(deck_, block, block.cards[++i], solid_widths) : fields;
        for (std::size_t k = 0; k < 8; ++k) solid.nodes[k] = list.id(k + (two_cards ? 0 : 2));
        model_.parts[fields.id(1)].solids.push_back(solid);
      });
    }
    remark(Outcome::exact, block, fmt::format("{} elements", block.cards.size()));
  }

  void points(const Block& block) {
    for (const Card& card : block.cards) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, card, sph_widths);
        model_.parts[fields.id(1)].points.push_back({fields.id(0), fields.required(2, "the mass")});
      });
    }
    remark(Outcome::converted, block, fmt::format("{} elements", block.cards.size()));
  }

  /// A heading and a card for each part.
  void part(const Block& block) {
    for (std::size_t i = 0; i + 1 < block.cards.size(); i += 2) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, block.cards[i + 1]);
        const Id number = static_cast<Id>(fields.required(0, "the number of the part"));
        Part& part = model_.parts[number];
        part.block = &block;
        part.name = fmt::format("part_{}", number);
        part.section = fields.id(1);
        part.material = fields.id(2);
        part.state = fields.id(3);
        remark(Outcome::exact, block, fmt::format("{}: {}", part.name, block.cards[i].text));
      });
    }
  }

  void set(const Block& block, std::map<Id, std::set<Id>>& sets) {
    const bool generated = block.keyword.ends_with("_GENERATE");
    std::set<Id>& members = sets[first_id(block)];
    for (std::size_t i = 1; i < block.cards.size(); ++i) {
      const Fields fields(deck_, block, block.cards[i]);
      for (std::size_t k = 0; k < fields.size(); k += generated ? 2 : 1) {
        const Id from = fields.id(k), to = generated ? fields.id(k + 1) : from;
        if (from == 0) continue;
        constexpr Id most = 5'000'000;  // members of a set: what fits into memory
        if (to < from || to - from + static_cast<Id>(members.size()) > most) {
          fail(block, fmt::format("the range {} to {} is none", from, to));
        }
        for (Id member = from; member <= to; ++member) members.insert(member);
      }
    }
    remark(Outcome::exact, block, fmt::format("{} members", members.size()));
  }

  void contact(const Block& block) {
    if (block.keyword.find("_MPP") != std::string::npos) {
      remark(Outcome::missing, block, "the cards of the option MPP, which come before that of the friction");
      return;
    }
    std::size_t card = 1;  // behind the card that says which parts
    if (block.keyword.ends_with("_ID")) card = 2;
    const double friction = card < block.cards.size() ? Fields(deck_, block, block.cards[card]).real(0) : 0.0;
    if (model_.friction && *model_.friction != friction) {
      remark(Outcome::missing, block, "friction that differs between contacts");
      return;
    }
    model_.friction = std::max(friction, 0.0);
    remark(Outcome::converted, block, "contact of all bodies with this friction");
  }

  const std::set<Id>& members(const Block& block, const std::map<Id, std::set<Id>>& sets, Id number) const {
    const auto set = sets.find(number);
    if (set == sets.end()) fail(block, fmt::format("there is no set {}", number));
    return set->second;
  }

  /// A card for each node.
  void starts_of_nodes(const Block& block) {
    for (const Card& card : block.cards) {
      const Fields each(deck_, block, card);
      model_.starts.push_back({&block, Vector3(each.real(1), each.real(2), each.real(3)), {each.id(0)}, {}});
    }
  }

  /// A set of nodes, or all; on the second card the velocity.
  void start_of_set(const Block& block) {
    const Fields card = first(block);
    const Id set = card.id(0);
    if (card.id(1) != 0 || card.id(2) != 0)
      remark(Outcome::missing, block, "nodes that are exempt (NSIDEX), or those of a box (BOXID)");
    Start start{&block, Vector3::Zero(), {}, {}};
    if (set != 0) start.nodes = members(block, node_sets_, set);
    if (block.cards.size() < 2) fail(block, "has no card with a velocity");
    const Fields second(deck_, block, block.cards[1]);
    start.velocity = Vector3(second.real(0), second.real(1), second.real(2));
    if (second.real(3) != 0.0 || second.real(4) != 0.0 || second.real(5) != 0.0)
      remark(Outcome::missing, block, "angular velocity");
    model_.starts.push_back(std::move(start));
  }

  /// A set of parts, a part or a set of nodes.
  void start_generated(const Block& block) {
    const Fields fields = first(block);
    const Id number = fields.id(0), kind = fields.id(1);
    Start start{&block, Vector3(fields.real(3), fields.real(4), fields.real(5)), {}, {}};
    if (kind == 1 && number != 0) start.parts = members(block, part_sets_, number);
    if (kind == 2) start.parts = {number};
    if (kind == 3) start.nodes = members(block, node_sets_, number);
    if (kind < 1 || kind > 3) fail(block, fmt::format("STYP is {}, read are 1, 2 and 3", kind));
    if (fields.real(2) != 0.0) remark(Outcome::missing, block, "angular velocity");
    model_.starts.push_back(std::move(start));
  }

  const Deck& deck_;
  Import& import_;
  FaultList& faults_;
  Model model_;
  std::map<Id, std::set<Id>> node_sets_, part_sets_;
  std::vector<std::pair<const Block*, Reader>> starts_;
};

ModelReader::Readers ModelReader::of_keywords() {
  static constexpr std::array<std::pair<std::string_view, Reader>, 19> readers = {
      {{"NODE", &ModelReader::nodes},
       {"ELEMENT_SOLID", &ModelReader::solids},
       {"ELEMENT_SPH", &ModelReader::points},
       {"PART", &ModelReader::part},
       {"SET_NODE", &ModelReader::node_set},
       {"SET_NODE_LIST", &ModelReader::node_set},
       {"SET_NODE_LIST_GENERATE", &ModelReader::node_set},
       {"SET_PART", &ModelReader::part_set},
       {"SET_PART_LIST", &ModelReader::part_set},
       {"SET_PART_LIST_GENERATE", &ModelReader::part_set},
       {"INITIAL_VELOCITY", &ModelReader::velocity},
       {"INITIAL_VELOCITY_NODE", &ModelReader::velocity_by_nodes},
       {"INITIAL_VELOCITY_GENERATION", &ModelReader::velocity_by_parts},
       {"INITIAL_DETONATION", &ModelReader::detonation},
       {"CONTROL_TERMINATION", &ModelReader::end},
       {"DATABASE_BINARY_D3PLOT", &ModelReader::snapshots},
       {"TITLE", &ModelReader::title},
       {"INCLUDE", &ModelReader::taken},
       {"PARAMETER", &ModelReader::taken}}};
  return readers;
}

ModelReader::Readers ModelReader::of_beginnings() {
  static constexpr std::array<std::pair<std::string_view, Reader>, 5> readers = {
      {{"MAT_ADD", nullptr},
       {"MAT_", &ModelReader::material},
       {"EOS_", &ModelReader::state},
       {"CONTACT_", &ModelReader::contact},
       {"DATABASE_", &ModelReader::dropped}}};
  return readers;
}

}  // namespace

Model read_model(const Deck& deck, Import& import, FaultList& faults) {
  return ModelReader(deck, import, faults).read();
}

}  // namespace whipple::decks::dyna
