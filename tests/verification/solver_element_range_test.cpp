// SPDX-License-Identifier: BSD-3-Clause
// Elements in the solver whose material loses its strength, and elements that leave their valid range: their energies
// and their treatment.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "src/core/base/error.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

using solver::Simulation;

/// Returns a case of a rod on a plate at 1 km/s, both of elements and of a material that fails in tension.
/// @param more  further keys of both bodies
cases::Case rod_on_plate(const std::string& more) {
  const std::string failing = aluminium("range_failing", "0.3 GPa",
                                        "[[failure]]\nmodel = \"principal_stress\"\nsource = \"test\"\n"
                                        "tensile_strength = \"1.2 GPa\"\n");
  return cases::read_case_text(fmt::format(R"(
[domain]
lower = ["-6 mm", "-6 mm", "-8 mm"]
upper = ["6 mm", "6 mm", "8 mm"]
cell_size = "1 mm"
[time]
end = "10 us"
[contact]
method = "multi_field"
[[body]]
name = "rod"
material = "{0}"
velocity = ["0 m/s", "0 m/s", "1 km/s"]
discretization = {{ method = "finite_elements" }}
shape = {{ box = {{ lower = ["-1 mm", "-1 mm", "-5 mm"], upper = ["1 mm", "1 mm", "-1 mm"] }} }}
{1}
[[body]]
name = "plate"
material = "{0}"
discretization = {{ method = "finite_elements" }}
shape = {{ box = {{ lower = ["-5 mm", "-5 mm", "0 mm"], upper = ["5 mm", "5 mm", "2 mm"] }} }}
{1}
)",
                                           failing, more),
                               "range.toml");
}

TEST(ElementsThatFail, KeepTheirEnergiesPossible) {
  Simulation simulation(rod_on_plate(""), parallel::world());
  const double initial = simulation.totals().energy();
  double failed = 0.0;
  run_to(simulation, 10e-6, [&](const Simulation& s) {
    for (const fem::Mesh& mesh : s.meshes()) {
      for (const double energy : mesh.elements.hourglass_energy) ASSERT_GE(energy, 0.0);
      for (const Vector3& v : mesh.nodes.velocity) ASSERT_LT(v.norm(), 3e3);
      for (const auto flag : mesh.points.failed) failed += flag != 0 ? 1.0 : 0.0;
    }
    ASSERT_LE(s.totals().kinetic_energy, 1.001 * initial);
  });
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_GT(failed, 0.0);
  EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_GT(ledger.hourglass_work, 0.0);
  EXPECT_LT(ledger.hourglass_overdrawn, 1e-3 * ledger.hourglass_work);
}

// Pure finite elements with deletion: what yields beyond a strain, or has failed, is eroded and counted as outflow with
// its momentum and energy; what is left obeys the limit, and the accounts stay exact.
TEST(ElementsBeyondTheirRange, AreErodedByStrainAndFailure) {
  for (const char* criterion : {"plastic_strain = 0.2", "failed = true"}) {
    const bool by_strain = std::string(criterion).starts_with("plastic");
    Simulation simulation(
        rod_on_plate(fmt::format("element_range = {{ beyond = \"remove\", {} }}", criterion)),
        parallel::world());
    const std::size_t elements = simulation.element_count();
    const double mass = simulation.totals().mass;
    double worst = 0.0;  // right after a step that looks for them, before the material yields further
    run_to(simulation, 6e-6, [&](const Simulation& s) {
      if (s.state().step % 4 != 1) return;
      for (const fem::Mesh& mesh : s.meshes()) {
        for (std::size_t q = 0; q < mesh.points.size(); ++q)
          worst = std::max(worst, by_strain ? mesh.points.plastic_strain[q] : 0.0);
      }
    });
    const solver::Ledger& ledger = simulation.state().ledger;
    EXPECT_EQ(simulation.particle_count(), 0U);
    EXPECT_EQ(static_cast<double>(elements - simulation.element_count()), ledger.elements_beyond_range);
    EXPECT_GT(ledger.elements_beyond_range, 3.0) << criterion;
    EXPECT_NEAR(ledger.removed_mass, mass - simulation.totals().mass, 1e-12 * mass);
    EXPECT_NEAR(ledger.outflow.mass, ledger.removed_mass, 1e-12 * mass);
    EXPECT_LT(worst, 0.25);  // a step strains by some per cent
    EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
    EXPECT_LT(std::abs(ledger.momentum_error(simulation.totals())), 1e-11);
  }
}

TEST(ElementsBeyondTheirRange, BecomeParticlesAreDeletedOrStopTheRun) {
  const auto beyond = [](const std::string& word) {  // (a bound that many elements of the rod exceed)
    return fmt::format("element_range = {{ beyond = \"{}\", jacobian = 0.7 }}", word);
  };
  Simulation become(rod_on_plate(beyond("particles")), parallel::world());
  const std::size_t elements = become.element_count();
  const double mass = become.totals().mass;
  run_to(become, 4e-6);
  const solver::Ledger& converted = become.state().ledger;
  EXPECT_GT(converted.elements_beyond_range, 0.0);
  EXPECT_EQ(become.element_count(), elements - static_cast<std::size_t>(converted.elements_beyond_range));
  EXPECT_EQ(become.particle_count(), 8 * (elements - become.element_count()));
  EXPECT_NEAR(become.totals().mass, mass, 1e-12 * mass);
  EXPECT_LT(std::abs(converted.energy_error(become.totals())), 1e-12);

  testing::internal::CaptureStderr();
  Simulation remove(rod_on_plate(beyond("remove")), parallel::world());
  run_to(remove, 4e-6);
  EXPECT_THAT(
      testing::internal::GetCapturedStderr(),
      testing::AllOf(testing::HasSubstr("body \"rod\", element "), testing::HasSubstr("it is deleted")));
  const solver::Ledger& deleted = remove.state().ledger;
  EXPECT_GT(deleted.elements_beyond_range, 0.0);
  EXPECT_EQ(remove.particle_count(), 0U);
  EXPECT_GT(deleted.removed_mass, 0.0);
  EXPECT_NEAR(deleted.removed_mass, deleted.outflow.mass, 1e-12 * mass);
  EXPECT_NEAR(remove.totals().mass, mass - deleted.removed_mass, 1e-12 * mass);
  EXPECT_LT(std::abs(deleted.energy_error(remove.totals())), 1e-12);
  EXPECT_LT(deleted.momentum_error(remove.totals()), 1e-12);

  Simulation stop(rod_on_plate(beyond("stop")), parallel::world());
  try {
    run_to(stop, 4e-6);
    FAIL() << "nothing stopped";
  } catch (const StateError& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex("body \"rod\", element [0-9]+: is distorted"));
  }
}

TEST(ElementsBeyondTheirRange, AreFoundBySpeedAndByHourglassEnergy) {
  for (const std::string bound : {"speed = \"1100 m/s\"", "hourglass_share = 1e-6"}) {
    Simulation simulation(rod_on_plate("element_range = { beyond = \"stop\", " + bound + " }"),
                          parallel::world());
    EXPECT_THROW(run_to(simulation, 4e-6), StateError) << bound;
  }
}

// A hard rod erodes its way into a plate of four layers. When the struck layer has gone, the faces that it has exposed
// take part in contact: they brake the rod, they are eroded in turn, and no node of the plate lies within it.
TEST(ElementsBeyondTheirRange, FacesThatDeletionExposesTakePartInContact) {
  const std::string hard = aluminium("range_hard", "5 GPa"), soft = aluminium("range_soft", "0.3 GPa");
  Simulation simulation(cases::read_case_text(fmt::format(R"(
[domain]
lower = ["-6 mm", "-6 mm", "-8 mm"]
upper = ["6 mm", "6 mm", "12 mm"]
cell_size = "1 mm"
[time]
end = "10 us"
[contact]
method = "multi_field"
friction = 0
[[body]]
name = "rod"
material = "{0}"
velocity = ["0 m/s", "0 m/s", "2 km/s"]
discretization = {{ method = "finite_elements" }}
shape = {{ box = {{ lower = ["-1 mm", "-1 mm", "-7 mm"], upper = ["1 mm", "1 mm", "0 mm"] }} }}
[[body]]
name = "plate"
material = "{1}"
discretization = {{ method = "finite_elements" }}
shape = {{ box = {{ lower = ["-5 mm", "-5 mm", "0 mm"], upper = ["5 mm", "5 mm", "4 mm"] }} }}
element_range = {{ beyond = "remove", plastic_strain = 0.2 }}
)",
                                                          hard, soft),
                                              "exposed.toml"),
                        parallel::world());
  // Elements of the plate within the path of the rod, by their layer (identifiers stay).
  const auto centre = [](const fem::Mesh& mesh, std::size_t e) {
    Vector3 sum = Vector3::Zero();
    for (const std::uint32_t a : mesh.elements.corners[e]) sum += mesh.nodes.position[a] / 8.0;
    return sum;
  };
  std::map<std::uint64_t, int> layer;
  const auto mesh_of = [&](std::uint32_t body) -> const fem::Mesh& {
    return *std::ranges::find(simulation.meshes(), body, &fem::Mesh::body);
  };
  for (std::size_t e = 0; e < mesh_of(1).elements.id.size(); ++e) {
    const Vector3 c = centre(mesh_of(1), e);
    if (std::max(std::abs(c[0]), std::abs(c[1])) < 1e-3)
      layer[mesh_of(1).elements.id[e]] = static_cast<int>(c[2] / 1e-3);
  }
  const auto momentum = [&] {
    double sum = 0.0;
    for (std::size_t a = 0; a < mesh_of(0).nodes.size(); ++a)
      sum += mesh_of(0).nodes.mass[a] * mesh_of(0).nodes.velocity[a][2];
    return sum;
  };
  const double initial = momentum();
  double exposed = 0.0, deepest = 0.0;  // momentum of the rod when the first layer has gone; overlap, m
  std::array<int, 4> left{};
  run_to(simulation, 4e-6, [&](const Simulation& s) {
    left = {};
    for (const std::uint64_t id : mesh_of(1).elements.id) {
      if (const auto at = layer.find(id); at != layer.end()) ++left[static_cast<std::size_t>(at->second)];
    }
    if (left[0] == 0 && exposed == 0.0) exposed = momentum();
    ASSERT_LT(std::abs(s.state().ledger.energy_error(s.totals())), 1e-12);
    double front = -1.0, nearest = 1.0;
    for (const Vector3& x : mesh_of(0).nodes.position) front = std::max(front, x[2]);
    for (const Vector3& x : mesh_of(1).nodes.position) {
      if (std::max(std::abs(x[0]), std::abs(x[1])) < 0.5e-3) nearest = std::min(nearest, x[2]);
    }
    if (nearest < 1.0) deepest = std::max(deepest, front - nearest);
  });
  const solver::Ledger& ledger = simulation.state().ledger;
  std::printf(
      "rod: %.4f of its momentum with the first layer gone, %.4f at the end; left %d %d %d %d; overlap %.2f "
      "mm\n",
      exposed / initial, momentum() / initial, left[0], left[1], left[2], left[3], deepest * 1e3);
  EXPECT_GT(exposed, 0.0);
  EXPECT_LT(momentum(), 0.97 * exposed);
  EXPECT_EQ(left[1], 0);
  EXPECT_LT(deepest, 0.5e-3);
  EXPECT_LT(std::abs(ledger.momentum_error(simulation.totals())), 1e-11);
  EXPECT_EQ(simulation.particle_count(), 0U);
}

}  // namespace
}  // namespace whipple::verification
