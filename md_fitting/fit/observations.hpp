// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

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
};

/// Has the crystal of a point not melted? Protocols without that flag simulate solids only.
bool is_solid(const md::PointRecord& point);

/// Sorts the finished points of a store into data.
/// @param least, most window of particle velocities (m/s) that must hold at least three Hugoniot states
/// @throws InputError listing every protocol whose points are missing or too few, and mixed potentials.
Observations observe(std::span<const md::PointRecord> points, double reference_temperature, double least,
                     double most, const std::string& store_name);

}  // namespace whipple::fit
