// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/text.hpp"
#include "src/decks/dyna_lighting.hpp"
#include "src/decks/dyna_material.hpp"
#include "src/decks/dyna_mesh.hpp"
#include "src/decks/dyna_model.hpp"
#include "src/decks/lattice.hpp"
#include "src/decks/points.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::dyna {
namespace {

constexpr std::size_t most_boxes_of_points = 400, most_boxes_of_nodes = 400;

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
    plan();
    faults_.raise();
    constrain();
    join();
    std::string bodies;
    for (Body& body : bodies_) faults_.guarded([&] { bodies += "\n" + text_of(body); });
    velocities_left();
    bodies += "\n" + lighting(model_, explosives_, units_, import_) + gauges();
    faults_.raise();
    import_.case_text = fmt::format("{}\n{}\n{}{}", head_.text(), domain(), toml_.text(), bodies);
    import_.sort_remarks();
    return std::move(import_);
  }

 private:
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, place_of(block), "*" + block.keyword, std::move(text));
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
                model_.friction ? "" : "the deck has no *CONTACT that is read");
    if (model_.friction) toml_.entry("friction", number(*model_.friction));
    toml_.table("[output]");
    if (model_.snapshots > 0.0)
      toml_.entry("snapshot_every", units_.quantity(model_.snapshots, dimension::time));
  }

  /// Lists the discretisations of a part.
  enum class Method { elements, adaptive, particles, lattice };
  struct Body {
    Id id = 0;
    const Part* part = nullptr;
    CaseMaterial material;
    Method method = Method::elements;
    PartMesh mesh;      ///< of solids
    std::string shape;  ///< of points
    std::vector<Id> nodes;
    HeldPart held;
    std::string group;  ///< contact group; empty: a separate one
  };

  /// Reads materials and geometry of all parts.
  void plan() {
    std::set<const Block*> used;
    for (auto& [number, part] : model_.parts) {
      faults_.guarded([&] { plan(number, part, used); });
    }
    for (const auto* blocks : {&model_.materials, &model_.states}) {
      for (const auto& [number, block] : *blocks) {
        if (!used.contains(block))
          remark(Outcome::dropped, *block, fmt::format("number {} is of no part", number));
      }
    }
  }

  void plan(Id id, const Part& part, std::set<const Block*>& used) {
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
    if (!part.solids.empty() && !part.points.empty())
      fail(*part.block, fmt::format("{}: solid and SPH elements in one part", part.name));
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
    Body body;
    body.id = id;
    body.part = &part;
    body.material = material_of(deck_, *material->second, part.state != 0 ? state->second : nullptr,
                                part.name, units_, options_.triaxiality, import_);
    body.nodes = nodes_of(part);
    for (const Id node : body.nodes) {
      body.held.nodes.push_back(place_of(model_, part, node));
      const auto held = model_.held.find(node);
      body.held.held.push_back(held == model_.held.end() ? Directions{0} : held->second);
    }
    body.held.lower = body.held.upper = body.held.nodes.front();
    for (const Vector3& x : body.held.nodes) {
      body.held.lower = body.held.lower.cwiseMin(x);
      body.held.upper = body.held.upper.cwiseMax(x);
    }
    if (!(part.solids.empty() ? lattice(body) : solids(body))) return;
    lower_ = bodies_.empty() ? body.held.lower : Vector3(lower_.cwiseMin(body.held.lower));
    upper_ = bodies_.empty() ? body.held.upper : Vector3(upper_.cwiseMax(body.held.upper));
    if (body.material.explosive) {
      explosives_.push_back(
          {id, part.name, body.material.detonation_velocity, body.material.burn, body.held.nodes});
    }
    bodies_.push_back(std::move(body));
  }

  /// Converts solid elements: to elements; to elements that become particles where the material fails or flows; or to
  /// particles.
  bool solids(Body& body) {
    const Part& part = *body.part;
    body.mesh = mesh_of(model_, part);
    if (body.mesh.odd_line != 0) {
      remark(Outcome::missing, *part.block,
             fmt::format("{}: elements that are no hexahedra, the first in line {}", part.name,
                         body.mesh.odd_line));
      return false;
    }
    body.held.shortest_edge = body.mesh.shortest_edge;
    const auto section = model_.sections.find(part.section);
    const Id formulation = section == model_.sections.end() ? 1 : section->second.formulation;
    constexpr std::array eulerian = {5, 6, 7, 11, 12};
    constexpr std::array lagrangian = {-18, -2, -1, 0, 1, 2, 3, 4, 9, 10, 13, 14, 15, 16, 17, 18};
    const bool flows = std::ranges::find(eulerian, formulation) != eulerian.end();
    if (!flows && std::ranges::find(lagrangian, formulation) == lagrangian.end()) {
      remark(Outcome::missing, *section->second.block,
             fmt::format("{}: elements of the formulation ELFORM = {}", part.name, formulation));
    }
    if (flows || body.material.explosive) {
      body.method = Method::particles;
      remark(
          Outcome::converted, *part.block,
          fmt::format("{}: {} become particles that fill their mesh; 'whipple check' compares the masses",
                      part.name,
                      flows ? fmt::format("elements that material flows through (ELFORM = {})", formulation)
                            : "elements of an explosive"));
    } else if (body.material.fails || body.material.fluid) {
      body.method = Method::adaptive;
      remark(Outcome::converted, *part.block,
             fmt::format("{}: elements become particles where the material {}", part.name,
                         body.material.fails ? "fails" : "has flowed far"));
    }
    if (body.mesh.longest_edge > 2.0 * cell_) {
      remark(Outcome::converted, *part.block,
             fmt::format("{}: elements of {} {} need cells of at least half of that", part.name,
                         number(body.mesh.longest_edge), units_.length));
    }
    add_row(body, "hexahedra", part.solids.size(), body.mesh.volume * body.material.density);
    return true;
  }

  /// Converts SPH elements: to boxes on a cubic lattice, else to a file of particles.
  bool lattice(Body& body) {
    const Part& part = *body.part;
    body.method = Method::lattice;
    std::vector<Vector3> places;
    std::vector<double> masses;
    double least = 0.0, greatest = 0.0, total = 0.0, density = body.material.density;
    for (const SphPoint& point : part.points) {
      const double mass = point.mass < 0.0 ? -point.mass * density : point.mass;  // negative: volume
      least = places.empty() ? mass : std::min(least, mass);
      greatest = std::max(greatest, mass);
      total += mass;
      masses.push_back(mass);
      places.push_back(place_of(model_, part, point.node));
    }
    const double spacing = body.held.shortest_edge = std::cbrt(greatest / density);
    body.held.lower.array() -= 0.5 * spacing;
    body.held.upper.array() += 0.5 * spacing;
    if (least <= 0.0 || greatest - least > 1e-3 * greatest) return as_given(body, places, masses, total);
    const auto boxes = boxes_of_points(places, spacing, most_boxes_of_points);
    if (!boxes) return as_given(body, places, masses, total);
    std::string list;
    for (const LatticeBox& box : *boxes) {
      list += fmt::format("{}{{ box = {{ lower = {}, upper = {} }} }}", list.empty() ? "" : ",\n  ",
                          vector(box.lower, dimension::length), vector(box.upper, dimension::length));
    }
    body.shape = boxes->size() == 1 ? list : fmt::format("{{ union = [{}] }}", list);
    const std::string shape = fmt::format("SPH points of a cubic lattice, {} boxes", boxes->size());
    add_row(body, shape, places.size(), total);
    return true;
  }
  /// Converts points that fill no lattice. @returns whether they have masses
  bool as_given(Body& body, const std::vector<Vector3>& places, const std::vector<double>& masses,
                double total) {
    body.shape = shape_of_points(import_, body.part->name, units_, places, masses);
    const bool whole = !body.shape.empty();
    remark(whole ? Outcome::converted : Outcome::missing, *body.part->block,
           fmt::format("{}: {} points that fill no cubic lattice of equal particles{}", body.part->name,
                       places.size(), whole ? ": its particles, in a file" : ", some without mass"));
    add_row(body, "SPH points as given", places.size(), total);
    return whole;
  }
  void add_row(const Body& body, const std::string& shape, std::size_t count, double mass) {
    import_.bodies.push_back({body.part->name,
                              body.method == Method::lattice ? shape : fmt::format("{} {}", count, shape),
                              static_cast<double>(count), units_.in_si(mass, {.mass = 1})});
  }

  /// Converts constrained nodes: first symmetry planes of the domain, then nodal boundary conditions of elements.
  void constrain() {
    if (model_.held.empty()) return;
    std::vector<HeldPart> parts;
    for (const Body& body : bodies_) parts.push_back(body.held);
    mirrors_ = take_mirrors(parts, cell_);
    std::vector<std::string> became;
    bool lost = false;
    for (const Mirror& mirror : mirrors_)
      became.push_back(fmt::format("plane of symmetry {} = {}", "xyz"[mirror.axis], number(mirror.place)));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Body& body = bodies_[i];
      body.held.held = std::move(parts[i].held);
      const auto left = std::ranges::count_if(body.held.held, [](Directions each) { return each != 0; });
      if (left == 0) continue;
      const std::string& name = body.part->name;
      const bool elements = body.method == Method::elements || body.method == Method::adaptive;
      const auto boxes = elements ? boxes_of_held_nodes(body.held, most_boxes_of_nodes) : std::nullopt;
      if (!boxes) {
        remark(Outcome::missing, *model_.holders.front(),
               fmt::format("{}: {} nodes that are held {}", name, left,
                           elements ? "lie among others so that too many boxes are needed"
                                    : "belong to particles, which have none"));
        lost = true;
        continue;
      }
      conditions_[body.id] = *boxes;
      became.push_back(fmt::format("node conditions of {} ({} nodes{})", name, left,
                                   body.method == Method::adaptive ? ", until they are of particles" : ""));
    }
    if (became.empty() && lost) return;
    for (const Block* block : model_.holders) {
      remark(became.empty() ? Outcome::dropped : Outcome::converted, *block,
             became.empty() ? "held nodes are those of no body"
                            : fmt::format("held nodes: {}", fmt::join(became, "; ")));
    }
  }

  /// Bonds parts with common nodes: their bodies form one contact group.
  void join() {
    if (!model_.friction) return;  // all bodies share one field
    std::map<Id, std::size_t> owner;
    std::vector<std::size_t> leader(bodies_.size());
    const auto leader_of = [&](std::size_t body) {
      while (leader[body] != body) body = leader[body];
      return body;
    };
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      leader[b] = b;
      for (const Id node : bodies_[b].nodes) {
        const std::size_t first = owner.try_emplace(node, b).first->second;
        leader[leader_of(b)] = leader_of(first);
      }
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const std::size_t first = leader_of(b);
      if (first == b) continue;
      bodies_[b].group = bodies_[first].group = bodies_[first].part->name;
      remark(Outcome::converted, *bodies_[b].part->block,
             fmt::format("{} has nodes in common with {}: bonded by one contact_group", bodies_[b].part->name,
                         bodies_[first].part->name));
    }
  }

  std::string text_of(const Body& body) {
    const Part& part = *body.part;
    const CaseMaterial& material = body.material;
    TomlText text;
    text.table("[[body]]", fmt::format("line {}", part.block->line));
    text.text_entry("name", part.name);
    text.entry("material", toml_string(material.file));
    const Vector3 velocity = velocity_of(body.id, {body.nodes.begin(), body.nodes.end()}, model_.starts);
    if (velocity != Vector3::Zero()) text.entry("velocity", vector(velocity, dimension::velocity));
    fastest_ = std::max(fastest_, velocity.norm());
    if (!body.group.empty()) text.text_entry("contact_group", body.group);
    if (material.explosive && !is_lit(model_, explosives_)) {
      text.entry("detonation", "\"instantaneous\"", "no *INITIAL_DETONATION in the deck");
      remark(Outcome::missing, *part.block,
             fmt::format("{} is lit by nothing: it starts as detonation products", part.name));
    } else if (material.explosive && material.detonation_velocity > 0.0) {
      text.entry("detonation_velocity", units_.quantity(material.detonation_velocity, dimension::velocity));
    }
    if (body.method == Method::lattice) {
      text.entry("shape", body.shape);
    } else {
      constexpr std::array<const char*, 3> methods = {"finite_elements", "adaptive", "particles"};
      const std::string file = fmt::format("meshes/{}.msh", part.name);
      import_.files.push_back({file, body.mesh.text});
      text.entry("discretization", fmt::format("{{ method = \"{}\", mesh = \"{}\", mesh_unit = {} }}",
                                               methods[static_cast<std::size_t>(body.method)], file,
                                               units_.quantity(1.0, dimension::length)));
    }
    if (material.initial_pressure != 0.0) {
      text.entry("initial", fmt::format("{{ density = {}, pressure = {} }}",
                                        units_.quantity(material.initial_density, dimension::density),
                                        units_.quantity(material.initial_pressure, dimension::pressure)));
    }
    for (const NodeBox& box : conditions_[body.id]) {
      text.table("[[body.node_condition]]");
      text.entry("lower", vector(box.lower, dimension::length));
      text.entry("upper", vector(box.upper, dimension::length));
      std::vector<std::string> directions;
      for (int axis = 0; axis < 3; ++axis) {
        if ((box.directions & along(axis)) != 0) directions.push_back(fmt::format("\"{}\"", "xyz"[axis]));
      }
      text.entry("directions", fmt::format("[{}]", fmt::join(directions, ", ")));
    }
    return text.text();
  }

  void velocities_left() {
    for (const Start& start : model_.starts) {
      if (velocities_.insert(start.block).second)
        remark(Outcome::missing, *start.block, "velocities of some nodes of a part, or of none");
    }
  }

  /// Writes the nodes of *DATABASE_HISTORY_NODE as gauges.
  std::string gauges() {
    TomlText text;
    std::set<Id> given, of_bodies;
    for (const Body& body : bodies_) of_bodies.insert(body.nodes.begin(), body.nodes.end());
    for (const Id node : model_.histories) {
      if (!of_bodies.contains(node) || !given.insert(node).second) continue;
      text.table("[[gauge]]");
      text.text_entry("name", fmt::format("node_{}", node));
      text.entry("kind", "\"moving\"");
      text.entry("position", vector(model_.nodes.at(node), dimension::length));
    }
    if (model_.histories_block != nullptr) {
      remark(given.empty() ? Outcome::dropped : Outcome::converted, *model_.histories_block,
             given.empty()
                 ? std::string("nodes of no body")
                 : fmt::format("{} gauges that move with the material next to the nodes", given.size()));
    }
    return given.empty() ? std::string() : "\n" + text.text();
  }

  /// Returns the velocity of a part: of each node, the last one assigned counts. Nodes that differ from the part are
  /// reported as missing.
  Vector3 velocity_of(Id id, const std::set<Id>& members, const std::vector<Start>& all_starts) {
    Vector3 velocity = Vector3::Zero();
    std::map<Id, Vector3> of_node;  // assigned to single nodes after `velocity`
    for (const Start& start : all_starts) {
      const bool all = start.nodes.empty() && start.parts.empty();
      const bool whole = all || start.parts.contains(id) ||
                         (!start.nodes.empty() && std::ranges::includes(start.nodes, members));
      if (whole) {
        velocity = start.velocity;
        of_node.clear();
        if (velocities_.insert(start.block).second)
          remark(Outcome::exact, *start.block, "velocity of whole parts");
      } else {
        for (const Id node : start.nodes) {
          if (members.contains(node)) of_node[node] = start.velocity;
        }
      }
    }
    std::map<std::array<double, 3>, std::size_t> nodes_with;
    for (const auto& [node, v] : of_node) ++nodes_with[{v[0], v[1], v[2]}];
    for (const auto& [value, nodes] : nodes_with) {
      if (nodes == members.size()) {
        velocity = Vector3(value[0], value[1], value[2]);
        for (const Start& start : all_starts) {
          if (start.velocity == velocity && velocities_.insert(start.block).second)
            remark(Outcome::converted, *start.block, "velocity of whole parts, node by node");
        }
      } else {
        import_.remark(Outcome::missing, 0, "*INITIAL_VELOCITY",
                       fmt::format("velocities of {} of the {} nodes of part {}", nodes, members.size(), id));
      }
    }
    return velocity;
  }

  /// Sizes the domain, as the deck has no grid: the bodies plus the path of the fastest one, at most twice their
  /// extent.
  std::string domain() {
    const double extent = (upper_ - lower_).maxCoeff();
    const double margin = std::min(fastest_ * model_.end, 2.0 * extent) + 4.0 * cell_;
    const Vector3 around = Vector3::Constant(cell_ * std::ceil(margin / cell_));
    Vector3 lower = lower_ - around, upper = upper_ + around;
    std::vector<std::string> faces;
    for (const Mirror& mirror : mirrors_) {
      (mirror.at_upper ? upper : lower)[mirror.axis] = mirror.place;
      faces.push_back(
          fmt::format("{}_{} = \"symmetry\"", "xyz"[mirror.axis], mirror.at_upper ? "upper" : "lower"));
    }
    for (const Mirror& mirror : mirrors_) {  // whole cells up to an upper plane
      const int a = mirror.axis;
      if (mirror.at_upper) lower[a] = upper[a] - cell_ * std::ceil((upper[a] - lower[a]) / cell_ - 1e-6);
    }
    TomlText text;
    text.table("[domain]",
               "not in the deck: room for the way of the fastest body, at most twice their extent");
    text.entry("lower", vector(lower, dimension::length));
    text.entry("upper", vector(upper, dimension::length));
    text.entry("cell_size", units_.quantity(cell_, dimension::length));
    if (!faces.empty()) text.entry("boundary", fmt::format("{{ {} }}", fmt::join(faces, ", ")));
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
  TomlText head_, toml_;
  FaultList faults_;
  std::vector<Body> bodies_;
  std::vector<Explosive> explosives_;
  std::vector<Mirror> mirrors_;
  std::map<Id, std::vector<NodeBox>> conditions_;  ///< by part
  std::set<const Block*> velocities_;
  double cell_ = 0.0, fastest_ = 0.0;
  Vector3 lower_ = Vector3::Zero(), upper_ = Vector3::Zero();
};

}  // namespace

Import to_case(const Deck& deck, const ImportOptions& options) { return CaseWriter(deck, options).write(); }

}  // namespace whipple::decks::dyna
