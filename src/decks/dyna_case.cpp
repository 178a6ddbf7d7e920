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
#include "src/decks/dyna_model.hpp"
#include "src/decks/lattice.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::dyna {
namespace {

constexpr std::size_t most_boxes_of_points = 400;

class CaseWriter {
 public:
  CaseWriter(const Deck& deck, const ImportOptions& options) : deck_(deck), options_(options) {
    import_.deck = deck.file.filename().string();
    import_.grammar = grammar;
  }

  Import write() {
    needs();
    model_ = read_model(deck_, import_, faults_);
    faults_.raise();
    head();
    bodies();
    detonators();
    faults_.raise();
    import_.case_text = fmt::format("{}\n{}\n{}{}", head_.text(), domain(), toml_.text(), bodies_);
    std::ranges::stable_sort(import_.remarks, {}, &Remark::line);
    return std::move(import_);
  }

 private:
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, block.line, "*" + block.keyword, std::move(text));
  }
  [[nodiscard]] std::string vector(const Vector3& v, const Dimension& dimension) const {
    return fmt::format("[{}, {}, {}]", units_.quantity(v[0], dimension), units_.quantity(v[1], dimension),
                       units_.quantity(v[2], dimension));
  }

  void needs() {
    const auto fault = [&](std::string text) {
      faults_.add({.file = deck_.file.string(), .line = 1, .column = 1, .text = std::move(text)});
    };
    if (options_.units) {
      units_ = *options_.units;
    } else {
      fault(
          "decks of LS-DYNA do not say their units: give them as in --units 'mm ms kg' (usual: 'mm ms kg', "
          "'cm g us', 'mm t s')");
    }
    if (!(options_.cell_size > 0.0))
      fault("the deck has no grid: give the edge of its cells, as in --cell-size '0.5 mm'");
    faults_.raise();
    import_.units = fmt::format("{} {} {}", units_.length, units_.mass, units_.time);
    cell_ = options_.cell_size / units_.in_si(1.0, dimension::length);
  }

  void head() {
    if (model_.end == 0.0)
      faults_.add({.file = deck_.file.string(),
                   .line = 1,
                   .column = 1,
                   .text = "the deck has no *CONTROL_TERMINATION"});
    head_.comment(fmt::format("Written by 'whipple import' from {}, a deck of {}; see import.txt.",
                              import_.deck, grammar));
    head_.text_entry("title", model_.title);
    toml_.table("[time]");
    toml_.entry("end", units_.quantity(model_.end, dimension::time));
    toml_.table("[contact]");
    toml_.entry("method", model_.friction ? "\"multi_field\"" : "\"none\"",
                model_.friction ? "" : "the deck has no *CONTACT");
    if (model_.friction) toml_.entry("friction", number(*model_.friction));
    toml_.table("[output]");
    if (model_.snapshots > 0.0)
      toml_.entry("snapshot_every", units_.quantity(model_.snapshots, dimension::time));
  }

  void bodies() {
    const std::vector<Start>& all_starts = model_.starts;
    std::set<const Block*> used;
    for (auto& [number, part] : model_.parts) {
      faults_.guarded([&] {
        const Id id = number;
        if (part.block == nullptr) {
          throw InputError(std::vector<InputFault>{
              {.file = deck_.file.string(),
               .line = 1,
               .column = 1,
               .text = fmt::format("elements are of part {}, which the deck does not define", id)}});
        }
        if (part.solids.empty() && part.points.empty()) {
          remark(Outcome::missing, *part.block, fmt::format("{}: no solid or SPH elements", part.name));
          return;
        }
        const auto material = model_.materials.find(part.material);
        if (material == model_.materials.end())
          fail(*part.block, fmt::format("{}: there is no *MAT {}", part.name, part.material));
        const auto state = model_.states.find(part.state);
        if (part.state != 0 && state == model_.states.end())
          fail(*part.block, fmt::format("{}: there is no *EOS {}", part.name, part.state));
        used.insert(material->second);
        if (part.state != 0) used.insert(state->second);
        if (!has_law(*material->second) && part.state == 0) {
          remark(Outcome::missing, *material->second, fmt::format("{}: this material law", part.name));
          return;
        }
        body(id, part,
             material_of(deck_, *material->second, part.state != 0 ? state->second : nullptr, part.name,
                         units_, import_),
             all_starts);
      });
    }
    for (const Start& start : all_starts) {
      if (velocities_.insert(start.block).second)
        remark(Outcome::missing, *start.block, "velocities of some nodes of a part, or of none");
    }
    for (const auto* blocks : {&model_.materials, &model_.states}) {
      for (const auto& [number, block] : *blocks) {
        if (!used.contains(block))
          remark(Outcome::dropped, *block, fmt::format("number {} is of no part", number));
      }
    }
  }

  void detonators() {
    for (const Detonator& detonator : model_.detonators) {
      if (!has_explosive_) {
        remark(Outcome::dropped, *detonator.block, "no part is an explosive");
        continue;
      }
      TomlText text;
      text.table("[[detonation]]", fmt::format("line {}", detonator.block->line));
      text.entry("position", vector(detonator.position, dimension::length));
      if (detonator.delay > 0.0) text.entry("delay", units_.quantity(detonator.delay, dimension::time));
      bodies_ += "\n" + text.text();
      remark(Outcome::exact, *detonator.block, "point of detonation, of all explosives");
    }
  }

  const Vector3& place(const Part& part, Id node) const {
    const auto found = model_.nodes.find(node);
    if (found == model_.nodes.end())
      fail(*part.block, fmt::format("{}: there is no node {}", part.name, node));
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
    if (!part.solids.empty() && !part.points.empty())
      fail(*part.block, fmt::format("{}: solid and SPH elements in one part", part.name));
    TomlText text;
    text.table("[[body]]", fmt::format("line {}", part.block->line));
    text.text_entry("name", part.name);
    text.entry("material", toml_string(material.file));
    const Vector3 velocity = velocity_of(id, members, all_starts);
    if (velocity != Vector3::Zero()) text.entry("velocity", vector(velocity, dimension::velocity));
    fastest_ = std::max(fastest_, velocity.norm());
    has_explosive_ = has_explosive_ || material.explosive;
    if (material.explosive && model_.detonators.empty()) {
      text.entry("detonation", "\"instantaneous\"", "no *INITIAL_DETONATION in the deck");
      remark(Outcome::missing, *part.block,
             fmt::format("{} is lit by nothing: it starts as detonation products", part.name));
    }
    const bool written = part.solids.empty() ? points(part, material, text) : mesh(part, material, text);
    if (!written) return;
    if (material.initial_pressure != 0.0) {
      text.entry("initial", fmt::format("{{ density = {}, pressure = {} }}",
                                        units_.quantity(material.density, dimension::density),
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
      const bool whole = all || start.parts.contains(id) ||
                         (!start.nodes.empty() && std::ranges::includes(start.nodes, members));
      if (whole) {
        velocity = start.velocity;
        if (velocities_.insert(start.block).second)
          remark(Outcome::exact, *start.block, "velocity of whole parts");
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
          if (start.velocity == velocity && velocities_.insert(start.block).second)
            remark(Outcome::converted, *start.block, "velocity of whole parts, node by node");
        }
      } else {
        import_.remark(
            Outcome::missing, 0, "*INITIAL_VELOCITY",
            fmt::format("velocities of {} of the {} nodes of part {}", nodes.size(), members.size(), id));
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
        remark(Outcome::missing, *part.block,
               fmt::format("{}: elements that are no hexahedra, the first in line {}", part.name,
                           part.solids[i].line));
        return false;
      }
      elements += fmt::format("{} 5 2 1 1", i + 1);
      for (const Id node : n)
        elements += fmt::format(" {}", index.try_emplace(node, index.size() + 1).first->second);
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
    import_.files.push_back(
        {file, fmt::format(
                   "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"{}\"\n$EndPhysicalNames\n"
                   "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
                   part.name, order.size(), nodes, part.solids.size(), elements)});
    text.entry("discretization",
               fmt::format("{{ method = \"finite_elements\", mesh = \"{}\", mesh_unit = {} }}", file,
                           units_.quantity(1.0, dimension::length)));
    if (longest > 2.0 * cell_) {
      remark(Outcome::converted, *part.block,
             fmt::format("{}: elements of {} {} need cells of at least half of that", part.name,
                         number(longest), units_.length));
    }
    import_.bodies.push_back({part.name, fmt::format("{} hexahedra", part.solids.size()),
                              static_cast<double>(part.solids.size()), units_.in_si(mass, {.mass = 1})});
    return true;
  }

  /// SPH elements on a cubic lattice as boxes.
  bool points(const Part& part, const CaseMaterial& material, TomlText& text) {
    std::vector<Vector3> places;
    double least = 0.0, greatest = 0.0, total = 0.0;
    for (const SphPoint& point : part.points) {
      const double mass =
          point.mass < 0.0 ? -point.mass * material.density : point.mass;  // negative: its volume
      least = places.empty() ? mass : std::min(least, mass);
      greatest = std::max(greatest, mass);
      total += mass;
      places.push_back(place(part, point.node));
    }
    const double spacing = std::cbrt(greatest / material.density);
    const bool alike = least > 0.0 && greatest - least <= 1e-3 * greatest;
    const auto boxes = alike ? boxes_of_points(places, spacing, most_boxes_of_points) : std::nullopt;
    if (!boxes) {
      remark(Outcome::missing, *part.block,
             fmt::format("{}: {} points that fill no cubic lattice of equal particles", part.name,
                         places.size()));
      return false;
    }
    std::string list;
    for (const LatticeBox& box : *boxes) {
      list += fmt::format("{}{{ box = {{ lower = {}, upper = {} }} }}", list.empty() ? "" : ",\n  ",
                          vector(box.lower, dimension::length), vector(box.upper, dimension::length));
    }
    text.entry("shape", boxes->size() == 1 ? list : fmt::format("{{ union = [{}] }}", list));
    lower_ -= Vector3::Constant(0.5 * spacing);
    upper_ += Vector3::Constant(0.5 * spacing);
    import_.bodies.push_back({part.name,
                              fmt::format("SPH points of a cubic lattice, {} boxes", boxes->size()),
                              static_cast<double>(places.size()), units_.in_si(total, {.mass = 1})});
    return true;
  }

  /// The deck has no grid: room around all bodies for the way of the fastest one, at most twice their extent.
  std::string domain() {
    const double extent = (upper_ - lower_).maxCoeff();
    const double margin = std::min(fastest_ * model_.end, 2.0 * extent) + 4.0 * cell_;
    const Vector3 around = Vector3::Constant(cell_ * std::ceil(margin / cell_));
    TomlText text;
    text.table("[domain]",
               "not in the deck: room for the way of the fastest body, at most twice their extent");
    text.entry("lower", vector(lower_ - around, dimension::length));
    text.entry("upper", vector(upper_ + around, dimension::length));
    text.entry("cell_size", units_.quantity(cell_, dimension::length));
    import_.remark(
        Outcome::converted, 0, "-",
        fmt::format("domain: the bodies with {} {} around them", number(around[0]), units_.length));
    return text.text();
  }

  const Deck& deck_;
  const ImportOptions& options_;
  Import import_;
  UnitSystem units_;
  Model model_;
  std::string bodies_;
  TomlText head_, toml_;
  FaultList faults_;
  std::set<const Block*> velocities_;
  double cell_ = 0.0, fastest_ = 0.0;
  Vector3 lower_ = Vector3::Zero(), upper_ = Vector3::Zero();
  bool empty_ = true, has_explosive_ = false;
};

}  // namespace

Import to_case(const Deck& deck, const ImportOptions& options) { return CaseWriter(deck, options).write(); }

}  // namespace whipple::decks::dyna
