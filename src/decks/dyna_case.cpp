// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/text.hpp"
#include "src/decks/dyna_material.hpp"
#include "src/decks/lattice.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::dyna {
namespace {

using Id = std::int64_t;

constexpr std::size_t most_boxes_of_points = 400;

struct Solid {
  unsigned line = 0;
  std::array<Id, 8> nodes = {};
};
struct SphPoint {
  Id node = 0;
  double mass = 0.0;
};
struct Part {
  const Block* block = nullptr;
  std::string name;
  Id section = 0, material = 0, state = 0;
  std::vector<Solid> solids;
  std::vector<SphPoint> points;
};
/// What a velocity is given to.
struct Start {
  const Block* block = nullptr;
  Vector3 velocity = Vector3::Zero();
  std::set<Id> nodes;  ///< empty with no parts: all
  std::set<Id> parts;
};

/// Keywords without influence on the physics of the case.
constexpr std::array harmless = {"KEYWORD", "END", "COMMENT", "CONTROL_ENERGY", "CONTROL_OUTPUT", "CONTROL_CPU", "CONTROL_HOURGLASS",
                                 "HOURGLASS", "CONTROL_BULK_VISCOSITY", "CONTROL_SOLUTION", "CONTROL_TIMESTEP", "CONTROL_CONTACT",
                                 "CONTROL_SPH", "CONTROL_ACCURACY", "CONTROL_SOLID", "CONTROL_PARALLEL", "SECTION_SOLID", "SECTION_SPH"};

class CaseWriter {
 public:
  CaseWriter(const Deck& deck, const ImportOptions& options) : deck_(deck), options_(options) {
    import_.deck = deck.file.filename().string();
    import_.grammar = grammar;
    title_ = import_.deck;
  }

  Import write() {
    needs();
    collect();
    raise();
    head();
    bodies();
    raise();
    import_.case_text = fmt::format("{}\n{}\n{}{}", head_.text(), domain(), toml_.text(), bodies_);
    std::ranges::stable_sort(import_.remarks, {}, &Remark::line);
    return std::move(import_);
  }

 private:
  void raise() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }
  /// Runs a part of the work and keeps its faults.
  template <class Work>
  void guarded(Work&& work) {
    constexpr std::size_t most = 20;
    try {
      work();
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
      if (faults_.size() >= most) raise();
    }
  }
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, block.line, "*" + block.keyword, std::move(text));
  }
  [[nodiscard]] std::string vector(const Vector3& v, const Dimension& dimension) const {
    return fmt::format("[{}, {}, {}]", units_.quantity(v[0], dimension), units_.quantity(v[1], dimension), units_.quantity(v[2], dimension));
  }

  void needs() {
    const auto fault = [&](std::string text) { faults_.push_back({.file = deck_.file.string(), .line = 1, .column = 1, .text = std::move(text)}); };
    if (options_.units) {
      units_ = *options_.units;
    } else {
      fault("decks of LS-DYNA do not say their units: give them as in --units 'mm ms kg' (usual: 'mm ms kg', 'cm g us', 'mm t s')");
    }
    if (!(options_.cell_size > 0.0)) fault("the deck has no grid: give the edge of its cells, as in --cell-size '0.5 mm'");
    raise();
    import_.units = fmt::format("{} {} {}", units_.length, units_.mass, units_.time);
    cell_ = options_.cell_size / units_.in_si(1.0, dimension::length);
  }

  void collect() {
    std::map<std::string, std::pair<const Block*, std::size_t>> unknown;
    for (const Block& block : deck_.blocks) {
      guarded([&] {
        if (read(block)) return;
        auto& [first, count] = unknown[block.keyword];
        if (count++ == 0) first = &block;
      });
    }
    for (const auto& [keyword, entry] : unknown) {
      remark(Outcome::missing, *entry.first, fmt::format("not read, {} time{}", entry.second, entry.second == 1 ? "" : "s"));
    }
  }

  /// Reads a keyword; false if it is none of those that are read.
  bool read(const Block& block) {
    const std::string& key = block.keyword;
    if (key == "NODE") {
      nodes(block);
    } else if (key == "ELEMENT_SOLID" || key == "ELEMENT_SPH") {
      elements(block);
    } else if (key == "PART") {
      part(block);
    } else if (key.starts_with("MAT_") && !key.starts_with("MAT_ADD")) {
      materials_[first_id(block)] = &block;
    } else if (key.starts_with("EOS_")) {
      states_[first_id(block)] = &block;
    } else if (key.starts_with("SET_NODE") || key.starts_with("SET_PART")) {
      set(block);
    } else if (key == "INITIAL_VELOCITY" || key == "INITIAL_VELOCITY_NODE" || key == "INITIAL_VELOCITY_GENERATION") {
      starts_.push_back(&block);
    } else if (key == "CONTROL_TERMINATION") {
      end_ = first(block).required(0, "the end time");
      if (!(end_ > 0.0)) fail(block, "the end time must be > 0");
      remark(Outcome::exact, block, "time.end");
    } else if (key == "DATABASE_BINARY_D3PLOT") {
      snapshots_ = first(block).real(0);
      remark(Outcome::exact, block, "output.snapshot_every");
    } else if (key.starts_with("CONTACT_")) {
      contact(block);
    } else if (key == "TITLE") {
      if (!block.cards.empty()) title_ = block.cards[0].text.substr(0, block.cards[0].text.find_last_not_of(" \t\r") + 1);
      remark(Outcome::exact, block, "title");
    } else if (key == "INCLUDE" || key == "PARAMETER") {
      remark(Outcome::exact, block, "read");
    } else if (std::ranges::find(harmless, key) != harmless.end() || key.starts_with("DATABASE_") || key.empty()) {
      remark(Outcome::dropped, block, "of the methods and output of that code");
    } else {
      return false;
    }
    return true;
  }

  [[nodiscard]] Fields first(const Block& block) const {
    if (block.cards.empty()) fail(block, "has no card");
    return {deck_, block, block.cards[0]};
  }
  [[nodiscard]] Id first_id(const Block& block) const { return static_cast<Id>(first(block).required(0, "its number")); }

  void nodes(const Block& block) {
    for (const Card& card : block.cards) {
      guarded([&] {
        const Fields fields(deck_, block, card, node_widths);
        nodes_[static_cast<Id>(fields.required(0, "the number of a node"))] = Vector3(fields.real(1), fields.real(2), fields.real(3));
      });
    }
    remark(Outcome::exact, block, fmt::format("{} nodes", block.cards.size()));
  }

  void elements(const Block& block) {
    const bool solids = block.keyword == "ELEMENT_SOLID";
    for (std::size_t i = 0; i < block.cards.size(); ++i) {
      guarded([&] {
        const Fields fields(deck_, block, block.cards[i], solids ? std::span<const int>(solid_widths) : sph_widths);
        const Id part = fields.id(1);
        if (!solids) {
          parts_[part].points.push_back({fields.id(0), fields.required(2, "the mass")});
          return;
        }
        Solid solid{.line = block.cards[i].line};
        // Element and part stand on a card of their own in the format of ten nodes.
        const bool two_cards = fields.id(2) == 0 && i + 1 < block.cards.size();
        const Fields list = two_cards ? Fields(deck_, block, block.cards[++i], solid_widths) : fields;
        for (std::size_t k = 0; k < 8; ++k) solid.nodes[k] = list.id(k + (two_cards ? 0 : 2));
        parts_[part].solids.push_back(solid);
      });
    }
    remark(solids ? Outcome::exact : Outcome::converted, block, fmt::format("{} elements", block.cards.size()));
  }

  /// A heading and a card for each part.
  void part(const Block& block) {
    for (std::size_t i = 0; i + 1 < block.cards.size(); i += 2) {
      guarded([&] {
        const Fields fields(deck_, block, block.cards[i + 1]);
        const Id number = static_cast<Id>(fields.required(0, "the number of the part"));
        Part& part = parts_[number];
        part.block = &block;
        part.name = fmt::format("part_{}", number);
        part.section = fields.id(1);
        part.material = fields.id(2);
        part.state = fields.id(3);
        remark(Outcome::exact, block, fmt::format("{}: {}", part.name, block.cards[i].text));
      });
    }
  }

  void set(const Block& block) {
    const bool generated = block.keyword.ends_with("_GENERATE");
    std::set<Id>& members = (block.keyword.starts_with("SET_NODE") ? node_sets_ : part_sets_)[first_id(block)];
    for (std::size_t i = 1; i < block.cards.size(); ++i) {
      const Fields fields(deck_, block, block.cards[i]);
      for (std::size_t k = 0; k < fields.size(); k += generated ? 2 : 1) {
        const Id from = fields.id(k), to = generated ? fields.id(k + 1) : from;
        if (from == 0) continue;
        constexpr Id most = 100'000'000;
        if (to < from || to - from > most) fail(block, fmt::format("the range {} to {} is none", from, to));
        for (Id member = from; member <= to; ++member) members.insert(member);
      }
    }
    remark(Outcome::exact, block, fmt::format("{} members", members.size()));
  }

  void contact(const Block& block) {
    std::size_t card = 1;  // behind the card that says which parts
    if (block.keyword.ends_with("_ID")) card = 2;
    const double friction = card < block.cards.size() ? Fields(deck_, block, block.cards[card]).real(0) : 0.0;
    if (friction_ && *friction_ != friction) {
      remark(Outcome::missing, block, "friction that differs between contacts");
      return;
    }
    friction_ = std::max(friction, 0.0);
    remark(Outcome::converted, block, "contact of all bodies with this friction");
  }

  /// Velocities refer to sets, which may come after them.
  [[nodiscard]] std::vector<Start> starts() {
    std::vector<Start> found;
    for (const Block* block : starts_) {
      guarded([&] {
        const auto members = [&](const std::map<Id, std::set<Id>>& sets, Id number) {
          const auto set = sets.find(number);
          if (set == sets.end()) fail(*block, fmt::format("there is no set {}", number));
          return set->second;
        };
        const Fields fields = first(*block);
        Start start{.block = block};
        if (block->keyword == "INITIAL_VELOCITY_NODE") {
          for (const Card& card : block->cards) {
            const Fields each(deck_, *block, card);
            found.push_back({block, Vector3(each.real(1), each.real(2), each.real(3)), {each.id(0)}, {}});
          }
          return;
        }
        if (block->keyword == "INITIAL_VELOCITY") {
          if (fields.id(0) != 0) start.nodes = members(node_sets_, fields.id(0));
          if (block->cards.size() < 2) fail(*block, "has no card with a velocity");
          const Fields second(deck_, *block, block->cards[1]);
          start.velocity = Vector3(second.real(0), second.real(1), second.real(2));
        } else {
          const Id number = fields.id(0), kind = fields.id(1);
          if (kind == 1 && number != 0) start.parts = members(part_sets_, number);
          if (kind == 2) start.parts = {number};
          if (kind == 3) start.nodes = members(node_sets_, number);
          if (kind < 1 || kind > 3) fail(*block, fmt::format("STYP is {}, read are 1, 2 and 3", kind));
          if (fields.real(2) != 0.0) remark(Outcome::missing, *block, "angular velocity");
          start.velocity = Vector3(fields.real(3), fields.real(4), fields.real(5));
        }
        found.push_back(std::move(start));
      });
    }
    return found;
  }

  void head() {
    if (end_ == 0.0) faults_.push_back({.file = deck_.file.string(), .line = 1, .column = 1, .text = "the deck has no *CONTROL_TERMINATION"});
    head_.comment(fmt::format("Written by 'whipple import' from {}, a deck of {}; see import.txt.", import_.deck, grammar));
    head_.text_entry("title", title_);
    toml_.table("[time]");
    toml_.entry("end", units_.quantity(end_, dimension::time));
    toml_.table("[contact]");
    toml_.entry("method", friction_ ? "\"multi_field\"" : "\"none\"", friction_ ? "" : "the deck has no *CONTACT");
    if (friction_) toml_.entry("friction", number(*friction_));
    toml_.table("[output]");
    if (snapshots_ > 0.0) toml_.entry("snapshot_every", units_.quantity(snapshots_, dimension::time));
  }

  void bodies() {
    const std::vector<Start> all_starts = starts();
    std::set<const Block*> used;
    for (auto& [number, part] : parts_) {
      guarded([&] {
        const Id id = number;
        if (part.block == nullptr) {
          throw InputError(std::vector<InputFault>{{.file = deck_.file.string(), .line = 1, .column = 1,
                                                    .text = fmt::format("elements are of part {}, which the deck does not define", id)}});
        }
        if (part.solids.empty() && part.points.empty()) {
          remark(Outcome::missing, *part.block, fmt::format("{}: no solid or SPH elements", part.name));
          return;
        }
        const auto material = materials_.find(part.material);
        if (material == materials_.end()) fail(*part.block, fmt::format("{}: there is no *MAT {}", part.name, part.material));
        const auto state = states_.find(part.state);
        if (part.state != 0 && state == states_.end()) fail(*part.block, fmt::format("{}: there is no *EOS {}", part.name, part.state));
        used.insert(material->second);
        if (part.state != 0) used.insert(state->second);
        if (!has_law(*material->second) && part.state == 0) {
          remark(Outcome::missing, *material->second, fmt::format("{}: this material law", part.name));
          return;
        }
        body(id, part, material_of(deck_, *material->second, part.state != 0 ? state->second : nullptr, part.name, units_, import_), all_starts);
      });
    }
    for (const Start& start : all_starts) {
      if (velocities_.insert(start.block).second) remark(Outcome::missing, *start.block, "velocities of some nodes of a part, or of none");
    }
    for (const auto* blocks : {&materials_, &states_}) {
      for (const auto& [number, block] : *blocks) {
        if (!used.contains(block)) remark(Outcome::dropped, *block, fmt::format("number {} is of no part", number));
      }
    }
  }

  const Vector3& place(const Part& part, Id node) const {
    const auto found = nodes_.find(node);
    if (found == nodes_.end()) fail(*part.block, fmt::format("{}: there is no node {}", part.name, node));
    return found->second;
  }

  void body(Id id, const Part& part, const CaseMaterial& material, const std::vector<Start>& all_starts) {
    std::set<Id> members;
    for (const Solid& solid : part.solids) members.insert(solid.nodes.begin(), solid.nodes.end());
    for (const SphPoint& point : part.points) members.insert(point.node);
    for (const Id node : members) {
      const Vector3& x = place(part, node);
      lower_ = empty_ ? x : Vector3(lower_.cwiseMin(x));
      upper_ = empty_ ? x : Vector3(upper_.cwiseMax(x));
      empty_ = false;
    }
    if (!part.solids.empty() && !part.points.empty()) fail(*part.block, fmt::format("{}: solid and SPH elements in one part", part.name));
    TomlText text;
    text.table("[[body]]", fmt::format("line {}", part.block->line));
    text.text_entry("name", part.name);
    text.entry("material", toml_string(material.file));
    const Vector3 velocity = velocity_of(id, members, all_starts);
    if (velocity != Vector3::Zero()) text.entry("velocity", vector(velocity, dimension::velocity));
    fastest_ = std::max(fastest_, velocity.norm());
    const bool written = part.solids.empty() ? points(part, material, text) : mesh(part, material, text);
    if (!written) return;
    if (material.initial_pressure != 0.0) {
      text.entry("initial", fmt::format("{{ density = {}, pressure = {} }}", units_.quantity(material.density, dimension::density),
                                        units_.quantity(material.initial_pressure, dimension::pressure)));
    }
    bodies_ += "\n" + text.text();
  }

  /// The last velocity that all nodes of a part get; what only some of them get is missing.
  Vector3 velocity_of(Id id, const std::set<Id>& members, const std::vector<Start>& all_starts) {
    Vector3 velocity = Vector3::Zero();
    std::map<std::array<double, 3>, std::set<Id>> one_by_one;
    for (const Start& start : all_starts) {
      const bool all = start.nodes.empty() && start.parts.empty();
      const bool whole = all || start.parts.contains(id) || (!start.nodes.empty() && std::ranges::includes(start.nodes, members));
      if (whole) {
        velocity = start.velocity;
        if (velocities_.insert(start.block).second) remark(Outcome::exact, *start.block, "velocity of whole parts");
      } else {
        auto& some = one_by_one[{start.velocity[0], start.velocity[1], start.velocity[2]}];
        std::ranges::set_intersection(start.nodes, members, std::inserter(some, some.end()));
      }
    }
    for (const auto& [value, nodes] : one_by_one) {
      if (nodes.empty()) continue;
      if (nodes.size() == members.size()) {
        velocity = Vector3(value[0], value[1], value[2]);
        for (const Start& start : all_starts) {
          if (start.velocity == velocity && velocities_.insert(start.block).second) remark(Outcome::converted, *start.block, "velocity of whole parts, node by node");
        }
      } else {
        import_.remark(Outcome::missing, 0, "*INITIAL_VELOCITY", fmt::format("velocities of {} of the {} nodes of part {}", nodes.size(), members.size(), id));
      }
    }
    return velocity;
  }

  /// Solid elements as a mesh of Gmsh, format 2.2.
  bool mesh(const Part& part, const CaseMaterial& material, TomlText& text) {
    std::map<Id, std::size_t> index;
    std::string elements;
    double mass = 0.0, longest = 0.0;
    for (std::size_t i = 0; i < part.solids.size(); ++i) {
      const std::array<Id, 8>& n = part.solids[i].nodes;
      if (std::set<Id>(n.begin(), n.end()).size() != 8) {
        remark(Outcome::missing, *part.block, fmt::format("{}: elements that are no hexahedra, the first in line {}", part.name, part.solids[i].line));
        return false;
      }
      elements += fmt::format("{} 5 2 1 1", i + 1);
      for (const Id node : n) elements += fmt::format(" {}", index.try_emplace(node, index.size() + 1).first->second);
      elements += '\n';
      const auto x = [&](std::size_t corner) { return place(part, n[corner]); };
      const Vector3 a = 0.25 * (x(1) + x(2) + x(5) + x(6) - x(0) - x(3) - x(4) - x(7));
      const Vector3 b = 0.25 * (x(2) + x(3) + x(6) + x(7) - x(0) - x(1) - x(4) - x(5));
      const Vector3 c = 0.25 * (x(4) + x(5) + x(6) + x(7) - x(0) - x(1) - x(2) - x(3));
      mass += material.density * a.cross(b).dot(c);
      longest = std::max({longest, a.norm(), b.norm(), c.norm()});
    }
    std::vector<Id> order(index.size());
    for (const auto& [node, number] : index) order[number - 1] = node;
    std::string nodes;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vector3& x = place(part, order[i]);
      nodes += fmt::format("{} {} {} {}\n", i + 1, x[0], x[1], x[2]);
    }
    const std::string file = fmt::format("meshes/{}.msh", part.name);
    import_.files.push_back({file, fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"{}\"\n$EndPhysicalNames\n"
                                               "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
                                               part.name, order.size(), nodes, part.solids.size(), elements)});
    text.entry("discretization", fmt::format("{{ method = \"finite_elements\", mesh = \"{}\", mesh_unit = {} }}", file, units_.quantity(1.0, dimension::length)));
    if (longest > 2.0 * cell_) {
      remark(Outcome::converted, *part.block, fmt::format("{}: elements of {} {} need cells of at least half of that", part.name, number(longest), units_.length));
    }
    import_.bodies.push_back({part.name, fmt::format("{} hexahedra", part.solids.size()), static_cast<double>(part.solids.size()),
                              units_.in_si(mass, {.mass = 1})});
    return true;
  }

  /// SPH elements on a cubic lattice as boxes.
  bool points(const Part& part, const CaseMaterial& material, TomlText& text) {
    std::vector<Vector3> places;
    double least = 0.0, greatest = 0.0, total = 0.0;
    for (const SphPoint& point : part.points) {
      const double mass = point.mass < 0.0 ? -point.mass * material.density : point.mass;  // negative: its volume
      least = places.empty() ? mass : std::min(least, mass);
      greatest = std::max(greatest, mass);
      total += mass;
      places.push_back(place(part, point.node));
    }
    const double spacing = std::cbrt(greatest / material.density);
    const bool alike = least > 0.0 && greatest - least <= 1e-3 * greatest;
    const auto boxes = alike ? boxes_of_points(places, spacing, most_boxes_of_points) : std::nullopt;
    if (!boxes) {
      remark(Outcome::missing, *part.block, fmt::format("{}: {} points that fill no cubic lattice of equal particles", part.name, places.size()));
      return false;
    }
    std::string list;
    for (const LatticeBox& box : *boxes) {
      list += fmt::format("{}{{ box = {{ lower = {}, upper = {} }} }}", list.empty() ? "" : ",\n  ", vector(box.lower, dimension::length),
                          vector(box.upper, dimension::length));
    }
    text.entry("shape", boxes->size() == 1 ? list : fmt::format("{{ union = [{}] }}", list));
    lower_ -= Vector3::Constant(0.5 * spacing);
    upper_ += Vector3::Constant(0.5 * spacing);
    import_.bodies.push_back({part.name, fmt::format("SPH points of a cubic lattice, {} boxes", boxes->size()), static_cast<double>(places.size()),
                              units_.in_si(total, {.mass = 1})});
    return true;
  }

  /// The deck has no grid: room around all bodies for the way of the fastest one, at most twice their extent.
  std::string domain() {
    const double extent = (upper_ - lower_).maxCoeff();
    const double margin = std::min(fastest_ * end_, 2.0 * extent) + 4.0 * cell_;
    const Vector3 around = Vector3::Constant(cell_ * std::ceil(margin / cell_));
    TomlText text;
    text.table("[domain]", "not in the deck: room for the way of the fastest body, at most twice their extent");
    text.entry("lower", vector(lower_ - around, dimension::length));
    text.entry("upper", vector(upper_ + around, dimension::length));
    text.entry("cell_size", units_.quantity(cell_, dimension::length));
    import_.remark(Outcome::converted, 0, "-", fmt::format("domain: the bodies with {} {} around them", number(around[0]), units_.length));
    return text.text();
  }

  const Deck& deck_;
  const ImportOptions& options_;
  Import import_;
  UnitSystem units_;
  std::string title_, bodies_;
  TomlText head_, toml_;
  std::vector<InputFault> faults_;
  std::map<Id, Vector3> nodes_;
  std::map<Id, Part> parts_;
  std::map<Id, const Block*> materials_, states_;
  std::map<Id, std::set<Id>> node_sets_, part_sets_;
  std::vector<const Block*> starts_;
  std::set<const Block*> velocities_;
  std::optional<double> friction_;
  double end_ = 0.0, snapshots_ = 0.0, cell_ = 0.0, fastest_ = 0.0;
  Vector3 lower_ = Vector3::Zero(), upper_ = Vector3::Zero();
  bool empty_ = true;
};

}  // namespace

Import to_case(const Deck& deck, const ImportOptions& options) { return CaseWriter(deck, options).write(); }

}  // namespace whipple::decks::dyna
