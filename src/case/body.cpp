// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <memory>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Body> Body::parameters() {
  return {
      text("name", &Body::name, "name of the body in output files"),
      text("material", &Body::material, "material file: a path, or a name in the library"),
      choice("equation_of_state", &Body::equation_of_state,
             "evaluation by the model | by a table of it, faster for expensive models")
          .optional(),
      real("table_error", &Body::table_error, "", range::between(1e-8, 0.05),
           "relative error of temperature and pressure of the table")
          .optional(),
      vector("velocity", &Body::velocity, "m/s", range::any(), "initial velocity").optional(),
      vector("angular_velocity", &Body::angular_velocity, "rad/s", range::any(),
             "initial rotation about the centre of the body's bounding box")
          .optional(),
      vector("expansion_rate", &Body::expansion_rate, "1/s", range::any(),
             "initial velocity along each axis per distance from that centre, as of a ring that coasts")
          .optional(),
      boolean("driven", &Body::driven,
              "an external force keeps the mean velocity of the body and holds it against turning: a grip, a "
              "punch, "
              "a die")
          .optional(),
      choice(
          "volumetric", &Body::volumetric,
          "pressure and volume rate act at every particle | as means over the particles of a cell, against "
          "locking of material that keeps its volume")
          .optional(),
      text("contact_group", &Body::contact_group,
           "bodies of one group share a velocity field and are bonded where they meet, those of different "
           "groups are not; empty: according to contact.method")
          .optional(),
      choice("detonation", &Body::ignition,
             "an explosive is lit by the detonators of the case | never reacts | is burnt from the start, at "
             "constant volume")
          .optional(),
      real("detonation_velocity", &Body::detonation_velocity, "m/s", range::positive(),
           "with which an explosive is lit, for instance a measured one")
          .optional("that of its Chapman-Jouguet state")};
}

std::span<const Section<Body>> Body::sections() {
  static const std::vector<Section<Body>> all = {
      section<&Body::discretization>("discretization"),
      section<&Body::conversion>("conversion", ", of adaptive bodies",
                                 [](const Body& body) { return body.discretization.converts(); }),
      section<&Body::element_range>("element_range", ", of bodies with elements",
                                    [](const Body& body) { return body.discretization.has_elements(); }),
      section<&Body::node_conditions>("node_condition", ", of bodies with elements"),
      section<&Body::path>("path", ", of tools: driven bodies, and bodies with node conditions"),
      section<&Body::bars>("bar", ", of bodies of bars"),
      section<&Body::initial>("initial", ", at most two of",
                              [](const Body& body) { return body.initial.given(); }),
      section<&Body::failure>("failure", "", [](const Body& body) { return body.failure.given(); }),
      section<&Body::failure_scatter>("failure_scatter", "",
                                      [](const Body& body) { return body.failure_scatter.given(); }),
      section<&Body::failure_grains>("failure_grains", "",
                                     [](const Body& body) { return body.failure_grains.given(); }),
      section<&Body::strength_scatter>("strength_scatter", "",
                                       [](const Body& body) { return body.strength_scatter.given(); }),
      section<&Body::viscosity>("artificial_viscosity", ", keys not given: those of [artificial_viscosity]")};
  return all;
}

double Body::failure_factor(std::uint64_t id, double volume, const Vector3& place,
                            const grid::Geometry& geometry) const {
  const double scattered = failure_scatter.given() ? failure_scatter.factor(id, volume) : 1.0;
  if (!failure_grains.given()) return scattered;
  return scattered * failure_grains.factor(place, geometry.cell_size, geometry.is_planar());
}

std::array<bool, 3> Body::guided_axes(const Case& setup) const {
  const grid::Geometry& geometry = setup.geometry;
  const Shape::Bounds box = shape->bounds();
  const double near = 0.01 * geometry.cell_size;
  std::array<bool, 3> guided{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<int>(a);
    const bool below = geometry.boundary[2 * a] == grid::Boundary::symmetry &&
                       box.lower[axis] <= geometry.lower[axis] + near;
    const bool above = geometry.boundary[2 * a + 1] == grid::Boundary::symmetry &&
                       box.upper[axis] >= geometry.upper(axis) - near;
    guided[a] = below || above;
  }
  // Axisymmetric bodies do not move in the circumferential direction, nor plane bodies normal to the plane.
  if (setup.domain.is_planar()) guided[2] = true;
  if (geometry.is_axisymmetric()) guided[1] = true;
  return guided;
}

void Body::read_rest(input::Table& table) {
  if (has_own_shape()) {
    shape = read_shape(table);
  } else if (table.has("shape")) {
    table.error_at("shape", discretization.is_bars()
                                ? "a body of bars has no 'shape': its bars are listed in [[body.bar]]"
                                : "a body has a 'shape' or a 'discretization.mesh', not both");
  }
}

std::string Body::rest_to_toml() const {
  return has_own_shape() ? fmt::format("shape = {}\n", shape->toml()) : std::string();
}

void Body::check(const Case& setup, const Faults& faults) const {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (name.empty()) faults.add("name", "'name' is empty: output files name the body by it");
  if (!std::ranges::all_of(name, allowed)) {
    faults.add("name", fmt::format("'name' is \"{}\": letters, digits, '_' and '-' only, it names columns of "
                                   "output",
                                   name));
  }
  const auto is_namesake = [&](const Body& other) { return other.name == name; };
  if (!name.empty() && &*std::ranges::find_if(setup.bodies, is_namesake) != this) {
    faults.add("name", fmt::format("two bodies are called \"{}\"", name));
  }
  if (has_own_shape()) {
    const std::string fault = shape == nullptr ? "is missing" : fault_of(*shape);
    if (!fault.empty()) faults.add("shape", "'shape' " + fault);
    const bool is_given = shape != nullptr && !shape->particles().empty();
    if (is_given && (discretization.partial_volumes || discretization.lattice != Arrangement::regular)) {
      faults.in("discretization")
          .add(discretization.partial_volumes ? "partial_volumes" : "lattice",
               "'points' are taken as they are, without a lattice: 'partial_volumes' and 'lattice' do not "
               "apply");
    }
  }
  if (driven && (discretization.has_elements() || discretization.is_bars())) {
    faults.add("driven", "only bodies of particles are 'driven'; nodes of elements have a node_condition");
  }
  if (driven && !(angular_velocity.isZero(0.0) && expansion_rate.isZero(0.0))) {
    faults.add("driven",
               "a 'driven' body moves with one velocity, without angular_velocity and expansion_rate");
  }
  if (driven && shape != nullptr) {
    const std::array<bool, 3> guided = guided_axes(setup);
    for (std::size_t a = 0; a < 3; ++a) {
      const bool of_section =
          setup.domain.is_planar() && (a == 2 || (a == 1 && setup.geometry.is_axisymmetric()));
      if (!guided[a] || of_section || velocity[static_cast<int>(a)] == 0.0) continue;
      faults.add("driven",
                 fmt::format("a 'driven' body that touches a symmetry plane normal to {0} is not moved along "
                             "{0}: expected a velocity of 0 there",
                             "xyz"[a]));
    }
  }
  failure_grains.check(setup, faults.in("failure_grains"));
  const std::shared_ptr<const Material>& own =
      setup.materials[static_cast<std::size_t>(this - setup.bodies.data())];
  if (strength_scatter.given() &&
      (discretization.is_bars() || (own != nullptr && !own->returns_radially()))) {
    faults.in("strength_scatter")
        .add("least",
             "only material that flows at a flow stress of its own can be weaker: not bars, nor brittle "
             "material, soil, foam, metal of Gurson, fluids, rubber or elastic material");
  }
  if (path && !driven && node_conditions.empty()) {
    faults.in("path").add("times",
                          "a path is that of prescribed velocities: the body needs 'driven = true' "
                          "(particles) or a [[body.node_condition]] (elements)");
  }
  if (path && discretization.converts()) {
    faults.in("path").add("times",
                          "a body on a path keeps its elements: expected method = "
                          "\"finite_elements\", not \"adaptive\"");
  }
  if (!discretization.has_elements()) {
    for (std::size_t i = 0; i < node_conditions.size(); ++i) {
      faults.in("node_condition").in(i).add("", "a body of particles has no nodes");
    }
  }
  if (parts_touch()) {
    const auto refuse = [&](const char* reason) { faults.in("element_range").add("pieces", reason); };
    if (discretization.method != Representation::finite_elements ||
        element_range.beyond != BeyondRange::remove) {
      refuse(
          "fields of pieces part finite elements at what deletion has taken away (beyond = \"remove\"): "
          "particles of the body connect its pieces");
    }
    if (setup.contact.method == ContactMethod::none ||
        setup.transfer.particle_update == ParticleUpdate::fmpm) {
      refuse(
          "pieces that touch each other need contact: another contact.method than \"none\", another "
          "transfer.particle_update than \"fmpm\"");
    }
  }
  if (volumetric == Volumetric::cell && !discretization.has_particles() && !discretization.converts()) {
    faults.add("volumetric", "means over the particles of a cell need particles, this body has none");
  }
  if (volumetric == Volumetric::cell && failure.cracks == CrackMotion::fields) {
    faults.add("volumetric", "\"cell\" does not part at cracks: not with failure.cracks = \"fields\"");
  }
  if (failure.cracks == CrackMotion::fields && !discretization.has_particles() &&
      !discretization.converts()) {
    faults.in("failure").add("cracks", "fields at cracks part particles, this body has none");
  }
  if (failure.cracks == CrackMotion::fields && setup.time.scheme != Scheme::symplectic) {
    faults.in("failure").add("cracks", "fields at cracks need time.scheme = \"symplectic\"");
  }
  if (failure.cracks == CrackMotion::fields && setup.transfer.particle_update == ParticleUpdate::fmpm) {
    faults.in("failure").add("cracks",
                             "fields at cracks need another transfer.particle_update than \"fmpm\"");
  }
  if (!discretization.is_bars()) {
    for (std::size_t i = 0; i < bars.size(); ++i) {
      faults.in("bar").in(i).add("", "bars belong to bodies with discretization.method = \"bars\"");
    }
    return;
  }
  if (bars.empty()) faults.add("", "a body of bars needs [[body.bar]]");
  for (std::size_t i = 0; !setup.domain.is_planar() && i < bars.size(); ++i) {
    if (bars[i].number != 1.0) {
      faults.in("bar").in(i).add("number", "'number' is that of a section: in three dimensions use 'count'");
    }
  }
  if (setup.contact.method == ContactMethod::multi_field && contact_group.empty()) {
    faults.add("contact_group",
               "bars have no surface of their own: 'contact_group' must be that of the body that they "
               "reinforce");
  }
}

}  // namespace whipple::cases
