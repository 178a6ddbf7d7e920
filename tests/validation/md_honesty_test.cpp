// SPDX-License-Identifier: BSD-3-Clause
// Stated errors against the scatter of twenty independent runs, for every quantity that depends on a seed.
// (Static crystals - lattice constant, cohesive energy, cold curve, elastic constants - have no seed:
// md_static_test holds them against published values.)
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/coexistence.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/hugoniostat.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "md_fitting/protocols/liquid_vapour.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/piston.hpp"
#include "md_fitting/protocols/spall.hpp"
#include "md_fitting/protocols/zero_pressure.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

constexpr int seeds = 20;

const Potential& foiles() {
  static const Potential potential = Potential::load("copper_universal_3", "Cu");
  return potential;
}

/// Results of one quantity over the seeds.
class Runs {
 public:
  std::vector<Estimate>& operator[](const std::string& quantity) { return runs_[quantity]; }

  /// Prints the standard deviation of the values over the root mean square of their errors, and demands that
  /// it is 1 within a factor of 1.5. Twenty values know it to a sixth, [1/(2 (20 - 1))]^(1/2), if the stated
  /// errors are known well; those of n replicas add 1/(2 x 20 (n - 1)) under the root: 19 % for four, 20 %
  /// for three.
  void expect_honest() const {
    for (const auto& [name, estimates] : runs_) {
      const double ratio = spread_over_stated(estimates);
      ::testing::Test::RecordProperty("spread over stated error, " + name, std::to_string(ratio));
      std::printf("  %-34s %.2f (%zu runs, %g +- %g)\n", name.c_str(), ratio, estimates.size(),
                  estimates.front().value, estimates.front().error);
      EXPECT_LT(ratio, 1.5) << name;
      EXPECT_GT(ratio, 1.0 / 1.5) << name;
    }
  }

 private:
  static double spread_over_stated(const std::vector<Estimate>& runs) {
    const auto n = static_cast<double>(runs.size());
    double mean = 0.0;
    double stated = 0.0;
    for (const Estimate& run : runs) mean += run.value / n, stated += run.error * run.error / n;
    double squares = 0.0;
    for (const Estimate& run : runs) squares += (run.value - mean) * (run.value - mean);
    return std::sqrt(squares / (n - 1.0) / stated);
  }
  std::map<std::string, std::vector<Estimate>> runs_;
};

/// Zero pressure and 293 K, from a run of 500 atoms and 20000 steps; the same for all seeds, so without
/// error.
ReferenceState at_rest() { return {{1.13515e-4, 0.0}, {-5.25865e6, 0.0}, 0.0}; }

TEST(StatedErrors, OfTheSolid) {
  const Potential& potential = foiles();
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const ZeroPressureResult rest = measure_zero_pressure(
        potential, 293.0, {.cells = 3, .equilibration_steps = 2000, .steps = 10000}, 7919 * seed);
    runs["volume at zero pressure"].push_back(rest.specific_volume);
    runs["thermal expansion"].push_back(rest.thermal_expansion);
    runs["energy at zero pressure"].push_back(rest.specific_internal_energy);

    NvtStateSource isochore(potential, {.cells = 3, .equilibration_steps = 1500, .steps = 5000},
                            104729 * seed);
    const State state = isochore.state(0.9 * potential.static_volume(), 1000.0, StateSource::Effort::final);
    runs["pressure on an isochore"].push_back(state.pressure);
    runs["energy on an isochore"].push_back(state.specific_internal_energy);

    const ReferenceState reference{rest.specific_volume, rest.specific_internal_energy, 0.0,
                                   rest.error_correlation};
    const double volume = 0.85 * potential.static_volume();
    NvtStateSource shock(potential, {.cells = 3, .equilibration_steps = 1000, .steps = 4000}, 1299709 * seed);
    HugoniotSearch search;
    search.specific_heat = 3.0 * metal::specific_energy(metal::boltzmann, potential.mass());
    search.gruneisen = 2.0 * volume / reference.specific_volume.value;
    search.first_temperature = guess_hugoniot(potential, reference, volume).temperature;
    const HugoniotState behind = solve_hugoniot(shock, reference, volume, search);
    runs["pressure behind the shock"].push_back(behind.pressure);
    runs["energy behind the shock"].push_back(behind.specific_internal_energy);
    runs["temperature behind the shock"].push_back(behind.temperature);
    runs["shock velocity"].push_back(behind.shock_velocity);
    runs["particle velocity"].push_back(behind.particle_velocity);
  }
  runs.expect_honest();
}

// So short runs often have not settled: these say so, and what their residual would change is in their
// errors. Twenty that have.
TEST(StatedErrors, OfTheHugoniostat) {
  constexpr int most_seeds = 100;
  Runs runs;
  for (int seed = 1; seed <= most_seeds && runs["shock velocity"].size() < seeds; ++seed) {
    const HugoniostatResult driven = run_hugoniostat(
        foiles(), at_rest(), 50e9, {.cells = 3, .equilibration_steps = 1000, .steps = 5000}, 7919 * seed);
    runs["volume"].push_back(driven.specific_volume);
    runs["temperature"].push_back(driven.temperature);
    if (!driven.converged) continue;
    runs["shock velocity"].push_back(driven.shock_velocity);
    runs["particle velocity"].push_back(driven.particle_velocity);
  }
  EXPECT_EQ(runs["shock velocity"].size(), static_cast<std::size_t>(seeds));
  runs.expect_honest();
}

TEST(StatedErrors, OfTheMelt) {
  constexpr double temperature = 1700.0;
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const RunSize size{.cells = 3, .equilibration_steps = 1500, .steps = 5000};
    std::string transcript;
    const Phase melt = measure_phase(foiles(), true, 0.0, temperature, size,
                                     time_step(foiles(), 1.0, temperature, size), 7919 * seed, transcript);
    runs["volume"].push_back(melt.volume);
    runs["enthalpy"].push_back(melt.enthalpy);
  }
  runs.expect_honest();
}

TEST(StatedErrors, OfThePiston) {
  const PistonPlan section{{}, 30, {.cells = 3, .equilibration_steps = 400}};
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const PistonResult shock = measure_piston(foiles(), at_rest(), 293.0, 2500.0, section, 7919 * seed);
    runs["shock velocity"].push_back(shock.shock_velocity);
    runs["pressure"].push_back(shock.pressure);
    runs["temperature"].push_back(shock.temperature);
  }
  runs.expect_honest();
}

TEST(StatedErrors, OfTheSpallStrength) {
  const SpallPlan section{{293.0}, 1e11, 5, 0.6, {.cells = 3, .equilibration_steps = 800}};
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const ReplicaSet<SpallPoint> spall = measure_spall(foiles(), 293.0, section, 7919 * seed);
    runs["strength"].push_back(spall.mean(&SpallPoint::spall_strength));
    runs["temperature"].push_back(spall.mean(&SpallPoint::spall_temperature));
  }
  runs.expect_honest();
}

// Small cells that keep both phases, brought to equilibrium over the 12 ps of a plan: after 8 ps they still
// remember the search run that all replicas start from (the melt's volume scattered by 1.50).
TEST(StatedErrors, OfTheMeltingPoint) {
  CoexistencePlan section;
  section.replicas = 3;
  section.length = 16;
  section.attempts = 8;
  section.size = {.cells = 4, .equilibration_steps = 6000, .steps = 4000};
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const ReplicaSet<CoexistencePoint> melting =
        measure_coexistence(foiles(), 0.0, 1275.0, section, 7919 * seed);
    if (!melting.remark.empty()) std::printf("  seed %d: %s\n", seed, melting.remark.c_str());
    for (const auto& [name, mean] : to_result<CoexistencePoint>(melting).results) runs[name].push_back(mean);
  }
  runs.expect_honest();
}

// So small a film tears now and then: such a run is left out, as in any plan.
TEST(StatedErrors, OfFilmAndVapour) {
  LiquidVapourPlan section{{}, 3.0, 4, {.cells = 4, .equilibration_steps = 12000, .steps = 8000}};
  Runs runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const ReplicaSet<FilmRun> film = measure_liquid_vapour(foiles(), 5100.0, section, 7919 * seed);
    if (!film.remark.empty()) std::printf("  seed %d: %s\n", seed, film.remark.c_str());
    for (const auto& [name, mean] : to_result<LiquidVapourPoint>(film).results) runs[name].push_back(mean);
  }
  runs.expect_honest();
}

}  // namespace
}  // namespace whipple::md
