// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "src/case/build/bars.hpp"
#include "src/case/build/lithostatic.hpp"
#include "src/case/build/patches.hpp"
#include "src/case/build/placement.hpp"
#include "src/case/shapes/mesh_shape.hpp"
#include "src/core/base/error.hpp"
#include "src/io/output_fields.hpp"
#include "src/material/material_file.hpp"

namespace whipple::cases {

ParameterTable<Case> Case::parameters() {
  return {text("title", &Case::title, "one line: what is simulated").optional()};
}

/// Lists the sections of a case file, one per line.
std::span<const Section<Case>> Case::sections() {
  static const std::vector<Section<Case>> all = {
      section<&Case::domain>("domain"),
      section<&Case::time>("time"),
      section<&Case::quasi_static>("quasi_static", ", of time.scheme = \"quasi_static\"",
                                   [](const Case& setup) { return !has_inertia(setup.time.scheme); }),
      section<&Case::transfer>("transfer"),
      section<&Case::splitting>("splitting"),
      section<&Case::viscosity>("artificial_viscosity"),
      section<&Case::dissipation>("dissipation"),
      section<&Case::heat>("heat"),
      section<&Case::contact>("contact"),
      section<&Case::gravity>("gravity"),
      section<&Case::damping>("damping", ", local: for states of rest"),
      section<&Case::burn>("burn", ", of explosives", [](const Case& setup) { return setup.has_burn(); }),
      section<&Case::output>("output"),
      section<&Case::bodies>("body"),
      section<&Case::loads>("load", ", adds up with the others"),
      section<&Case::detonations>("detonation"),
      section<&Case::gauges>("gauge"),
      section<&Case::tracers>("tracers"),
      section<&Case::force_gauges>("force_gauge", ", a force on a body or a face over time"),
      section<&Case::stops>("stop", ", ends the run before time.end")};
  return all;
}

bool Case::has_bars() const {
  return std::ranges::any_of(bodies, [](const Body& body) { return body.discretization.is_bars(); });
}

bool Case::has_burn() const {
  return std::ranges::any_of(materials,
                             [](const auto& material) { return material != nullptr && material->burns(); });
}

bool Case::holds(const Body& body, Vector3 point) const {
  if (geometry.is_planar()) point[2] = 1e-6 * geometry.cell_size;
  return body.shape->contains(point);
}

bool Case::may_hold(const Body& body, Vector3 point, double radius) const {
  if (geometry.is_planar()) point[2] = 1e-6 * geometry.cell_size;
  return body.shape->may_hold(point, radius);
}

bool Case::has_elements() const {
  return std::ranges::any_of(bodies, [](const Body& body) { return body.discretization.has_elements(); });
}

std::vector<Gauge> Case::all_gauges() const {
  std::vector<Gauge> all = gauges;
  for (const Tracers& line : tracers) {
    for (Gauge& gauge : line.gauges()) all.push_back(std::move(gauge));
  }
  return all;
}

namespace {

/// Sets keys that were not given to values that depend on other keys.
void fill_in(Case& setup) {
  if (setup.transfer.particle_update == ParticleUpdate::by_scheme) {
    setup.transfer.particle_update = default_update(setup.time.scheme);
  }
  if (setup.dissipation.losses == Losses::by_scheme) {
    setup.dissipation.losses = default_losses(setup.time.scheme);
  }
  setup.geometry = setup.domain.geometry();
  lay_into_section(setup.gauges, setup.tracers, setup.domain.dimension);
}

/// Creates the shapes of bodies defined by bars or by a mesh.
void make_shapes(Case& setup, const Faults& bodies) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    Body& body = setup.bodies[b];
    if (body.discretization.is_bars() && !body.bars.empty()) body.shape = shape_of_bars(body);
    if (body.has_own_shape() || body.discretization.is_bars() || body.shape != nullptr) continue;
    try {
      body.shape = shape_of_mesh(body.discretization);
    } catch (const InputError& error) {
      bodies.in(b).add("discretization", error.what());
    }
  }
}

/// Reads the missing materials; bodies with the same file share its material.
void read_materials(Case& setup, const Faults& bodies) {
  std::map<std::string, std::shared_ptr<const Material>> known;
  std::map<std::tuple<std::shared_ptr<const Material>, Ignition, double>, std::shared_ptr<const Material>>
      forms;
  setup.materials.resize(setup.bodies.size());
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const std::string& name = setup.bodies[b].material;
    std::shared_ptr<const Material>& material = setup.materials[b];
    try {
      if (material == nullptr && name.empty()) {
        bodies.in(b).add("material", "'material' is empty: expected a file, or a name in the library");
      } else if (material == nullptr) {
        std::shared_ptr<const Material>& of_file = known[name];
        if (of_file == nullptr) {
          auto read = std::make_shared<const Material>(read_material(name, setup.file.parent_path()));
          require_usable(*read);
          of_file = std::move(read);
        }
        material = of_file;
      }
    } catch (const InputError& error) {
      bodies.in(b).add("material", fmt::format("'body[{}].material':\n  {}", b, error.what()));
    }
    if (material == nullptr) continue;
    try {
      // Bodies of one material with the same burn settings share it.
      const auto form = std::tuple(material, setup.bodies[b].ignition, setup.bodies[b].detonation_velocity);
      std::shared_ptr<const Material>& of_form = forms[form];
      if (of_form == nullptr) of_form = ignited(setup, b, material);
      material = of_form;
    } catch (const InputError& error) {
      bodies.in(b).add("detonation", error.what());
    }
    try {
      static_cast<void>(setup.bodies[b].initial.of(*material));
    } catch (const InputError& error) {
      bodies.in(b).add("initial", error.what());
    }
  }
}

/// Gives particles of files the volumes that follow from the domain and the densities of their bodies.
void settle_particles(Case& setup, const Faults& bodies) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    Body& body = setup.bodies[b];
    if (body.shape == nullptr || body.shape->particles().empty() || setup.materials[b] == nullptr) continue;
    if (body.initial.lithostatic) {
      bodies.in(b).in("initial").add("lithostatic",
                                     "'points' have the masses or volumes of their file: the "
                                     "weight above them cannot set their density");
    }
    eos::State state;
    try {
      state = body.initial.of(*setup.materials[b]);
    } catch (const InputError&) {
      continue;  // reported with the material
    }
    try {
      Settling settling{body_density(*setup.materials[b], state), setup.geometry.is_planar(),
                        [&](const Vector3& x) { return setup.geometry.depth(x); }};
      if (auto shape = body.shape->settled(settling)) body.shape = std::move(shape);
    } catch (const InputError& error) {
      bodies.in(b).add("shape", error.what());
    }
  }
}

/// Adds faults for settings that are impossible in two dimensions.
void check_planar(const Case& setup, const Faults& faults) {
  const bool axisymmetric = setup.domain.dimension == grid::Dimension::axisymmetric;
  const auto lies_in_plane = [&](const Vector3& v) { return v[2] == 0.0 && !(axisymmetric && v[1] != 0.0); };
  const char* const expected = axisymmetric ? "along x, the axis" : "in the plane x, y";
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    const Faults of_body = faults.in("body").in(b);
    if (!lies_in_plane(body.velocity)) {
      of_body.add("velocity", fmt::format("'velocity' must be {}", expected));
    }
    const Vector3& spin = body.angular_velocity;
    if (spin[0] != 0.0 || spin[1] != 0.0 || (axisymmetric && spin[2] != 0.0)) {
      of_body.add("angular_velocity",
                  axisymmetric ? "nothing rotates in axisymmetry" : "rotation is about z");
    }
    if (!lies_in_plane(body.expansion_rate)) {
      of_body.add("expansion_rate", fmt::format("expansion is {}", expected));
    }
    for (std::size_t i = 0; i < body.bars.size(); ++i) {
      const BarRow& row = body.bars[i];
      if (row.from[2] != 0.0 || row.to[2] != 0.0 || row.step[2] != 0.0) {
        of_body.in("bar").in(i).add("from", "bars of a section are in its plane");
      }
    }
    if (body.discretization.has_elements() && body.discretization.element != fem::Quadrature::one_point) {
      of_body.add("discretization",
                  "the quadrilaterals of a section have one point: element = \"one_point\"");
    }
  }
  if (!lies_in_plane(setup.gravity.acceleration)) {
    faults.in("gravity").add("acceleration", fmt::format("'acceleration' must be {}", expected));
  }
}

/// Adds faults for bodies, and rims of rotating or expanding bodies, that are faster than light: wrong units.
void check_speeds(const Case& setup, const Faults& faults) {
  constexpr double light = 299792458.0;  // m/s
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    const Faults of_body = faults.in("body").in(b);
    if (body.velocity.norm() >= light) of_body.add("velocity", "'velocity' is beyond the speed of light");
    if (body.shape == nullptr) continue;
    const Shape::Bounds bounds = body.shape->bounds();
    const Vector3 half = 0.5 * (bounds.upper - bounds.lower);
    if (!half.allFinite()) continue;
    if (body.angular_velocity.norm() * half.norm() >= light)
      of_body.add("angular_velocity", "'angular_velocity' moves the rim beyond the speed of light");
    if (body.expansion_rate.cwiseProduct(half).norm() >= light)
      of_body.add("expansion_rate", "'expansion_rate' moves the rim beyond the speed of light");
  }
}

bool can_be_placed(const Case& setup) {
  return std::ranges::all_of(setup.geometry.cells, [](std::int32_t count) { return count > 0; }) &&
         std::ranges::all_of(setup.bodies, [](const Body& body) { return body.shape != nullptr; });
}

/// Completes a case as far as possible. @returns its faults
std::vector<InputFault> settle(Case& setup) {
  std::vector<InputFault> list;
  const Faults faults(list), bodies = faults.in("body");
  fill_in(setup);
  make_shapes(setup, bodies);
  setup.geometry.levels = levels_of(setup);
  read_materials(setup, bodies);
  const std::size_t of_files = list.size();
  settle_particles(setup, bodies);
  if (setup.bodies.empty()) faults.add("body", "no bodies: expected at least one [[body]]");
  input::check_content(setup, setup, faults);
  if (setup.domain.is_planar()) check_planar(setup, faults);
  check_speeds(setup, faults);
  check_explosives(setup, faults);
  check_load_steps(setup, faults);
  // Bodies can only be placed if all values are valid.
  if (list.size() > of_files || !can_be_placed(setup)) return list;
  setup.contact_fields = find_contact_fields(setup);
  choose_volumes(setup);
  for (const PlacementFault& fault : placement_faults(setup))
    bodies.in(fault.body).add("shape", fault.message);
  check_places_of_gauges(setup, faults);
  check_bodies_of_force_gauges(setup, faults);
  check_places_of_loads(setup, faults);
  check_lithostatic(setup, faults);
  check_load_step_fields(setup, faults);
  check_two_levels(setup, faults);
  return list;
}

/// Reads the keys that determine how vectors are read.
Domain peek_dimension(input::Table& root) {
  Domain domain;
  auto table = root.optional_table("domain");
  if (!table) return domain;
  ParameterTable<Domain> keys = Domain::parameters();
  keys.remove_if([](const ParameterInfo& info) { return info.name != "dimension" && info.name != "axis"; });
  if (!table->read(keys, domain)) return {};
  return domain;
}

/// Reads the size of the cells before the shapes, which may be resolved to it; infinite if it is missing or invalid,
/// which is reported with the section.
double peek_cell_size(input::Table& root) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  auto table = root.optional_table("domain");
  if (!table || !table->has("cell_size")) return unknown;
  Domain domain;
  ParameterTable<Domain> keys = Domain::parameters();
  keys.remove_if([](const ParameterInfo& info) { return info.name != "cell_size"; });
  return table->read(keys, domain) ? domain.cell_size : unknown;
}

Case read(input::Document document, const std::vector<std::pair<std::string, std::string>>& overrides) {
  for (const auto& [key, value] : overrides) document.set(key, value);
  Case setup;
  setup.file = document.path();
  input::Table root = document.root();
  root.accept("provenance");
  const Domain section = peek_dimension(root);
  if (section.is_planar()) document.set_section(static_cast<int>(index_of(section.axis)));
  document.set_resolution(peek_cell_size(root));
  input::read_content(setup, setup, root);
  if (section.is_planar()) {
    setup.domain.boundary =
        setup.domain.boundary.in_section(static_cast<std::size_t>(index_of(section.axis)));
    const auto turn = [&](Face& face) {
      if (face == Face::none) return;
      face =
          static_cast<Face>((static_cast<int>(face) + 6 - 2 * static_cast<int>(index_of(section.axis))) % 6);
    };
    for (AppliedLoad& load : setup.loads) turn(load.face);
    for (ForceGauge& gauge : setup.force_gauges) turn(gauge.face);
    setup.domain.axis = Axis::x;
  }
  document.add(settle(setup));
  document.finish();
  return setup;
}

}  // namespace

std::vector<InputFault> check(const Case& setup) {
  Case copy = setup;
  return settle(copy);
}

Case complete(Case setup) {
  std::vector<InputFault> faults = settle(setup);
  if (!faults.empty()) throw InputError(std::move(faults));
  return setup;
}

Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides) {
  return read(input::Document::from_file(path), overrides);
}

Case read_case_text(const std::string& text, const std::string& name) {
  return read(input::Document::from_text(text, name), {});
}

Case read_written_case(const std::filesystem::path& path) {
  input::Document document = input::Document::from_file(path);
  Case setup;
  setup.file = document.path();
  input::Table root = document.root();
  input::read_content(setup, setup, root);
  document.finish_partly_read();
  const grid::Geometry geometry = setup.domain.geometry();
  for (Body& body : setup.bodies) {
    if (body.shape == nullptr || body.shape->particles().empty()) continue;
    auto shape = body.shape->settled(
        {.is_planar = geometry.is_planar(), .depth = [&](const Vector3& x) { return geometry.depth(x); }});
    if (shape) body.shape = std::move(shape);
  }
  return setup;
}

std::string to_toml(const Case& setup, const std::vector<std::string>& material_of_body) {
  Case copy = setup;
  for (std::size_t b = 0; b < copy.bodies.size(); ++b) copy.bodies[b].material = material_of_body[b];
  return input::write_content(copy, "");
}

std::string describe_case() {
  std::string text = "Case file (TOML). Quantities are texts with a unit, \"6.58 km/s\".\n\n";
  text += input::describe_content<Case>("");
  for (const ShapeEntry& entry : shape_catalogue()) {
    text +=
        fmt::format("\nshape = {{ {} = {{ ... }} }}: {}\n{}", entry.name, entry.summary, entry.describe());
  }
  text += "\nQuantities for output.fields\n" + io::describe_output_fields();
  return text;
}

}  // namespace whipple::cases
