// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/hugoniostat.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/cold_curve.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr int most_parts = 10;
/// Residual, as a fraction of the shock heating, up to which a point counts as converged.
constexpr double accepted_residual = 0.02;

}  // namespace

HugoniostatResult run_hugoniostat(const Potential& potential, const ReferenceState& reference,
                                  double pressure, const RunSize& size, std::int64_t seed) {
  const HugoniotGuess guess = guess_hugoniot_at_pressure(potential, reference, pressure);
  const double ratio = guess.specific_volume / potential.static_volume();
  potential.require_range(ratio);
  const double mass = potential.mass();
  const CrystalStructure structure = potential.structure();
  const double dt = time_step(potential, ratio, guess.temperature, size);
  HugoniostatResult result;
  result.imposed_pressure = pressure;

  // The centre of mass of the simulated crystal is at rest, which was corrected for in the reference (equations 4
  // and 7): the thermostat needs the reference of a crystal of the simulated size.
  const double n = 4.0 * std::pow(static_cast<double>(size.cells), 3) * (potential.atoms_per_cell() / 4.0);
  const double modes = n / (n - 1.0);
  const ColdState rest = measure_cold(potential, structure, potential.static_volume(), result.transcript);
  const double reference_energy =
      rest.specific_internal_energy +
      (reference.specific_internal_energy.value - rest.specific_internal_energy) / modes;
  const double reference_volume =
      potential.static_volume() + (reference.specific_volume.value - potential.static_volume()) / modes;
  const double electron_volt = metal::specific_energy(1.0, mass);  // J/kg of 1 eV per atom

  const double a =
      std::cbrt(metal::volume_per_atom(guess.specific_volume, mass) * potential.atoms_per_cell());
  Crystal crystal(potential, a, size.cells, size.cells, size.cells);
  Lammps& lammps = crystal.lammps();
  lammps.command("variable total_energy equal (pe+ke)/{:.17g}", n);
  lammps.command("variable total_pressure equal press");
  lammps.command("thermo_style custom step temp pe ke press vol c_virial c_displacement[4]");
  lammps.command("thermo_modify norm no");
  lammps.command("timestep {:.17g}", dt);
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * guess.temperature,
                 seed);
  // The temperatures of the command are placeholders: the fix sets the target from the residual.
  lammps.command("fix shock all nphug temp 1.0 1.0 {0:.17g} iso {1:.17g} {1:.17g} {2:.17g}", 100 * dt,
                 pressure / metal::bar, 1000 * dt);
  lammps.command("fix_modify shock e0 {:.17g} v0 {:.17g} p0 {:.17g}", n * reference_energy / electron_volt,
                 n * metal::volume_per_atom(reference_volume, mass), reference.pressure / metal::bar);

  const double heat = 3.0 * metal::specific_energy(metal::boltzmann, mass);  // J/(kg K)
  const auto sample = [&](std::int64_t steps) {
    auto series = crystal.sample({"total_energy", "total_pressure", "volume", "kinetic_temperature"},
                                 sampling_interval(steps), steps);
    for (double& energy : series[0]) energy *= electron_volt;
    for (double& p : series[1]) p *= metal::bar;
    for (double& volume : series[2]) volume = metal::specific_volume(volume, mass);
    std::vector<double> residual(series[0].size());
    for (std::size_t i = 0; i < residual.size(); ++i) {
      residual[i] = (series[0][i] - reference_energy -
                     0.5 * (series[1][i] + reference.pressure) * (reference_volume - series[2][i])) /
                    heat;
    }
    series.push_back(residual);
    return series;
  };
  const auto settled = [&](const Estimate& residual, double temperature) {
    return std::abs(residual.value) <=
           std::fmax(2.0 * residual.error, accepted_residual * (temperature - 0.5 * guess.temperature));
  };
  for (result.parts = 1; result.parts <= most_parts; ++result.parts) {
    const auto series = sample(size.equilibration_steps);
    if (settled(series_mean(series[4]), series_mean(series[3]).value)) break;
  }
  const auto series = sample(size.steps);
  result.residual_temperature = series_mean(series[4]);
  result.temperature = series_mean(series[3]);
  result.converged = settled(result.residual_temperature, result.temperature.value);

  // Energy and pressure of a crystal without the size effect, relative to the static one at the mean volume.
  result.specific_volume = series_mean(series[2]);
  const double v = result.specific_volume.value;
  const ColdState cold = measure_cold(potential, structure, v, result.transcript);
  const Estimate energy = series_mean(series[0]);
  result.specific_internal_energy = {
      cold.specific_internal_energy + modes * (energy.value - cold.specific_internal_energy), energy.error};
  const Estimate mean_pressure = series_mean(series[1]);
  result.pressure = {cold.pressure + modes * (mean_pressure.value - cold.pressure), mean_pressure.error};

  // Jump conditions (equation 9) at the imposed pressure, which the mean approaches as 1/t. The noise of the volume
  // includes the effect of the noise of the residual at that pressure; the residual of a run that has not
  // converged, interpreted as heat at constant volume, is added.
  const double compression = reference.specific_volume.value - v;
  const double jump = cold.pressure + modes * (pressure - cold.pressure) - reference.pressure;
  if (!(compression > 0.0 && jump > 0.0)) throw StateError("the Hugoniostat did not compress the crystal");
  const double gruneisen = 2.0 * v / reference.specific_volume.value;
  const double missed = result.converged ? 0.0 : std::abs(result.residual_temperature.value);
  const double heated = missed * heat * gruneisen / v / (1.0 - 0.5 * gruneisen * compression / v) / jump;
  const double noise =
      std::hypot(result.specific_volume.error, reference.specific_volume.error) / compression;
  const double relative_error = 0.5 * std::hypot(noise, heated);
  const double shock = reference.specific_volume.value * std::sqrt(jump / compression);
  const double particle = std::sqrt(jump * compression);
  result.shock_velocity = {shock, shock * relative_error};
  result.particle_velocity = {particle, particle * relative_error};
  result.crystal_share = inherent_crystal_share(crystal, potential);
  result.solid = result.crystal_share > solid_share_limit;
  result.transcript += lammps.transcript();
  return result;
}

void add_hugoniostat(const Plan& plan, TaskList& list) {
  if (!plan.hugoniostat) return;
  const RunSize size = plan.hugoniostat->size;
  for (const double pressure : plan.hugoniostat->pressure) {
    // Estimate the compression from the static crystal at zero pressure: sufficient to detect the end of the table.
    const Potential& potential = list.potential();
    const ReferenceState at_rest = static_reference(potential);
    try {
      list.require_range(guess_hugoniot_at_pressure(potential, at_rest, pressure).specific_volume /
                         potential.static_volume());
    } catch (const StateError& error) {
      list.fault(error.what());
    }
    list.add({conditions_of(HugoniostatPoint{.imposed_pressure = pressure}), size_settings(size),
              list.first_key(ZeroPressurePoint::protocol)},
             [&potential, size, pressure](std::int64_t seed, const PointRecord* zero_pressure) {
               const ReferenceState reference = reference_state(*zero_pressure);
               const HugoniostatResult state = run_hugoniostat(potential, reference, pressure, size, seed);
               std::string message = structure_remark(state.crystal_share, state.solid);
               if (!state.converged) {
                 message += fmt::format("{}not converged: the Hugoniot is missed by {:.1f} K",
                                        message.empty() ? "" : "; ", state.residual_temperature.value);
               }
               return TaskResult{results_of<HugoniostatPoint>(state), message, state.transcript};
             });
  }
}

}  // namespace whipple::md
