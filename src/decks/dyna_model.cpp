// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <ranges>
#include <span>
#include <string_view>
#include <utility>

#include "src/decks/dyna_contact.hpp"
#include "src/decks/dyna_fields.hpp"
#include "src/decks/dyna_keywords.hpp"
#include "src/decks/dyna_sets.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {
namespace {

/// Returns the letters, digits, '_' and '-' of a heading, as the name of a body.
std::string name_of(std::string_view heading) {
  constexpr std::size_t longest = 40;
  std::string name;
  for (const char c : heading) {
    const bool allowed = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    if (allowed) name += c;
    if (!allowed && !name.empty() && name.back() != '_') name += '_';
  }
  name.resize(std::min(name.size(), longest));
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

auto written(const Block& block) {
  return block.cards | std::views::filter([](const Card& card) { return !is_blank(card); });
}

class ModelReader {
 public:
  ModelReader(const Deck& deck, Import& import, FaultList& faults)
      : deck_(deck), import_(import), faults_(faults) {
    model_.title = import.deck;
  }

  Model read() {
    collect();
    for (const Block* block : general_sets_) faults_.guarded([&] { general_set(*block); });
    for (const auto& [block, reader] : of_sets_) faults_.guarded([&] { (this->*reader)(*block); });
    for (const Deck::Note& note : deck_.notes)
      import_.remark(Outcome::converted, note.place, note.keyword, note.text);
    return std::move(model_);
  }

 private:
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, place_of(block), "*" + block.keyword, std::move(text));
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
  /// Returns the readers of keywords, and of all keywords with a given prefix: the first match is used.
  static Readers of_keywords();
  static Readers of_beginnings();

  /// Reads a keyword; returns false if it is not supported.
  bool read(const Block& block) {
    const std::string_view key = block.keyword;
    Reader reader =
        std::ranges::find(harmless, key) != harmless.end() || key.empty() ? &ModelReader::dropped : nullptr;
    if (std::ranges::find(used_by_others, key) != used_by_others.end()) reader = &ModelReader::useful;
    const auto whole = std::ranges::find(of_keywords(), key, [](const auto& entry) { return entry.first; });
    const auto start = std::ranges::find_if(of_beginnings(),
                                            [&](const auto& entry) { return key.starts_with(entry.first); });
    if (whole != of_keywords().end()) {
      reader = whole->second;
    } else if (reader == nullptr && start != of_beginnings().end()) {
      reader = start->second;
    }
    if (reader == nullptr) return false;
    if (!block.behind.empty())
      remark(Outcome::dropped, block, fmt::format("'{}', behind the keyword", block.behind));
    (this->*reader)(block);
    return true;
  }

  /// Reports settings on the cards of a keyword that are not read.
  void check(const Block& block) { check(block, rule_of(block.keyword)); }
  void check(const Block& block, const KeywordRule* rule, std::size_t first = 0) {
    if (rule != nullptr) check_fields(deck_, block, *rule, import_, {}, first);
  }

  void dropped(const Block& block) {
    remark(Outcome::dropped, block, "of the methods and output of that code");
    check(block);
  }
  void useful(const Block& block) {
    remark(Outcome::dropped, block, "of use to other keywords, which are named if they are not read");
  }
  void groups(const Block& block) {
    remark(Outcome::dropped, block, "each part is a body with a material of its own");
  }
  void coupling(const Block& block) {
    remark(Outcome::converted, block, "bodies meet on the grid, whatever they are made of");
  }
  void shadows(const Block& block) {
    model_.shadows = true;
    remark(Outcome::exact, block, "detonation goes around what is no explosive");
  }
  void taken(const Block& block) { remark(Outcome::exact, block, "read"); }
  void material(const Block& block) { define(model_.materials, block, "material"); }
  void state(const Block& block) { define(model_.states, block, "equation of state"); }
  /// Keeps a block by its number. @throws InputError if another has it: which of them counts is not known
  void define(auto& blocks, const Block& block, std::string_view what) {
    const Id number = first_id(block);
    const auto [place, is_new] = blocks.emplace(number, &block);
    if (!is_new)
      fail(block, fmt::format("{} {} is defined at line {}, too", what, number, place->second->line));
  }
  void node_set(const Block& block) { set(block, node_sets_); }
  void part_set(const Block& block) { set(block, part_sets_); }
  void general_node_set(const Block& block) { general_sets_.push_back(&block); }
  void title(const Block& block) {
    if (!block.cards.empty()) {
      const std::string& text = block.cards[0].text;
      model_.title = text.substr(0, text.find_last_not_of(" \t\r") + 1);
    }
    remark(Outcome::exact, block, "title");
  }
  void end(const Block& block) {
    const double earlier = model_.end;
    model_.end = first(block).required(0, "the end time");
    if (earlier > 0.0 && earlier != model_.end)
      fail(block, fmt::format("another *{} has the end time {}", block.keyword, earlier));
    if (!(model_.end > 0.0)) fail(block, "the end time must be > 0");
    remark(Outcome::exact, block, "time.end");
    check(block);
  }
  void snapshots(const Block& block) {
    model_.snapshots = first(block).real(0);
    remark(Outcome::exact, block, "output.snapshot_every");
  }
  /// Reads one card for each detonator: part, place, delay.
  void detonation(const Block& block) {
    for (const Card& card : written(block)) {
      const Fields fields(deck_, block, card);
      model_.detonators.push_back({&block, card.line, fields.id(0),
                                   Vector3(fields.real(1), fields.real(2), fields.real(3)), fields.real(4)});
    }
    check(block);
  }
  void section(const Block& block) {
    for (const Card& card : written(block)) {
      const Fields fields(deck_, block, card);
      const bool solid = block.keyword == "SECTION_SOLID";
      model_.sections[static_cast<Id>(fields.required(0, "its number"))] = {&block, solid ? fields.id(1) : 0};
    }
    remark(Outcome::dropped, block, "of the methods and output of that code");
    check(block);
  }
  void histories(const Block& block) {
    model_.histories_block = &block;
    const bool named = block.keyword.ends_with("_ID");  // one card with a heading for each
    for (const Card& card : block.cards) {
      const Fields fields(deck_, block, card);
      for (std::size_t i = 0; i < (named ? 1 : fields.size()); ++i) {
        if (fields.id(i) > 0) model_.histories.push_back(fields.id(i));
      }
    }
  }
  /// Defers keywords that refer to sets until all sets have been read.
  void velocity(const Block& block) { of_sets_.emplace_back(&block, &ModelReader::start_of_set); }
  void velocity_by_nodes(const Block& block) { of_sets_.emplace_back(&block, &ModelReader::starts_of_nodes); }
  void velocity_by_parts(const Block& block) { of_sets_.emplace_back(&block, &ModelReader::start_generated); }
  void constraint(const Block& block) { of_sets_.emplace_back(&block, &ModelReader::constraints); }

  [[nodiscard]] Fields first(const Block& block) const {
    if (block.cards.empty()) fail(block, "has no card");
    return {deck_, block, block.cards[0]};
  }
  [[nodiscard]] Id first_id(const Block& block) const {
    return static_cast<Id>(first(block).required(0, "its number"));
  }

  void nodes(const Block& block) {
    for (const Card& card : written(block)) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, card, node_widths);
        const auto node = static_cast<Id>(fields.required(0, "the number of a node"));
        const Vector3 place(fields.real(1), fields.real(2), fields.real(3));
        if (const auto [other, is_new] = model_.nodes.emplace(node, place); !is_new && other->second != place)
          fail(block, card.line, fmt::format("node {} lies at another place, too", node));
        // Rotational constraints (RC) do not apply to nodes of solids.
        constexpr std::array<Directions, 8> of_code = {0, 1, 2, 4, 3, 6, 5, 7};
        const Id code = fields.id(4);
        if (code < 0 || code >= static_cast<Id>(of_code.size()))
          fail(block, card.line, fmt::format("the constraint TC is {}, not 0 to 7", code));
        hold(block, node, of_code[static_cast<std::size_t>(code)]);
      });
    }
    remark(Outcome::exact, block, fmt::format("{} nodes", block.cards.size()));
  }

  void hold(const Block& block, Id node, Directions directions) {
    if (directions == 0) return;
    Directions& held = model_.held[node];
    held = static_cast<Directions>(held | directions);
    if (model_.holders.empty() || model_.holders.back() != &block) model_.holders.push_back(&block);
  }

  /// Reads *BOUNDARY_SPC_NODE, _SET: one card for each node or set; with _ID each is preceded by one with a heading.
  void constraints(const Block& block) {
    const bool of_sets = block.keyword.find("_SET") != std::string::npos,
               named = block.keyword.ends_with("_ID");
    for (std::size_t i = named ? 1 : 0; i < block.cards.size(); i += named ? 2 : 1) {
      const Fields fields(deck_, block, block.cards[i]);
      const Id number = fields.id(0);
      if (number == 0) continue;
      if (fields.id(1) != 0) {
        import_.remark(Outcome::missing, place_of(block, block.cards[i].line), "*" + block.keyword,
                       fmt::format("CID = {}: a local coordinate system", fields.id(1)));
        continue;
      }
      Directions directions = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (fields.real(static_cast<std::size_t>(axis) + 2) != 0.0)
          directions = static_cast<Directions>(directions | along(axis));
      }
      if (of_sets) {
        for (const Id node : members(block, node_sets_, number)) hold(block, node, directions);
      } else {
        hold(block, number, directions);
      }
    }
  }

  void solids(const Block& block) {
    for (std::size_t i = 0; i < block.cards.size(); ++i) {
      if (is_blank(block.cards[i])) continue;
      faults_.guarded([&] {
        const Fields fields(deck_, block, block.cards[i], solid_widths);
        Solid solid{.line = block.cards[i].line};
        // In the ten-node format, element and part are on a separate card.
        const bool two_cards = fields.id(2) == 0 && i + 1 < block.cards.size();
        const Fields list = two_cards ? Fields(deck_, block, block.cards[++i], solid_widths) : fields;
        for (std::size_t k = 0; k < 8; ++k) solid.nodes[k] = list.id(k + (two_cards ? 0 : 2));
        model_.parts[fields.id(1)].solids.push_back(solid);
      });
    }
    remark(Outcome::exact, block, fmt::format("{} elements", block.cards.size()));
  }

  void points(const Block& block) {
    for (const Card& card : written(block)) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, card, sph_widths);
        model_.parts[fields.id(1)].points.push_back({fields.id(0), fields.required(2, "the mass")});
        if (fields.id(3) != 0)
          import_.remark(Outcome::missing, place_of(block, card.line), "*" + block.keyword,
                         fmt::format("NEND = {}: points up to this node", fields.id(3)));
      });
    }
    remark(Outcome::converted, block, fmt::format("{} elements", block.cards.size()));
  }

  /// Reads a heading and a card for each part.
  void part(const Block& block) {
    for (std::size_t i = 0; i + 1 < block.cards.size(); i += 2) {
      faults_.guarded([&] {
        const Fields fields(deck_, block, block.cards[i + 1]);
        const Id number = static_cast<Id>(fields.required(0, "the number of the part"));
        Part& part = model_.parts[number];
        part.block = &block;
        part.name = name_of(block.cards[i].text);
        const auto is_taken = [&] {
          return std::ranges::any_of(model_.parts, [&](const auto& entry) {
            return entry.first != number && entry.second.name == part.name;
          });
        };
        if (part.name.empty() || is_taken()) part.name = fmt::format("part_{}", number);
        while (is_taken()) part.name += "_";
        part.section = fields.id(1);
        part.material = fields.id(2);
        part.state = fields.id(3);
        remark(Outcome::exact, block, fmt::format("{}: {}", part.name, trimmed(block.cards[i].text)));
      });
    }
    check(block);
  }

  void set(const Block& block, std::map<Id, std::set<Id>>& sets) {
    std::set<Id>& members = sets[first_id(block)];
    members.merge(listed_members(deck_, block));
    remark(Outcome::exact, block, fmt::format("{} members", members.size()));
  }
  void general_set(const Block& block) {
    const std::optional<std::set<Id>> nodes = general_nodes(deck_, block, model_, boxes_);
    if (!nodes) {
      remark(Outcome::missing, block, "nodes that are chosen by something else than ALL, NODE, PART and BOX");
      return;
    }
    node_sets_[first_id(block)] = *nodes;
    remark(Outcome::exact, block, fmt::format("{} members", nodes->size()));
  }
  void box(const Block& block) {
    const Fields c = first(block);
    boxes_[first_id(block)] = {Vector3(c.real(1), c.real(3), c.real(5)),
                               Vector3(c.real(2), c.real(4), c.real(6))};
    useful(block);
  }
  /// Checks DFLAG: the first value of a parameter is kept, which is the default of that code.
  void duplication(const Block& block) {
    const Id flag = first(block).id(0);
    const bool first_stays = flag == 0 || flag == 1 || flag == 4;
    remark(first_stays ? Outcome::exact : Outcome::missing, block,
           fmt::format("DFLAG = {}: the first value of a parameter stays", flag));
  }

  void contact(const Block& block) {
    const ContactType type = contact_type(block);
    if (type.kind != ContactKind::pressing) {
      remark(type.kind == ContactKind::output ? Outcome::dropped : Outcome::missing, block,
             type.kind == ContactKind::output ? "output of forces"
             : type.kind == ContactKind::tied ? "surfaces that are tied: give the parts common nodes"
                                              : "this contact is not read");
      return;
    }
    const std::size_t card = type.first_card;
    check(block, rule_of("CONTACT"), card);
    if (card + 1 >= block.cards.size()) return friction(block, 0.0);
    const Fields second(deck_, block, block.cards[card + 1]);
    const double at_rest = second.real(0), sliding = second.real(1);
    if (at_rest < 0.0) {
      remark(Outcome::missing, block,
             fmt::format("FS = {}: friction of parts or of a table", number(at_rest)));
    } else if (sliding != at_rest && second.real(2) != 0.0) {
      remark(Outcome::missing, block,
             fmt::format("friction that goes from FS = {} to FD = {} with the speed (DC = {})",
                         number(at_rest), number(sliding), number(second.real(2))));
    } else {
      friction(block, at_rest);
    }
  }
  void friction(const Block& block, double coefficient) {
    if (model_.friction && *model_.friction != coefficient) {
      remark(Outcome::missing, block, "friction that differs between contacts");
      return;
    }
    model_.friction = coefficient;
    remark(Outcome::converted, block, "contact of all bodies with this friction");
  }

  const std::set<Id>& members(const Block& block, const std::map<Id, std::set<Id>>& sets, Id number) const {
    const auto set = sets.find(number);
    if (set == sets.end() || set->second.empty()) fail(block, fmt::format("there is no set {}", number));
    return set->second;
  }

  /// Reads one card for each node.
  void starts_of_nodes(const Block& block) {
    for (const Card& card : written(block)) {
      const Fields each(deck_, block, card);
      model_.starts.push_back({&block, Vector3(each.real(1), each.real(2), each.real(3)), {each.id(0)}, {}});
    }
    check(block);
  }

  /// Reads a set of nodes, or all nodes, and the velocity on the second card.
  void start_of_set(const Block& block) {
    const Fields card = first(block);
    const Id set = card.id(0);
    Start start{&block, Vector3::Zero(), {}, {}};
    if (set != 0) start.nodes = members(block, node_sets_, set);
    if (block.cards.size() < 2) fail(block, "has no card with a velocity");
    const Fields second(deck_, block, block.cards[1]);
    start.velocity = Vector3(second.real(0), second.real(1), second.real(2));
    check(block);
    model_.starts.push_back(std::move(start));
  }

  /// Reads the velocity of a set of parts, a part or a set of nodes.
  void start_generated(const Block& block) {
    const Fields fields = first(block);
    const Id number = fields.id(0), kind = fields.id(1);
    Start start{&block, Vector3(fields.real(3), fields.real(4), fields.real(5)), {}, {}};
    if (kind == 1 && number != 0) start.parts = members(block, part_sets_, number);
    if (kind == 2) start.parts = {number};
    if (kind == 3) start.nodes = members(block, node_sets_, number);
    if (kind < 1 || kind > 3) fail(block, fmt::format("STYP is {}, read are 1, 2 and 3", kind));
    check(block);
    model_.starts.push_back(std::move(start));
  }

  const Deck& deck_;
  Import& import_;
  FaultList& faults_;
  Model model_;
  std::map<Id, std::set<Id>> node_sets_, part_sets_;
  std::map<Id, DeckBox> boxes_;
  std::vector<const Block*> general_sets_;  ///< read after all nodes and parts
  std::vector<std::pair<const Block*, Reader>> of_sets_;
};

ModelReader::Readers ModelReader::of_keywords() {
  static const auto readers = std::to_array<std::pair<std::string_view, Reader>>(
      {{"NODE", &ModelReader::nodes},
       {"ELEMENT_SOLID", &ModelReader::solids},
       {"ELEMENT_SPH", &ModelReader::points},
       {"PART", &ModelReader::part},
       {"SECTION_SOLID", &ModelReader::section},
       {"SECTION_SPH", &ModelReader::section},
       {"SET_NODE", &ModelReader::node_set},
       {"SET_NODE_LIST", &ModelReader::node_set},
       {"SET_NODE_LIST_GENERATE", &ModelReader::node_set},
       {"SET_NODE_GENERAL", &ModelReader::general_node_set},
       {"SET_PART", &ModelReader::part_set},
       {"SET_PART_LIST", &ModelReader::part_set},
       {"SET_PART_LIST_GENERATE", &ModelReader::part_set},
       {"INITIAL_VELOCITY", &ModelReader::velocity},
       {"INITIAL_VELOCITY_NODE", &ModelReader::velocity_by_nodes},
       {"INITIAL_VELOCITY_GENERATION", &ModelReader::velocity_by_parts},
       {"INITIAL_DETONATION", &ModelReader::detonation},
       {"CONTROL_EXPLOSIVE_SHADOW", &ModelReader::shadows},
       {"BOUNDARY_SPC_NODE", &ModelReader::constraint},
       {"BOUNDARY_SPC_NODE_ID", &ModelReader::constraint},
       {"BOUNDARY_SPC_SET", &ModelReader::constraint},
       {"BOUNDARY_SPC_SET_ID", &ModelReader::constraint},
       {"ALE_MULTI-MATERIAL_GROUP", &ModelReader::groups},
       {"CONSTRAINED_LAGRANGE_IN_SOLID", &ModelReader::coupling},
       {"CONTROL_TERMINATION", &ModelReader::end},
       {"DATABASE_BINARY_D3PLOT", &ModelReader::snapshots},
       {"DATABASE_HISTORY_NODE", &ModelReader::histories},
       {"DATABASE_HISTORY_NODE_ID", &ModelReader::histories},
       {"TITLE", &ModelReader::title},
       {"INCLUDE", &ModelReader::taken},
       {"PARAMETER", &ModelReader::taken},
       {"DEFINE_BOX", &ModelReader::box},
       {"PARAMETER_DUPLICATION", &ModelReader::duplication},
       {"PARAMETER_LOCAL", &ModelReader::taken},
       {"PARAMETER_EXPRESSION", &ModelReader::taken},
       {"PARAMETER_EXPRESSION_LOCAL", &ModelReader::taken}});
  return readers;
}

ModelReader::Readers ModelReader::of_beginnings() {
  static constexpr std::array<std::pair<std::string_view, Reader>, 6> readers = {
      {{"MAT_ADD", nullptr},
       {"CONTROL_MPP_", &ModelReader::dropped},
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
