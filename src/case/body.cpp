// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "src/case/build/bars.hpp"
#include "src/case/case.hpp"
#include "src/case/shapes/mesh_shape.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"

namespace whipple::cases {

ParameterTable<Body> Body::parameters() {
  return {text("name", &Body::name, "name of the body in output files"),
          text("material", &Body::material, "material file: a path, or a name in the library"),
          choice("equation_of_state", &Body::equation_of_state, {"model", "table"},
                 "how it is evaluated: by the model itself, or by a table of it, faster for costly models")
              .optional(),
          real("table_error", &Body::table_error, "", range::between(1e-8, 0.05),
               "of the table: relative error of temperature and pressure")
              .optional(),
          vector("velocity", &Body::velocity, "m/s", range::any(), "initial velocity").optional(),
          vector("angular_velocity", &Body::angular_velocity, "rad/s", range::any(),
                 "initial rotation about the centre of the body's bounding box")
              .optional(),
          text("contact_group", &Body::contact_group,
               "bodies of one group share a velocity field and are bonded where they meet, those of "
               "different groups "
               "never; empty: contact.method decides")
              .optional()};
}

namespace {

void read_body(Case& setup, input::Table table, std::set<std::string>& names,
               std::map<std::string, std::shared_ptr<const Material>>& materials) {
  Body body;
  table.read(Body::parameters(), body);
  if (!std::ranges::all_of(body.name,
                           [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; })) {
    table.error_at(
        "name", fmt::format("'name' is \"{}\": letters, digits, '_' and '-' only, it names columns of output",
                            body.name));
  }
  if (body.name.empty() && table.has("name")) {
    table.error_at("name", "'name' is empty: output files name the body by it");
  }
  if (!body.name.empty() && !names.insert(body.name).second) {
    table.error_at("name", fmt::format("two bodies are called \"{}\"", body.name));
  }
  if (auto discretization = table.optional_table("discretization")) {
    discretization->read(Discretization::parameters(), body.discretization);
    body.discretization.partial_volumes_given = discretization->has("partial_volumes");
    const double edge = std::cbrt(static_cast<double>(body.discretization.per_cell));
    if (std::abs(edge - std::round(edge)) > 1e-9) {
      discretization->error_at("per_cell", fmt::format("'per_cell' is {}, expected a cube: 1, 8, 27, 64",
                                                       body.discretization.per_cell));
    }
    check_elements(setup, body.discretization, *discretization);
  }
  if (auto conversion = table.optional_table("conversion")) {
    conversion->read(Conversion::parameters(), body.conversion);
  }
  for (input::Table& condition : table.list("node_condition")) {
    condition.read(NodeCondition::parameters(), body.node_conditions.emplace_back());
    if (!body.discretization.has_elements()) condition.error("a body of particles has no nodes");
  }
  for (input::Table& row : table.list("bar")) {
    row.read(BarRow::parameters(), body.bars.emplace_back());
    if (!body.discretization.is_bars()) {
      row.error("bars belong to bodies with discretization.method = \"bars\"");
    }
  }
  if (body.discretization.is_bars() && setup.contact.method == "multi_field" && body.contact_group.empty()) {
    table.error_at(
        "contact_group",
        "bars have no surface of their own: 'contact_group' must be that of the body that they reinforce");
  }
  auto initial = table.optional_table("initial");
  if (initial) initial->read(InitialState::parameters(), body.initial);
  if (auto scatter = table.optional_table("failure_scatter")) {
    scatter->read(FailureScatter::parameters(), body.failure_scatter);
  }
  if (auto viscosity = table.optional_table("artificial_viscosity")) {
    body.viscosity = setup.viscosity;
    viscosity->read(ArtificialViscosity::parameters(), *body.viscosity);
  }
  body.shape = body.discretization.is_bars()      ? read_bar_shape(body, table)
               : body.discretization.mesh.empty() ? read_shape(table)
                                                  : read_mesh_shape(body.discretization, table);
  std::shared_ptr<const Material> material;
  if (!body.material.empty()) {
    auto& known = materials[body.material];
    if (!known) {
      try {
        known = std::make_shared<const Material>(read_material(body.material, table.folder()));
        require_usable(*known);
      } catch (const InputError& error) {
        table.error_at("material", fmt::format("'{}.material':\n  {}", table.name(), error.what()));
      }
    }
    material = known;
  } else if (table.has("material")) {
    table.error_at("material", "'material' is empty: expected a file, or a name in the library");
  }
  if (initial && material) {
    try {
      static_cast<void>(body.initial.of(*material));
    } catch (const InputError& error) {
      initial->error(error.what());
    }
  }
  setup.bodies.push_back(std::move(body));
  setup.materials.push_back(std::move(material));
}

template <class Owner>
std::string table_of(const char* heading, Owner owner) {
  return fmt::format("{}\n{}", heading, whipple::to_toml(whipple::bind(Owner::parameters(), owner)));
}

}  // namespace

void read_bodies(Case& setup, const std::vector<input::Table>& tables) {
  std::set<std::string> names;
  std::map<std::string, std::shared_ptr<const Material>> materials;
  for (const input::Table& table : tables) read_body(setup, table, names, materials);
}

std::string body_to_toml(Body body, const std::string& material) {
  body.material = material;
  std::string text = table_of("\n[[body]]", body);
  if (body.discretization.mesh.empty() && !body.discretization.is_bars())
    text += fmt::format("shape = {}\n", body.shape->toml());
  text += table_of("[body.discretization]", body.discretization);
  if (body.discretization.converts()) text += table_of("[body.conversion]", body.conversion);
  for (const NodeCondition& condition : body.node_conditions) {
    text += table_of("[[body.node_condition]]", condition);
  }
  for (const BarRow& row : body.bars) text += table_of("[[body.bar]]", row);
  if (body.initial.given()) text += table_of("[body.initial]", body.initial);
  if (body.failure_scatter.given()) text += table_of("[body.failure_scatter]", body.failure_scatter);
  if (body.viscosity) text += table_of("[body.artificial_viscosity]", *body.viscosity);
  return text;
}

std::string describe_body() {
  std::string text = "\n[[body]]\n" + describe_table(Body::parameters());
  text += "\n[body.discretization]\n" + describe_table(Discretization::parameters());
  text += "\n[body.conversion], of adaptive bodies\n" + describe_table(Conversion::parameters());
  text +=
      "\n[[body.node_condition]], of bodies with elements\n" + describe_table(NodeCondition::parameters());
  text += "\n[[body.bar]], of bodies of bars\n" + describe_table(BarRow::parameters());
  text += "\n[body.initial], at most two of\n" + describe_table(InitialState::parameters());
  text += "\n[body.failure_scatter]\n" + describe_table(FailureScatter::parameters());
  text += "\n[body.artificial_viscosity], keys not given: those of [artificial_viscosity]\n" +
          describe_table(ArtificialViscosity::parameters());
  return text;
}

}  // namespace whipple::cases
