// SPDX-License-Identifier: BSD-3-Clause
// The solver on several ranks (run under mpiexec; every rank runs every test). Proves: all integrals of a debris cloud
// are equal on every rank and agree with those of one rank to 1e-11, with both schemes, while shocks, spall, melting,
// mirror planes and outflow cross the boundaries between ranks; a run resumes from a checkpoint on another number of
// ranks; more ranks than blocks cause no failure; an error on one rank ends the step on all of them.
#include "tests/parallel/solver_ranks.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/ranks.hpp"
#include "src/particles/migrate.hpp"
#include "src/run/checkpointing.hpp"
#include "src/run/gauges.hpp"
#include "src/solver/simulation.hpp"
#include "src/solver/stages/material.hpp"
#include "tests/folders.hpp"
#include "tests/parallel/debris_case.hpp"

namespace whipple::solver {
namespace {

namespace fs = std::filesystem;

/// A copper disk through an aluminium plate, quarter model, in a domain so short that material leaves it.
const char* const debris_head = R"(
[domain]
lower = ["0 mm", "0 mm", "-6 mm"]
upper = ["12 mm", "12 mm", "8 mm"]
cell_size = "1.2 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "2.5 us"
)";

class SolverRanks : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() / ("whipple_solver_ranks_" + ranks_.broadcast(std::to_string(::getpid())));
    ranks_.on_root([&] {
      fs::create_directories(folder_);
      std::ofstream(folder_ / "case.toml") << debris_head << debris_case::bodies;
    });
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    ranks_.on_root([&] { fs::remove_all(folder_); });
  }
  using Overrides = std::vector<std::pair<std::string, std::string>>;
  [[nodiscard]] cases::Case read(const Overrides& overrides = {}) const {
    return cases::read_case(folder_ / "case.toml", overrides);
  }

  io::Ranks ranks_{MPI_COMM_WORLD};
  fs::path folder_;
};

TEST_F(SolverRanks, AgreeWithOneRank) {
  Simulation together(read(), MPI_COMM_WORLD);
  advance_to(together, 2.5e-6);
  Simulation alone(read(), MPI_COMM_SELF);
  advance_on_root(alone, 2.5e-6);
  expect_agreement(together, alone, 1e-11);
  EXPECT_EQ(together.particles().size() < together.particle_count(), ranks_.is_parallel());
  EXPECT_GT(together.state().ledger.outflow.mass, 0.0);  // the case is meant to test it
  double of_bodies = 0.0;
  for (const BodyOutflow& body : together.state().outflow_of_body) of_bodies += body.mass;
  EXPECT_NEAR(of_bodies, together.state().ledger.outflow.mass, 1e-12 * of_bodies);
}

// Work is counted, not timed: the partition, and with it every bit, is equal in every run.
TEST_F(SolverRanks, GiveTheSameBitsEveryTime) {
  Simulation first(read(), MPI_COMM_WORLD), second(read(), MPI_COMM_WORLD);
  advance_to(first, 1e-6);
  advance_to(second, 1e-6);
  ASSERT_EQ(first.particles().size(), second.particles().size());
  for_each_field(first.particles(), [&](const auto& field) {
    const auto &a = field.of(first.particles()), &b = field.of(second.particles());
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0) << field.name;
  });
}

// Particles with three times the work on one side: the ranks balance the work, not the number of particles.
TEST_F(SolverRanks, ShareOutTheWork) {
  const grid::Geometry geometry{
      .lower = Vector3::Zero(), .cells = {128, 32, 32}, .cell_size = 1.0, .boundary = {}, .levels = {}};
  std::vector<Vector3> x;
  std::vector<double> work;
  for (int i = ranks_.rank(); i < 128 * 32 * 32; i += ranks_.count()) {
    x.emplace_back(i % 128 + 0.5, i / 128 % 32 + 0.5, i / 4096 + 0.5);
    work.push_back(i % 128 < 64 ? 3.0 : 1.0);
  }
  const auto heaviest = [&](const grid::Work& by) {
    grid::BlockGrid blocks(geometry, MPI_COMM_WORLD);
    blocks.adapt(x, std::vector<Vector3>(x.size(), Vector3::Zero()), 0.0, {}, by);
    const std::vector<int> owner = blocks.owners(x);
    std::vector<double> load(static_cast<std::size_t>(ranks_.count()), 0.0);
    for (std::size_t p = 0; p < x.size(); ++p) load[static_cast<std::size_t>(owner[p])] += work[p];
    parallel::sum(MPI_COMM_WORLD, load);
    return *std::ranges::max_element(load) * ranks_.count() / (2.0 * 128 * 32 * 32);
  };
  EXPECT_LT(heaviest({work, 0.0}), 1.15);
  if (ranks_.is_parallel()) {
    EXPECT_GT(heaviest({}), 1.3);  // by number
  }
}

// Particles are sent to and from all ranks, including ranks without particles: each arrives once with its fields, and
// the bodies remain contiguous.
TEST_F(SolverRanks, MigrateWithAllFieldsAndStandByBody) {
  const auto value = [](std::uint64_t id) { return 0.5 * static_cast<double>(id) + 1.0; };
  const std::size_t own = ranks_.rank() == 1 ? 0 : 200 + 30 * static_cast<std::size_t>(ranks_.rank());
  Particles particles;
  resize(particles, own);
  particles.affine_velocity.resize(own);
  for (std::size_t p = 0; p < own; ++p) {
    const std::uint64_t id = 1000 * static_cast<std::uint64_t>(ranks_.rank()) + p;
    particles.id[p] = id;
    particles.body[p] = static_cast<std::uint32_t>(4 * p / own);
    particles.mass[p] = value(id);
    particles.position[p] = Vector3(value(id), value(2 * id), value(3 * id));
    particles.affine_velocity[p] = Matrix3::Constant(value(id));
  }
  std::array<double, 2> sums = {static_cast<double>(own), 0.0};
  for (const std::uint64_t id : particles.id) sums[1] += static_cast<double>(id);
  parallel::sum(MPI_COMM_WORLD, sums);
  const auto ranks = static_cast<std::uint64_t>(ranks_.count());
  // In turn: everywhere, all except body 1 to the last rank, a few away from there, none anywhere.
  const auto destination = [&](int round, std::size_t p) {
    const std::uint64_t id = particles.id[p];
    if (round == 0) return static_cast<int>((id * 7 + id / 3) % ranks);
    if (round == 1 && particles.body[p] != 1) return static_cast<int>(ranks) - 1;
    if (round == 2 && id % 11 == 0) return static_cast<int>(id / 11 % ranks);
    return ranks_.rank();
  };
  for (int round = 0; round < 4; ++round) {
    std::vector<int> to;
    for (std::size_t p = 0; p < particles.size(); ++p) to.push_back(destination(round, p));
    EXPECT_EQ(migrate(particles, to, MPI_COMM_WORLD), round < 3 && ranks > 1);
    std::array<double, 2> now = {static_cast<double>(particles.size()), 0.0};
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const std::uint64_t id = particles.id[p];
      now[1] += static_cast<double>(id);
      EXPECT_EQ(particles.mass[p], value(id));
      EXPECT_EQ(particles.position[p], Vector3(value(id), value(2 * id), value(3 * id)));
      EXPECT_EQ(particles.affine_velocity[p], Matrix3::Constant(value(id)));
      EXPECT_EQ(destination(round, p), ranks_.rank());
    }
    parallel::sum(MPI_COMM_WORLD, now);
    EXPECT_EQ(now, sums) << "round " << round;
    EXPECT_TRUE(std::ranges::is_sorted(particles.body));
    for_each_field(particles, [&](const auto& field) {
      const auto& values = field.of(particles);
      EXPECT_TRUE(values.size() == particles.size() || (field.optional && values.empty())) << field.name;
    });
  }
}

// Options whose decisions must be equal on all ranks: contact of a separating wall, divisions with new numbers,
// particles in free flight, shifts of the grid, wide kernels with domains.
TEST_F(SolverRanks, AgreeWithOneRankInEveryOption) {
  const Overrides options = {{"domain.upper", R"(["12 mm", "12 mm", "3.6 mm"])"},
                             {"domain.boundary.z_upper", "separating"},
                             {"splitting.of", "all"},
                             {"splitting.length", "0.7"},
                             {"heat.conduction", "true"},
                             {"body.0.material", "\"copper_ofhc.toml\""},
                             {"transfer.free_flight", "true"},
                             {"transfer.random_shift", "true"},
                             {"transfer.shape_function", "cubic_bspline"}};
  const Overrides domains = {{"time.scheme", "usl"},
                             {"transfer.shape_function", "convected_gimp"},
                             {"transfer.particle_update", "fmpm"},
                             {"output.maximum_energy_error", "1"}};
  for (const Overrides& chosen : {options, domains}) {
    const double end = chosen == options ? 1.5e-6 : 0.5e-6;
    Simulation together(read(chosen), MPI_COMM_WORLD);
    advance_to(together, end);
    Simulation alone(read(chosen), MPI_COMM_SELF);
    const std::size_t seeded = alone.particle_count();
    advance_on_root(alone, end);
    expect_same_on_all_ranks(together);
    if (!is_root()) continue;
    EXPECT_EQ(together.state().step, alone.state().step);
    EXPECT_EQ(together.particle_count(), alone.particle_count());
    EXPECT_EQ(alone.particle_count() > seeded, chosen == options);
    const Totals& initial = alone.state().ledger.initial;
    EXPECT_NEAR(together.totals().internal_energy, alone.totals().internal_energy, 1e-11 * initial.energy());
    EXPECT_LE((together.totals().momentum - alone.totals().momentum).norm(), 1e-11 * initial.momentum_scale);
    EXPECT_LE((together.state().ledger.wall_impulse - alone.state().ledger.wall_impulse).norm(),
              1e-11 * initial.momentum_scale);
    EXPECT_LE(together.state().ledger.momentum_error(together.totals()), 1e-11);
  }
}

// Blocks of rings are in one layer; the hoop force is that of the particles of each rank; a run resumes from a
// checkpoint.
TEST_F(SolverRanks, AgreeWithOneRankInAxisymmetry) {
  const Overrides rings = {
      {"domain.dimension", "axisymmetric"}, {"domain.axis", "z"}, {"domain.cell_size", "0.4 mm"}};
  Simulation together(read(rings), MPI_COMM_WORLD);
  advance_to(together, 0.7e-6);
  const fs::path file = io::write_checkpoint(folder_ / "rings", together.state().step, together.particles(),
                                             run::to_checkpoint(together.state()), MPI_COMM_WORLD);
  advance_to(together, 1.2e-6);
  Simulation alone(read(rings), MPI_COMM_SELF);
  advance_on_root(alone, 0.7e-6);
  advance_on_root(alone, 1.2e-6);
  expect_agreement(together, alone, 1e-11);
  EXPECT_EQ(together.particles().size() < together.particle_count(), ranks_.is_parallel());
  EXPECT_LE(together.state().ledger.momentum_error(together.totals()), 1e-12);
  io::Checkpoint checkpoint = io::read_checkpoint(file, MPI_COMM_SELF);
  Simulation resumed(read(rings), std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                     MPI_COMM_SELF);
  advance_on_root(resumed, 1.2e-6);
  if (is_root()) expect_equal(resumed, alone, 1e-11);
}

// Deformation gradients, a history field of a constitutive model, follow their particles between ranks: the block
// crosses the boundaries of the ranks while it rebounds.
TEST_F(SolverRanks, DeformationGradientsMoveWithTheirParticles) {
  ranks_.on_root([&] {
    std::ofstream(folder_ / "bounce.toml") << R"(
[domain]
lower = ["0 mm", "-4 mm", "-4 mm"]
upper = ["24 mm", "8 mm", "8 mm"]
cell_size = "1 mm"
boundary = { x_lower = "separating" }
[time]
end = "400 us"
[[body]]
name = "block"
)" << "material = \"" + whipple::tests::source_folder() + "/tests/data/rubber.toml\"\n"
                                           << R"(
velocity = ["-25 m/s", "0 m/s", "0 m/s"]
shape = { box = { lower = ["5 mm", "0 mm", "0 mm"], upper = ["15 mm", "4 mm", "4 mm"] } }
)";
  });
  MPI_Barrier(MPI_COMM_WORLD);
  const cases::Case setup = cases::read_case(folder_ / "bounce.toml", {});
  const double end = 4e-4;
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, end);
  advance_on_root(alone, end);
  expect_agreement(together, alone, 1e-11);
  // Sums with an individual weight of every component of every particle
  const auto sums = [](const Particles& q) {
    std::vector<double> sum(2, 0.0);
    const auto& deformation = q.history.values<Matrix3>("deformation_gradient");
    for (std::size_t p = 0; p < q.size(); ++p) {
      for (int i = 0; i < 9; ++i) {
        const double weight = std::sin(static_cast<double>(9 * q.id[p]) + i);
        sum[0] += weight * (deformation[p] - Matrix3::Identity()).eval().data()[i];
        sum[1] += std::abs(deformation[p].data()[i] - Matrix3::Identity().eval().data()[i]);
      }
    }
    return sum;
  };
  std::vector<double> of_all = sums(together.particles());
  parallel::sum(MPI_COMM_WORLD, of_all);
  if (is_root()) {
    const std::vector<double> of_one = sums(alone.particles());
    EXPECT_NEAR(of_all[0], of_one[0], 1e-10 * of_one[1]);
    EXPECT_GT(of_one[1], 0.05 * static_cast<double>(alone.particle_count()));  // it is deformed
  }
}

// Fields that only other ranks have at a shared block, nodes at which several ranks are in contact, mirror planes
// through the contact, three bodies
TEST_F(SolverRanks, AgreeWithOneRankInContact) {
  for (const auto& [method, normal] :
       {std::pair("\"auto\"", "\"separating\""), std::pair("\"auto\"", "\"collinear\""),
        std::pair("\"multi_field\"", "\"logistic_regression\"")}) {
    const Overrides contact = {
        {"contact.method", method}, {"contact.friction", "0.3"}, {"contact.normal", normal}};
    Simulation together(read(contact), MPI_COMM_WORLD);
    advance_to(together, 1.2e-6);
    Simulation alone(read(contact), MPI_COMM_SELF);
    advance_on_root(alone, 1.2e-6);
    expect_agreement(together, alone, 1e-11);
    if (!is_root()) continue;
    const Ledger &a = together.state().ledger, &b = alone.state().ledger;
    EXPECT_GT(b.friction_heat, 0.0);
    EXPECT_NEAR(a.contact_heat, b.contact_heat, 1e-11 * b.initial.energy());
    EXPECT_NEAR(a.friction_heat, b.friction_heat, 1e-11 * b.initial.energy());
    EXPECT_NEAR(a.contact_impulse, b.contact_impulse, 1e-11 * b.initial.momentum_scale);
  }
}

// The velocity fields are determined again in every step: a checkpoint need not store them.
TEST_F(SolverRanks, GoOnFromACheckpointInContact) {
  const Overrides contact = {{"contact.method", "\"auto\""}, {"contact.friction", "0.3"}};
  Simulation together(read(contact), MPI_COMM_WORLD);
  advance_to(together, 0.5e-6);
  const fs::path file = io::write_checkpoint(folder_ / "contact", together.state().step, together.particles(),
                                             run::to_checkpoint(together.state()), MPI_COMM_WORLD);
  advance_to(together, 0.8e-6);
  io::Checkpoint checkpoint = io::read_checkpoint(file, MPI_COMM_SELF);
  Simulation alone(read(contact), std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                   MPI_COMM_SELF);
  advance_on_root(alone, 0.8e-6);
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  EXPECT_NEAR(together.state().ledger.friction_heat, alone.state().ledger.friction_heat,
              1e-11 * alone.state().ledger.initial.energy());
}

TEST_F(SolverRanks, GaugesAgreeWithOneRankAndFollowTheSameParticles) {
  const std::vector<cases::Gauge> gauges = {{"fixed", cases::GaugeKind::fixed, {1e-3, 1e-3, 1e-3}},
                                            {"moving", cases::GaugeKind::moving, {2e-3, 2e-3, 2.8e-3}},
                                            {"disk", cases::GaugeKind::moving, {0.0, 0.0, -3e-3}},
                                            {"empty", cases::GaugeKind::fixed, {11e-3, 11e-3, 7e-3}}};
  Simulation together(read(), MPI_COMM_WORLD), alone(read(), MPI_COMM_SELF);
  const run::GaugeRecorder all(gauges, {}, together);
  const run::GaugeRecorder one(gauges, {}, alone);
  io::CheckpointValues of_all, of_one;
  all.to_checkpoint(of_all);
  one.to_checkpoint(of_one);
  EXPECT_EQ(of_all.integers, of_one.integers);
  EXPECT_EQ(of_all.integers.size(), 2U);
  advance_to(together, 0.5e-6);
  advance_on_root(alone, 0.5e-6);
  const std::vector<io::HistoryValue> a = all.row(together),
                                      b = run::GaugeRecorder(gauges, {}, of_one).row(alone);
  if (!is_root()) return;
  ASSERT_EQ(a.size(), b.size());
  std::map<std::string, double> value;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    value[b[i].name] = b[i].value;
    if (std::isnan(b[i].value)) {
      EXPECT_TRUE(std::isnan(a[i].value)) << a[i].name;
    } else {
      // Shear stresses that vanish by symmetry are the round-off of stresses of 1e10 Pa.
      const double least = b[i].name.find("stress") != std::string::npos ? 1e3 : 1.0;
      EXPECT_NEAR(a[i].value, b[i].value, 1e-9 * std::max(std::abs(b[i].value), least)) << a[i].name;
    }
  }
  EXPECT_TRUE(std::isnan(value["empty.pressure"]));
  EXPECT_GT(value["fixed.pressure"], 1e10);  // shocked
  EXPECT_GT(value["moving.z"], 2.5e-3);
  EXPECT_LT(value["disk.velocity_z"], 5550.0);  // the shock reaches it
  EXPECT_GT(value["disk.velocity_z"], 3000.0);
}

TEST_F(SolverRanks, AgreeWithOneRankInMusl) {
  const Overrides musl = {{"time.scheme", "musl"},
                          {"transfer.shape_function", "linear"},
                          {"transfer.particle_update", "flip"},
                          {"time.courant", "0.3"},
                          {"output.maximum_energy_error", "1"}};
  Simulation together(read(musl), MPI_COMM_WORLD);
  advance_to(together, 0.6e-6);
  Simulation alone(read(musl), MPI_COMM_SELF);
  advance_on_root(alone, 0.6e-6);
  expect_same_on_all_ranks(together);
  if (!is_root()) return;
  EXPECT_EQ(together.state().step, alone.state().step);
  EXPECT_NEAR(together.totals().internal_energy, alone.totals().internal_energy,
              1e-11 * alone.state().ledger.initial.energy());
  EXPECT_LE((together.totals().momentum - alone.totals().momentum).norm(),
            1e-11 * alone.state().ledger.initial.momentum_scale);
}

TEST_F(SolverRanks, GoOnFromACheckpointOfAnotherNumberOfRanks) {
  Simulation alone(read(), MPI_COMM_SELF);
  advance_on_root(alone, 0.5e-6);
  Simulation together(read(), MPI_COMM_WORLD);
  advance_to(together, 0.5e-6);
  const fs::path of_all = io::write_checkpoint(folder_ / "all", together.state().step, together.particles(),
                                               run::to_checkpoint(together.state()), MPI_COMM_WORLD);
  ranks_.on_root([&] {
    io::write_checkpoint(folder_ / "one", alone.state().step, alone.particles(),
                         run::to_checkpoint(alone.state()), MPI_COMM_SELF);
  });
  advance_on_root(alone, 1e-6);

  io::Checkpoint checkpoint = io::read_checkpoint(of_all, MPI_COMM_SELF);
  Simulation from_all(read(), std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                      MPI_COMM_SELF);
  advance_on_root(from_all, 1e-6);
  if (is_root()) expect_equal(from_all, alone, 1e-11);

  checkpoint = io::read_latest_checkpoint(folder_ / "one", MPI_COMM_WORLD);
  Simulation from_one(read(), std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                      MPI_COMM_WORLD);
  advance_to(from_one, 1e-6);
  expect_agreement(from_one, alone, 1e-11);
}

TEST_F(SolverRanks, MoreRanksThanBlocksDoNoHarm) {
  const Overrides tiny = {{"domain.cell_size", "12 mm"}, {"time.end", "20 us"}};
  Simulation together(read(tiny), MPI_COMM_WORLD);
  Simulation alone(read(tiny), MPI_COMM_SELF);
  for (int step = 0; step < 3; ++step) {
    together.advance(20e-6);
    alone.advance(20e-6);
  }
  expect_agreement(together, alone, 1e-11);
}

TEST_F(SolverRanks, AnErrorOfOneRankEndsTheStepOnAll) {
  cases::Seeding seeding = cases::seed(read(), ranks_.rank(), ranks_.count());
  RunState state;
  state.ledger.initial = totals_of(seeding.particles, 0.25 * 1.2e-3 * 1.2e-3);
  sum_over_ranks(MPI_COMM_WORLD, state.ledger.initial);
  if (ranks_.rank() == ranks_.count() - 1) {
    seeding.particles.specific_internal_energy.back() = std::numeric_limits<double>::quiet_NaN();
  }
  Simulation simulation(read(), std::move(seeding.particles), state, MPI_COMM_WORLD);
  try {
    simulation.advance(1e-6);
    ADD_FAILURE() << "no error";
  } catch (const StateError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text, ranks_.broadcast(text));
    EXPECT_NE(text.find("specific internal energy nan"), std::string::npos) << text;
  }
}

// An error names the particle of the whole run, whichever rank holds it.
TEST_F(SolverRanks, AnErrorNamesTheFastestParticleOfAllRanks) {
  const auto error_of = [&](const Overrides& overrides, MPI_Comm communicator) -> std::string {
    try {
      Simulation simulation(read(overrides), communicator);
      for (int step = 0; step < 5; ++step) simulation.advance(2.5e-6);
    } catch (const StateError& error) {
      const std::string text = error.what();
      return text.substr(0, text.find('\n'));  // the particle's velocity differs by round-off
    }
    return "";
  };
  for (const auto& [key, value, part] : {std::tuple("time.acceleration_limit", "1e-300", "the fastest: "),
                                         std::tuple("output.maximum_speed_factor", "1e-3", "of body \"")}) {
    const std::string alone = error_of({{key, value}}, MPI_COMM_SELF);
    EXPECT_NE(alone.find(part), std::string::npos) << alone;
    EXPECT_EQ(error_of({{key, value}}, MPI_COMM_WORLD), alone);
  }
}

// Whether points at the end of their equation of state are single ones is decided by the mass on all ranks: 600 points
// of a body on each of two ranks are more than a thousand.
TEST_F(SolverRanks, CountPointsAtTheEndOfTheEquationOfStateTogether) {
  const cases::Case setup = read();
  const auto fault_of = [&](std::size_t on_root, std::size_t elsewhere) {
    MaterialReport report;
    report.points = 600;
    report.mass = 600.0;
    report.squeezed = is_root() ? on_root : elsewhere;
    report.squeezed_mass = static_cast<double>(report.squeezed);
    report.first_squeezed = 7;
    SqueezedPoints squeezed(setup.bodies.size());
    squeezed.add(1, report, [](std::size_t p, const std::string& why) { return std::to_string(p) + why; });
    return squeezed.fault(MPI_COMM_WORLD, setup.materials);
  };
  const auto ranks = static_cast<std::size_t>(parallel::size(MPI_COMM_WORLD));
  EXPECT_EQ(fault_of(0, 0), "");
  EXPECT_EQ(fault_of(1, 0).empty(), !is_root() || ranks > 1);
  const std::string fault = fault_of(600, 0);
  EXPECT_EQ(fault.empty(), !is_root());  // one rank describes its point, the step ends on all
  if (!is_root()) return;
  EXPECT_NE(fault.find("7the equation of state"), std::string::npos) << fault;
  EXPECT_NE(fault.find("600 of " + std::to_string(600 * ranks) + " points"), std::string::npos) << fault;
}

}  // namespace
}  // namespace whipple::solver

int main(int argc, char** argv) {
  whipple::parallel::world();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
