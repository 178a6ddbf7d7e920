// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/coexistence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/base/error.hpp"
#include "src/base/hash.hpp"
#include "src/base/log.hpp"

namespace whipple::md {
namespace {

constexpr double accepted_sigmas = 3.0;
constexpr double least_accepted_share = 0.15;
constexpr double largest_accepted_drift = 0.12;
constexpr std::int64_t share_interval = 200;

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::int64_t next_seed(std::int64_t seed, const std::string& what) {
  return seed_from(sha256(fmt::format("{} {}", seed, what)));
}

/// One cell with crystal below and melt above, brought to the pressure and to about the guessed temperature.
class TwoPhaseCell {
 public:
  TwoPhaseCell(const Potential& potential, double pressure, double guess, const RunSize& size, double dt,
               std::int64_t seed)
      : crystal_(potential, 1.015 * potential.lattice_constant(), size.cells, size.cells, 2 * size.cells) {
    Lammps& lammps = crystal_.lammps();
    const double bars = pressure / metal::bar;
    const auto npt = [&](double temperature, const char* coupling) {
      return fmt::format("npt temp {0:.17g} {0:.17g} {1:.17g} {2} {3:.17g} {3:.17g} {4:.17g}", temperature,
                         100 * dt, coupling, bars, 1000 * dt);
    };
    // Crystal at the guess.
    lammps.command("timestep {:.17g}", dt);
    lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * guess, seed);
    lammps.command("fix whole all {}", npt(guess, "iso"));
    lammps.command("run 1500");
    lammps.command("unfix whole");
    const double a = std::cbrt(crystal_.lammps().variable("volume") * potential.atoms_per_cell());
    lammps.command("compute order all orientorder/atom degrees 1 6 nnn 12 cutoff {:.17g}", 0.85 * a);
    lammps.command("variable is_crystal atom c_order[1]>{}", crystal_order);
    lammps.command("compute share all reduce ave v_is_crystal");
    lammps.command("variable share equal c_share");
    // The upper half melts at constant volume while the lower half rests.
    lammps.command("variable middle equal 0.5*(zlo+zhi)");
    lammps.command("variable middle_now equal {:.17g}", lammps.variable("middle"));
    lammps.command("region upper block INF INF INF INF ${middle_now} INF units box");
    lammps.command("group upper region upper");
    lammps.command("compute upper_share upper reduce ave v_is_crystal");
    lammps.command("variable upper_share equal c_upper_share");
    lammps.command("thermo_style custom step temp pe vol c_virial c_displacement[4] c_share c_upper_share");
    lammps.command("thermo_modify norm no");
    crystal_.evaluate();
    crystal_reading_ = lammps.variable("share");
    lammps.command("velocity upper create {:.17g} {} mom yes rot no dist gaussian", overheating * guess,
                   next_seed(seed, "melt"));
    lammps.command("timestep {:.17g}", 0.5 * dt);
    lammps.command("fix melt upper nvt temp {0:.17g} {0:.17g} {1:.17g}", overheating * guess, 50 * dt);
    lammps.command("run 5000");
    lammps.command("unfix melt");
    lammps.command("timestep {:.17g}", dt);
    lammps.command("fix cool upper nvt temp {0:.17g} {0:.17g} {1:.17g}", guess, 100 * dt);
    lammps.command("run 1000");
    lammps.command("unfix cool");
    melt_reading_ = lammps.variable("upper_share");
    // Both halves together at the guess, then free at constant enthalpy.
    const std::string couplings = fmt::format(
        "x {0:.17g} {0:.17g} {1:.17g} y {0:.17g} {0:.17g} {1:.17g} z {0:.17g} "
        "{0:.17g} {1:.17g}",
        bars, 1000 * dt);
    lammps.command("fix whole all npt temp {0:.17g} {0:.17g} {1:.17g} {2}", guess, 100 * dt, couplings);
    lammps.command("run 1000");
    lammps.command("unfix whole");
    lammps.command("velocity all scale {:.17g}", guess);
    lammps.command("fix whole all nph {}", couplings);
    lammps.command("run {}", size.equilibration_steps);
  }

  /// Runs on and averages.
  CoexistenceRun run(std::int64_t steps) {
    Lammps& lammps = crystal_.lammps();
    lammps.command("fix shares all vector {} v_share", share_interval);
    const std::vector<double> temperature =
        crystal_.sample({"kinetic_temperature"}, sampling_interval(steps), steps)[0];
    std::vector<double> share = lammps.series("shares", 1)[0];
    lammps.command("unfix shares");
    for (double& s : share) s = (s - melt_reading_) / (crystal_reading_ - melt_reading_);
    const std::span<const double> t(temperature);
    const std::span<const double> x(share);
    const auto extremes = std::minmax_element(share.begin(), share.end());
    const SeriesMean whole = series_statistics(t);
    return {series_mean(t.first(t.size() / 2)),
            series_mean(t.last(t.size() / 2)),
            mean(x.first(x.size() / 2)),
            mean(x.last(x.size() / 2)),
            *extremes.first,
            *extremes.second,
            {whole.estimate.value, coexistence_error(whole, crystal_.atoms())}};
  }
  [[nodiscard]] const std::string& transcript() { return crystal_.lammps().transcript(); }

 private:
  Crystal crystal_;
  double crystal_reading_ = 1.0;  // share that the order parameter finds in the hot crystal (about 0.5)
  double melt_reading_ = 0.0;     // and in the melt (about 0.05)
};

}  // namespace

double coexistence_error(const SeriesMean& temperature, double atoms) {
  constexpr double clearly = 1.3;  // standard errors of the variance
  const Estimate& mean = temperature.estimate;
  const double own = mean.error * mean.error;
  const double whole = 2.0 * mean.value * mean.value / (3.0 * atoms);
  const double lacking = whole - temperature.variance;
  return lacking > own + clearly * temperature.spread * whole ? std::sqrt(lacking) : mean.error;
}

std::string refusal(const CoexistenceRun& run) {
  const double difference = std::abs(run.first_half.value - run.second_half.value);
  const double sigma =
      std::fmax(std::hypot(run.first_half.error, run.second_half.error), 2.0 * run.whole.error);
  if (run.largest_share > 1.0 - least_accepted_share) {
    return fmt::format("the melt froze (share of crystal up to {:.2f})", run.largest_share);
  }
  if (run.least_share < least_accepted_share) {
    return fmt::format("the crystal melted (share of crystal down to {:.2f})", run.least_share);
  }
  if (std::abs(run.first_share - run.second_share) > largest_accepted_drift) {
    return fmt::format("the share of crystal drifts from {:.2f} to {:.2f}", run.first_share,
                       run.second_share);
  }
  if (difference > accepted_sigmas * sigma) {
    return fmt::format("the temperature drifts from {:.1f} K to {:.1f} K", run.first_half.value,
                       run.second_half.value);
  }
  return {};
}

CoexistenceResult measure_coexistence(const Potential& potential, double pressure, double first_guess,
                                      std::int64_t attempts, const RunSize& size, std::int64_t seed) {
  if (potential.structure() != "fcc") {
    throw InputError(fmt::format("coexistence is measured for fcc crystals, {} of {} is {}",
                                 potential.element(), potential.name(), potential.structure()));
  }
  // The melting line that is meant here lies below a few 10 GPa: the temperature of the crystal decides, not
  // the guess.
  const double dt =
      size.time_step > 0.0 ? size.time_step / metal::picosecond : time_step(potential, 1.0, 300.0, size);
  CoexistenceResult result;
  std::string report;
  double guess = first_guess;
  double temperature = 0.0;
  for (std::int64_t attempt = 1; attempt <= attempts && temperature == 0.0; ++attempt) {
    TwoPhaseCell cell(potential, pressure, guess, size, dt,
                      next_seed(seed, fmt::format("attempt {}", attempt)));
    // A cell that still has both phases only needs more time; one that has lost a phase is of no use.
    for (int part = 0; part < 3; ++part) {
      const CoexistenceRun run = cell.run(size.steps);
      const std::string reason = refusal(run);
      const double half_difference = 0.5 * std::abs(run.first_half.value - run.second_half.value);
      guess = run.second_half.value;
      log::detail(
          "coexistence at {} GPa, attempt {}.{}: {:.1f} K, then {:.1f} K, mean {:.1f} +- {:.1f} K, share of "
          "crystal {:.2f} ... {:.2f}: {}",
          1e-9 * pressure, attempt, part + 1, run.first_half.value, run.second_half.value, run.whole.value,
          run.whole.error, run.least_share, run.largest_share, reason.empty() ? "accepted" : reason);
      if (reason.empty()) {
        temperature = run.whole.value;
        result.melting_temperature = {temperature, std::max(run.whole.error, half_difference)};
        result.solid_share = {0.5 * (run.first_share + run.second_share),
                              0.5 * std::abs(run.first_share - run.second_share)};
        break;
      }
      report += fmt::format("{}attempt {}.{} at {:.1f} K: {}", report.empty() ? "" : "; ", attempt, part + 1,
                            run.whole.value, reason);
      const bool both_phases =
          run.least_share > least_accepted_share && run.largest_share < 1 - least_accepted_share;
      if (!both_phases) break;
    }
    result.attempts = static_cast<int>(attempt);
    result.transcript += cell.transcript();
  }
  if (temperature == 0.0) {
    throw StateError(fmt::format("no coexistence found at {} GPa: {}", 1e-9 * pressure, report));
  }
  const RunSize phase_size{.cells = std::max<std::int64_t>(4, 3 * size.cells / 4),
                           .equilibration_steps = size.equilibration_steps / 2,
                           .steps = size.steps / 2};
  const Phase solid = measure_phase(potential, false, pressure, temperature, phase_size, dt,
                                    next_seed(seed, "solid"), result.transcript);
  const Phase liquid = measure_phase(potential, true, pressure, temperature, phase_size, dt,
                                     next_seed(seed, "liquid"), result.transcript);
  const double mass = potential.mass();
  const auto volume = [&](const Estimate& e) {
    return Estimate{metal::specific_volume(e.value, mass), metal::specific_volume(e.error, mass)};
  };
  result.solid_specific_volume = volume(solid.volume);
  result.liquid_specific_volume = volume(liquid.volume);
  result.fusion_volume = {
      result.liquid_specific_volume.value - result.solid_specific_volume.value,
      std::hypot(result.liquid_specific_volume.error, result.solid_specific_volume.error)};
  result.latent_heat = {
      metal::specific_energy(liquid.enthalpy.value - solid.enthalpy.value, mass),
      metal::specific_energy(std::hypot(liquid.enthalpy.error, solid.enthalpy.error), mass)};
  return result;
}

void add_coexistence(const Plan& plan, TaskList& list) {
  if (!plan.coexistence) return;
  const CoexistencePlan& melting = *plan.coexistence;
  for (std::size_t i = 0; i < melting.pressure.size(); ++i) {
    PointRequest request{{{"pressure", melting.pressure[i]}},
                         size_settings(melting.size),
                         {},
                         precision_of("melting_temperature", false, melting.target, melting.size)};
    request.settings["first_guess"] = fmt::format("{}", melting.first_guess[i]);
    request.settings["attempts"] = std::to_string(melting.attempts);
    list.add(request, [&potential = list.potential(), size = melting.size, pressure = melting.pressure[i],
                       guess = melting.first_guess[i],
                       attempts = melting.attempts](std::int64_t seed, const PointRecord*) {
      const CoexistenceResult result = measure_coexistence(potential, pressure, guess, attempts, size, seed);
      return TaskResult{{{"melting_temperature", result.melting_temperature},
                         {"solid_share", result.solid_share},
                         {"solid_specific_volume", result.solid_specific_volume},
                         {"liquid_specific_volume", result.liquid_specific_volume},
                         {"latent_heat", result.latent_heat},
                         {"fusion_volume", result.fusion_volume}},
                        fmt::format("accepted at attempt {}", result.attempts),
                        result.transcript};
    });
  }
}

}  // namespace whipple::md
