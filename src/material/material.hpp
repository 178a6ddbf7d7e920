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

/// Holds measured values for comparison, which the models do not use (docs/manual/materials.md); NaN: unknown.
struct Measured {
  double melting_point = std::numeric_limits<double>::quiet_NaN();  ///< at 1 atm, K; of an alloy: solidus
  double liquidus = std::numeric_limits<double>::quiet_NaN();       ///< of an alloy at 1 atm, K
  double boiling_point = std::numeric_limits<double>::quiet_NaN();  ///< at 1 atm, K
};

/// Describes a material: its equation of state and the constitutive model that computes its stress, by default from
/// strength and failure. Immutable after `make_material`; shared by threads.
struct Material {
  std::string name;
  std::filesystem::path file;                     ///< that it was read from; empty if built in memory
  std::vector<std::filesystem::path> companions;  ///< files that it requires, relative to its folder
  std::string source;                             ///< source of its constants
  std::string note;
  std::string group;  ///< group of the library: "metals", "explosives", ...; may be empty
  Measured measured;
  double conductivity = 0.0;                           ///< W/(m K); used by runs with heat conduction
  double taylor_quinney = 1.0;                         ///< fraction of the plastic work that becomes heat
  std::shared_ptr<const eos::EquationOfState> eos;     ///< never null
  std::shared_ptr<const strength::Strength> strength;  ///< never null
  std::vector<std::shared_ptr<const failure::Criterion>> failure;  ///< in the order of the file; may be empty
  std::shared_ptr<const material::Constitutive> constitutive;      ///< never null; combines all parts above
  /// Explosive whose products the equation of state describes; null: no explosive. The material represents the
  /// products, burnt from the start, unless it `burns`.
  std::shared_ptr<const Explosive> explosive;
  double reference_bulk_modulus = 0.0;              ///< rho c^2 of the reference state, Pa
  const failure::Criterion* void_growth = nullptr;  ///< the element of `failure` that grows voids; null: none
  eos::State reference;  ///< initial state of bodies: p = 0 at the reference temperature

  /// Returns whether some plastic work is stored instead of being converted to heat.
  [[nodiscard]] bool stores_cold_work() const { return taylor_quinney < 1.0; }
  /// Returns whether the deviator returns to a flow stress, which a factor can scale.
  [[nodiscard]] bool returns_radially() const;
  /// Returns whether the material starts as unreacted explosive and burns to products.
  [[nodiscard]] bool burns() const { return constitutive->explosive() != nullptr; }
  /// Returns the explosive as which it starts; of a material that `burns`.
  [[nodiscard]] const Explosive& burning_explosive() const { return *constitutive->explosive(); }
  /// Returns the material as a material file with all defaults written out (provenance in output files).
  [[nodiscard]] std::string constants() const;
};

/// Sets the fraction of the plastic work that becomes heat, in (0, 1].
/// @throws InputError if it is less than 1 and the parts of the material do not account for plastic work separately
void set_taylor_quinney(Material& material, double share);

/// Combines the parts and computes the reference state. A null strength means no strength.
/// @throws InputError if the equation of state has no state of zero pressure near its reference density, or if the
/// parts are incompatible
Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const strength::Strength> strength = nullptr,
                       std::vector<std::shared_ptr<const failure::Criterion>> failure = {});

/// Combines an equation of state and a constitutive model that replaces strength and failure.
/// @throws InputError if the equation of state has no state of zero pressure near its reference density, or if the
/// parts are incompatible
Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const material::Constitutive> constitutive);

/// Returns the material with another equation of state of the same material.
Material with_eos(const Material& material, std::shared_ptr<const eos::EquationOfState> eos);

/// Returns the explosive that starts unreacted and burns.
/// @param detonation_velocity  D, m/s, instead of that of its Chapman-Jouguet state; 0: that of the state
/// @throws InputError if the material is no explosive, or has failure criteria
Material burning(const Material& material, double detonation_velocity = 0.0);
/// Returns the unreacted explosive that never burns.
/// @throws InputError if the material is no explosive
Material unreacted(const Material& material);

/// Returns the state of material at the start of a run, from at most two of density (kg/m^3), temperature (K) and
/// pressure (Pa). Without a temperature: the reference temperature, unless density and pressure determine it; without
/// density and pressure: the density of zero pressure at the temperature. At a pressure and a temperature it is the
/// condensed phase if there is one (its branch of the isotherm), otherwise the vapour.
/// @throws InputError if there is no such state, if all three are given, or if a temperature is required that the model
/// does not have
eos::State initial_state(const Material& material, std::optional<double> density = {},
                         std::optional<double> temperature = {}, std::optional<double> pressure = {});

/// Returns the density of a body in an initial state, including the voids of its failure model.
double body_density(const Material& material, const eos::State& state);

/// Declares the history fields of the material for the points.
void use_fields(const Material& material, MaterialPoints& points);

/// Sets every field except mass of the points [begin, end) to a state, intact, without scatter and deviatoric stress:
/// volume = mass / density, specific internal energy of the equation of state, longitudinal sound speed. Declares the
/// history fields of the material for the points.
void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end,
                const eos::State& state);
/// Initialises points with the reference state.
void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end);

}  // namespace whipple
