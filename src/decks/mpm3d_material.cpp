// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/decks/nearest_heat.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::mpm3d {
namespace {

/// Sets the initial temperature of particles in MPM3D-F90, independent of the temperature scale of a deck.
constexpr double start_temperature = 293.0;
/// Sets the limit below which a reference temperature is in degrees Celsius: tests are not run at 200 K, and decks give
/// 20 or 25.
constexpr double least_kelvin = 200.0;

class MaterialBuilder {
 public:
  MaterialBuilder(const Deck& deck, const UnitSystem& units, Import& import, const Statement& material,
                  const Statement* state)
      : deck_(deck),
        units_(units),
        import_(import),
        material_(material),
        state_(state),
        n_(material.numbers) {}

  CaseMaterial build() {
    const int index = whole(n_[0]);
    CaseMaterial result{.file = fmt::format("materials/material_{}.toml", index),
                        .density = n_[1],
                        .explosive = material_.kind == "hiex"};
    if (!(n_[1] > 0.0)) fail(material_, "the density must be > 0");
    toml_.comment(fmt::format("Written by 'whipple import' from {}; constants in the units of the deck.",
                              deck_.file.filename().string()));
    toml_.text_entry("name", fmt::format("material {} ({})", index, material_.kind));
    toml_.text_entry("source", source(material_));
    toml_.table("[eos]");
    equation_of_state(result);
    if (material_.kind == "neoh") {
      neo_hookean();
    } else {
      toml_.table("[strength]");
      strength();
    }
    if (material_.kind == "sjcf" || material_.kind == "jcf") failure();
    import_.files.push_back({result.file, toml_.text()});
    return result;
  }

 private:
  [[noreturn]] void fail(const Statement& statement, std::string text) const {
    throw InputError(std::vector<InputFault>{{.file = deck_.file.string(),
                                              .line = statement.line,
                                              .column = 1,
                                              .text = fmt::format("{}: {}", statement.name(), text)}});
  }
  [[nodiscard]] std::string source(const Statement& statement) const {
    return fmt::format("{}, line {}", deck_.file.filename().string(), statement.line);
  }
  void remark(Outcome outcome, const Statement& statement, std::string text) {
    import_.remark(outcome, statement.line, statement.name(), fmt::format("material {}: {}", n_[0], text));
  }
  void quantity(const char* key, double value, const Dimension& dimension, std::string_view note = {}) {
    toml_.entry(key, units_.quantity(value, dimension), note);
  }
  void begin(const char* model, const Statement& statement) {
    toml_.entry("model", fmt::format("\"{}\"", model));
    toml_.text_entry("source", source(statement));
  }

  /// Writes the heat capacity of `john` and `jcf`; for other kinds, which give none, that of the library material of
  /// the nearest density.
  void heat_capacity(const char* model) {
    if (material_.kind == "john" || material_.kind == "jcf") {
      quantity("heat_capacity", n_[11], dimension::heat_capacity);
    } else {
      const LibraryHeat heat = nearest_heat(units_.in_si(n_[1], dimension::density), model);
      toml_.entry("heat_capacity", fmt::format("\"{} J/(kg K)\"", number(heat.value)),
                  "not in the deck: that of " + heat.material);
      remark(Outcome::converted, material_,
             fmt::format("no heat capacity in the deck: that of {}, {} J/(kg K); temperatures depend on it",
                         heat.material, number(heat.value)));
    }
  }

  void equation_of_state(CaseMaterial& result) {
    if (state_ == nullptr) {
      elastic_volume();
      return;
    }
    const std::vector<double>& c = state_->numbers;  // from the third on
    switch (whole(c[1])) {
      case 1:
        polynomial();
        break;
      case 2:
        begin("mie_gruneisen", *state_);
        quantity("reference_density", n_[1], dimension::density);
        quantity("hugoniot_intercept", c[2], dimension::velocity);
        quantity("hugoniot_slope", c[3], dimension::none);
        quantity("gruneisen", c[4], dimension::none);
        heat_capacity("mie_gruneisen");
        quantity("reference_temperature", start_temperature, {.temperature = 1});
        result.initial_pressure = c[4] * c[5];
        if (c[5] != 0.0) {
          remark(Outcome::converted, *state_,
                 "the initial energy E0 becomes the pressure of the body at the start, gamma0 E0");
        } else {
          remark(Outcome::exact, *state_, "mie_gruneisen");
        }
        break;
      case 3:
        begin("jwl", *state_);
        quantity("reference_density", n_[1], dimension::density);
        quantity("pressure_1", c[2], dimension::pressure);
        quantity("pressure_2", c[3], dimension::pressure);
        quantity("exponent_1", c[4], dimension::none);
        quantity("exponent_2", c[5], dimension::none);
        quantity("gruneisen", c[6], dimension::none);
        quantity("detonation_energy", c[7], dimension::pressure);
        heat_capacity("jwl");
        if (material_.kind == "hiex" && n_[2] > 0.0)
          quantity("detonation_velocity", n_[2], dimension::velocity);
        remark(Outcome::exact, *state_, "jwl");
        break;
      default:
        begin("polynomial", *state_);
        quantity("reference_density", n_[1], dimension::density);
        quantity("C1", n_[1] * c[2] * c[2], dimension::pressure,
                 "density times the square of the sound speed");
        quantity("C4", 0.0, dimension::none);
        heat_capacity("mie_gruneisen");
        quantity("reference_temperature", start_temperature, {.temperature = 1});
        remark(Outcome::converted, *state_,
               "polynomial with C1 = rho c^2: equal in compressions of some per cent");
    }
  }

  void polynomial() {
    const std::vector<double>& c = state_->numbers;
    begin("polynomial", *state_);
    quantity("reference_density", n_[1], dimension::density);
    for (std::size_t i = 0; i < 7; ++i) {
      quantity(fmt::format("C{}", i).c_str(), c[2 + i], i < 4 ? dimension::pressure : dimension::none);
    }
    if (c[9] != 0.0)
      quantity("reference_energy", c[9] / n_[1], dimension::specific_energy, "E0 over the density");
    heat_capacity("mie_gruneisen");
    quantity("reference_temperature", start_temperature, {.temperature = 1});
    remark(Outcome::exact, *state_, "polynomial");
  }

  /// Writes pressure by the elastic law, which MPM3D-F90 also uses without `seos`.
  void elastic_volume() {
    begin("polynomial", material_);
    quantity("reference_density", n_[1], dimension::density);
    double bulk_modulus = 0.0;
    if (material_.kind == "null") {
      bulk_modulus = n_[2];
    } else if (material_.kind == "hiex") {
      fail(material_, "an explosive needs 'seos' with type 3 (JWL)");
    } else {
      if (!(n_[3] < 0.5)) fail(material_, "Poisson's ratio must be < 0.5 without 'seos'");
      bulk_modulus = n_[2] / (3.0 * (1.0 - 2.0 * n_[3]));
    }
    if (!(bulk_modulus > 0.0)) fail(material_, "the bulk modulus must be > 0");
    quantity("C1", bulk_modulus, dimension::pressure, "bulk modulus");
    quantity("C4", 0.0, dimension::none);
    heat_capacity("mie_gruneisen");
    quantity("reference_temperature", start_temperature, {.temperature = 1});
    remark(Outcome::converted, material_,
           "no 'seos': pressure by the bulk modulus, p = K (rho/rho0 - 1), equal at small strains");
  }

  void elastic_constants() {
    quantity("youngs_modulus", n_[2], dimension::pressure);
    quantity("poisson_ratio", n_[3], dimension::none);
  }

  void neo_hookean() {
    toml_.table("[constitutive]");
    begin("neo_hookean", material_);
    quantity("shear_modulus", n_[2] / (2.0 * (1.0 + n_[3])), dimension::pressure, "E / (2 (1 + nu))");
    remark(Outcome::converted, material_,
           "neo_hookean: shear of the isochoric deformation, pressure of the equation of state; equal at "
           "small strains");
  }

  void strength() {
    if (material_.kind == "elas") {
      begin("elastic", material_);
      elastic_constants();
      remark(Outcome::exact, material_, "elastic");
    } else if (material_.kind == "pla1" || material_.kind == "pla2") {
      begin("von_mises", material_);
      elastic_constants();
      quantity("yield_stress", n_[4], dimension::pressure);
      if (material_.kind == "pla2") {
        if (!(n_[5] < n_[2])) fail(material_, "the tangent modulus must be less than Young's modulus");
        quantity("hardening_modulus", n_[2] * n_[5] / (n_[2] - n_[5]), dimension::pressure,
                 "E Et / (E - Et)");
      }
      remark(Outcome::exact, material_, "von_mises");
    } else if (material_.kind == "john" || material_.kind == "jcf") {
      johnson_cook();
    } else if (material_.kind == "sjc" || material_.kind == "sjcf") {
      johnson_cook_without_softening();
    } else if (material_.kind == "null" && n_[3] > 0.0) {
      begin("viscous_fluid", material_);
      quantity("viscosity", n_[3], dimension::viscosity);
      remark(Outcome::exact, material_, "viscous_fluid");
    } else if (material_.kind == "dpm") {
      drucker_prager();
    } else {
      begin("none", material_);
      if (material_.kind == "null") {
        remark(Outcome::exact, material_, "a fluid without viscosity");
      } else {
        remark(Outcome::converted, material_,
               "programmed burn over two cells from an unreacted explosive; that code burns each particle at "
               "once");
      }
    }
  }

  /// Writes the cone tau <= k_phi + q_phi p of a deck as the angle and the cohesion with which the cone of triaxial
  /// compression, q = sqrt(3) tau <= d + M p, is the same: sin(phi) = 3 M/(6 + M), c = d (3 - sin(phi))/(6 cos(phi)).
  /// That cone covers every slope which an angle below 90 degrees can have.
  void drucker_prager() {
    const double slope = std::numbers::sqrt3 * n_[4], cohesion = std::numbers::sqrt3 * n_[5];
    constexpr double steepest = 3.0;  // of compression at 90 degrees
    if (!(slope > 0.0 && slope < steepest)) fail(material_, "q_phi must be > 0 and < sqrt(3)");
    if (!(cohesion >= 0.0)) fail(material_, "k_phi must be >= 0");
    if (!(n_[7] >= 0.0)) fail(material_, "the tensile strength must be >= 0");
    if (!(n_[6] >= 0.0 && n_[6] <= n_[4])) fail(material_, "q_psi must be >= 0 and not above q_phi");
    const double sine = 3.0 * slope / (6.0 + slope), angle = std::asin(sine);
    begin("drucker_prager", material_);
    elastic_constants();
    toml_.text_entry("match", "compression");
    toml_.entry("friction_angle", fmt::format("\"{} deg\"", number(angle * 180.0 / std::numbers::pi)),
                "the cone of the deck's q_phi and k_phi");
    quantity("cohesion", cohesion * (3.0 - sine) / (6.0 * std::cos(angle)), dimension::pressure);
    quantity("tensile_strength", n_[7], dimension::pressure);
    const std::string cone =
        "drucker_prager with the same cone; tension opens a gap, and the stress stays on the cone there";
    if (n_[6] == 0.0) {
      remark(Outcome::converted, material_, cone);
      return;
    }
    const double flow = std::numbers::sqrt3 * n_[6], dilation = std::asin(3.0 * flow / (6.0 + flow));
    toml_.entry("dilation_angle", fmt::format("\"{} deg\"", number(dilation * 180.0 / std::numbers::pi)),
                "the flow of the deck's q_psi");
    remark(
        Outcome::converted, material_,
        cone +
            "; dilation begins with q_psi and ends at 'maximum_dilation', while that of the deck never ends");
  }

  void johnson_cook() {
    begin("johnson_cook", material_);
    elastic_constants();
    quantity("yield_stress", n_[4], dimension::pressure);
    quantity("hardening_coefficient", n_[5], dimension::pressure);
    quantity("hardening_exponent", n_[6], dimension::none);
    quantity("rate_coefficient", n_[7], dimension::none);
    quantity("reference_rate", n_[12], dimension::rate);
    quantity("thermal_exponent", n_[8], dimension::none);
    const char* scale = n_[9] < least_kelvin ? "degC" : "K";
    toml_.entry("reference_temperature", fmt::format("\"{} {}\"", number(n_[9]), scale));
    toml_.entry("melting_temperature", fmt::format("\"{} {}\"", number(n_[10]), scale));
    if (n_[9] < least_kelvin) {
      remark(Outcome::converted, material_,
             fmt::format("johnson_cook; its room temperature {} is taken for degrees Celsius, while "
                         "MPM3D-F90 starts particles at 293",
                         number(n_[9])));
    } else {
      remark(Outcome::exact, material_, "johnson_cook");
    }
  }

  void johnson_cook_without_softening() {
    if (n_[7] == 0.0 && (n_[6] == 1.0 || n_[5] == 0.0)) {
      begin("von_mises", material_);
      elastic_constants();
      quantity("yield_stress", n_[4], dimension::pressure);
      quantity("hardening_modulus", n_[5], dimension::pressure, "n = 1 and C = 0");
      remark(Outcome::exact, material_, "von_mises: n = 1 and C = 0");
      return;
    }
    begin(n_[7] == 0.0 ? "power_law" : "johnson_cook", material_);
    elastic_constants();
    quantity("yield_stress", n_[4], dimension::pressure);
    quantity("hardening_coefficient", n_[5], dimension::pressure);
    quantity("hardening_exponent", n_[6], dimension::none);
    if (n_[7] == 0.0) {
      remark(Outcome::exact, material_, "power_law: C = 0");
      return;
    }
    quantity("rate_coefficient", n_[7], dimension::none);
    quantity("reference_rate", n_[8], dimension::rate);
    quantity("thermal_exponent", 1.0, dimension::none);
    toml_.entry("reference_temperature", "\"1e8 K\"",
                "no thermal softening in the deck: none below this temperature");
    toml_.entry("melting_temperature", "\"2e8 K\"");
    remark(Outcome::converted, material_, "johnson_cook with temperatures of softening that nothing reaches");
  }

  void failure() {
    toml_.table("[[failure]]");
    begin("plastic_strain", material_);
    quantity("failure_strain", n_.back(), dimension::none);
    remark(Outcome::exact, material_, "failure at a plastic strain");
  }

  const Deck& deck_;
  const UnitSystem& units_;
  Import& import_;
  const Statement& material_;
  const Statement* state_;
  const std::vector<double>& n_;  ///< number, density, then the constants of the model
  TomlText toml_;
};

}  // namespace

std::map<int, CaseMaterial> materials_of(const Deck& deck, const UnitSystem& units, Import& import) {
  std::vector<InputFault> faults;
  const auto fault = [&](const Statement& statement, std::string text) {
    faults.push_back(
        {.file = deck.file.string(), .line = statement.line, .column = 1, .text = std::move(text)});
  };
  std::map<int, const Statement*> states;
  for (const Statement* state : deck.all(Keyword::equation_of_state))
    states[whole(state->numbers[0])] = state;
  std::map<int, CaseMaterial> materials;
  for (const Statement* material : deck.all(Keyword::material)) {
    const int index = whole(material->numbers[0]);
    if (materials.contains(index)) {
      fault(*material, fmt::format("material {} is defined twice", index));
      continue;
    }
    const auto state = states.find(index);
    try {
      materials[index] =
          MaterialBuilder(deck, units, import, *material, state == states.end() ? nullptr : state->second)
              .build();
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  for (const auto& [index, state] : states) {
    if (!materials.contains(index) && faults.empty())
      fault(*state, fmt::format("material {} is not among those of 'mate'", index));
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return materials;
}

}  // namespace whipple::decks::mpm3d
