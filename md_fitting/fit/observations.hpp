// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_settings.hpp"

/// From the points of a store to the data of the fit.
namespace whipple::fit {

struct HugoniotState {
  double volume = 0.0;             ///< m^3/kg, set exactly in the simulation
  md::Estimate pressure;           ///< Pa, above the initial pressure
  double shock_velocity = 0.0;     ///< m/s
  double particle_velocity = 0.0;  ///< m/s
};

struct ThermalState {
  double temperature = 0.0;
  md::Estimate pressure;
  md::Estimate energy;       ///< specific internal energy
  double correlation = 0.0;  ///< of the errors of pressure and energy
};

/// Solid states of equal volume, by rising temperature.
struct Isochore {
  double volume = 0.0;
  std::vector<ThermalState> states;
};

struct MeltingPoint {
  double pressure = 0.0;
  md::Estimate temperature;
  md::Estimate solid_volume;
  std::optional<md::Estimate> latent_heat;    ///< J/kg; older stores have none
  std::optional<md::Estimate> fusion_volume;  ///< m^3/kg
};

/// A solid at the reference temperature.
struct IsothermState {
  double volume = 0.0;
  md::Estimate pressure;
};

/// Melt at a temperature and a pressure.
struct LiquidState {
  double temperature = 0.0, pressure = 0.0;
  md::Estimate volume;
};

/// Melt and vapour in equilibrium, kg/m^3.
struct SaturationState {
  double temperature = 0.0;
  md::Estimate liquid_density, vapour_density;
};

/// Elastic constants of the static crystal at a volume, Pa.
struct ElasticState {
  double volume = 0.0;
  double bulk_modulus = 0.0, shear_modulus = 0.0;  ///< Hill's
};

/// What quantum nuclei add to classical ones at the reference temperature.
struct QuantumState {
  double volume = 0.0;
  md::Estimate pressure;
  double debye_temperature = 0.0;  ///< K, of the second moment of the frequencies
};

/// One volume of the isotherm, Pa.
struct NucleiPressures {
  double volume = 0.0;
  double classical = 0.0;  ///< pressure of classical nuclei, as simulated
  double addition = 0.0;   ///< of quantum nuclei
};

/// What quantum nuclei make of the isotherm at the reference temperature.
struct NucleiComparison {
  std::vector<NucleiPressures>
      isotherm;            ///< by falling volume; empty without points of the protocol "quantum"
  double expansion = 0.0;  ///< relative growth of the reference volume
  bool contained = false;  ///< in the isotherm and the reference volume of the fit
};

struct Observations {
  std::string element;
  std::string potential;
  double molar_mass = 0.0;
  double reference_temperature = 0.0;
  md::Estimate reference_volume;        ///< at zero pressure and the reference temperature
  std::vector<HugoniotState> hugoniot;  ///< all states, by rising particle velocity
  std::vector<Isochore> isochores;      ///< by falling volume; at least three states each
  std::vector<MeltingPoint> melting;    ///< by rising pressure
  std::vector<IsothermState> isotherm;  ///< by falling volume
  std::vector<LiquidState> liquid;
  std::vector<SaturationState> saturation;  ///< by rising temperature
  std::vector<ElasticState> elastic;
  std::vector<QuantumState> quantum;  ///< by falling volume
  NucleiComparison nuclei;
};

/// Which data must be there.
struct Needs {
  bool hugoniot = true;
  bool isotherm = false;
};

/// Returns whether the crystal of a point has not melted; true for protocols without that flag, which
/// simulate solids only.
bool is_solid(const md::PointRecord& point);

/// Sorts the finished points of a store into data.
/// @param settings  reference temperature, and the window of particle velocities that must hold at least
/// three
///                  Hugoniot states
/// @throws InputError listing every protocol whose points are missing or too few, and mixed potentials.
Observations observe(std::span<const md::PointRecord> points, const FitSettings& settings, const Needs& needs,
                     const std::string& store_name);

}  // namespace whipple::fit
