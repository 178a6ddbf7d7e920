// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/shield.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>

#include "src/core/base/error.hpp"
#include "src/core/input/section.hpp"
#include "src/shields/alloys.hpp"

namespace whipple::shields {
namespace {

using Section = input::Section<Impact, Impact>;
using ShieldSection = input::Section<Shield, Impact>;

const Range below_right_angle = {
    .lower = 0.0, .upper = 0.5 * std::numbers::pi * (1.0 - 1e-12), .upper_open = true};

/// Adds a fault if an alloy is unknown.
void check_alloy(const std::string& alloy, const input::Faults& faults) {
  try {
    static_cast<void>(alloy_named(alloy));
  } catch (const InputError& error) {
    faults.add("alloy", error.what());
  }
}

}  // namespace

ParameterTable<Sheet> Sheet::parameters() {
  return {text("alloy", &Sheet::alloy, "designation of the aluminium alloy, \"6061-T6\""),
          real("thickness", &Sheet::thickness, "m", range::positive(), "of the sheet"),
          real("density", &Sheet::density, "kg/m^3", range::positive(), "for the equations")
              .optional("of the alloy"),
          real("yield", &Sheet::yield, "Pa", range::positive(), "yield stress, for the equations")
              .optional("of the alloy"),
          real("hardness", &Sheet::hardness, "", range::positive(), "Brinell hardness, for the equations")
              .optional("of the alloy")};
}

void Sheet::check(const Impact& /*impact*/, const input::Faults& faults) const { check_alloy(alloy, faults); }

ParameterTable<Bumper> Bumper::parameters() {
  return with_part(ParameterTable<Bumper>{real("spacing", &Bumper::spacing, "m", range::positive(),
                                               "from its rear face to the front face of the next sheet")},
                   &Bumper::sheet, Sheet::parameters());
}

void Bumper::check(const Impact& impact, const input::Faults& faults) const { sheet.check(impact, faults); }

ParameterTable<Stuffing> Stuffing::parameters() {
  return {real("areal_density", &Stuffing::areal_density, "kg/m^2", range::non_negative(),
               "of fabric between bumper and wall")
              .optional()};
}

ParameterTable<Foam> Foam::parameters() {
  return {real("density", &Foam::density, "kg/m^3", range::non_negative(),
               "of open-cell foam, pores included, that fills the spacing")
              .optional(),
          real("cell", &Foam::cell, "m", range::non_negative(),
               "size of its cells, the cube root of their volume: for cases with its struts")
              .optional(),
          text("alloy", &Foam::alloy, "designation of the alloy of its struts").optional()};
}

void Foam::check(const Impact& /*impact*/, const input::Faults& faults) const { check_alloy(alloy, faults); }

ParameterTable<Projectile> Projectile::parameters() {
  return {
      text("alloy", &Projectile::alloy, "designation of the aluminium alloy of the sphere, \"2017-T4\""),
      real("diameter", &Projectile::diameter, "m", range::positive(), "of the sphere"),
      real("velocity", &Projectile::velocity, "m/s", range::positive(), "of the sphere"),
      real("angle", &Projectile::angle, "rad", below_right_angle, "between flight and normal of the shield")
          .optional(),
      real("density", &Projectile::density, "kg/m^3", range::positive(), "for the equations")
          .optional("of the alloy")};
}

void Projectile::check(const Impact& /*impact*/, const input::Faults& faults) const {
  check_alloy(alloy, faults);
}

std::span<const input::Section<Shield, Impact>> Shield::sections() {
  using input::section;
  static const std::vector<ShieldSection> all = {
      section<&Shield::bumpers, Impact>("bumper", "  (one for each, in the order in which they are struck)"),
      section<&Shield::wall, Impact>("wall"), section<&Shield::stuffing, Impact>("stuffing"),
      section<&Shield::foam, Impact>("foam")};
  return all;
}

ParameterTable<Impact> Impact::parameters() {
  return {text("name", &Impact::name, "of the shot or the shield").optional()};
}

std::span<const Section> Impact::sections() {
  using input::section;
  static const std::vector<Section> all = {section<&Impact::projectile, Impact>("projectile"),
                                           section<&Impact::shield, Impact>("shield")};
  return all;
}

void complete(Impact& impact) {
  const auto take = [](double& value, double of_alloy) {
    if (!std::isfinite(value)) value = of_alloy;
  };
  const auto fill = [&](Sheet& sheet) {
    const Alloy& alloy = alloy_named(sheet.alloy);
    take(sheet.density, alloy.density);
    take(sheet.yield, alloy.yield);
    take(sheet.hardness, alloy.hardness);
  };
  take(impact.projectile.density, alloy_named(impact.projectile.alloy).density);
  for (Bumper& bumper : impact.shield.bumpers) fill(bumper.sheet);
  fill(impact.shield.wall);
}

Impact read_impact(const std::filesystem::path& file) {
  input::Document document = input::Document::from_file(file);
  Impact impact;
  input::Table root = document.root();
  input::read_content(impact, impact, root);
  std::vector<InputFault> faults;
  input::check_content(impact, impact, input::Faults(faults));
  document.add(std::move(faults));
  document.finish();
  complete(impact);
  return impact;
}

std::string describe_impact() {
  return "Shield file (TOML): a shield and the sphere that strikes it (docs/manual/shields.md). Quantities "
         "are texts "
         "with a unit, \"3.175 mm\".\n\n" +
         input::describe_content<Impact>("");
}

std::string impact_schema() {
  input::Schema table;
  input::add_content<Impact>(table);
  return input::schema_text(table, "Shield of whipple",
                            "Shield file of whipple shield: a shield and the sphere that strikes it.");
}

}  // namespace whipple::shields
