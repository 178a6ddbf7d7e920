// SPDX-License-Identifier: BSD-3-Clause
// Fluid at constant volume and temperature: hot liquid, supercritical and expanded fluid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/bath.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"

namespace whipple::md {
namespace {

/// Share of crystalline atoms above which a melt has frozen, as of `liquid`.
constexpr double largest_liquid_share = 0.25;
constexpr double thinnest_crystal = 1.5;  ///< V over that of the static crystal
/// Structure factor of the longest waves above which a fluid separates or is about to: 1 in an ideal gas, less in a melt,
/// growing without bound towards the spinodal; where it exceeds 4 the box is too small for the fluctuations.
constexpr double largest_structure_factor = 4.0;

/// Defines the variable `density_wave`: |sum exp(2 pi i x/L)|^2/N^2 of the longest waves of the box, mean of the three
/// directions.
void define_density_wave(Crystal& crystal) {
  Lammps& lammps = crystal.lammps();
  std::string sums, squares;
  for (const char axis : {'x', 'y', 'z'}) {
    for (const char* function : {"cos", "sin"}) {
      const std::string name = fmt::format("wave_{}_{}", function, axis);
      lammps.command("variable {} atom {}(2*PI*{}/l{})", name, function, axis, axis);
      sums += " v_" + name;
      squares +=
          fmt::format("{}c_wave[{}]^2", squares.empty() ? "" : "+", 1 + std::ranges::count(squares, '^'));
    }
  }
  lammps.command("compute wave all reduce sum{}", sums);
  const double n = crystal.atoms();
  lammps.command("variable density_wave equal ({})/{:.17g}", squares, 3 * n * n);
  lammps.command("thermo_style custom step temp pe vol c_virial c_displacement[4] c_wave[1]");
  lammps.command("thermo_modify norm no");
}

TaskResult compute_fluid(const Potential& potential, const RunSize& size, std::int64_t seed, double volume,
                         double temperature) {
  const double ratio = volume / potential.static_volume(), mass = potential.mass();
  const double atomic_volume = metal::volume_per_atom(volume, mass);
  const double dt = time_step(potential, ratio, temperature, size);
  Crystal crystal(potential, std::cbrt(atomic_volume * potential.atoms_per_cell()), size.cells, size.cells,
                  size.cells);
  Lammps& lammps = crystal.lammps();
  make_melt(crystal, temperature, dt, seed);
  lammps.command("fix integrate all nve");
  couple_to_bath(lammps, temperature, dt, seed);
  lammps.command("run {} post no", size.equilibration_steps);
  define_density_wave(crystal);
  const std::int64_t interval = sampling_interval(size.steps);
  auto series =
      crystal.sample({"energy", "virial", "kinetic_temperature", "density_wave"}, interval, size.steps);
  // Of the second half: a fluid that separates takes its time.
  const std::vector<double>& waves = series[3];
  const Estimate wave =
      series_mean(std::vector(waves.begin() + static_cast<std::ptrdiff_t>(waves.size() / 2), waves.end()));
  // Thinner than any crystal: what condenses there is seen in the density.
  const double share = ratio < thinnest_crystal ? crystal_share(crystal, potential) : 0.0;

  // Equations 3 to 5 of a fluid: the kinetic part of 3N degrees of freedom is exact.
  const double kinetic_energy = 1.5 * metal::boltzmann * temperature;  // eV
  const double kinetic_pressure =
      metal::boltzmann * temperature / atomic_volume * metal::pressure_from_energy;  // bar
  for (double& energy : series[0]) energy += kinetic_energy;
  for (double& virial : series[1]) virial += kinetic_pressure;
  const Estimate energy = series_mean(series[0]), pressure = series_mean(series[1]);
  const bool froze = share > largest_liquid_share;
  const bool separated = wave.value * crystal.atoms() > largest_structure_factor;
  const FluidPoint point{.specific_volume = volume,
                         .temperature = temperature,
                         .pressure = {pressure.value * metal::bar, pressure.error * metal::bar},
                         .specific_internal_energy = {metal::specific_energy(energy.value, mass),
                                                      metal::specific_energy(energy.error, mass)},
                         .error_correlation = error_correlation(series[0], series[1]),
                         .crystal_share = share,
                         .density_wave = wave.value,
                         .uniform = !froze && !separated};
  std::vector<double> energies = block_means(series[0]), pressures = block_means(series[1]);
  for (double& mean : energies) mean = metal::specific_energy(mean, mass);
  for (double& mean : pressures) mean *= metal::bar;
  return {results_of(point),
          froze       ? "the melt froze"
          : separated ? "the fluid separated: the state lies between melt and vapour"
                      : "",
          lammps.transcript(),
          {blocks_of(&FluidPoint::pressure, pressures),
           blocks_of(&FluidPoint::specific_internal_energy, energies)}};
}

}  // namespace

void add_fluid(const Plan& plan, TaskList& list) {
  for (const FluidPlan& fluid : plan.fluids) {
    const RunSize size = fluid.size;
    const Precision precision = precision_of(&FluidPoint::pressure, false, fluid.target, size);
    for (const double ratio : fluid.volume_ratio) {
      list.require_range(ratio);
      const double volume = ratio * list.potential().static_volume();
      for (const double temperature : fluid.temperature) {
        list.add({conditions_of(FluidPoint{.specific_volume = volume, .temperature = temperature}),
                  size_settings(size),
                  {},
                  precision},
                 [&potential = list.potential(), size, volume, temperature](std::int64_t seed,
                                                                            const PointRecord*) {
                   return compute_fluid(potential, size, seed, volume, temperature);
                 });
      }
    }
  }
}

}  // namespace whipple::md
