// SPDX-License-Identifier: BSD-3-Clause
// Grains of failure are the Voronoi cells of seeds that lie one in each cube, and their faces a layer of one cell.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/case/failure_grains.hpp"
#include "src/core/base/random_bits.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

constexpr double size = 0.5e-3, strength = 7.0;
const FailureGrains grains{.size = size, .strength = strength, .seed = 4};

/// Returns the share of random places that are beside a face.
double share_at_faces(double cell, bool planar) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(-5e-3, 5e-3);
  constexpr int trials = 20000;
  int at_face = 0;
  for (int n = 0; n < trials; ++n) {
    const Vector3 x(along(random), along(random), along(random));
    at_face += grains.factor(x, cell, planar) == 1.0 ? 1 : 0;
  }
  return static_cast<double>(at_face) / trials;
}

// The faces of the Voronoi cells of random seeds of one per unit volume have an area of 2.910 per unit volume (Poisson; Meijering,
// Philips Res. Rep. 8 (1953) 270), in the plane a length of 2 per unit area; seeds of one per cube lie somewhat more evenly.
TEST(FailureGrains, HaveFacesOfTheAreaOfVoronoiCells) {
  for (const bool planar : {false, true}) {
    const double thin = size / 100.0, area = share_at_faces(thin, planar) * size / thin;
    EXPECT_NEAR(area, planar ? 2.0 : 2.91, 0.2) << planar;
    // A layer is twice as thick with cells twice as large, and the grains stay where they are.
    EXPECT_NEAR(share_at_faces(2.0 * thin, planar) / share_at_faces(thin, planar), 2.0, 0.2) << planar;
  }
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> along(-5e-3, 5e-3);
  for (int n = 0; n < 2000; ++n) {
    const Vector3 x(along(random), along(random), along(random));
    EXPECT_LE(grains.factor(x, size / 10.0, false), grains.factor(x, size / 20.0, false));
    EXPECT_EQ(grains.factor(x, size / 10.0, true),
              grains.factor(x + Vector3(0.0, 0.0, 1.0), size / 10.0, true));
  }
}

TEST(FailureGrains, AreTheSameForAnyNumberOfRanksAndAreReadAndWritten) {
  const std::string key = "failure_grains = { size = \"2 mm\", strength = 5, seed = 3 }\n";
  const std::string scatter = "failure_scatter = { weibull_modulus = 8, seed = 5 }\n";
  const Case setup = read_case_text(domain + sphere + key + scatter, "case.toml");
  const Particles whole = seed(setup).particles;
  std::size_t at = 0, at_faces = 0;
  for (int rank = 0; rank < 3; ++rank) {
    const Particles part = seed(setup, rank, 3).particles;
    for (std::size_t p = 0; p < part.size(); ++p, ++at) {
      ASSERT_EQ(part.failure_threshold_factor[p], whole.failure_threshold_factor[at]);
      const double scattered = setup.bodies[0].failure_scatter.factor(part.id[p], part.volume[p]);
      const double of_grain = part.failure_threshold_factor[p] / scattered;
      ASSERT_NEAR(of_grain, of_grain < 3.0 ? 1.0 : 5.0, 1e-12);  // both factors act
      at_faces += of_grain < 3.0 ? 1U : 0U;
    }
  }
  EXPECT_GT(at_faces, whole.size() / 4);
  EXPECT_LT(at_faces, whole.size());
  const Case again = read_case_text(to_toml(setup, {"copper.toml"}), "run.toml");
  EXPECT_EQ(again.bodies[0].failure_grains.size, 2e-3);
  EXPECT_EQ(again.bodies[0].failure_grains.strength, 5.0);
  EXPECT_EQ(again.bodies[0].failure_grains.seed, 3);
  expect_error(domain + sphere + "failure_grains = { seed = 5 }\n", {"missing key 'size'"});
  expect_error(domain + sphere + "failure_grains = { size = \"1e-25 m\" }\n", {"'size'", "of a cell"});
  expect_error(domain + sphere + "failure_grains = { size = \"1 mm\", strength = 0.5 }\n",
               {"'strength'", "1"});
}

TEST(StrengthScatter, IsUniformTheSameForAnyNumberOfRanksAndIsReadAndWritten) {
  const std::string key = "strength_scatter = { least = 0.8, seed = 3 }\n";
  const Case setup = read_case_text(domain + sphere + key, "case.toml");
  const Particles whole = seed(setup).particles;
  std::size_t at = 0;
  double sum = 0.0, squares = 0.0;
  for (int rank = 0; rank < 3; ++rank) {
    const Particles part = seed(setup, rank, 3).particles;
    for (std::size_t p = 0; p < part.size(); ++p, ++at) {
      ASSERT_EQ(part.id[p], whole.id[at]);
      ASSERT_EQ(part.strength_factor[p], whole.strength_factor[at]);
      ASSERT_GE(part.strength_factor[p], 0.8);
      ASSERT_LE(part.strength_factor[p], 1.0);
      sum += part.strength_factor[p];
      squares += part.strength_factor[p] * part.strength_factor[p];
    }
  }
  ASSERT_EQ(at, whole.size());
  const double n = static_cast<double>(at), mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  EXPECT_NEAR(mean, 0.9, 4.0 * 0.2 / std::sqrt(12.0 * n));
  EXPECT_NEAR(deviation, 0.2 / std::sqrt(12.0), 4.0 * 0.2 / std::sqrt(12.0 * n));
  const Case again = read_case_text(to_toml(setup, {"copper.toml"}), "run.toml");
  EXPECT_EQ(again.bodies[0].strength_scatter.least, 0.8);
  EXPECT_EQ(again.bodies[0].strength_scatter.seed, 3);
  EXPECT_TRUE(seed(read_case_text(domain + sphere, "case.toml")).particles.strength_factor.empty());
  std::string ceramic = sphere;
  ceramic.replace(ceramic.find("copper"), 6, "alumina_99_5_jh2");
  expect_error(domain + ceramic + key, {"flow stress of its own"});
  expect_error(domain + sphere + "strength_scatter = { seed = 5 }\n", {"missing key 'least'"});
  expect_error(domain + sphere + "strength_scatter = { least = 1.5 }\n", {"'least'", "1"});
}

TEST(RandomBits, DependOnBothNumbers) {
  double sum = 0.0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const double u = uniform(7, n);
    ASSERT_GT(u, 0.0);
    ASSERT_LE(u, 1.0);
    EXPECT_NE(u, uniform(8, n));
    sum += u;
  }
  EXPECT_NEAR(sum / 1000.0, 0.5, 0.03);
}

}  // namespace
}  // namespace whipple::cases
