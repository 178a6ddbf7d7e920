// SPDX-License-Identifier: BSD-3-Clause
// Stated errors against the scatter of twenty independent runs, for every quantity that a fit of the solid
// uses.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/zero_pressure.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

constexpr int seeds = 20;

/// Standard deviation of the values over the root mean square of their errors.
double spread_over_stated(const std::vector<Estimate>& runs) {
  const auto n = static_cast<double>(runs.size());
  double mean = 0.0;
  double stated = 0.0;
  for (const Estimate& run : runs) mean += run.value / n, stated += run.error * run.error / n;
  double squares = 0.0;
  for (const Estimate& run : runs) squares += (run.value - mean) * (run.value - mean);
  return std::sqrt(squares / (n - 1.0) / stated);
}

TEST(StatedErrors, MatchTheScatterOfTwentySeeds) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  std::map<std::string, std::vector<Estimate>> runs;
  for (int seed = 1; seed <= seeds; ++seed) {
    const ZeroPressureResult rest = measure_zero_pressure(
        potential, 293.0, {.cells = 3, .equilibration_steps = 2000, .steps = 10000}, 7919 * seed);
    runs["volume at zero pressure"].push_back(rest.specific_volume);
    runs["energy at zero pressure"].push_back(rest.specific_internal_energy);

    NvtStateSource isochore(potential, {.cells = 3, .equilibration_steps = 1500, .steps = 5000},
                            104729 * seed);
    const State state = isochore.state(0.9 * potential.static_volume(), 1000.0, StateSource::Effort::final);
    runs["pressure on an isochore"].push_back(state.pressure);
    runs["energy on an isochore"].push_back(state.specific_internal_energy);

    const ReferenceState reference{rest.specific_volume, rest.specific_internal_energy, 0.0};
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
  for (const auto& [name, estimates] : runs) {
    const double ratio = spread_over_stated(estimates);
    RecordProperty("spread over stated error, " + name, std::to_string(ratio));
    std::printf("  %-30s %.2f\n", name.c_str(), ratio);
    EXPECT_LT(ratio, 1.5) << name;
    EXPECT_GT(ratio, 1.0 / 1.5) << name;
  }
}

}  // namespace
}  // namespace whipple::md
