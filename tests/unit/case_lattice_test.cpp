// SPDX-License-Identifier: BSD-3-Clause
// Layered lattices: every particle of a cell in a layer of its own, faces flat, mass and centroid those of the regular
// lattice.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

constexpr double dx = 0.001;

/// Particles of one body of copper whose box begins at the lower corner of the domain.
Particles particles_of(const std::string& more_of_domain, const std::string& shape,
                       const std::string& lattice) {
  return seed(read_case_text("[time]\nend = 1\n[domain]\nlower = [0, 0, 0]\nupper = [0.012, 0.012, 0.012]\n"
                             "cell_size = 0.001\n" +
                                 more_of_domain +
                                 "[[body]]\nname = \"one\"\nmaterial = \"copper.toml\"\nshape = " + shape +
                                 "\ndiscretization = { lattice = \"" + lattice + "\" }\n",
                             "case.toml"))
      .particles;
}

const std::string block = "{ box = { lower = [0.002, 0.002, 0.002], upper = [0.008, 0.008, 0.008] } }";

Vector3 centroid(const Particles& q) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t p = 0; p < q.size(); ++p) sum += q.mass[p] * q.position[p];
  return sum / std::reduce(q.mass.begin(), q.mass.end());
}

/// Whether every part of a cell, whose lower corner is given in cells, has a particle, in a layer of its own along every
/// axis.
void expect_layers(const Particles& q, const Vector3& cell, int axes) {
  std::set<int> parts;
  std::vector<std::set<long>> layers(static_cast<std::size_t>(axes));
  std::size_t count = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Vector3 place = q.position[p] / dx - cell;
    bool inside = true;
    int part = 0;
    for (int a = 0; a < axes; ++a) {
      inside = inside && place[a] > 0.0 && place[a] < 1.0;
      part += (place[a] > 0.5 ? 1 : 0) << a;
    }
    if (!inside) continue;
    ++count;
    parts.insert(part);
    const double of_cell = std::pow(2, axes);  // layers
    for (int a = 0; a < axes; ++a) {
      const double layer = place[a] * of_cell - 0.5;
      EXPECT_NEAR(layer, std::round(layer), 1e-9);
      layers[static_cast<std::size_t>(a)].insert(std::lround(layer));
    }
  }
  const std::size_t all = std::size_t{1} << static_cast<unsigned>(axes);
  EXPECT_EQ(count, all);
  EXPECT_EQ(parts.size(), all);
  for (const std::set<long>& of_axis : layers) EXPECT_EQ(of_axis.size(), all);
}

TEST(LayeredLattice, PutsTheParticlesOfACellInLayersOfTheirOwn) {
  const Particles regular = particles_of("", block, "regular"), layered = particles_of("", block, "layered");
  ASSERT_EQ(layered.size(), regular.size());
  for (const double x : {3, 4, 5, 6}) expect_layers(layered, {x, 4, 6}, 3);
  EXPECT_EQ(layered.mass, regular.mass);
  EXPECT_LT((centroid(layered) - centroid(regular)).norm(), 1e-12 * dx);
}

TEST(LayeredLattice, PutsThoseOfThePlaneInFour) {
  const std::string plane = "dimension = \"plane_strain\"\n",
                    square =
                        "{ box = { lower = [0.002, 0.002, -1], upper = "
                        "[0.008, 0.008, 1] } }";
  const Particles regular = particles_of(plane, square, "regular"),
                  layered = particles_of(plane, square, "layered");
  ASSERT_EQ(layered.size(), regular.size());
  for (const double x : {3, 4, 5, 6}) expect_layers(layered, {x, 5, 0}, 2);
  EXPECT_EQ(layered.mass, regular.mass);
  EXPECT_LT((centroid(layered) - centroid(regular)).norm(), 1e-12 * dx);
}

TEST(LayeredLattice, KeepsFacesFlatButNotAtAPlaneThatTheMaterialGoesOnBeyond) {
  const std::string half = "{ box = { lower = [0, 0.002, 0.002], upper = [0.006, 0.008, 0.008] } }";
  for (const bool mirrored : {true, false}) {
    const Particles q =
        particles_of(mirrored ? "boundary = { x_lower = \"symmetry\" }\n" : "", half, "layered");
    std::set<long> at_plane, at_face;
    for (std::size_t p = 0; p < q.size(); ++p) {
      const double x = q.position[p][0] / dx;
      if (x < 0.5) at_plane.insert(std::lround(1e6 * x));
      if (x > 5.5) at_face.insert(std::lround(1e6 * x));
    }
    EXPECT_EQ(at_face, std::set<long>{5750000});
    EXPECT_EQ(at_plane.size(), mirrored ? 4U : 1U);
  }
}

TEST(LayeredLattice, LeavesCutParticlesAtTheirCentroids) {
  const std::string ball = "{ sphere = { center = [0.006, 0.006, 0.006], radius = 0.0037 } }";
  const Particles regular = particles_of("", ball, "regular"), layered = particles_of("", ball, "layered");
  ASSERT_EQ(layered.size(), regular.size());
  EXPECT_EQ(layered.mass, regular.mass);
  std::vector<double> masses = regular.mass;
  std::ranges::sort(masses);
  const double whole = masses[masses.size() / 2];  // most are
  std::size_t moved = 0;
  for (std::size_t p = 0; p < regular.size(); ++p) {
    const double distance = (layered.position[p] - regular.position[p]).norm();
    EXPECT_LT(distance, 0.5 * dx);
    if (std::abs(regular.mass[p] - whole) > 1e-9 * whole) {
      EXPECT_EQ(distance, 0.0);
    }
    moved += distance > 0.0 ? 1 : 0;
  }
  EXPECT_GT(moved, regular.size() / 3);
}

TEST(LayeredLattice, IsRefusedWhereItMakesNoSense) {
  const auto refused = [](const std::string& of_domain, const std::string& method, const std::string& why) {
    expect_error(
        "[time]\nend = 1\n[domain]\nlower = [0, 0, 0]\nupper = [0.01, 0.01, 0.01]\ncell_size = 0.001\n" +
            of_domain +
            "[[body]]\nname = \"one\"\nmaterial = \"copper.toml\"\nshape = { box = { lower = [0.002, 0.002, "
            "0.002], upper = [0.006, 0.006, 0.006] } }\ndiscretization = { lattice = \"layered\"" +
            method + " }\n",
        {"lattice", why});
  };
  refused("", ", method = \"finite_elements\"", "become particles");
  refused("dimension = \"axisymmetric\"\n", "", "rings");
}

}  // namespace
}  // namespace whipple::cases
