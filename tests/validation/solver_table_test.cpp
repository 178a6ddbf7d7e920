// SPDX-License-Identifier: BSD-3-Clause
// The main case, coarse, with the equations of state as models and as tables: equal phase masses, energy conserved to
// round-off by both.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "src/case/build/tables.hpp"
#include "tests/folders.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

struct Outcome {
  double melted[2] = {}, vaporised[2] = {}, mass[2] = {};  ///< by body, kg
  double energy_error = 0, speed = 0;                      ///< axial speed of the disk's centre of mass
  double nanoseconds = 0;                                  ///< of the stage "material" per particle and step
};

Outcome outcome(const std::string& evaluation) {
  cases::Case setup =
      cases::read_case(whipple::tests::source_folder() + "/cases/copper_disk_on_aluminium/case.toml",
                       {{"domain.cell_size", "1.2 mm"},
                        {"time.end", "5 us"},
                        {"body.0.equation_of_state", evaluation},
                        {"body.1.equation_of_state", evaluation}});
  cases::tabulate_materials(setup, io::Ranks(parallel::world()));
  EXPECT_EQ(setup.materials[0]->eos->model(), evaluation == "table" ? "table" : "gray");
  solver::Simulation simulation(setup, parallel::world());
  const double particles = static_cast<double>(simulation.particles().size());
  EnergyWatch watch;
  run_to(simulation, 5e-6, std::ref(watch));
  Outcome result;
  result.energy_error = watch.worst;
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const std::size_t b = q.body[p] == 0 ? 0 : 1;  // the disk; the plate and its rear layer
    result.mass[b] += q.mass[p];
    result.melted[b] += q.mass[p] * q.melted_fraction[p];
    result.vaporised[b] += q.mass[p] * q.vaporised_fraction[p];
    if (b == 0) result.speed += q.mass[p] * q.velocity[p][2];
  }
  result.speed /= result.mass[0];
  for (const auto& stage : simulation.profile().stages()) {
    if (stage.name == "material")
      result.nanoseconds = 1e9 * stage.seconds / (particles * static_cast<double>(simulation.state().step));
  }
  return result;
}

TEST(TableOfEquationOfState, GivesThePhaseMassesOfTheModel) {
  const auto cache = std::filesystem::temp_directory_path() / "whipple_table_test_cache";
  ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  const Outcome model = outcome("model"), table = outcome("table");
  for (int b = 0; b < 2; ++b) {
    std::printf("%s: melted %.4f %% and %.4f %%, vaporised %.4f %% and %.4f %% of the mass\n",
                b == 0 ? "disk" : "plate", 100 * model.melted[b] / model.mass[b],
                100 * table.melted[b] / table.mass[b], 100 * model.vaporised[b] / model.mass[b],
                100 * table.vaporised[b] / table.mass[b]);
    EXPECT_NEAR(table.melted[b], model.melted[b], 0.005 * model.mass[b]);
    EXPECT_NEAR(table.vaporised[b], model.vaporised[b], 0.005 * model.mass[b]);
  }
  std::printf(
      "energy error %.1e and %.1e, disk %.2f and %.2f m/s, material %.0f and %.0f ns per particle and step\n",
      model.energy_error, table.energy_error, model.speed, table.speed, model.nanoseconds, table.nanoseconds);
  EXPECT_GT(model.melted[1], 0.01 * model.mass[1]) << "the case must melt something";
  EXPECT_NEAR(table.speed, model.speed, 0.002 * model.speed);
  EXPECT_LT(model.energy_error, 1e-10);
  EXPECT_LT(table.energy_error, 1e-10);
}

}  // namespace
}  // namespace whipple::verification
