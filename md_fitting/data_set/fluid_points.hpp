// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "md_fitting/data_set/record.hpp"

/// Records of what melts, evaporates or fails.
namespace whipple::md {

/// Crystal and melt in equilibrium at a pressure.
struct CoexistencePoint {
  double pressure = 0.0;
  Estimate melting_temperature{}, solid_share{};
  std::optional<Estimate> solid_specific_volume{}, liquid_specific_volume{}, latent_heat{}, fusion_volume{};

  static constexpr std::string_view protocol = "coexistence";
  static constexpr auto conditions() {
    using P = CoexistencePoint;
    return std::array{Quantity<P>{"pressure", "Pa", "", &P::pressure}};
  }
  static constexpr auto results() {
    using P = CoexistencePoint;
    return std::array{Quantity<P>{"melting_temperature", "K", "", &P::melting_temperature},
                      Quantity<P>{"solid_share", "", "fraction of the atoms in the crystal", &P::solid_share,
                                  IfMissing::keep_default},
                      Quantity<P>{"solid_specific_volume", "m^3/kg", "at the melting temperature",
                                  &P::solid_specific_volume},
                      Quantity<P>{"liquid_specific_volume", "m^3/kg", "likewise", &P::liquid_specific_volume},
                      Quantity<P>{"latent_heat", "J/kg", "", &P::latent_heat},
                      Quantity<P>{"fusion_volume", "m^3/kg", "volume of the melt less that of the crystal",
                                  &P::fusion_volume}};
  }
};

/// Melt at a temperature and a pressure.
struct LiquidPoint {
  double temperature = 0.0, pressure = 0.0;
  Estimate specific_volume{}, specific_enthalpy{}, specific_internal_energy{};
  double crystal_share = 0.0;
  bool liquid = false;

  static constexpr std::string_view protocol = "liquid";
  static constexpr auto conditions() {
    using P = LiquidPoint;
    return std::array{Quantity<P>{"temperature", "K", "", &P::temperature},
                      Quantity<P>{"pressure", "Pa", "", &P::pressure}};
  }
  static constexpr auto results() {
    using P = LiquidPoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
        Quantity<P>{"specific_enthalpy", "J/kg", "", &P::specific_enthalpy, keep_default},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy, keep_default},
        Quantity<P>{"crystal_share", "", "fraction of the atoms with the surroundings of a crystal",
                    &P::crystal_share, keep_default},
        Quantity<P>{"liquid", "", "1: the melt did not freeze", &P::liquid}};
  }
};

/// Fluid at constant volume and temperature.
struct FluidPoint {
  double specific_volume = 0.0, temperature = 0.0;
  Estimate pressure{}, specific_internal_energy{};
  double error_correlation = 0.0, crystal_share = 0.0, density_wave = 0.0;
  bool uniform = false;

  static constexpr std::string_view protocol = "fluid";
  static constexpr auto conditions() {
    using P = FluidPoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
                      Quantity<P>{"temperature", "K", "", &P::temperature}};
  }
  static constexpr auto results() {
    using P = FluidPoint;
    return std::array{
        Quantity<P>{"pressure", "Pa", "", &P::pressure},
        Quantity<P>{"specific_internal_energy", "J/kg", "", &P::specific_internal_energy},
        Quantity<P>{"error_correlation", "", "of the errors of pressure and energy, -1 to 1",
                    &P::error_correlation},
        Quantity<P>{"crystal_share", "", "fraction of the atoms with the surroundings of a crystal",
                    &P::crystal_share},
        Quantity<P>{"density_wave", "", "squared amplitude of the longest waves of the box, of 0 to 1",
                    &P::density_wave},
        Quantity<P>{"uniform", "", "1: the fluid neither froze nor separated", &P::uniform}};
  }
};

/// Film of melt and its vapour at a temperature.
struct LiquidVapourPoint {
  double temperature = 0.0;
  Estimate liquid_density{}, vapour_density{}, vapour_pressure{}, surface_energy{}, interface_width{};

  static constexpr std::string_view protocol = "liquid_vapour";
  static constexpr auto conditions() {
    using P = LiquidVapourPoint;
    return std::array{Quantity<P>{"temperature", "K", "", &P::temperature}};
  }
  static constexpr auto results() {
    using P = LiquidVapourPoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"liquid_density", "kg/m^3", "", &P::liquid_density},
        Quantity<P>{"vapour_density", "kg/m^3", "", &P::vapour_density},
        Quantity<P>{"vapour_pressure", "Pa", "normal stress of the film", &P::vapour_pressure, keep_default},
        Quantity<P>{"surface_energy", "J/m^2", "", &P::surface_energy, keep_default},
        Quantity<P>{"interface_width", "m", "from 90 to 10 % of the density", &P::interface_width,
                    keep_default}};
  }
};

/// Tension at which a crystal fails that is stretched in all directions.
struct SpallPoint {
  double temperature = 0.0, strain_rate = 0.0;
  Estimate spall_strength{}, spall_temperature{}, spall_specific_volume{}, specific_volume{};

  static constexpr std::string_view protocol = "spall";
  static constexpr auto conditions() {
    using P = SpallPoint;
    return std::array{Quantity<P>{"temperature", "K", "at the start", &P::temperature},
                      Quantity<P>{"strain_rate", "1/s", "of the volume", &P::strain_rate}};
  }
  static constexpr auto results() {
    using P = SpallPoint;
    return std::array{Quantity<P>{"spall_strength", "Pa", "largest mean tension", &P::spall_strength},
                      Quantity<P>{"spall_temperature", "K", "then", &P::spall_temperature},
                      Quantity<P>{"spall_specific_volume", "m^3/kg", "then", &P::spall_specific_volume},
                      Quantity<P>{"specific_volume", "m^3/kg", "at the start", &P::specific_volume}};
  }
};

}  // namespace whipple::md
