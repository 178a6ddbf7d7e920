// SPDX-License-Identifier: BSD-3-Clause
// Contact of material with its image on several ranks: a node and its mirror node may belong to different
// ranks.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/contact_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::solver {
namespace {

/// Selects what the blocks meet, as lines of the case.
struct Corner {
  const char *contact, *wall, *domain;
};

/// Returns a case of three blocks that fly into the corner of three walls.
cases::Case blocks_into_corner(const Corner& corner) {
  using namespace verification;
  constexpr double cell = 1e-3;
  const std::string material = aluminium("aluminium_of_ranks", "0.3 GPa");
  const auto block = [&](const char* name, const Vector3& lower, double size, const Vector3& velocity) {
    const Vector3 upper = lower + Vector3::Constant(size);
    return std::string("[[body]]\nname = \"") + name + "\"\nmaterial = \"" + material +
           "\"\nvelocity = " + vector3(velocity) + "\nshape = { " + box(cell * lower, cell * upper) + " }\n";
  };
  return cases::read_case_text(
      Method{}.time_toml(2e-6) + Method{}.toml() + corner.contact +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.024, 0.024, 0.024]\ncell_size = 0.001\n" + corner.domain +
          "boundary = { x_lower = \"symmetry\", y_lower = \"" + corner.wall +
          "\", z_lower = \"no_slip\" }\n" + block("first", {0.4, 0.9, 0.7}, 6, {-700, -1500, -800}) +
          block("second", {0.3, 7.6, 0.7}, 5, {-900, -2500, -300}) +
          "[[force_gauge]]\nname = \"base\"\nface = \"z_lower\"\nabout = [0.001, 0.002, 0]\n"
          "[[force_gauge]]\nname = \"part\"\nface = \"y_lower\"\nbox = { lower = [0.0023, -1, 0], upper = "
          "[1, 1, "
          "0.0091] }\n" +
          (std::string(corner.contact).find("none") == std::string::npos
               ? "[[force_gauge]]\nname = \"third\"\nbody = \"third\"\n"
               : "") +
          block("third", {0.5, 1.1, 8.0}, 6, {-900, -800, -1900}),
      "corner.toml");
}

class WallRanks : public testing::TestWithParam<Corner> {};

TEST_P(WallRanks, AgreeWithOneRank) {
  const cases::Case setup = blocks_into_corner(GetParam());
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 2e-6);
  advance_on_root(alone, 2e-6);
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  const Ledger &a = together.state().ledger, &b = alone.state().ledger;
  EXPECT_GT(b.contact_heat, 1e-4 * b.initial.energy());
  EXPECT_NEAR(a.contact_heat, b.contact_heat, 1e-11 * b.initial.energy());
  const std::vector<GaugedImpulse>&of_all = together.state().gauged, &of_one = alone.state().gauged;
  ASSERT_EQ(of_all.size(), of_one.size());
  const double scale = b.initial.momentum_scale, length = 0.024;
  for (std::size_t g = 0; g < of_one.size(); ++g) {
    EXPECT_GT(of_one[g].impulse.norm(), 1e-3 * scale) << g;
    EXPECT_LE((of_all[g].impulse - of_one[g].impulse).norm(), 1e-11 * scale) << g;
    EXPECT_LE((of_all[g].moment - of_one[g].moment).norm(), 1e-11 * scale * length) << g;
  }
}

INSTANTIATE_TEST_SUITE_P(Contact, WallRanks,
                         testing::Values(Corner{"[contact]\nmethod = \"none\"\n", "separating", ""},
                                         Corner{"[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n",
                                                "separating", ""},
                                         Corner{"[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n"
                                                "[[load]]\nbody = \"second\"\nforce = [3e4, 1e4, -2e4]\n"
                                                "times = [0, 1e-6, 2e-6]\nfactors = [0, 1, -1]\n"
                                                "[damping]\ncoefficient = 0.4\n",
                                                "friction", "friction = 0.3\n"}));

/// A block on a base and against a side, to both of which it is bonded, under its weight with local damping.
class DampedRanks : public testing::TestWithParam<const char*> {};

TEST_P(DampedRanks, AgreeWithOneRank) {
  using namespace verification;
  constexpr double end = 8e-6;
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.02, 0.02, 0.02]\ncell_size = 0.001\n"
          "boundary = { x_lower = \"symmetry\", z_lower = \"no_slip\" }\n"
          "[gravity]\nacceleration = [3e5, 1e5, -1e6]\n[damping]\ncoefficient = 0.6\n" +
          BodyOptions{"block", elastic_aluminium(), box({0, 0.003, 0}, {0.011, 0.012, 0.012}),
                      Vector3::Zero(), GetParam()}
              .toml() +
          "[[force_gauge]]\nname = \"base\"\nface = \"z_lower\"\n[[force_gauge]]\nname = \"block\"\nbody = "
          "\"block\"\n",
      "damped.toml");
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, end);
  advance_on_root(alone, end);
  expect_same_on_all_ranks(together);
  if (!is_root()) return;
  const Ledger &a = together.state().ledger, &b = alone.state().ledger;
  const double work = b.external_work, momentum = b.external_impulse.norm();
  EXPECT_LT(b.damping_work, -0.01 * work);
  EXPECT_NEAR(a.damping_work, b.damping_work, 1e-10 * work);
  EXPECT_LE((a.external_impulse - b.external_impulse).norm(), 1e-10 * momentum);
  EXPECT_LE(std::abs(a.energy_error(together.totals())), 1e-12);
  EXPECT_LE(a.momentum_error(together.totals()), 1e-12);
  for (std::size_t g = 0; g < 2; ++g) {
    const GaugedImpulse &of_all = together.state().gauged[g], &of_one = alone.state().gauged[g];
    EXPECT_GT(of_one.impulse.norm(), 0.01 * momentum);
    EXPECT_LE((of_all.impulse - of_one.impulse).norm(), 1e-10 * momentum);
    EXPECT_LE((of_all.moment - of_one.moment).norm(), 1e-10 * momentum * 0.02);
  }
  // What the block has gained is the impulse of loads and damping and that of the faces.
  const Vector3 gained = together.totals().momentum;
  EXPECT_LE((gained - a.external_impulse - together.state().gauged[1].impulse).norm(), 1e-12 * momentum);
}

INSTANTIATE_TEST_SUITE_P(Methods, DampedRanks,
                         testing::Values("", "discretization = { method = \"finite_elements\" }\n"));

/// Tests a bar between two grips that move apart, one of them driven, the other held by a separating plane.
TEST(DrivenRanks, AgreeWithOneRank) {
  using namespace verification;
  const std::string material = aluminium("aluminium_of_grips", "0.3 GPa");
  const auto part = [&](const char* name, double from, double to, const char* keys) {
    return std::string("[[body]]\nname = \"") + name + "\"\nmaterial = \"" + material + "\"\n" + keys +
           "contact_group = \"one\"\nshape = { " +
           box(1e-3 * Vector3(from, 4.0, 4.0), 1e-3 * Vector3(to, 8.0, 8.0)) + " }\n";
  };
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(2e-6) + Method{}.toml() +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.024, 0.012, 0.012]\ncell_size = 0.001\n" +
          part("left", 4.0, 6.0, "velocity = [\"-20 m/s\", \"5 m/s\", \"0 m/s\"]\ndriven = true\n") +
          part("bar", 6.0, 16.0, "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n") +
          part("right", 16.0, 18.0, "velocity = [\"30 m/s\", \"0 m/s\", \"0 m/s\"]\ndriven = true\n"),
      "grips.toml");
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 2e-6);
  advance_on_root(alone, 2e-6);
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  const Ledger &a = together.state().ledger, &b = alone.state().ledger;
  EXPECT_GT(b.external_work, 0.01 * b.initial.kinetic_energy);
  EXPECT_NEAR(a.external_work, b.external_work, 1e-11 * b.initial.kinetic_energy);
  EXPECT_LE((a.external_impulse - b.external_impulse).norm(), 1e-11 * b.initial.momentum_scale);
}

}  // namespace
}  // namespace whipple::solver
