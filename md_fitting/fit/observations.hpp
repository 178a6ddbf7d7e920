// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_settings.hpp"

/// Converts the points of a database to the data of the fit.
namespace whipple::fit {

struct HugoniotState {
  double volume = 0.0;             ///< m^3/kg, prescribed exactly in the simulation
  md::Estimate pressure;           ///< Pa, relative to the initial pressure
  double shock_velocity = 0.0;     ///< m/s
  double particle_velocity = 0.0;  ///< m/s
};

struct ThermalState {
  double temperature = 0.0;
  md::Estimate pressure;
  md::Estimate energy;       ///< specific internal energy
  double correlation = 0.0;  ///< of the errors of pressure and energy
};

/// Holds solid states of equal volume, in order of increasing temperature.
struct Isochore {
  double volume = 0.0;
  std::vector<ThermalState> states;
};

struct MeltingPoint {
  double pressure = 0.0;
  md::Estimate temperature;
  md::Estimate solid_volume;
  std::optional<md::Estimate> latent_heat;    ///< J/kg; absent from older databases
  std::optional<md::Estimate> fusion_volume;  ///< m^3/kg
};

/// Holds a state of the solid at the reference temperature.
struct IsothermState {
  double volume = 0.0;
  md::Estimate pressure;
};

/// Holds the melt at a temperature and a pressure.
struct LiquidState {
  double temperature = 0.0, pressure = 0.0;
  md::Estimate volume;
};

/// Holds melt and vapour in equilibrium, kg/m^3.
struct SaturationState {
  double temperature = 0.0;
  md::Estimate liquid_density, vapour_density;
};

/// Holds the elastic constants of the static crystal at a volume, Pa.
struct ElasticState {
  double volume = 0.0;
  double bulk_modulus = 0.0, shear_modulus = 0.0;  ///< Hill averages
};

/// Holds the quantum correction to classical nuclei at the reference temperature.
struct QuantumState {
  double volume = 0.0;
  md::Estimate pressure;
  double debye_temperature = 0.0;  ///< K, of the second moment of the frequencies
};

/// Holds the nuclear pressures at one volume of the isotherm, Pa.
struct NucleiPressures {
  double volume = 0.0;
  double classical = 0.0;  ///< pressure of classical nuclei, as simulated
  double addition = 0.0;   ///< quantum correction
};

/// Holds the effect of quantum nuclei on the isotherm at the reference temperature.
struct NucleiComparison {
  std::vector<NucleiPressures> isotherm;  ///< by decreasing volume; empty without "quantum" points
  double expansion = 0.0;                 ///< relative growth of the reference volume
  bool contained = false;  ///< whether the isotherm and the reference volume of the fit include it
};

struct Observations {
  std::string element;
  std::string potential;
  double molar_mass = 0.0;
  double reference_temperature = 0.0;
  md::Estimate reference_volume;        ///< at zero pressure and the reference temperature
  std::vector<HugoniotState> hugoniot;  ///< all states, by increasing particle velocity
  std::vector<Isochore> isochores;      ///< by decreasing volume; at least three states each
  std::vector<MeltingPoint> melting;    ///< by increasing pressure
  std::vector<IsothermState> isotherm;  ///< by decreasing volume
  std::vector<LiquidState> liquid;
  std::vector<SaturationState> saturation;  ///< by increasing temperature
  std::vector<ElasticState> elastic;
  std::vector<QuantumState> quantum;  ///< by decreasing volume
  NucleiComparison nuclei;
};

/// Specifies which data are required.
struct Needs {
  bool hugoniot = true;
  bool isotherm = false;
};

/// Converts the finished points of a database to data.
/// @param settings  reference temperature, and the window of particle velocities, which must contain at least three
/// Hugoniot states
/// @throws InputError listing every protocol whose points are missing or too few, and mixed potentials.
Observations observe(std::span<const md::PointRecord> points, const FitSettings& settings, const Needs& needs,
                     const std::string& store_name);

}  // namespace whipple::fit
