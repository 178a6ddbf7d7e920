// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "eos/hermite_table.hpp"
#include "eos/models/debye_gruneisen.hpp"
#include "eos/models/phase_equilibrium.hpp"

namespace whipple::eos {

struct SolidTransitionConstants {
  double molar_mass = 0;                 ///< kg/mol
  double reference_temperature = 300.0;  ///< K
  double transition_pressure = 0;        ///< of equal Gibbs energies at the reference temperature, Pa
  DebyeGruneisenConstants low, high;     ///< of the phases at low and at high pressure

  static ParameterTable<SolidTransitionConstants> parameters();
};

/// Models a metal with two solid phases in equilibrium, each a Debye-Grueneisen solid
/// (docs/theory/equations_of_state.md, "Two solid phases"): at one temperature the common tangent of their free energies
/// has the pressure of the transition, and states between the volumes of both phases are mixtures with its pressure.
/// Without kinetics and hysteresis; no liquid.
///
/// Explicit policies: those of DebyeGruneisen in either phase; in a mixture whose pressure does not depend on the
/// temperature the sound speed has the least value of the phases.
class SolidTransition {
 public:
  using Constants = SolidTransitionConstants;
  static constexpr std::string_view name = "solid_transition";
  static constexpr std::string_view summary =
      "two solid phases in equilibrium, each with its isotherm, Debye lattice and electrons";
  static constexpr double relative_cost = 16.0;
  static constexpr double least_temperature = DebyeGruneisen::least_temperature;
  static constexpr bool has_phases = false;  ///< neither melts nor vaporises
  static ParameterTable<Constants> parameters() { return Constants::parameters(); }

  /// @throws InputError if the constants contradict each other, or the phases have no transition at the pressure
  explicit SolidTransition(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return low_.reference_density(); }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double maximum_density() const { return high_.maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }
  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

  /// Returns the pressure of the transition at a temperature, within the range of the equilibrium.
  [[nodiscard]] double transition_pressure(double temperature) const { return pressure_(temperature); }
  /// Returns the specific volumes of both phases in equilibrium.
  [[nodiscard]] double low_volume(double temperature) const { return low_volume_(within(temperature)); }
  [[nodiscard]] double high_volume(double temperature) const { return high_volume_(within(temperature)); }
  [[nodiscard]] double coldest() const { return coldest_; }  ///< K, of the equilibrium
  [[nodiscard]] double hottest() const { return hottest_; }

 private:
  enum class Region : std::uint8_t { low, high, mixture };
  struct Place;
  [[nodiscard]] double within(double temperature) const;
  [[nodiscard]] GrayPoint low_surface(double V, double T) const;
  [[nodiscard]] GrayPoint high_surface(double V, double T) const;
  /// Returns region and temperature of a state from the temperatures that both phases would have there; NaN: none.
  [[nodiscard]] Place place(double V, double E, double low_temperature, double high_temperature) const;
  [[nodiscard]] PhaseMixture mixture(double V, double T) const;
  [[nodiscard]] State mixed_state(double V, double T) const;
  void tabulate();

  Constants constants_;
  DebyeGruneisen low_, high_;
  double energy_offset_ = 0;  ///< of the high-pressure phase, J/kg
  double coldest_ = 0, hottest_ = 0;
  HermiteTable pressure_, gibbs_, low_volume_, high_volume_;  ///< over T
  double least_squared_sound_speed_ = 0;
};

}  // namespace whipple::eos
