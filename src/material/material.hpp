// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "src/material/burn.hpp"
#include "src/material/constitutive.hpp"
#include "src/material/failure/criterion.hpp"
#include "src/material/strength/strength.hpp"
#include "src/particles/material_points.hpp"

namespace whipple {

/// Measured values that the models do not use, to be compared with (docs/manual/materials.md); NaN: not known.
struct Measured {
  double melting_point = std::numeric_limits<double>::quiet_NaN();  ///< K, at 1 atm; of an alloy: solidus
  double liquidus = std::numeric_limits<double>::quiet_NaN();       ///< K, at 1 atm, of an alloy
  double boiling_point = std::numeric_limits<double>::quiet_NaN();  ///< K, at 1 atm
};

/// Everything that a point of material needs to know about itself: equation of state, and the constitutive model that
/// makes its stress, by default of strength and failure.
/// Immutable after `make_material`; shared by threads.
struct Material {
  std::string name;
  std::filesystem::path file;                     ///< where it was read from; empty if it was built in memory
  std::vector<std::filesystem::path> companions;  ///< files that it reads, relative to its own folder
  std::string source;                             ///< where its constants come from
  std::string note;
  std::string group;  ///< where the library lists it: "metals", "explosives", ...; may be empty
  Measured measured;
  double conductivity = 0.0;                           ///< W/(m K); used by runs with heat conduction
  double taylor_quinney = 1.0;                         ///< fraction of the plastic work that becomes heat
  std::shared_ptr<const eos::EquationOfState> eos;     ///< never null
  std::shared_ptr<const strength::Strength> strength;  ///< never null
  std::vector<std::shared_ptr<const failure::Criterion>> failure;  ///< in the order of the file; may be empty
  std::shared_ptr<const material::Constitutive> constitutive;      ///< never null; of all the parts above
  /// What the products of the equation of state are made of by burning; null: no explosive. The material itself is the
  /// products, burnt from the start, unless it `burns`.
  std::shared_ptr<const Explosive> explosive;
  double reference_bulk_modulus = 0.0;              ///< Pa, rho c^2 of the reference state
  const failure::Criterion* void_growth = nullptr;  ///< the one of `failure` that grows voids; null: none
  eos::State reference;  ///< the state that bodies start from: p = 0 at the reference temperature

  /// Returns whether some plastic work is stored instead of converted to heat.
  [[nodiscard]] bool stores_cold_work() const { return taylor_quinney < 1.0; }
  /// Returns whether it starts as unreacted explosive and burns to products.
  [[nodiscard]] bool burns() const { return constitutive->explosive() != nullptr; }
  /// Returns the explosive as which it starts; of a material that `burns`.
  [[nodiscard]] const Explosive& burning_explosive() const { return *constitutive->explosive(); }
  /// The material as a material file with every default written out (provenance in output files).
  [[nodiscard]] std::string constants() const;
};

/// Sets the fraction of the plastic work that becomes heat, in (0, 1].
/// @throws InputError if it is less than 1 and the parts of the material do not count plastic work apart
void set_taylor_quinney(Material& material, double share);

/// Puts the parts together and computes the reference state. A null strength means none.
/// @throws InputError if the equation of state has no state of zero pressure near its reference density, or
/// if parts do not go together
Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const strength::Strength> strength = nullptr,
                       std::vector<std::shared_ptr<const failure::Criterion>> failure = {});

/// Puts the parts together, with a constitutive model in place of strength and failure.
/// @throws InputError as above
Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const material::Constitutive> constitutive);

/// The material with another equation of state of the same material; all else stays.
Material with_eos(const Material& material, std::shared_ptr<const eos::EquationOfState> eos);

/// The explosive that starts unreacted and burns.
/// @param detonation_velocity  D, m/s, in place of that of its Chapman-Jouguet state; 0: that
/// @throws InputError if the material is no explosive, or has failure criteria
Material burning(const Material& material, double detonation_velocity = 0.0);
/// The unreacted explosive that never burns. @throws InputError if the material is no explosive
Material unreacted(const Material& material);

/// State of material at the start of a run, from at most two of density (kg/m^3), temperature (K) and pressure
/// (Pa). Without a temperature: the reference temperature, unless density and pressure fix it; without
/// density and pressure: the density of zero pressure at the temperature. At a pressure and a temperature it
/// is the condensed phase if there is one (its branch of the isotherm), else the vapour.
/// @throws InputError if there is no such state, if all three are given, or if the model carries no
/// temperature and one is needed
eos::State initial_state(const Material& material, std::optional<double> density = {},
                         std::optional<double> temperature = {}, std::optional<double> pressure = {});

/// Density of a body that starts from a state: with the voids of its failure model.
double body_density(const Material& material, const eos::State& state);

/// Brings the history fields that the material declares into use.
void use_fields(const Material& material, MaterialPoints& points);

/// Sets every field of the points [begin, end) but mass to a state, intact and without scatter, without
/// deviatoric stress: volume = mass / density, specific internal energy of the equation of state, sound speed
/// longitudinal; brings the history fields that the material declares into use.
void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end,
                const eos::State& state);
/// Initialises points with the reference state.
void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end);

}  // namespace whipple
