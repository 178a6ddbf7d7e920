// SPDX-License-Identifier: BSD-3-Clause
// Elements on several ranks (run under mpiexec; every rank runs every test). Proves: all integrals agree with those of
// one rank to 1e-11, for elements alone, for elements that become particles while shared nodes lose elements on other
// ranks, in contact, with bars, and while elements leave the domain; copies of shared nodes are bitwise equal; runs
// resume from checkpoints on other numbers of ranks; snapshots equal those of one rank.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "src/analysis/run.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/element_series.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/ranks.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::solver {
namespace {

namespace fs = std::filesystem;
using verification::restored;
using verification::save;

cases::Case read(const std::string& text) { return cases::read_case_text(text, "element_ranks.toml"); }

/// Returns a case of a free bar that flies, rotates and vibrates, with a prescribed velocity at its end.
std::string bar(const std::string& element) {
  return R"(
[domain]
lower = ["-12 mm", "-6 mm", "-8 mm"]
upper = ["24 mm", "6 mm", "8 mm"]
cell_size = "1 mm"
[time]
end = "3 us"
[[body]]
name = "bar"
material = "aluminium.toml"
velocity = ["100 m/s", "20 m/s", "0 m/s"]
angular_velocity = [0, 1e4, 0]
discretization = { method = "finite_elements", element = ")" +
         element + R"(" }
shape = { box = { lower = ["-10.3 mm", "-2.2 mm", "-2.1 mm"], upper = ["17.7 mm", "1.8 mm", "1.9 mm"] } }
[[body.node_condition]]
lower = ["-11 mm", "-3 mm", "-3 mm"]
upper = ["-10 mm", "3 mm", "3 mm"]
directions = ["x"]
velocity = ["150 m/s", "0 m/s", "0 m/s"]
)";
}

/// Returns a case of an adaptive sphere on an adaptive layer next to a plate of particles, half model; material leaves
/// the domain.
std::string impact(const std::string& more = {}) {
  return R"(
[domain]
lower = ["-10 mm", "0 mm", "-10 mm"]
upper = ["5.2 mm", "9 mm", "3.5 mm"]
cell_size = "1 mm"
boundary = { y_lower = "symmetry" }
[time]
end = "3 us"
[[body]]
name = "projectile"
material = "aluminium.toml"
velocity = ["0.5 km/s", "0 km/s", "2 km/s"]
discretization = { method = "adaptive" }
conversion = { plastic_strain = 0.3 }
shape = { sphere = { center = ["0 mm", "0 mm", "-3.27 mm"], radius = "3.1 mm" } }
[[body]]
name = "layer"
material = "aluminium.toml"
discretization = { method = "adaptive" }
conversion = { plastic_strain = 0.3 }
shape = { box = { lower = ["-5.13 mm", "-9 mm", "0.07 mm"], upper = ["-1.09 mm", "5.8 mm", "2.04 mm"] } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { box = { lower = ["-1.09 mm", "-6 mm", "0.07 mm"], upper = ["4.6 mm", "6.0 mm", "2.04 mm"] } }
)" + more;
}

std::string contact(const std::string& normal) {
  return "[contact]\nmethod = \"multi_field\"\nfriction = 0.3\nnormal = \"" + normal + "\"\n";
}

class ElementRanks : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() / ("whipple_element_ranks_" + ranks_.broadcast(std::to_string(::getpid())));
    ranks_.on_root([&] { fs::create_directories(folder_); });
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    ranks_.on_root([&] { fs::remove_all(folder_); });
  }
  fs::path write_snapshot(const Simulation& simulation, const std::string& name,
                          MPI_Comm communicator) const {
    const io::SeriesOptions options{
        .folder = folder_, .name = name, .fields = {}, .material_of_body = {0, 0, 0}, .provenance = {}};
    io::ElementSeries(options, communicator)
        .write(simulation.meshes(), simulation.bars(), simulation.state().time);
    return io::ParticleSeries(options, communicator).write(simulation.particles(), simulation.state().time);
  }
  /// Compares snapshots. Partitions of the file have separate nodes, which the reader combines.
  void expect_same_snapshot(const Simulation& together, const Simulation& alone) const {
    const fs::path of_all = write_snapshot(together, "all", MPI_COMM_WORLD);
    ranks_.on_root([&] {
      const double time = alone.state().time;
      const analysis::Snapshot a = analysis::read_snapshot({of_all, time});
      const analysis::Snapshot b =
          analysis::read_snapshot({write_snapshot(alone, "one", MPI_COMM_SELF), time});
      std::size_t bars = 0;
      for (const fem::Bars& of_body : alone.bars()) bars += of_body.elements.size();
      ASSERT_EQ(a.id, b.id);
      ASSERT_EQ(std::ranges::adjacent_find(a.id), a.id.end());
      ASSERT_EQ(a.id.size(), alone.particle_count() + 8 * alone.element_count() + bars);
      double distance = 0.0, speed = 0.0, mass = 0.0;
      for (std::size_t p = 0; p < a.id.size(); ++p) {
        distance = std::max(distance, (a.position[p] - b.position[p]).norm());
        speed = std::max(speed, (a.velocity[p] - b.velocity[p]).norm());
        mass += a.mass[p];
      }
      EXPECT_LT(distance, 1e-8);
      EXPECT_LT(speed, 1e-2);
      EXPECT_NEAR(mass, alone.totals().mass, 1e-6 * mass);
    });
  }

  io::Ranks ranks_{MPI_COMM_WORLD};
  fs::path folder_;
};

/// Requires that copies of one node on several ranks are equal; their masses are fractions of that of the node.
/// @returns number of copies
std::size_t expect_equal_copies(const Simulation& simulation, const io::Ranks& ranks) {
  std::size_t copies = 0;
  using Node = std::array<double, 9>;
  const auto values = [](const fem::Nodes& n, std::size_t a) {
    return Node{static_cast<double>(n.id[a]),
                n.position[a][0],
                n.position[a][1],
                n.position[a][2],
                n.velocity[a][0],
                n.velocity[a][1],
                n.velocity[a][2],
                n.affine_velocity[a].sum(),
                static_cast<double>(10 * n.on_surface[a] + n.in_transition[a])};
  };
  for (const fem::Mesh& mesh : simulation.meshes()) {
    std::vector<Node> own;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) own.push_back(values(mesh.nodes, a));
    const auto count = static_cast<std::size_t>(ranks.count());
    std::map<double, Node> first;
    std::size_t different = 0;
    for (const auto& part : parallel::exchange(MPI_COMM_WORLD, std::vector(count, own))) {
      for (const Node& node : part) {
        const auto [place, is_new] = first.emplace(node[0], node);
        if (is_new) continue;
        ++copies;
        if (place->second != node) ++different;
      }
    }
    EXPECT_EQ(different, 0U);
  }
  return copies;
}

TEST_F(ElementRanks, ABarByItselfAgreesWithOneRank) {
  for (const char* element : {"one_point", "b_bar"}) {
    Simulation together(read(bar(element)), MPI_COMM_WORLD), alone(read(bar(element)), MPI_COMM_SELF);
    advance_to(together, 3e-6);
    advance_on_root(alone, 3e-6);
    expect_agreement(together, alone, 1e-11);
    EXPECT_EQ(expect_equal_copies(together, ranks_) > 0, ranks_.is_parallel());
    EXPECT_GT(together.meshes().front().elements.size(), 0U);
    EXPECT_EQ(together.meshes().front().elements.size() < together.element_count(), ranks_.is_parallel());
    if (!is_root()) continue;
    EXPECT_NEAR(together.state().ledger.external_work, alone.state().ledger.external_work,
                1e-11 * alone.state().ledger.initial.energy());
  }
}

TEST_F(ElementRanks, ElementsThatBecomeParticlesAgreeWithOneRank) {
  Simulation together(read(impact()), MPI_COMM_WORLD), alone(read(impact()), MPI_COMM_SELF);
  const std::size_t elements = alone.element_count();
  EXPECT_EQ(together.element_count(), elements);
  for (const double time : {0.3e-6, 0.6e-6, 3e-6}) {
    advance_to(together, time);
    advance_on_root(alone, time);
    expect_equal_copies(together, ranks_);
  }
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  const Ledger &a = together.state().ledger, &b = alone.state().ledger;
  EXPECT_NEAR(a.converted_mass, b.converted_mass, 1e-11 * b.initial.mass);
  EXPECT_NEAR(a.conversion_heat, b.conversion_heat, 1e-11 * b.initial.energy());
  EXPECT_LT(alone.element_count(), elements);
  EXPECT_GT(alone.element_count(), 0U);
  EXPECT_GT(b.outflow.mass, 0.0);
}

TEST_F(ElementRanks, QuadrilateralsOfSectionsAgreeWithOneRank) {
  for (const char* dimension : {"plane_strain", "axisymmetric"}) {
    const cases::Case setup = read(std::string("[domain]\ndimension = \"") + dimension + R"("
lower = ["-6 mm", "0 mm"]
upper = ["10 mm", "9 mm"]
cell_size = "0.5 mm"
boundary = { y_lower = "symmetry" }
[time]
end = "3 us"
[[body]]
name = "ball"
material = "aluminium.toml"
velocity = ["2 km/s", "0 m/s"]
discretization = { method = "adaptive" }
conversion = { plastic_strain = 0.3 }
shape = { sphere = { center = ["-2.2 mm", "0 mm"], radius = "2 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
discretization = { method = "adaptive" }
conversion = { plastic_strain = 0.3 }
shape = { box = { lower = ["0 mm", "0 mm"], upper = ["2 mm", "8 mm"] } }
)");
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
    advance_to(together, 1e-6);
    advance_on_root(alone, 1e-6);
    expect_agreement(together, alone, 1e-11);
    expect_equal_copies(together, ranks_);
    if (!is_root()) continue;
    const Ledger &a = together.state().ledger, &b = alone.state().ledger;
    EXPECT_GT(b.converted_mass, 0.0);
    EXPECT_NEAR(a.converted_mass, b.converted_mass, 1e-11 * b.initial.mass);
    EXPECT_NEAR(a.wall_impulse[1], b.wall_impulse[1], 1e-11 * b.initial.momentum_scale);
  }
}

TEST_F(ElementRanks, ContactAgreesWithOneRank) {
  for (const char* normal : {"separating", "logistic_regression"}) {
    const double end = normal[0] == 's' ? 1e-6 : 0.4e-6;
    const cases::Case setup = read(impact(contact(normal)));
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
    advance_to(together, end);
    advance_on_root(alone, end);
    expect_agreement(together, alone, 1e-11);
    expect_equal_copies(together, ranks_);
    if (!is_root()) continue;
    const Ledger &a = together.state().ledger, &b = alone.state().ledger;
    EXPECT_GT(b.friction_heat, 0.0);
    EXPECT_GT(b.converted_mass, 0.0);
    EXPECT_NEAR(a.contact_heat, b.contact_heat, 1e-11 * b.initial.energy());
    EXPECT_NEAR(a.friction_heat, b.friction_heat, 1e-11 * b.initial.energy());
    EXPECT_NEAR(a.contact_impulse, b.contact_impulse, 1e-11 * b.initial.momentum_scale);
  }
}

TEST_F(ElementRanks, GiveTheSameBitsEveryTime) {
  const cases::Case setup = read(impact(contact("separating")));
  Simulation first(setup, MPI_COMM_WORLD), second(setup, MPI_COMM_WORLD);
  advance_to(first, 0.5e-6);
  advance_to(second, 0.5e-6);
  verification::expect_same(first, second);
}

// Two ranks, then one, then all.
TEST_F(ElementRanks, GoOnFromACheckpointOfAnotherNumberOfRanks) {
  for (const std::string& more : {std::string(), contact("separating")}) {
    const cases::Case setup = read(impact(more));
    Simulation alone(setup, MPI_COMM_SELF);
    advance_on_root(alone, 0.3e-6);
    advance_on_root(alone, 0.6e-6);
    advance_on_root(alone, 0.9e-6);
    MPI_Comm two = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, ranks_.rank() < 2 ? 0 : MPI_UNDEFINED, ranks_.rank(), &two);
    std::string file;
    if (two != MPI_COMM_NULL) {
      Simulation of_two(setup, two);
      advance_to(of_two, 0.3e-6);
      file = save(of_two, folder_ / "two").string();
    }
    ranks_.on_root([&] {
      Simulation of_one = restored(setup, file, MPI_COMM_SELF);
      advance_to(of_one, 0.6e-6);
      file = save(of_one, folder_ / "one").string();
    });
    file = ranks_.broadcast(file);
    Simulation together = restored(setup, file, MPI_COMM_WORLD);
    advance_to(together, 0.9e-6);
    expect_agreement(together, alone, 1e-11);
    expect_equal_copies(together, ranks_);
    EXPECT_GT(together.state().ledger.converted_mass, 0.0);
    if (two != MPI_COMM_NULL) MPI_Comm_free(&two);
  }
}

TEST_F(ElementRanks, BarsInParticlesAgreeWithOneRank) {
  const std::string metal = verification::aluminium("bars_on_ranks", "0.3 GPa");
  const cases::Case setup = read(R"(
[domain]
lower = ["0 mm", "0 mm", "-6 mm"]
upper = ["6 mm", "6 mm", "6 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "6 us"
[[body]]
name = "ball"
material = "aluminium.toml"
velocity = ["0 m/s", "0 m/s", "2 km/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "-2.63 mm"], radius = "2.5 mm" } }
[[body]]
name = "block"
material = "aluminium.toml"
shape = { box = { lower = ["0 mm", "0 mm", "0 mm"], upper = ["5 mm", "5 mm", "3 mm"] } }
[[body]]
name = "rods"
material = ")" + metal + R"("
discretization = { method = "bars", bar_diameter = "0.4 mm", bar_failure_strain = 0.5 }
[[body.bar]]
from = ["0 mm", "0.53 mm", "1.03 mm"]
to = ["5 mm", "0.53 mm", "1.03 mm"]
count = 3
step = ["0 mm", "1.5 mm", "0 mm"]
)");
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 1e-6);
  const fs::path file = save(together, folder_ / "bars");
  advance_to(together, 4e-6);
  advance_on_root(alone, 1e-6);
  advance_on_root(alone, 4e-6);
  expect_agreement(together, alone, 1e-11);
  Simulation again = restored(setup, file, MPI_COMM_WORLD);
  advance_to(again, 4e-6);
  expect_agreement(again, alone, 1e-11);
  expect_same_snapshot(together, alone);

  // Every rank has its part; copies of a node are bitwise equal.
  const std::vector<fem::Bars>& own = together.bars();
  std::vector<double> bars_of(static_cast<std::size_t>(ranks_.count()), 0.0);
  bars_of[static_cast<std::size_t>(ranks_.rank())] = static_cast<double>(own.front().elements.size());
  parallel::sum(MPI_COMM_WORLD, bars_of);
  if (ranks_.count() == 2) {
    EXPECT_GT(std::ranges::min(bars_of), 0.0);
  }
  struct Copy {
    std::uint64_t id;
    std::array<double, 3> position;
    auto operator<=>(const Copy&) const = default;
  };
  std::vector<Copy> copies;
  for (std::size_t a = 0; a < own.front().nodes.size(); ++a) {
    const Vector3& x = own.front().nodes.position[a];
    copies.push_back({own.front().nodes.id[a], {x[0], x[1], x[2]}});
  }
  std::map<std::uint64_t, Copy> known;
  for (const auto& part :
       parallel::exchange(MPI_COMM_WORLD, std::vector<std::vector<Copy>>(bars_of.size(), copies))) {
    for (const Copy& copy : part) EXPECT_EQ(known.emplace(copy.id, copy).first->second, copy);
  }
  if (!is_root()) return;
  const fem::Bars& of_one = alone.bars().front();
  EXPECT_GT(fem::internal_energy(of_one), 0.0);
  EXPECT_EQ(known.size(), of_one.nodes.size());
  EXPECT_EQ(std::accumulate(bars_of.begin(), bars_of.end(), 0.0),
            static_cast<double>(of_one.elements.size()));
}

TEST_F(ElementRanks, SnapshotsAreThoseOfOneRank) {
  const cases::Case setup = read(impact());
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 0.5e-6);
  advance_on_root(alone, 0.5e-6);
  expect_same_snapshot(together, alone);
}

// Two pieces of one body that deletion has parted, each of them on several ranks: they touch each other on all alike.
TEST_F(ElementRanks, PiecesOfABodyAgreeWithOneRank) {
  const cases::Case setup = read(R"(
[domain]
lower = ["-14 mm", "-5 mm", "-5 mm"]
upper = ["14 mm", "5 mm", "5 mm"]
cell_size = "1 mm"
[time]
end = "4 us"
[[body]]
name = "bar"
material = ")" + verification::elastic_aluminium() +
                                 R"("
discretization = { method = "finite_elements" }
element_range = { beyond = "remove", plastic_strain = 1, pieces = "fields" }
shape = { box = { lower = ["-10 mm", "-3 mm", "-3 mm"], upper = ["10 mm", "3 mm", "3 mm"] } }
)");
  const Simulation whole(setup, MPI_COMM_SELF);
  std::string file;
  compute_on_root([&] {
    std::vector<fem::Mesh> meshes(whole.meshes().begin(), whole.meshes().end());
    fem::Mesh& mesh = meshes.at(0);
    std::vector<std::uint8_t> middle(mesh.elements.size());
    for (std::size_t e = 0; e < middle.size(); ++e) {
      for (const std::uint32_t a : mesh.elements.corners[e])
        if (std::abs(mesh.nodes.position[a][0]) < 0.5e-3) middle[e] = 1;
      for (const std::uint32_t a : mesh.elements.corners[e])
        if (middle[e] != 0) mesh.nodes.on_surface[a] = 1;
    }
    fem::remove_elements(mesh, middle);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      mesh.nodes.velocity[a][0] = mesh.nodes.position[a][0] > 0.0 ? -300.0 : 300.0;
    const Simulation parted(setup, Particles(whole.particles()), RunState{}, MPI_COMM_SELF, meshes);
    file = save(parted, folder_ / "pieces").string();
  });
  file = ranks_.broadcast(file);
  Simulation together = restored(setup, file, MPI_COMM_WORLD), alone = restored(setup, file, MPI_COMM_SELF);
  advance_to(together, 4e-6);
  advance_on_root(alone, 4e-6);
  expect_equal_copies(together, ranks_);
  expect_agreement(together, alone,
                   1e-9);  // faces that meet at once: round-off decides which node does first
  if (!is_root()) return;
  EXPECT_GT(alone.state().ledger.contact_heat, 1e-3 * alone.state().ledger.initial.energy());
}

}  // namespace
}  // namespace whipple::solver
