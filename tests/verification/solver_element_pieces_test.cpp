// SPDX-License-Identifier: BSD-3-Clause
// Pieces of one body of elements that deletion has parted (docs/theory/afemp.md, 2).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/pieces.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace element_pieces_test {

using solver::Simulation;

const char* const touching =
    "element_range = { beyond = \"remove\", plastic_strain = 0.05, pieces = \"fields\" }\n";
const char* const apart = "element_range = { beyond = \"remove\", plastic_strain = 0.05 }\n";

/// Returns a bar of elements along x. @param lower, upper  its ends, mm
std::string body(const std::string& name, double lower, double upper, double speed,
                 const std::string& yield_stress, const std::string& more) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nvelocity = [\"{} m/s\", \"0 m/s\", \"0 m/s\"]\n"
      "discretization = {{ method = \"finite_elements\" }}\nshape = {{ box = {{ lower = [\"{} mm\", \"-2 "
      "mm\", \"-2 mm\"], "
      "upper = [\"{} mm\", \"2 mm\", \"2 mm\"] }} }}\n{}",
      name, aluminium("pieces_" + yield_stress.substr(0, 1), yield_stress), speed, lower, upper, more);
}

/// Cells of 1 mm, or half of it if WHIPPLE_FINE_PIECES is set.
cases::Case read(const std::string& bodies) {
  return cases::read_case_text(
      fmt::format(
          "[domain]\nlower = [\"-14 mm\", \"-4 mm\", \"-4 mm\"]\nupper = [\"14 mm\", \"4 mm\", \"4 mm\"]\n"
          "cell_size = \"{} mm\"\n[time]\nend = \"40 us\"\n",
          std::getenv("WHIPPLE_FINE_PIECES") != nullptr ? 0.5 : 1.0) +
          bodies,
      "pieces.toml");
}

Vector3 centre(const fem::Mesh& mesh, std::size_t element) {
  Vector3 x = Vector3::Zero();
  for (const std::uint32_t a : mesh.elements.corners[element]) x += mesh.nodes.position[a] / 8.0;
  return x;
}

/// Takes the elements with |x| < half out of a mesh, as a run does, but for a bridge.
/// @param bridge  half of its thickness, m
void take_middle(fem::Mesh& mesh, double half, double bridge) {
  std::vector<std::uint8_t> middle(mesh.elements.size());
  for (std::size_t e = 0; e < middle.size(); ++e) {
    const Vector3 x = centre(mesh, e);
    middle[e] = std::abs(x[0]) < half && std::max(std::abs(x[1]), std::abs(x[2])) > bridge ? 1 : 0;
    for (const std::uint32_t a : mesh.elements.corners[e]) {
      if (middle[e] != 0) mesh.nodes.on_surface[a] = 1;
    }
  }
  fem::remove_elements(mesh, middle);
}

/// A body whose halves move at each other; what is between them, up to |x| = half, in proportion.
Simulation thrown(const cases::Case& setup, double speed, double half, double bridge) {
  const Simulation whole(setup, parallel::world());
  std::vector<fem::Mesh> meshes(whole.meshes().begin(), whole.meshes().end());
  take_middle(meshes.at(0), half, bridge);
  fem::Nodes& nodes = meshes.at(0).nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    nodes.velocity[a][0] = -speed * std::clamp(nodes.position[a][0] / half, -1.0, 1.0);
  return {setup, Particles(whole.particles()), solver::RunState{}, parallel::world(), meshes};
}

/// Follows the elements that begin at x > 0, and the distance to the others.
class RightHalf {
 public:
  explicit RightHalf(const Simulation& simulation) {
    for (std::size_t m = 0; m < simulation.meshes().size(); ++m) {
      const fem::Mesh& mesh = simulation.meshes()[m];
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        if (centre(mesh, e)[0] > 0.0) right_.emplace(m, mesh.elements.id[e]);
      }
    }
  }
  void look(const Simulation& simulation) {
    double momentum = 0.0, mass = 0.0, left = -1.0, right = 1.0;
    for (std::size_t m = 0; m < simulation.meshes().size(); ++m) {
      const fem::Mesh& mesh = simulation.meshes()[m];
      for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        const bool is_right = right_.contains({m, mesh.elements.id[e]});
        for (const std::uint32_t a : mesh.elements.corners[e]) {
          const double x = mesh.nodes.position[a][0];
          (is_right ? right : left) = is_right ? std::min(right, x) : std::max(left, x);
          if (!is_right) continue;
          const double share = fem::mass(mesh, e) / 8.0;
          momentum += share * mesh.nodes.velocity[a][0];
          mass += share;
        }
      }
    }
    velocity = momentum / mass;
    gap = right - left;
    least_gap = std::min(least_gap, gap);
  }
  double velocity = 0.0;                                                  // m/s
  double gap = 0.0, least_gap = std::numeric_limits<double>::infinity();  // m

 private:
  std::set<std::pair<std::size_t, std::uint64_t>> right_;
};

RightHalf followed(Simulation& simulation, double end) {
  RightHalf right(simulation);
  run_to(simulation, end, [&](const Simulation& s) { right.look(s); });
  return right;
}

void expect_exact(const Simulation& simulation) {
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_LT(std::abs(ledger.momentum_error(simulation.totals())), 1e-12);
}

// Parted before they meet, the halves of one body are two bodies: the same motion, as far as round-off, which decides
// which nodes of two plane faces meet first, lets it be. In the velocity field of the body alone they pass each other.
TEST(PiecesOfABody, MeetAsTwoBodiesDo) {
  const double end = 40e-6, speed = 100.0;
  Simulation two(
      read(body("left", -10.0, -3.0, speed, "5 GPa", "") + body("right", 3.0, 10.0, -speed, "5 GPa", "")),
      parallel::world());
  const RightHalf of_two = followed(two, end);
  Simulation one = thrown(read(body("bar", -10.0, 10.0, 0.0, "5 GPa", touching)), speed, 3e-3, 0.0);
  const RightHalf of_one = followed(one, end);
  Simulation unaware = thrown(read(body("bar", -10.0, 10.0, 0.0, "5 GPa", apart)), speed, 3e-3, 0.0);
  const RightHalf of_unaware = followed(unaware, end);
  std::printf("two bodies: %.4f m/s, least gap %.4f mm; pieces: %.4f, %.4f; without fields: %.4f, %.4f\n",
              of_two.velocity, 1e3 * of_two.least_gap, of_one.velocity, 1e3 * of_one.least_gap,
              of_unaware.velocity, 1e3 * of_unaware.least_gap);
  EXPECT_GT(of_two.velocity, 0.4 * speed);  // they rebound
  EXPECT_NEAR(of_one.velocity, of_two.velocity, 1e-4 * speed);
  EXPECT_NEAR(of_one.gap, of_two.gap, 1e-6);
  EXPECT_GT(of_one.least_gap, -0.02e-3);  // of elements of 1 mm
  EXPECT_NEAR(of_unaware.velocity, -speed, 1e-9 * speed);
  expect_exact(one);
}

// Two blocks that a bridge joins: half of it yields and is deleted, the other half between the blocks then, and the blocks
// rebound from each other.
TEST(PiecesOfABody, ReboundWhenTheirBridgeIsDeleted) {
  Simulation simulation =
      thrown(read(body("blocks", -10.0, 10.0, 0.0, "1 GPa", touching)), 100.0, 2e-3, 1e-3);
  const std::size_t elements = simulation.element_count();
  const RightHalf right = followed(simulation, 40e-6);
  std::printf("blocks: %.3f m/s, least gap %.4f mm, %zu of %zu elements\n", right.velocity,
              1e3 * right.least_gap, simulation.element_count(), elements);
  EXPECT_EQ(simulation.element_count(), elements - 16);
  EXPECT_GT(right.velocity, 15.0);
  EXPECT_GT(right.least_gap, -0.02e-3);
  expect_exact(simulation);
}

// As long as nothing is deleted fields for pieces change no bit.
TEST(PiecesOfABody, FieldsForThemChangeNothingInAWholeBody) {
  const auto run = [&](const char* range) {
    Simulation simulation(read(body("left", -10.0, -3.0, 100.0, "5 GPa", range) +
                               body("right", -2.8, 4.2, -100.0, "5 GPa", range)),
                          parallel::world());
    run_to(simulation, 4e-6);
    return simulation;
  };
  expect_same(run(touching), run(apart));
}

// Nothing of them is kept between steps: a restart after the bridge has gone is the same run.
TEST(PiecesOfABody, RestartBitwise) {
  const cases::Case setup = read(body("bar", -10.0, 10.0, 0.0, "5 GPa", touching));
  Simulation first = thrown(setup, 100.0, 1e-3, 0.0);
  run_to(first, 6e-6);  // the halves are in contact
  Simulation second(setup, Particles(first.particles()), first.state(), parallel::world(),
                    std::vector<fem::Mesh>(first.meshes().begin(), first.meshes().end()));
  run_to(first, 9e-6);
  run_to(second, 9e-6);
  expect_same(first, second);
}

TEST(PiecesOfABody, AreCountedFromTheLargest) {
  const Simulation whole(read(body("bar", -10.0, 10.0, 0.0, "5 GPa", apart)), parallel::world());
  std::vector<fem::Mesh> meshes(whole.meshes().begin(), whole.meshes().end());
  fem::Mesh& mesh = meshes.at(0);
  const std::vector<std::uint8_t> wanted = {1}, unwanted = {0};
  EXPECT_EQ(fem::find_pieces(meshes, wanted, {}, parallel::world()).at(0).count, 1U);
  EXPECT_EQ(fem::find_pieces(meshes, unwanted, {}, parallel::world()).at(0).count, 0U);
  std::vector<std::uint8_t> removed(mesh.elements.size());
  for (std::size_t e = 0; e < removed.size(); ++e) {
    const double x = 1e3 * centre(mesh, e)[0];  // pieces of 5, 9 and 4 layers
    removed[e] = (x > -5.0 && x < -4.0) || (x > 5.0 && x < 6.0) ? 1 : 0;
  }
  fem::remove_elements(mesh, removed);
  const fem::Pieces pieces = fem::find_pieces(meshes, wanted, {}, parallel::world()).at(0);
  EXPECT_EQ(pieces.count, 3U);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const double x = 1e3 * mesh.nodes.position[a][0];
    EXPECT_EQ(pieces.of_node[a], x < -4.5 ? 1U : x < 5.5 ? 0U : 2U) << x;
  }
}

TEST(PiecesOfABody, NeedDeletionAndContact) {
  const auto fault = [](const std::string& more) -> std::string {
    try {
      read(more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(fault(body("bar", -1.0, 1.0, 0.0, "5 GPa", "element_range = { pieces = \"fields\" }\n")),
              testing::HasSubstr("what deletion has taken away"));
  EXPECT_THAT(fault("[contact]\nmethod = \"none\"\n" + body("bar", -1.0, 1.0, 0.0, "5 GPa", touching)),
              testing::HasSubstr("need contact"));
}

}  // namespace element_pieces_test
}  // namespace whipple::verification
