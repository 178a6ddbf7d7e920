// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/laws.hpp"
#include "src/core/base/hash.hpp"

/// Points as molecular dynamics would give them, from a GRAY model with known constants and noise of known
/// size.
namespace whipple::fit::testing {

/// Copper-like; the terms in T^2 are all anharmonic, as in a classical simulation.
inline eos::GrayConstants true_constants() {
  eos::GrayConstants c;
  c.molar_mass = 0.06355;
  c.reference_specific_volume = 0.1134e-3;
  c.hugoniot_intercept = 3870.0;
  c.hugoniot_slope = 1.47;
  c.gruneisen = 1.98;
  c.gruneisen_slope = 1.6;
  c.anharmonic_heat_coefficient = 6.0e-4;
  c.melting_temperature = 1850.0;
  c.vapour_attraction = 620.0;
  c.reference_temperature = 293.0;
  return c;
}

/// Standard errors of the points.
struct Noise {
  double volume = 3e-5;          ///< relative
  double shock_pressure = 5e-3;  ///< relative
  double pressure = 2e7;         ///< Pa
  double energy = 400.0;         ///< J/kg
  double correlation = 0.5;      ///< of pressure and energy
  double melting = 10.0;         ///< K
  double latent_heat = 0.02;     ///< relative
  bool silent = false;           ///< the errors are stated, but the values are exact
  /// Us = C + S up exactly. The model's own Hugoniot is a line only if gamma_e = gamma or g = 0.
  bool straight_hugoniot = true;
};

class SyntheticStore {
 public:
  SyntheticStore(const eos::GrayConstants& constants, const Noise& noise, unsigned seed)
      : constants_(constants), noise_(noise), generator_(seed) {
    const eos::ModelEquationOfState<eos::Gray> model(constants);
    const eos::GrayFreeEnergy& surface = model.underlying().free_energy();
    const double v0 = constants.reference_specific_volume;
    for (const double temperature : {293.0, 600.0}) {
      const double v = 1.0 / eos::density_at_pressure(model, 0.0, temperature);
      add("zero_pressure_volume", {{"temperature", temperature}, {"pressure", 0.0}},
          {{"specific_volume", noisy(v, noise.volume * v)}});
    }
    const eos::Hugoniot hugoniot(model);
    for (const double ratio : {0.97, 0.94, 0.91, 0.88, 0.85, 0.82, 0.79, 0.76, 0.74}) {
      const double x = 1.0 - ratio;
      const double exact =
          noise.straight_hugoniot
              ? std::pow(constants.hugoniot_intercept / (1.0 - constants.hugoniot_slope * x), 2) * x / v0
              : hugoniot.at_density(1.0 / (ratio * v0)).state.pressure;
      const md::Estimate pressure = noisy(exact, noise.shock_pressure * exact);
      add("hugoniot", {{"specific_volume", ratio * v0}},
          {{"pressure", pressure},
           {"shock_velocity", {std::sqrt(pressure.value * v0 / (1.0 - ratio)), 0.0}},
           {"particle_velocity", {std::sqrt(pressure.value * v0 * (1.0 - ratio)), 0.0}}});
    }
    for (const double ratio : {1.03, 1.0, 0.95, 0.9, 0.85, 0.8}) {
      for (double temperature = 300.0; temperature < 0.9 * surface.band(surface.isochore(ratio * v0)).T1;
           temperature += 200.0) {
        add_state("isochore", ratio * v0, temperature, surface);
      }
    }
    for (const double ratio : {0.98, 0.93, 0.88}) add_state("isotherm", ratio * v0, 293.0, surface);
    const Melting melting(constants);
    for (const double ratio : {1.06, 1.02, 0.98, 0.94}) {
      const double temperature = melting.solidus(ratio * v0);
      const double pressure = surface.solid(ratio * v0, temperature).pressure;
      const double heat = melting.latent_heat(pressure, temperature);
      add("coexistence", {{"pressure", pressure}},
          {{"melting_temperature", noisy(temperature, noise.melting)},
           {"solid_specific_volume", {ratio * v0, 0.0}},
           {"latent_heat", noisy(heat, noise.latent_heat * heat)}});
    }
  }

  std::vector<md::PointRecord> points;

  void add(const std::string& protocol, std::map<std::string, double> conditions,
           std::map<std::string, md::Estimate> results) {
    md::PointRecord point;
    point.protocol = protocol;
    point.status = md::PointStatus::done;
    point.conditions = std::move(conditions);
    point.results = std::move(results);
    point.provenance = {{"element", "Cu"},
                        {"potential", "synthetic"},
                        {"molar_mass", fmt::format("{}", constants_.molar_mass)},
                        {"lammps_version", "none"}};
    point.key = whipple::sha256(fmt::format("{}", points.size()));
    points.push_back(point);
  }

 private:
  md::Estimate noisy(double value, double error) {
    return {noise_.silent ? value : value + error * normal_(generator_), error};
  }

  void add_state(const std::string& protocol, double v, double temperature,
                 const eos::GrayFreeEnergy& surface) {
    const eos::GrayPoint state = surface.solid(v, temperature);
    const double first = noise_.silent ? 0.0 : normal_(generator_);
    const double second = noise_.silent ? 0.0 : normal_(generator_);
    const double rho = noise_.correlation;
    add(protocol, {{"specific_volume", v}, {"temperature", temperature}},
        {{"pressure", {state.pressure + noise_.pressure * first, noise_.pressure}},
         {"specific_internal_energy",
          {state.energy - 5.3e6 + noise_.energy * (rho * first + std::sqrt(1.0 - rho * rho) * second),
           noise_.energy}},
         {"error_correlation", {rho, 0.0}},
         {"solid", {1.0, 0.0}}});
  }

  eos::GrayConstants constants_;
  Noise noise_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace whipple::fit::testing
