// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

#include "md_fitting/data_set/record.hpp"

/// Records of crystals in motion, at rest and behind shocks.
namespace whipple::md {

/// Crystal at zero pressure and a temperature.
struct ZeroPressurePoint {
  double temperature = 0.0, pressure = 0.0;
  Estimate specific_volume{}, specific_internal_energy{}, thermal_expansion{};
  double error_correlation = 0.0;

  static constexpr std::string_view protocol = "zero_pressure_volume";
  static constexpr auto conditions() {
    using P = ZeroPressurePoint;
    return std::array{Quantity<P>{"temperature", "K", "", &P::temperature},
                      Quantity<P>{"pressure", "Pa", "0", &P::pressure}};
  }
  static constexpr auto results() {
    using P = ZeroPressurePoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy, keep_default},
        Quantity<P>{"error_correlation", "", "of the errors of volume and energy, -1 to 1",
                    &P::error_correlation, keep_default},
        Quantity<P>{"thermal_expansion", "1/K", "(1/V) dV/dT at constant pressure, from fluctuations",
                    &P::thermal_expansion, keep_default}};
  }
};

/// Crystal at constant volume and temperature, of an isotherm or an isochore.
struct StatePoint {
  double specific_volume = 0.0, temperature = 0.0;
  Estimate pressure{}, specific_internal_energy{}, mean_square_displacement{};
  double error_correlation = 0.0;
  double crystal_share = 0.0;
  bool solid = true;

  static constexpr std::string_view protocol = "isotherm, isochore";
  static constexpr auto conditions() {
    using P = StatePoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
                      Quantity<P>{"temperature", "K", "", &P::temperature}};
  }
  static constexpr auto results() {
    using P = StatePoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"pressure", "Pa", "", &P::pressure},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy},
        Quantity<P>{"error_correlation", "", "of the errors of pressure and energy, -1 to 1",
                    &P::error_correlation, keep_default},
        Quantity<P>{"mean_square_displacement", "m^2", "of the atoms from their sites",
                    &P::mean_square_displacement, keep_default},
        Quantity<P>{"crystal_share", "",
                    "fraction of the atoms that belong to the crystal, in the nearest minimum of the energy",
                    &P::crystal_share, keep_default},
        Quantity<P>{"solid", "", "1: the crystal did not melt", &P::solid, keep_default}};
  }
};

/// State behind a steady shock, at a volume.
struct HugoniotPoint {
  double specific_volume = 0.0;
  Estimate pressure{}, temperature{}, specific_internal_energy{}, shock_velocity{}, particle_velocity{},
      mean_square_displacement{};
  double crystal_share = 0.0;
  bool solid = true;

  static constexpr std::string_view protocol = "hugoniot";
  static constexpr auto conditions() {
    using P = HugoniotPoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "behind the shock", &P::specific_volume}};
  }
  static constexpr auto results() {
    using P = HugoniotPoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"pressure", "Pa", "", &P::pressure},
        Quantity<P>{"temperature", "K", "", &P::temperature, keep_default},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy, keep_default},
        Quantity<P>{"shock_velocity", "m/s", "", &P::shock_velocity},
        Quantity<P>{"particle_velocity", "m/s", "", &P::particle_velocity},
        Quantity<P>{"mean_square_displacement", "m^2", "of the atoms from their sites",
                    &P::mean_square_displacement, keep_default},
        Quantity<P>{"crystal_share", "",
                    "fraction of the atoms that belong to the crystal, in the nearest minimum of the energy",
                    &P::crystal_share, keep_default},
        Quantity<P>{"solid", "", "1: the crystal did not melt", &P::solid, keep_default}};
  }
};

/// State behind a shock, by dynamics that are driven to the Hugoniot at a pressure.
struct HugoniostatPoint {
  double imposed_pressure = 0.0;
  Estimate pressure{}, specific_volume{}, temperature{}, specific_internal_energy{}, shock_velocity{},
      particle_velocity{}, residual_temperature{};
  bool converged = false;
  double crystal_share = 0.0;
  bool solid = false;

  static constexpr std::string_view protocol = "hugoniostat";
  static constexpr auto conditions() {
    using P = HugoniostatPoint;
    return std::array{Quantity<P>{"pressure", "Pa", "imposed", &P::imposed_pressure}};
  }
  static constexpr auto results() {
    using P = HugoniostatPoint;
    return std::array{
        Quantity<P>{"pressure", "Pa", "mean of the run", &P::pressure},
        Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
        Quantity<P>{"temperature", "K", "", &P::temperature},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy},
        Quantity<P>{"shock_velocity", "m/s", "the error includes the effect of the residual",
                    &P::shock_velocity},
        Quantity<P>{"particle_velocity", "m/s", "likewise", &P::particle_velocity},
        Quantity<P>{"residual_temperature", "K", "residual of equation 8 over 3k/m",
                    &P::residual_temperature},
        Quantity<P>{"converged", "", "1: the residual is a small fraction of the shock heating",
                    &P::converged},
        Quantity<P>{"crystal_share", "",
                    "fraction of the atoms that belong to the crystal, in the nearest minimum of the energy",
                    &P::crystal_share},
        Quantity<P>{"solid", "", "1: the crystal did not melt", &P::solid}};
  }
};

/// Shock driven by a piston.
struct PistonPoint {
  double particle_velocity = 0.0;
  Estimate shock_velocity{}, pressure{}, temperature{};
  double density = 0.0, shear_stress_share = 0.0, slipped_share = 0.0;
  bool elastic = false;

  static constexpr std::string_view protocol = "piston";
  static constexpr auto conditions() {
    using P = PistonPoint;
    return std::array{Quantity<P>{"particle_velocity", "m/s", "of the piston", &P::particle_velocity}};
  }
  static constexpr auto results() {
    using P = PistonPoint;
    return std::array{
        Quantity<P>{"shock_velocity", "m/s", "relative to the material ahead of the shock",
                    &P::shock_velocity},
        Quantity<P>{"particle_velocity", "m/s", "of the piston", &P::particle_velocity},
        Quantity<P>{"pressure", "Pa", "normal stress behind the front, from the jump of momentum",
                    &P::pressure},
        Quantity<P>{"temperature", "K", "behind the front", &P::temperature},
        Quantity<P>{"density", "kg/m^3", "behind the front, from the number of atoms", &P::density},
        Quantity<P>{"shear_stress_share", "", "(P_zz - (P_xx + P_yy)/2) / P_zz behind the front",
                    &P::shear_stress_share},
        Quantity<P>{"slipped_share", "", "fraction of the atoms behind the front that lost neighbours",
                    &P::slipped_share},
        Quantity<P>{"elastic", "", "1: compressed without slip, no datum for an equation of state",
                    &P::elastic}};
  }
};

}  // namespace whipple::md
