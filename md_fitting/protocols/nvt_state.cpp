// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/nvt_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/bath.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/core/base/hash.hpp"

namespace whipple::md {
namespace {

/// Divisor of the steps for search runs, whose noise affects the next temperature but not the result.
constexpr std::int64_t search_share = 4;

}  // namespace

NvtStateSource::NvtStateSource(const Potential& potential, const RunSize& size, std::int64_t seed)
    : potential_(potential), size_(size), seed_(seed) {}

State NvtStateSource::state(double specific_volume, double temperature, Effort effort) {
  const double ratio = specific_volume / potential_.static_volume();
  potential_.require_range(ratio);
  const double mass = potential_.mass();
  const double atomic_volume = metal::volume_per_atom(specific_volume, mass);
  const double a = std::cbrt(atomic_volume * potential_.atoms_per_cell());
  const double dt = time_step(potential_, ratio, temperature, size_);
  const bool search = effort == Effort::search;
  const std::int64_t steps = search ? std::max<std::int64_t>(200, size_.steps / search_share) : size_.steps;
  const std::int64_t equilibration =
      search ? std::max<std::int64_t>(100, size_.equilibration_steps / 2) : size_.equilibration_steps;
  const std::int64_t seed = states_ == 0 ? seed_ : seed_from(sha256(fmt::format("{} {}", seed_, states_)));
  ++states_;

  Crystal crystal(potential_, a, size_.cells, size_.cells, size_.cells);
  Lammps& lammps = crystal.lammps();
  crystal.evaluate();
  const double cold_energy = lammps.variable("energy");
  const double cold_virial = lammps.variable("virial");
  lammps.command("timestep {:.17g}", dt);
  // Half of the kinetic energy of the perfect crystal is converted to potential energy within a vibration.
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * temperature, seed);
  lammps.command("fix integrate all nve");
  couple_to_bath(lammps, temperature, dt, seed);
  lammps.command("run {} post no", equilibration);
  const std::int64_t interval = sampling_interval(steps);
  auto series = crystal.sample({"energy", "virial", "displacement", "kinetic_temperature"}, interval, steps);
  State state;
  if (!search) state.crystal_share = inherent_crystal_share(crystal, potential_);
  transcript_ += lammps.transcript();

  const std::vector<double>& displacement = series[2];
  const auto tail = static_cast<std::ptrdiff_t>(displacement.size() / 10 + 1);
  const double last_displacement =
      std::accumulate(displacement.end() - tail, displacement.end(), 0.0) / static_cast<double>(tail);
  const double neighbour = nearest_neighbour(potential_.structure(), a);
  state.solid = std::sqrt(last_displacement) < melting_displacement * neighbour &&
                state.crystal_share > solid_share_limit;

  // Equations 3 to 5: kinetic part of 3N degrees of freedom; the potential part of a crystal has 3N - 3.
  const double n = crystal.atoms();
  const double modes = state.solid ? n / (n - 1.0) : 1.0;
  const double kinetic_energy = 1.5 * metal::boltzmann * temperature;  // eV
  const double kinetic_pressure =
      metal::boltzmann * temperature / atomic_volume * metal::pressure_from_energy;  // bar
  series[0] = in_bath(series[0], cold_energy, series[3], temperature, interval);
  series[1] = in_bath(series[1], cold_virial, series[3], temperature, interval);
  for (double& energy : series[0]) energy = cold_energy + modes * (energy - cold_energy) + kinetic_energy;
  for (double& virial : series[1]) virial = cold_virial + modes * (virial - cold_virial) + kinetic_pressure;
  const Estimate energy = series_mean(series[0]);
  require_stable(state.solid, energy, cold_energy, temperature, potential_);
  const Estimate pressure = series_mean(series[1]);
  state.specific_internal_energy = {metal::specific_energy(energy.value, mass),
                                    metal::specific_energy(energy.error, mass)};
  state.pressure = {pressure.value * metal::bar, pressure.error * metal::bar};
  state.correlation = error_correlation(series[0], series[1]);
  for (const double mean : block_means(series[0])) {
    state.energy_blocks.push_back(metal::specific_energy(mean, mass));
  }
  for (const double mean : block_means(series[1])) state.pressure_blocks.push_back(mean * metal::bar);
  const double square = metal::angstrom * metal::angstrom;
  state.mean_square_displacement = {last_displacement * square, series_mean(displacement).error * square};
  return state;
}

}  // namespace whipple::md
