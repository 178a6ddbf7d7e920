// SPDX-License-Identifier: BSD-3-Clause
// Gauges in bodies of elements see the state there, and follow it when elements become particles.
#include "src/run/gauges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "src/core/parallel/mpi.hpp"
#include "src/case/case.hpp"

namespace whipple::run {
namespace {

std::string text(const std::string& method, const std::string& velocity, const std::string& end) {
  return R"(
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["6 mm", "6 mm", "14 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry", z_lower = "symmetry" }
[time]
end = ")" + end + R"("
[[body]]
name = "bar"
material = "copper_ofhc.toml"
velocity = ["0 m/s", "0 m/s", ")" + velocity + R"("]
discretization = { method = ")" + method + R"(", element_size = "1 mm" }
)" + (method == "adaptive" ? "conversion = { plastic_strain = 0.05 }\n" : "") + R"(
shape = { box = { lower = ["0 mm", "0 mm", "0 mm"], upper = ["3 mm", "3 mm", "10 mm"] } }
[[gauge]]
name = "place"
position = ["1 mm", "1 mm", "5 mm"]
[[gauge]]
name = "material"
kind = "moving"
position = ["0.3 mm", "0.3 mm", "1.2 mm"]
)";
}

std::map<std::string, double> values(const GaugeRecorder& recorder, const solver::Simulation& simulation) {
  std::map<std::string, double> row;
  for (const io::HistoryValue& value : recorder.row(simulation)) row[value.name] = value.value;
  return row;
}

TEST(Gauges, SeeElements) {
  const cases::Case setup = cases::read_case_text(text("finite_elements", "100 m/s", "1 us"), "case.toml");
  solver::Simulation simulation(setup, parallel::world());
  const GaugeRecorder recorder(setup.all_gauges(), simulation);
  const double density = setup.materials[0]->reference.density;
  auto now = values(recorder, simulation);
  EXPECT_NEAR(now["place.density"], density, 1e-9 * density);
  EXPECT_NEAR(now["place.velocity_z"], 100.0, 1e-9);
  EXPECT_NEAR(now["material.z"], 1.25e-3, 1e-12);  // a quarter of the element, as its particle would be
  EXPECT_NEAR(now["material.x"], 0.25e-3, 1e-12);
  EXPECT_NEAR(now["material.density"], density, 1e-9 * density);
}

TEST(Gauges, FollowMatterThroughItsConversion) {
  const cases::Case setup = cases::read_case_text(text("adaptive", "-250 m/s", "4 us"), "case.toml");
  solver::Simulation simulation(setup, parallel::world());
  const GaugeRecorder recorder(setup.all_gauges(), simulation);
  const std::size_t elements = simulation.element_count();
  double before = values(recorder, simulation)["material.z"];
  while (simulation.state().time < setup.time.end) {
    simulation.advance(setup.time.end);
    auto now = values(recorder, simulation);
    ASSERT_TRUE(std::isfinite(now["material.pressure"]) && std::isfinite(now["place.pressure"]));
    EXPECT_LT(std::abs(now["material.z"] - before), 2.0 * 250.0 * simulation.state().time_step + 0.05e-3);
    before = now["material.z"];
  }
  EXPECT_LT(simulation.element_count(), elements);  // some have become particles, that of the gauge among them
  EXPECT_GT(values(recorder, simulation)["material.plastic_strain"], 0.05);
}

}  // namespace
}  // namespace whipple::run
