// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/coexistence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/compressed_start.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"

namespace whipple::md {
namespace {

constexpr double accepted_sigmas = 3.0;
constexpr double least_accepted_share = 0.15;
constexpr double largest_accepted_drift = 0.12;
constexpr double largest_order_of_melt = 0.35;
constexpr double least_order_of_crystal = 0.5;
/// Relative temperature step after a start that lost a phase, as long as there is no bound on the other side.
constexpr double start_step = 0.04;
constexpr int most_parts = 3;
/// Estimated relative volume change on melting; fcc metals expand by 3 to 7 %.
constexpr double melting_expansion = 0.05;
constexpr std::int64_t share_interval = 200;

std::int64_t next_seed(std::int64_t seed, const std::string& what) {
  return seed_from(sha256(fmt::format("{} {}", seed, what)));
}

/// Holds one cell with crystal below and melt above, at the pressure and about the guessed temperature.
class TwoPhaseCell {
 public:
  TwoPhaseCell(const Potential& potential, double pressure, double guess, const CoexistencePlan& section,
               double dt, std::int64_t seed)
      : layers_(section.length),
        crystal_(potential, 1.015 * compressed_start(potential, pressure).lattice_constant,
                 section.size.cells, section.size.cells, section.length) {
    Lammps& lammps = crystal_.lammps();
    const double bars = pressure / metal::bar;
    const auto npt = [&](double temperature, const char* coupling) {
      return fmt::format("npt temp {0:.17g} {0:.17g} {1:.17g} {2} {3:.17g} {3:.17g} {4:.17g}", temperature,
                         100 * dt, coupling, bars, 1000 * dt);
    };
    // Equilibrate the crystal at the guess.
    lammps.command("timestep {:.17g}", dt);
    lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * guess, seed);
    lammps.command("fix whole all {}", npt(guess, "iso"));
    lammps.command("run 1500");
    lammps.command("unfix whole");
    define_crystal_order(lammps, potential);
    lammps.command("compute share all reduce ave v_is_crystal");
    lammps.command("variable share equal c_share");
    // The upper half, stretched to the volume of a melt (a compressed one refreezes as it cools), melts at constant
    // volume while the lower half is held fixed.
    lammps.command("variable middle equal 0.5*(zlo+zhi)");
    lammps.command("variable middle_now equal {:.17g}", lammps.variable("middle"));
    lammps.command("region upper block INF INF INF INF ${middle_now} INF units box");
    lammps.command("group upper region upper");
    lammps.command("variable top equal zhi");
    const double top = lammps.variable("top");
    const double stretch = melting_expansion * (top - lammps.variable("middle"));
    lammps.command("change_box all z delta 0 {:.17g} units box", stretch);
    lammps.command("displace_atoms upper ramp z 0 {:.17g} z ${{middle_now}} {:.17g} units box", stretch, top);
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
    // Both halves are first equilibrated at the guess, then released at constant enthalpy.
    const std::string couplings = fmt::format(
        "x {0:.17g} {0:.17g} {1:.17g} y {0:.17g} {0:.17g} {1:.17g} z {0:.17g} "
        "{0:.17g} {1:.17g}",
        bars, 1000 * dt);
    lammps.command("fix whole all npt temp {0:.17g} {0:.17g} {1:.17g} {2}", guess, 100 * dt, couplings);
    lammps.command("run 1000");
    lammps.command("unfix whole");
    lammps.command("velocity all scale {:.17g}", guess);
    lammps.command("fix whole all nph {}", couplings);
    log::detail("fraction of crystal by the order parameter: {:.3f} in the crystal, {:.3f} in the melt",
                crystal_reading_, melt_reading_);
    lammps.command("run {}", section.size.equilibration_steps);
    // Crystal order in layers of one unit cell each.
    std::string flags;
    for (std::int64_t k = 0; k < layers_; ++k) {
      lammps.command("variable crystal_{0} atom v_is_crystal*(floor((z-zlo)/lz*{1})=={0})", k, layers_);
      flags += fmt::format(" v_crystal_{}", k);
    }
    lammps.command("compute layer_order all reduce ave{}", flags);
  }

  /// Continues the run and averages.
  CoexistenceRun run(std::int64_t steps) {
    Lammps& lammps = crystal_.lammps();
    std::string columns = "v_share";
    for (std::int64_t k = 1; k <= layers_; ++k) columns += fmt::format(" c_layer_order[{}]", k);
    lammps.command("fix shares all vector {} {}", share_interval, columns);
    const std::vector<double> temperature =
        crystal_.sample({"kinetic_temperature"}, sampling_interval(steps), steps)[0];
    std::vector<std::vector<double>> shares = lammps.series("shares", static_cast<int>(layers_) + 1);
    lammps.command("unfix shares");
    const auto normalised = [&](double s) {
      return (s - melt_reading_) / (crystal_reading_ - melt_reading_);
    };
    // The first sample is taken before the run has built its neighbour list.
    for (std::vector<double>& column : shares) column.erase(column.begin());
    for (double& s : shares[0]) s = normalised(s);
    const std::span<const double> t(temperature);
    const std::span<const double> x(shares[0]);
    const auto extremes = std::minmax_element(x.begin(), x.end());
    const SeriesMean whole = series_statistics(t);
    CoexistenceRun run{series_mean(t.first(t.size() / 2)),
                       series_mean(t.last(t.size() / 2)),
                       mean(x.first(x.size() / 2)),
                       mean(x.last(x.size() / 2)),
                       *extremes.first,
                       *extremes.second,
                       1.0,
                       0.0,
                       {whole.estimate.value, coexistence_error(whole, crystal_.atoms())}};
    for (std::size_t k = 1; k < shares.size(); ++k) {
      const double of_all_atoms = mean(std::span<const double>(shares[k]).last(x.size() / 2));
      const double order = normalised(of_all_atoms * static_cast<double>(layers_));
      run.least_order = std::min(run.least_order, order);
      run.largest_order = std::max(run.largest_order, order);
    }
    return run;
  }
  [[nodiscard]] const std::string& transcript() { return crystal_.lammps().transcript(); }

 private:
  std::int64_t layers_;
  Crystal crystal_;
  double crystal_reading_ = 1.0;  // fraction found by the order parameter in the hot crystal (about 0.5)
  double melt_reading_ = 0.0;     // and in the melt (about 0.05)
};

bool froze(const CoexistenceRun& run) {
  return run.largest_share > 1.0 - least_accepted_share || run.least_order > largest_order_of_melt;
}
bool melted(const CoexistenceRun& run) {
  return run.least_share < least_accepted_share || run.largest_order < least_order_of_crystal;
}

/// Returns the temperature of crystal and melt in contact, and the crystal fraction, from one cell, or from the
/// next one if that lost a phase.
std::pair<double, double> find_coexistence(const Potential& potential, double pressure, double first_guess,
                                           const CoexistencePlan& section, double dt, std::int64_t seed,
                                           std::string& transcript) {
  StartingTemperature start(first_guess);
  std::string report;
  for (std::int64_t attempt = 1; attempt <= section.attempts; ++attempt) {
    TwoPhaseCell cell(potential, pressure, start.next(), section, dt,
                      next_seed(seed, fmt::format("attempt {}", attempt)));
    // A cell that still has both phases only needs more time; one that has lost a phase is discarded.
    for (int part = 1; part <= most_parts; ++part) {
      const CoexistenceRun run = cell.run(section.size.steps);
      const std::string reason = refusal(run);
      log::detail(
          "coexistence at {} GPa, attempt {}.{}: {:.1f} K, then {:.1f} K, mean {:.1f} +- {:.1f} K, fraction "
          "of "
          "crystal {:.2f} ... {:.2f}, by layers {:.2f} ... {:.2f}: {}",
          1e-9 * pressure, attempt, part, run.first_half.value, run.second_half.value, run.whole.value,
          run.whole.error, run.least_share, run.largest_share, run.least_order, run.largest_order,
          reason.empty() ? "accepted" : reason);
      if (reason.empty()) {
        transcript += cell.transcript();
        return {run.whole.value, 0.5 * (run.first_share + run.second_share)};
      }
      report += fmt::format("{}attempt {}.{} from {:.1f} K at {:.1f} K: {}", report.empty() ? "" : "; ",
                            attempt, part, start.next(), run.whole.value, reason);
      if (froze(run)) {
        start.froze();
        break;
      }
      if (melted(run)) {
        start.melted();
        break;
      }
      if (part == most_parts) start.ended_at(run.second_half.value);
    }
  }
  throw StateError(fmt::format("no coexistence found at {} GPa: {}", 1e-9 * pressure, report));
}

/// Computes one run of the point.
CoexistencePoint melting_point(const Potential& potential, double pressure, double first_guess,
                               const CoexistencePlan& section, double dt, std::int64_t seed,
                               std::string& transcript) {
  const auto [temperature, share] =
      find_coexistence(potential, pressure, first_guess, section, dt, seed, transcript);
  const RunSize& size = section.size;
  const RunSize phase_size{.cells = std::max<std::int64_t>(4, 3 * size.cells / 4),
                           .equilibration_steps = size.equilibration_steps / 2,
                           .steps = size.steps / 2};
  const Phase solid = measure_phase(potential, false, pressure, temperature, phase_size, dt,
                                    next_seed(seed, "solid"), transcript);
  const Phase liquid = measure_phase(potential, true, pressure, temperature, phase_size, dt,
                                     next_seed(seed, "liquid"), transcript);
  const double mass = potential.mass();
  const double solid_volume = metal::specific_volume(solid.volume.value, mass);
  const double liquid_volume = metal::specific_volume(liquid.volume.value, mass);
  const double latent_heat = metal::specific_energy(liquid.enthalpy.value - solid.enthalpy.value, mass);
  return {.pressure = pressure,
          .melting_temperature = {temperature, 0.0},
          .solid_share = {share, 0.0},
          .solid_specific_volume = Estimate{solid_volume, 0.0},
          .liquid_specific_volume = Estimate{liquid_volume, 0.0},
          .latent_heat = Estimate{latent_heat, 0.0},
          .fusion_volume = Estimate{liquid_volume - solid_volume, 0.0}};
}

}  // namespace

void StartingTemperature::froze() {
  too_cold_ = std::max(too_cold_, next_);
  next_ = too_hot_ > too_cold_ ? 0.5 * (too_cold_ + too_hot_) : (1.0 + start_step) * too_cold_;
}

void StartingTemperature::melted() {
  too_hot_ = too_hot_ > 0.0 ? std::min(too_hot_, next_) : next_;
  next_ =
      too_cold_ > 0.0 && too_cold_ < too_hot_ ? 0.5 * (too_cold_ + too_hot_) : (1.0 - start_step) * too_hot_;
}

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
  if (froze(run)) {
    return fmt::format("the melt froze (fraction of crystal up to {:.2f}, {:.2f} in the least ordered layer)",
                       run.largest_share, run.least_order);
  }
  if (melted(run)) {
    return fmt::format(
        "the crystal melted (fraction of crystal down to {:.2f}, {:.2f} in the most ordered layer)",
        run.least_share, run.largest_order);
  }
  if (std::abs(run.first_share - run.second_share) > largest_accepted_drift) {
    return fmt::format("the fraction of crystal drifts from {:.2f} to {:.2f}", run.first_share,
                       run.second_share);
  }
  if (difference > accepted_sigmas * sigma) {
    return fmt::format("the temperature drifts from {:.1f} K to {:.1f} K", run.first_half.value,
                       run.second_half.value);
  }
  return {};
}

ReplicaSet<CoexistencePoint> measure_coexistence(const Potential& potential, double pressure,
                                                 double first_guess, const CoexistencePlan& section,
                                                 std::int64_t seed) {
  if (potential.structure() == CrystalStructure::hcp) {
    throw InputError(fmt::format("coexistence is measured for fcc and bcc crystals, {} of {} is {}",
                                 potential.element(), potential.name(), word_of(potential.structure())));
  }
  // Near zero pressure the time step of the cold crystal is sufficient; under strong compression the melt is hot as
  // well.
  const CompressedStart start_crystal = compressed_start(potential, pressure);
  const bool compressed = start_crystal.volume_ratio < 1.0;
  const double dt =
      time_step(potential, start_crystal.volume_ratio, compressed ? first_guess : 300.0, section.size);
  // Memory of the start would be common to all replicas: they begin at the end of a run from the guess, which does
  // not enter the mean.
  std::string search;
  const double start =
      find_coexistence(potential, pressure, first_guess, section, dt, next_seed(seed, "search"), search)
          .first;
  auto set = run_replicas<CoexistencePoint>(
      section.replicas, seed, [&](std::int64_t own_seed, std::string& transcript) {
        return melting_point(potential, pressure, start, section, dt, own_seed, transcript);
      });
  set.transcript.insert(0, search);
  return set;
}

void add_coexistence(const Plan& plan, TaskList& list) {
  for (const CoexistencePlan& section : plan.coexistences) {
    for (std::size_t i = 0; i < section.pressure.size(); ++i) {
      PointRequest request{conditions_of(CoexistencePoint{.pressure = section.pressure[i]}),
                           size_settings(section.size),
                           {},
                           precision_of(&CoexistencePoint::melting_temperature, false, section.target,
                                        section.size, section.replicas)};
      request.settings["first_guess"] = fmt::format("{}", section.first_guess[i]);
      request.settings["attempts"] = std::to_string(section.attempts);
      request.settings["replicas"] = std::to_string(section.replicas);
      request.settings["length"] = std::to_string(section.length);
      list.add(request, [&potential = list.potential(), section, i](std::int64_t seed, const PointRecord*) {
        return to_result<CoexistencePoint>(
            measure_coexistence(potential, section.pressure[i], section.first_guess[i], section, seed));
      });
    }
  }
}

}  // namespace whipple::md
