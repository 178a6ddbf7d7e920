// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/spall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Fraction of the maximum tension below which a run counts as failed.
constexpr double failed_share = 0.5;
/// Volume strain over which the tension is averaged: much less than the failure strain.
constexpr double window_strain = 0.004;
constexpr double part_strain = 0.02;
constexpr std::int64_t interval = 5;

SpallPoint stretch(const Potential& potential, double temperature, const SpallPlan& section,
                   std::int64_t seed, std::string& transcript) {
  const std::int64_t cells = section.size.cells;
  // Half of the usual step: the failure is sudden and hot.
  const double dt =
      (section.size.time_step > 0.0 ? 1.0 : 0.5) * time_step(potential, 1.0, temperature, section.size);
  Crystal crystal(potential, potential.lattice_constant(), cells, cells, cells);
  Lammps& lammps = crystal.lammps();
  lammps.command("timestep {:.17g}", dt);
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * temperature, seed);
  lammps.command("fix rest all npt temp {0:.17g} {0:.17g} {1:.17g} iso 0.0 0.0 {2:.17g}", temperature,
                 100 * dt, 1000 * dt);
  lammps.command("run {} post no", section.size.equilibration_steps);
  lammps.command("unfix rest");
  if (crystal_share(crystal, potential) < 0.25) {
    throw StateError(fmt::format("the crystal melted at {} K and zero pressure", temperature));
  }
  const double initial_volume = lammps.variable("volume");  // A^3 per atom

  // Every edge grows at one constant rate and every atom initially moves with its position: a uniform expansion
  // without a driving force. Temperature and pressure are those of the motion relative to it.
  const double rate = section.strain_rate * metal::picosecond / 3.0;  // 1/ps, of each edge
  for (const char axis : {'x', 'y', 'z'}) {
    lammps.command("variable flow_{0} atom {1:.17g}*({0}-0.5*({0}lo+{0}hi))", axis, rate);
  }
  lammps.command("velocity all set v_flow_x v_flow_y v_flow_z sum yes units box");
  lammps.command("fix move all nve");
  lammps.command("fix stretch all deform 1 x erate {0:.17g} y erate {0:.17g} z erate {0:.17g} remap v", rate);
  lammps.command("compute relative all temp/deform");
  lammps.command("compute relative_pressure all pressure relative");
  lammps.command("variable tension equal -c_relative_pressure");
  lammps.command("variable relative_temperature equal c_relative");
  lammps.command("thermo_style custom step pe vol c_virial c_displacement[4] c_relative c_relative_pressure");
  lammps.command("thermo_modify norm no");

  const double strain_per_step = section.strain_rate * metal::picosecond * dt;
  const auto steps = std::max<std::int64_t>(interval, std::llround(part_strain / strain_per_step));
  const auto window = static_cast<std::size_t>(
      std::max(8.0, window_strain / (strain_per_step * static_cast<double>(interval))));
  std::array<std::vector<double>, 3> history;
  double strain = 0.0;
  while (strain < section.largest_strain) {
    const auto part = crystal.sample({"tension", "relative_temperature", "volume"}, interval, steps);
    // The first sample of a part is the last of the previous one.
    for (std::size_t k = 0; k < 3; ++k)
      history[k].insert(history[k].end(), part[k].begin() + 1, part[k].end());
    strain = history[2].back() / initial_volume - 1.0;
    const std::span<const double> tension(history[0]);
    if (tension.size() < 2 * window) continue;
    const Peak peak = largest_mean(tension, window);
    if (!(peak.value > 0.0) || mean(tension.last(window)) > failed_share * peak.value) continue;
    const auto at_peak = [&](const std::vector<double>& series) {
      return mean(std::span<const double>(series).subspan(peak.first, window));
    };
    transcript += lammps.transcript();
    const double mass = potential.mass();
    return {.temperature = temperature,
            .strain_rate = section.strain_rate,
            .spall_strength = {metal::bar * peak.value, 0.0},
            .spall_temperature = {at_peak(history[1]), 0.0},
            .spall_specific_volume = {metal::specific_volume(at_peak(history[2]), mass), 0.0},
            .specific_volume = {metal::specific_volume(initial_volume, mass), 0.0}};
  }
  throw StateError(fmt::format("no failure up to a volume strain of {:.3g}; the tension is {:.4g} GPa",
                               strain, 1e-9 * metal::bar * history[0].back()));
}

}  // namespace

Peak largest_mean(std::span<const double> series, std::size_t window) {
  if (window == 0 || series.size() < window) throw InternalError("the window is longer than the series");
  double sum = std::accumulate(series.begin(), series.begin() + static_cast<std::ptrdiff_t>(window), 0.0);
  Peak peak{sum, 0};
  for (std::size_t i = window; i < series.size(); ++i) {
    sum += series[i] - series[i - window];
    if (sum > peak.value) peak = {sum, i + 1 - window};
  }
  peak.value /= static_cast<double>(window);
  return peak;
}

ReplicaSet<SpallPoint> measure_spall(const Potential& potential, double temperature, const SpallPlan& section,
                                     std::int64_t seed) {
  return run_replicas<SpallPoint>(section.replicas, seed,
                                  [&](std::int64_t own_seed, std::string& transcript) {
                                    return stretch(potential, temperature, section, own_seed, transcript);
                                  });
}

void add_spall(const Plan& plan, TaskList& list) {
  if (!plan.spall) return;
  const SpallPlan section = *plan.spall;
  for (const double temperature : section.temperature) {
    PointRequest request{
        conditions_of(SpallPoint{.temperature = temperature, .strain_rate = section.strain_rate}),
        size_settings(section.size),
        {}};
    request.settings["replicas"] = std::to_string(section.replicas);
    request.settings["largest_strain"] = fmt::format("{}", section.largest_strain);
    request.settings.erase("steps");  // a run ends with the failure
    list.add(request,
             [&potential = list.potential(), section, temperature](std::int64_t seed, const PointRecord*) {
               return to_result<SpallPoint>(measure_spall(potential, temperature, section, seed));
             });
  }
}

}  // namespace whipple::md
