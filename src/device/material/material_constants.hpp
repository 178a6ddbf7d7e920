// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "eos/models/gruneisen_point.hpp"
#include "eos/table/point.hpp"
#include "src/material/heating_viscosity.hpp"
#include "src/material/stress_rotation.hpp"

/// Constants of a material as kernels of a graphics processor read them: numbers only. Tables of equations of state stand
/// in one array of numbers for all materials (describe.hpp).
namespace whipple::device {

enum class EosKind : std::uint8_t { gruneisen, table };
enum class StrengthKind : std::uint8_t { none, von_mises, johnson_cook, steinberg_guinan };
/// Lists the failure criteria.
enum class CriterionKind : std::uint8_t { tensile_pressure, plastic_strain, johnson_cook_damage };

/// Selects how voids grow in intact material: not, so that the pressure stays at the spall strength, or at a rate.
enum class VoidKind : std::uint8_t { none, cut_off, viscous_growth };

/// strength::VonMises; of material that never yields the greatest numbers.
struct VonMisesConstants {
  double yield_stress = 0.0, hardening_modulus = 0.0, maximum_flow_stress = 0.0;
};

/// strength::JohnsonCook.
struct JohnsonCookConstants {
  double yield_stress = 0.0, hardening_coefficient = 0.0, hardening_exponent = 1.0;
  double rate_coefficient = 0.0, reference_rate = 1.0;
  double thermal_exponent = 1.0, reference_temperature = 0.0, melting_temperature = 0.0;
};

/// strength::SteinbergGuinan.
struct SteinbergGuinanConstants {
  double reference_density = 0.0, shear_modulus = 0.0, pressure_coefficient = 0.0,
         temperature_coefficient = 0.0;
  double yield_stress = 0.0, maximum_flow_stress = 0.0;
  double hardening_coefficient = 0.0, hardening_exponent = 1.0, initial_plastic_strain = 0.0;
};

/// failure::JohnsonCookDamage.
struct JohnsonCookDamageConstants {
  double d1 = 0.0, d2 = 0.0, d3 = 0.0, d4 = 0.0, d5 = 0.0;
  double reference_rate = 1.0, reference_temperature = 0.0, melting_temperature = 0.0;
  double least_failure_strain = 0.0, least_triaxiality = 0.0, greatest_triaxiality = 0.0;
};

/// failure::ViscousVoidGrowth.
struct VoidGrowthConstants {
  double resistance = 0.0, viscosity = 0.0, nuclei = 0.0, failure_porosity = 0.0;
  double at_nuclei = 0.0;  ///< tension from which nuclei grow, over the resistance
};

/// Describes a material and the artificial viscosity of a body of it. `linear_viscosity` to `rotation` are those of
/// `UpdateSettings`.
struct MaterialConstants {
  EosKind eos = EosKind::gruneisen;
  StrengthKind strength = StrengthKind::none;
  bool has_phases = false;
  bool stores_cold_work = false;
  VoidKind voids = VoidKind::none;
  bool heals_tension = false;        ///< whether points that tension has failed are intact again once closed
  bool heals_growth = false;         ///< the same for those that voids have failed
  bool keeps_fragment_size = false;  ///< of points that fail
  std::uint8_t criteria = 0;         ///< number of failure criteria
  std::array<CriterionKind, 4> order{};  ///< in which they are evaluated

  eos::GruneisenPoint gruneisen;
  eos::table::Point table;
  double reference_density = 0.0;      ///< of the initial state, kg/m^3
  double reference_sound_speed = 0.0;  ///< bulk, m/s
  double maximum_density = 0.0;        ///< of the equation of state, kg/m^3

  double shear_modulus = 0.0;  ///< Pa, of von_mises and johnson_cook
  VonMisesConstants von_mises;
  JohnsonCookConstants johnson_cook;
  SteinbergGuinanConstants steinberg_guinan;
  double taylor_quinney = 1.0;

  double spall_strength = 0.0;  ///< Pa
  VoidGrowthConstants void_growth;
  double failure_strain = 0.0;
  JohnsonCookDamageConstants damage;
  double energy_per_area = 0.0;  ///< of fragment_size, J/m^2

  double cell_size = 0.0;  ///< length of the artificial viscosity, m
  double linear_viscosity = 0.0, quadratic_viscosity = 0.0, expansion_viscosity = 0.0;
  HeatingViscosity heating = HeatingViscosity::not_distinguished;
  double affine_gain = 1.0, affine_compression = 0.0, initial_density = 1.0;
  material::StressRotation rotation = material::StressRotation::hughes_winget;
};

}  // namespace whipple::device
