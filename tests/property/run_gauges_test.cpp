// SPDX-License-Identifier: BSD-3-Clause
// Gauges in bodies of elements see the state there, and follow it when elements become particles; angular momentum in the
// history.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "src/case/case.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/run/gauges.hpp"
#include "src/run/observers/history_columns.hpp"

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
end = ")" +
         end + R"("
[[body]]
name = "bar"
material = "copper_ofhc.toml"
velocity = ["0 m/s", "0 m/s", ")" +
         velocity + R"("]
discretization = { method = ")" +
         method + R"(", element_size = "1 mm" }
)" + (method == "adaptive" ? "conversion = { plastic_strain = 0.05 }\n" : "") +
         R"(
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
  const GaugeRecorder recorder(setup.all_gauges(), {}, simulation);
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
  const GaugeRecorder recorder(setup.all_gauges(), {}, simulation);
  const std::size_t elements = simulation.element_count();
  double before = values(recorder, simulation)["material.z"];
  while (simulation.state().time < setup.time.end) {
    simulation.advance(setup.time.end);
    auto now = values(recorder, simulation);
    ASSERT_TRUE(std::isfinite(now["material.pressure"]) && std::isfinite(now["place.pressure"]));
    EXPECT_LT(std::abs(now["material.z"] - before), 2.0 * 250.0 * simulation.state().time_step + 0.05e-3);
    before = now["material.z"];
  }
  EXPECT_LT(simulation.element_count(),
            elements);  // some have become particles, that of the gauge among them
  EXPECT_GT(values(recorder, simulation)["material.plastic_strain"], 0.05);
}

// Two millimetres off a bar: within reach of the large cells there, beyond that of the small ones.
TEST(Gauges, SeeAsFarAsTheCellsAroundThem) {
  const auto density_at_gauge = [](const std::string& region) {
    const cases::Case setup = cases::read_case_text(R"(
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["6 mm", "6 mm", "30 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry", z_lower = "symmetry" }
)" + region + R"([time]
end = "1 us"
[[body]]
name = "bar"
material = "copper_ofhc.toml"
shape = { box = { lower = ["0 mm", "0 mm", "0 mm"], upper = ["4 mm", "4 mm", "10 mm"] } }
[[gauge]]
name = "place"
position = ["1 mm", "1 mm", "12 mm"]
)",
                                                    "case.toml");
    const solver::Simulation simulation(setup, parallel::world());
    return values(GaugeRecorder(setup.all_gauges(), {}, simulation), simulation)["place.density"] /
           setup.materials[0]->reference.density;
  };
  EXPECT_TRUE(std::isnan(density_at_gauge("")));
  EXPECT_NEAR(density_at_gauge("[[domain.refinement]]\nlower = [\"0 mm\", \"0 mm\", \"20 mm\"]\n"
                               "upper = [\"6 mm\", \"6 mm\", \"30 mm\"]\n"),
              1.0, 1e-9);
}

/// A block of 4 x 3 x 2 mm that turns about z at 1e4 rad/s and flies along x, off the axis.
std::string spinning(const std::string& method) {
  return R"(
[domain]
lower = ["-8 mm", "-8 mm", "-8 mm"]
upper = ["8 mm", "8 mm", "8 mm"]
cell_size = "1 mm"
[time]
end = "2 us"
[[body]]
name = "block"
material = "copper_ofhc.toml"
velocity = ["100 m/s", "0 m/s", "0 m/s"]
angular_velocity = ["0 rad/s", "0 rad/s", "1e4 rad/s"]
discretization = { method = ")" +
         method + R"(" }
shape = { box = { lower = ["-2 mm", "-1.5 mm", "1 mm"], upper = ["2 mm", "1.5 mm", "3 mm"] } }
)";
}

/// The row of now by the names of history.csv.
std::map<std::string, double> history(const cases::Case& setup, const solver::Simulation& simulation) {
  std::map<std::string, double> row;
  for (const io::HistoryValue& value : history_row(history_columns(setup), simulation))
    row[value.name] = value.value;
  return row;
}

TEST(AngularMomentum, OfElementsIsThatOfTheirMassesAndStays) {
  const cases::Case setup = cases::read_case_text(spinning("finite_elements"), "case.toml");
  solver::Simulation simulation(setup, parallel::world());
  const auto start = history(setup, simulation);
  const double mass = start.at("mass"), omega = 1e4;
  // Nodes of n elements along a side a: sum m x^2 = M a^2 (1 + 2/n^2) / 12.
  const double inertia = mass * (16e-6 * (1 + 2.0 / 16) + 9e-6 * (1 + 2.0 / 9)) / 12;
  EXPECT_NEAR(start.at("angular_momentum_z"), inertia * omega, 1e-10 * inertia * omega);
  EXPECT_NEAR(start.at("angular_momentum_y"), mass * 2e-3 * 100, 1e-10 * mass * 0.2);  // z times v_x
  while (simulation.state().time < setup.time.end) simulation.advance(setup.time.end);
  const auto end = history(setup, simulation);
  for (const char* name : {"angular_momentum_x", "angular_momentum_y", "angular_momentum_z"}) {
    EXPECT_NEAR(end.at(name), start.at(name), 1e-12 * mass * 0.2) << name;
  }
}

// Particles of a rigid rotation hold a part of it in their affine fields; with `turned` no more than (4.9) of mpm.md
// gets lost.
TEST(AngularMomentum, OfParticlesCountsTheirAffineFields) {
  const std::string turned = "[transfer]\naffine_field = \"turned\"\n";
  const cases::Case setup = cases::read_case_text(spinning("particles") + turned, "case.toml");
  solver::Simulation simulation(setup, parallel::world());
  const auto start = history(setup, simulation);
  const Particles& q = simulation.particles();
  double of_motion = 0, of_fields = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    of_motion += q.mass[p] * (q.position[p][0] * q.velocity[p][1] - q.position[p][1] * q.velocity[p][0]);
    of_fields += q.mass[p] * 0.25e-6 * 2e4;  // h^2/4 of quadratic B-splines, 2 omega
  }
  EXPECT_GT(of_fields, 0.1 * of_motion);
  EXPECT_NEAR(start.at("angular_momentum_z"), of_motion + of_fields, 1e-12 * of_motion);
  while (simulation.state().time < setup.time.end) simulation.advance(setup.time.end);
  EXPECT_NEAR(history(setup, simulation).at("angular_momentum_z"), of_motion + of_fields, 2e-4 * of_motion);
}

}  // namespace
}  // namespace whipple::run
