// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/zero_pressure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/bath.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {

ZeroPressureResult measure_zero_pressure(const Potential& potential, double temperature, const RunSize& size,
                                         std::int64_t seed) {
  const double mass = potential.mass();
  const double a = potential.lattice_constant();
  const double dt = time_step(potential, 1.0, temperature, size);
  Crystal crystal(potential, a, size.cells, size.cells, size.cells);
  Lammps& lammps = crystal.lammps();
  crystal.evaluate();
  const double cold_energy = lammps.variable("energy");
  const double cold_volume = lammps.variable("volume");
  lammps.command("timestep {:.17g}", dt);
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * temperature, seed);
  lammps.command("fix integrate all nph iso 0.0 0.0 {:.17g}", 1000.0 * dt);
  couple_to_bath(lammps, temperature, dt, seed);
  lammps.command("run {} post no", size.equilibration_steps);
  const std::int64_t interval = sampling_interval(size.steps);
  auto series =
      crystal.sample({"energy", "volume", "displacement", "kinetic_temperature"}, interval, size.steps);
  const double neighbour = nearest_neighbour(potential.structure(), a);
  if (std::sqrt(series[2].back()) > melting_displacement * neighbour) {
    throw StateError(
        fmt::format("the crystal melted at {} K and zero pressure: atoms moved {:.2f} A from their sites",
                    temperature, std::sqrt(series[2].back())));
  }
  const double share = inherent_crystal_share(crystal, potential);
  if (share < solid_share_limit) {
    throw StateError(fmt::format("the crystal melted at {} K and zero pressure: fraction of crystal {:.2f}",
                                 temperature, share));
  }
  const double n = crystal.atoms();
  const double modes = n / (n - 1.0);
  const Estimate expansion = thermal_expansion(series[1], series[0], n, temperature);
  const double kinetic_energy = 1.5 * metal::boltzmann * temperature;
  series[0] = in_bath(series[0], cold_energy, series[3], temperature, interval);
  series[1] = in_bath(series[1], cold_volume, series[3], temperature, interval);
  for (double& energy : series[0]) energy = cold_energy + modes * (energy - cold_energy) + kinetic_energy;
  for (double& volume : series[1]) volume = cold_volume + modes * (volume - cold_volume);
  const Estimate energy = series_mean(series[0]);
  require_stable(true, energy, cold_energy, temperature, potential);
  const Estimate volume = series_mean(series[1]);
  std::vector<double> blocks;
  for (const double mean : block_means(series[1])) blocks.push_back(metal::specific_volume(mean, mass));
  ZeroPressureResult result;
  result.specific_volume = {metal::specific_volume(volume.value, mass),
                            metal::specific_volume(volume.error, mass)};
  result.specific_internal_energy = {metal::specific_energy(energy.value, mass),
                                     metal::specific_energy(energy.error, mass)};
  result.thermal_expansion = {modes * expansion.value, modes * expansion.error};
  result.error_correlation = error_correlation(series[0], series[1]);
  result.transcript = lammps.transcript();
  result.volume_blocks = std::move(blocks);
  return result;
}

Estimate thermal_expansion(std::span<const double> volume, std::span<const double> energy, double atoms,
                           double temperature) {
  const double scale = atoms / (metal::boltzmann * temperature * temperature * series_mean(volume).value);
  const Estimate covariance = series_covariance(volume, energy);
  return {scale * covariance.value, scale * covariance.error};
}

void add_zero_pressure(const Plan& plan, TaskList& list) {
  if (!plan.zero_pressure) return;
  const RunSize size = plan.zero_pressure->size;
  for (const double temperature : plan.zero_pressure->temperature) {
    list.add({conditions_of(ZeroPressurePoint{.temperature = temperature}),
              size_settings(size),
              {},
              precision_of(&ZeroPressurePoint::specific_volume, true, plan.zero_pressure->target, size)},
             [&potential = list.potential(), size, temperature](std::int64_t seed, const PointRecord*) {
               const ZeroPressureResult result = measure_zero_pressure(potential, temperature, size, seed);
               return TaskResult{results_of<ZeroPressurePoint>(result),
                                 "",
                                 result.transcript,
                                 {blocks_of(&ZeroPressurePoint::specific_volume, result.volume_blocks)}};
             });
  }
}

}  // namespace whipple::md
