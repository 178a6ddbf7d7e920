// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/case/build/seeding.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/io/output_fields.hpp"

namespace whipple::cases {

ParameterTable<Domain> Domain::parameters() {
  return {vector("lower", &Domain::lower, "m", range::any(), "lower corner of the domain"),
          vector("upper", &Domain::upper, "m", range::any(),
                 "upper corner; moved outwards to whole cells at outflow faces"),
          real("cell_size", &Domain::cell_size, "m", range::positive(),
               "edge of the cells of the background grid")};
}

ParameterTable<Domain> Domain::boundary_parameters() {
  const auto face = [](const char* name, std::string Domain::*member) {
    return choice(name, member, {"outflow", "symmetry", "no_slip", "separating"},
                  "matter leaves and is counted | frictionless mirror plane | wall that matter sticks to | "
                  "frictionless wall that pushes but does not hold")
        .optional();
  };
  return {face("x_lower", &Domain::x_lower), face("x_upper", &Domain::x_upper),
          face("y_lower", &Domain::y_lower), face("y_upper", &Domain::y_upper),
          face("z_lower", &Domain::z_lower), face("z_upper", &Domain::z_upper)};
}

ParameterTable<TimeControl> TimeControl::parameters() {
  return {
      real("end", &TimeControl::end, "s", range::positive(), "time at which the run ends"),
      real("courant", &TimeControl::courant, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step as a share of cell_size / (sound speed + particle speed)")
          .optional(),
      real("first_step", &TimeControl::first_step, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "first time step of a run as a share of the stable one, which it then grows to")
          .optional(),
      real("maximum_growth", &TimeControl::maximum_growth, "", {.lower = 1.0, .lower_open = true},
           "largest ratio of a time step to the one before")
          .optional(),
      real("acceleration_limit", &TimeControl::acceleration_limit, "", range::positive(),
           "largest acceleration * dt^2 as a share of the cell size")
          .optional(),
      real("compression_limit", &TimeControl::compression_limit, "", range::positive(),
           "largest share of its volume that matter under pressure may lose in a step")
          .optional(),
      real("element_safety", &TimeControl::element_safety, "",
           {.lower = 0.0, .upper = 1.0, .lower_open = true},
           "time step of finite elements as a share of their bound of stability")
          .optional(),
      choice("scheme", &TimeControl::scheme, {"symplectic", "musl", "usl", "usf"},
             "symplectic: exact energy (default); for comparison with other codes: modified update stress "
             "last, update stress last, update stress first")
          .optional(),
      choice(
          "stress_rotation", &TimeControl::stress_rotation, {"hughes_winget", "polar"},
          "how stresses turn with the matter: with the middle of the step, or by the exact rotation of the "
          "step")
          .optional()};
}

ParameterTable<TransferControl> TransferControl::parameters() {
  return {
      choice("shape_function", &TransferControl::shape_function,
             {"quadratic_bspline", "cubic_bspline", "convected_gimp", "gimp", "linear"},
             "functions that carry fields between particles and nodes")
          .optional(),
      choice("particle_update", &TransferControl::particle_update,
             {"relaxed_affine", "apic", "flip", "pic", "blend", "fmpm"},
             "velocity transfer to the particles; schemes other than symplectic take flip by default")
          .optional(),
      real("kappa", &TransferControl::kappa, "", range::non_negative(),
           "relaxation of the affine field: beta = 1 - exp(-kappa c dt / dx)")
          .optional(),
      choice(
          "affine_field", &TransferControl::affine_field, {"deformed", "turned"},
          "carried on with the deformation of the step: for clouds; or with its rotation only: for rotating "
          "and vibrating bodies")
          .optional(),
      real("flip_fraction", &TransferControl::flip_fraction, "", range::between(0.0, 1.0),
           "share of FLIP in particle_update \"blend\", the rest is PIC")
          .optional(),
      integer("fmpm_order", &TransferControl::fmpm_order, range::between(1, 20),
              "k of particle_update \"fmpm\": terms of the inverse of the full mass matrix")
          .optional(),
      boolean("random_shift", &TransferControl::random_shift,
              "shift the grid by a random part of a cell in every step, along axes without walls")
          .optional(),
      integer("random_seed", &TransferControl::random_seed, range::between(0, 1e9), "of random_shift")
          .optional(),
      boolean("free_flight", &TransferControl::free_flight,
              "failed particles without stress and neighbours fly on without the grid")
          .optional(),
      real("rest_tolerance", &TransferControl::rest_tolerance, "", range::between(0.0, 1e-6),
           "blocks of matter slower than this share of its sound speed c, and stressed less than this share "
           "of "
           "rho c^2, are left as they are until a wave reaches them; 0: never")
          .optional()};
}

ParameterTable<Splitting> Splitting::parameters() {
  return {
      real("length", &Splitting::length, "", range::between(0.0, 2.0),
           "length in cells of an intact particle along its longest direction beyond which it is divided in "
           "two; 0: never, 1 to 1.2 keeps stretched matter together")
          .optional(),
      integer("maximum_generations", &Splitting::maximum_generations, range::between(0, 20),
              "divisions that a particle and its parts may undergo")
          .optional()};
}

ParameterTable<OutputControl> OutputControl::parameters() {
  return {real("snapshot_every", &OutputControl::snapshot_every, "s", range::non_negative(),
               "simulated time between snapshots for ParaView; 0: first and last only")
              .optional(),
          real("checkpoint_every", &OutputControl::checkpoint_every, "s", range::non_negative(),
               "wall-clock time between checkpoints; 0: at the end and on signals only")
              .optional(),
          integer("history_every", &OutputControl::history_every, range::between(1, 1e9),
                  "steps between rows of history.csv")
              .optional(),
          integer("gauges_every", &OutputControl::gauges_every, range::between(1, 1e9),
                  "steps between rows of gauges.csv")
              .optional(),
          real("maximum_energy_error", &OutputControl::maximum_energy_error, "", range::positive(),
               "the run stops when the relative error of the total energy exceeds this")
              .optional(),
          text_list("fields", &OutputControl::fields, io::output_field_names(), "quantities in the snapshots")
              .optional()};
}

std::vector<std::string> OutputControl::default_fields() { return io::default_output_fields(); }

ParameterTable<HeatControl> HeatControl::parameters() {
  return {boolean("conduction", &HeatControl::conduction,
                  "heat flows between particles by the conductivities of their materials ([thermal])")
              .optional()};
}

ParameterTable<Gravity> Gravity::parameters() {
  return {vector("acceleration", &Gravity::acceleration, "m/s^2", range::any(), "of all matter").optional(),
          real("rise_time", &Gravity::rise_time, "s", range::non_negative(),
               "time over which it grows from 0, so that bodies at rest do not begin to vibrate")
              .optional()};
}

ParameterTable<Case> Case::parameters() {
  return {text("title", &Case::title, "one line that says what is simulated").optional()};
}

namespace {

grid::Boundary boundary_kind(const std::string& word) {
  return word == "symmetry"     ? grid::Boundary::symmetry
         : word == "no_slip"    ? grid::Boundary::no_slip
         : word == "separating" ? grid::Boundary::separating
                                : grid::Boundary::outflow;
}

std::array<std::string, 6> faces(const Domain& domain) {
  return {domain.x_lower, domain.x_upper, domain.y_lower, domain.y_upper, domain.z_lower, domain.z_upper};
}

/// Whole cells; a wall must lie on a face of a cell, an outflow face is moved outwards.
void make_geometry(Case& setup, input::Table& domain) {
  const Domain& d = setup.domain;
  if (!(d.cell_size > 0.0)) return;  // reported by the reader
  grid::Geometry& g = setup.geometry;
  g.lower = d.lower;
  g.cell_size = d.cell_size;
  const std::array<std::string, 6> boundary = faces(d);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    g.boundary[2 * a] = boundary_kind(boundary[2 * a]);
    g.boundary[2 * a + 1] = boundary_kind(boundary[2 * a + 1]);
    const double exact = (d.upper[axis] - d.lower[axis]) / d.cell_size;
    if (!(exact > 0.0) || exact > 1e6) {
      domain.error_at("upper",
                      fmt::format("the domain has {} cells along {}; expected 1 to 1e6", exact, "xyz"[a]));
      continue;
    }
    const double nearest = std::round(exact);
    const bool whole = std::abs(exact - nearest) < 1e-6 * std::max(nearest, 1.0);
    if (!whole && g.boundary[2 * a + 1] != grid::Boundary::outflow) {
      domain.error_at(
          "upper", fmt::format("{}_upper is a {} face, so the domain must hold a whole number of cells "
                               "along {}: {} m holds {:.6g} cells of {} m",
                               "xyz"[a], boundary[2 * a + 1], "xyz"[a], d.upper[axis] - d.lower[axis], exact,
                               d.cell_size));
    }
    g.cells[a] = static_cast<std::int32_t>(whole ? nearest : std::ceil(exact));
  }
}

/// What the schemes, particle updates and shape functions can do together (docs/theory/mpm.md, section 5).
void check_transfer(Case& setup, input::Table* transfer) {
  const std::string& scheme = setup.time.scheme;
  TransferControl& control = setup.transfer;
  const bool exact = scheme == "symplectic";
  const auto given = [&](const char* key) { return transfer != nullptr && transfer->has(key); };
  if (!exact && !given("particle_update")) control.particle_update = "flip";
  const std::string& update = control.particle_update;
  const bool affine = update == "relaxed_affine" || update == "apic";
  if (transfer == nullptr) return;
  if (!exact && affine) {
    transfer->error_at("particle_update",
                       fmt::format("scheme \"{}\" carries no affine field: it works with particle_update = "
                                   "\"flip\", \"pic\", \"blend\" or \"fmpm\"; \"{}\" needs \"symplectic\"",
                                   scheme, update));
  }
  if (exact && update == "fmpm") {
    transfer->error_at("particle_update",
                       "particle_update = \"fmpm\" has no exact energy balance, which scheme \"symplectic\" "
                       "keeps: it works with scheme = \"usl\", \"musl\" or \"usf\"");
  }
  const bool bspline =
      control.shape_function == "quadratic_bspline" || control.shape_function == "cubic_bspline";
  if (exact && affine && !bspline) {
    transfer->error_at(
        "shape_function",
        fmt::format("particle_update = \"{}\" needs functions whose second moment is the same everywhere: "
                    "shape_function = \"quadratic_bspline\" or \"cubic_bspline\"; \"{}\" works with "
                    "\"flip\", \"pic\", \"blend\" (and \"fmpm\" in schemes other than symplectic)",
                    update, control.shape_function));
  }
}

/// What conduction of heat needs of the transfer and of the materials.
void check_conduction(const Case& setup, input::Table& heat) {
  if (!setup.heat.conduction) return;
  if (setup.transfer.shape_function == "linear") {
    heat.error_at("conduction",
                  "'conduction' needs smooth shape functions; transfer.shape_function is \"linear\"");
  }
  bool conducts = false;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material* material = setup.materials[b].get();
    if (material == nullptr || !(material->conductivity > 0.0)) continue;
    conducts = true;
    if (!(material->reference.heat_capacity > 0.0)) {
      heat.error_at("conduction", fmt::format("'conduction': the equation of state of body \"{}\" has no "
                                              "temperature",
                                              setup.bodies[b].name));
    }
  }
  if (!conducts) {
    heat.error_at("conduction", "'conduction' is on, but no material has a conductivity ([thermal])");
  }
}

/// Only the work identity of the symplectic scheme says what the transfers lose.
void check_dissipation(Case& setup, input::Table& root) {
  if (setup.time.scheme == "symplectic") return;
  if (auto table = root.optional_table("dissipation");
      table && table->has("losses") && setup.dissipation.keeps_losses()) {
    table->error_at("losses",
                    fmt::format("losses = \"unresolved\" needs scheme = \"symplectic\": \"{}\" does not know "
                                "what its transfers lose",
                                setup.time.scheme));
  }
  setup.dissipation.losses = "heat";
}

void check_combinations(Case& setup, input::Table& root) {
  check_dissipation(setup, root);
  auto transfer = root.optional_table("transfer");
  check_transfer(setup, transfer ? &*transfer : nullptr);
  const bool separating = std::ranges::count(faces(setup.domain), "separating") > 0;
  if (separating && setup.time.scheme == "usf") {
    if (auto domain = root.optional_table("domain")) {
      domain->error_at("boundary",
                       "a separating wall is found to be in contact by the forces on the grid, which scheme "
                       "\"usf\" does not know yet where it needs them: take \"symplectic\", \"musl\" or "
                       "\"usl\"");
    }
  }
}

/// A length below that of the particles would divide all of them, as often as generations allow.
void check_splitting(const Case& setup, input::Table& splitting) {
  for (const Body& body : setup.bodies) {
    const double own = std::cbrt(1.0 / static_cast<double>(body.discretization.per_cell));
    if (setup.splitting.length == 0.0 || setup.splitting.length >= own ||
        body.discretization.method != "particles") {
      continue;
    }
    splitting.error_at("length",
                       fmt::format("'length' is {}, and the particles of body \"{}\" are {:.3g} cells long "
                                   "from the start: expected at least that, or 0 (never)",
                                   setup.splitting.length, body.name, own));
    return;
  }
}

void check_gravity(const Case& setup, input::Table& gravity) {
  if (!setup.gravity.acceleration.isZero(0.0) && setup.transfer.free_flight) {
    gravity.error_at("acceleration", "'acceleration': particles of transfer.free_flight would not fall");
  }
}

Case read(input::Document document, const std::vector<std::pair<std::string, std::string>>& overrides) {
  for (const auto& [key, value] : overrides) document.set(key, value);
  Case setup;
  setup.file = document.path();
  input::Table root = document.root();
  root.read(Case::parameters(), setup);
  root.accept("provenance");
  std::optional<input::Table> domain = root.required_table("domain");
  if (domain) {
    domain->read(Domain::parameters(), setup.domain);
    if (auto boundary = domain->optional_table("boundary")) {
      boundary->read(Domain::boundary_parameters(), setup.domain);
    }
    make_geometry(setup, *domain);
  }
  if (auto table = root.required_table("time")) table->read(TimeControl::parameters(), setup.time);
  if (auto table = root.optional_table("transfer"))
    table->read(TransferControl::parameters(), setup.transfer);
  auto splitting = root.optional_table("splitting");
  if (splitting) splitting->read(Splitting::parameters(), setup.splitting);
  if (auto table = root.optional_table("artificial_viscosity")) {
    table->read(ArtificialViscosity::parameters(), setup.viscosity);
  }
  if (auto table = root.optional_table("dissipation"))
    table->read(Dissipation::parameters(), setup.dissipation);
  if (auto table = root.optional_table("output")) table->read(OutputControl::parameters(), setup.output);
  auto heat = root.optional_table("heat");
  if (heat) heat->read(HeatControl::parameters(), setup.heat);
  auto contact = root.optional_table("contact");
  if (contact) contact->read(ContactControl::parameters(), setup.contact);
  auto gravity = root.optional_table("gravity");
  if (gravity) gravity->read(Gravity::parameters(), setup.gravity);
  check_combinations(setup, root);
  if (gravity) check_gravity(setup, *gravity);

  std::vector<input::Table> bodies = root.list("body");
  if (bodies.empty()) root.error("no bodies: expected at least one [[body]]");
  read_bodies(setup, bodies);
  const bool complete =
      domain && std::ranges::all_of(setup.bodies, [](const Body& b) { return b.shape != nullptr; });
  if (complete && setup.geometry.cells[0] > 0 && setup.geometry.cells[1] > 0 && setup.geometry.cells[2] > 0) {
    setup.contact_fields = find_contact_fields(setup);
    choose_volumes(setup);
    for (const PlacementFault& fault : placement_faults(setup))
      bodies[fault.body].error_at("shape", fault.message);
  }
  if (splitting) check_splitting(setup, *splitting);
  if (heat) check_conduction(setup, *heat);
  if (contact && !setup.bodies.empty()) check_contact(setup, *contact);
  setup.gauges = read_gauges(root);
  if (complete) {
    check_gauges(setup.gauges, root, setup.geometry, [&](const Vector3& point) {
      return std::ranges::any_of(setup.bodies, [&](const Body& b) {
        return !b.discretization.is_bars() && b.shape->contains(point);
      });
    });
  }
  document.finish();
  return setup;
}

template <class Owner>
std::string section(const char* name, const ParameterTable<Owner>& table, Owner owner) {
  return fmt::format("\n[{}]\n{}", name, whipple::to_toml(whipple::bind(table, owner)));
}

}  // namespace

bool Case::has_bars() const {
  return std::ranges::any_of(bodies, [](const Body& body) { return body.discretization.is_bars(); });
}

bool Case::has_elements() const {
  return std::ranges::any_of(bodies, [](const Body& body) { return body.discretization.has_elements(); });
}

Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides) {
  return read(input::Document::from_file(path), overrides);
}

Case read_case_text(const std::string& text, const std::string& name) {
  return read(input::Document::from_text(text, name), {});
}

std::string to_toml(const Case& setup, const std::vector<std::string>& material_of_body) {
  std::string text = fmt::format("title = {}\n", toml_string(setup.title));
  text += section("domain", Domain::parameters(), setup.domain);
  text += section("domain.boundary", Domain::boundary_parameters(), setup.domain);
  text += section("time", TimeControl::parameters(), setup.time);
  text += section("transfer", TransferControl::parameters(), setup.transfer);
  text += section("splitting", Splitting::parameters(), setup.splitting);
  text += section("artificial_viscosity", ArtificialViscosity::parameters(), setup.viscosity);
  text += section("dissipation", Dissipation::parameters(), setup.dissipation);
  text += section("heat", HeatControl::parameters(), setup.heat);
  text += section("contact", ContactControl::parameters(), setup.contact);
  text += section("gravity", Gravity::parameters(), setup.gravity);
  text += section("output", OutputControl::parameters(), setup.output);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    text += body_to_toml(setup.bodies[b], material_of_body[b]);
  }
  return text + setup.gauges.toml();
}

std::string describe_case() {
  std::string text =
      "Case file (TOML). Quantities are texts with a unit, \"6.58 km/s\".\n\n";
  text += describe_table(Case::parameters());
  text += "\n[domain]\n" + describe_table(Domain::parameters());
  text += "\n[domain.boundary], or boundary = { x_lower = \"symmetry\", ... }\n" +
          describe_table(Domain::boundary_parameters());
  text += "\n[time]\n" + describe_table(TimeControl::parameters());
  text += "\n[transfer]\n" + describe_table(TransferControl::parameters());
  text += "\n[splitting]\n" + describe_table(Splitting::parameters());
  text += "\n[artificial_viscosity]\n" + describe_table(ArtificialViscosity::parameters());
  text += "\n[dissipation]\n" + describe_table(Dissipation::parameters());
  text += "\n[heat]\n" + describe_table(HeatControl::parameters());
  text += "\n[contact]\n" + describe_table(ContactControl::parameters());
  text += "\n[gravity]\n" + describe_table(Gravity::parameters());
  text += "\n[output]\n" + describe_table(OutputControl::parameters());
  text += describe_body();
  text += "\n[[gauge]]\n" + describe_table(Gauge::parameters());
  text += "\n[[tracers]]\n" + describe_table(Tracers::parameters());
  for (const ShapeEntry& entry : shape_catalogue()) {
    text +=
        fmt::format("\nshape = {{ {} = {{ ... }} }}: {}\n{}", entry.name, entry.summary, entry.describe());
  }
  text += "\nQuantities for output.fields\n" + io::describe_output_fields();
  return text;
}

}  // namespace whipple::cases
