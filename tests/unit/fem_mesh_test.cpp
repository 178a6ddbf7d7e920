// SPDX-License-Identifier: BSD-3-Clause
// Meshes: generators against exact volumes, checks and their messages, removal of elements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/fem/facets.hpp"
#include "src/fem/order.hpp"
#include "tests/unit/fem_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::fem_test {
namespace {

using fem::Hexahedra;
using std::numbers::pi;
using ::testing::AllOf;
using ::testing::HasSubstr;

double volume_of(const Hexahedra& mesh) {
  const fem::Mesh built = fem::make_mesh(mesh, Quadrature::one_point);
  double sum = 0.0;
  for (std::size_t e = 0; e < built.elements.size(); ++e) sum += fem::volume(built, e);
  return sum;
}

/// Number of faces that belong to one element, after merging of nodes; a conforming mesh has them on its
/// surface.
std::size_t surface_faces(const Hexahedra& mesh, const std::function<bool(const Vector3&)>& on_surface) {
  constexpr std::array<std::array<int, 4>, 6> faces = {
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  std::map<std::array<std::uint32_t, 4>, int> count;
  for (const auto& corners : mesh.elements) {
    for (const auto& face : faces) {
      std::array<std::uint32_t, 4> key;
      for (std::size_t i = 0; i < 4; ++i) key[i] = corners[static_cast<std::size_t>(face[i])];
      std::ranges::sort(key);
      ++count[key];
    }
  }
  std::size_t free = 0;
  for (const auto& [key, n] : count) {
    EXPECT_LE(n, 2);
    if (n != 1) continue;
    ++free;
    for (const std::uint32_t node : key)
      EXPECT_TRUE(on_surface(mesh.nodes[node])) << mesh.nodes[node].transpose();
  }
  return free;
}

/// Worst element: least Jacobian of the corners over the mean one.
double quality(const Hexahedra& mesh) {
  const fem::Mesh built = fem::make_mesh(mesh, Quadrature::one_point);
  double worst = 1.0;
  for (std::size_t e = 0; e < built.elements.size(); ++e)
    worst = std::min(worst, fem::scaled_jacobian(built, e));
  return worst;
}

TEST(Meshes, Box) {
  const Hexahedra box = fem::make_box(Vector3(1, 2, 3), Vector3(2, 4, 6), 0.5);
  EXPECT_EQ(box.elements.size(), 2U * 4U * 6U);
  EXPECT_EQ(box.nodes.size(), 3U * 5U * 7U);
  fem::check(box, "box");
  EXPECT_NEAR(volume_of(box), 6.0, 1e-14);
  EXPECT_NEAR(quality(box), 1.0, 1e-12);
}

/// Curved bodies: the volume is the exact one whatever the size, the surface converges to where it should be
/// with second order, no node is doubled, elements are good, halves and quarters are halves and quarters.
struct Round {
  const char* name;
  double volume;
  std::function<Hexahedra(double, fem::Halved)> make;
  std::function<double(const Vector3&)> beyond;  // distance of a node of the surface from the exact one
  int halvings;                                  // axes that can be halved
  double least_quality;
  double size;  // whole numbers of elements fit twice as many at half of it
};
std::vector<Round> rounds() {
  const auto radius = [](const Vector3& x) { return std::hypot(x[0], x[1]); };
  const auto least = [](std::initializer_list<double> distances) {
    return std::ranges::min(distances, {}, [](double d) { return std::abs(d); });
  };
  return {{"cylinder", pi * 4.0 * 3.0,
           [](double h, fem::Halved half) { return fem::make_cylinder(2.0, 3.0, h, half); },
           [=](const Vector3& x) { return least({radius(x) - 2.0, x[2], x[2] - 3.0}); }, 2, 0.3, 0.5},
          {"tube", pi * (4.0 - 1.0) * 3.0,
           [](double h, fem::Halved half) { return fem::make_tube(1.0, 2.0, 3.0, h, half); },
           [=](const Vector3& x) { return least({radius(x) - 2.0, radius(x) - 1.0, x[2], x[2] - 3.0}); }, 2,
           0.8, 0.4},
          {"sphere", 4.0 / 3.0 * pi * 8.0,
           [](double h, fem::Halved half) { return fem::make_sphere(2.0, h, half); },
           [=](const Vector3& x) { return x.norm() - 2.0; }, 3, 0.25, 0.5}};
}

TEST(Meshes, RoundBodies) {
  for (const Round& round : rounds()) {
    const Hexahedra coarse = round.make(round.size, {}), fine = round.make(0.5 * round.size, {});
    fem::check(coarse, round.name);
    fem::check(fine, round.name);
    EXPECT_NEAR(volume_of(coarse), round.volume, 1e-12 * round.volume) << round.name;
    EXPECT_NEAR(volume_of(fine), round.volume, 1e-12 * round.volume) << round.name;
    EXPECT_NEAR(fem::volume(fine), round.volume, 1e-12 * round.volume) << round.name;
    const auto farthest = [&](const Hexahedra& mesh) {
      double distance = 0.0;
      const std::size_t faces = surface_faces(mesh, [&](const Vector3& x) {
        distance = std::max(distance, std::abs(round.beyond(x)));
        return true;
      });
      EXPECT_GT(faces, 20U) << round.name;
      return distance;
    };
    const double first = farthest(coarse), second = farthest(fine);
    EXPECT_NEAR(std::log2(first / second), 2.0, 0.15) << round.name;
    EXPECT_LT(second, 0.02) << round.name;
    EXPECT_GT(quality(fine), round.least_quality) << round.name;
    fem::Halved half = {};
    double share = 1.0;
    for (int axis = 0; axis < round.halvings; ++axis) {
      half[static_cast<std::size_t>(axis)] = true;
      share *= 0.5;
      const Hexahedra part = round.make(round.size, half);
      EXPECT_NEAR(volume_of(part), share * volume_of(coarse), 1e-12 * round.volume) << round.name;
      for (const Vector3& x : part.nodes) EXPECT_GT(x[axis], -1e-12);
    }
  }
}

// Noses from a hemisphere to a needle, coarse and fine: sound elements, a sharp tip at the right place, the
// surface on the arc but for the widening of polygons, the volume of the ogive to second order.
TEST(Meshes, Ogive) {
  const double radius = 2.0, shank = 5.0;
  for (const double nose : {2.0, 3.7, 6.6, 14.0}) {
    const double arc = (radius * radius + nose * nose) / (2 * radius), depth = arc - radius;
    const double volume =
        pi * (radius * radius * shank + arc * arc * nose - nose * nose * nose / 3 + depth * depth * nose -
              depth * (nose * depth + arc * arc * std::asin(nose / arc)));
    std::array<double, 2> error;
    for (const bool fine : {false, true}) {
      const Hexahedra mesh = fem::make_ogive(radius, nose, shank, fine ? 0.25 : 0.5);
      const double half_angle = pi / (fine ? 32 : 16);  // of the arc between two corners of the polygon
      const double widened = std::sqrt(half_angle / (std::sin(half_angle) * std::cos(half_angle)));
      fem::check(mesh, "ogive");
      EXPECT_GT(quality(mesh), nose < 10.0 ? 0.2 : 0.09) << nose;  // flat in the tip of a needle
      error[fine ? 1 : 0] = 1.0 - volume_of(mesh) / volume;
      double tip = 0.0;
      surface_faces(mesh, [&](const Vector3& x) {
        tip = std::max(tip, x[2]);
        const double along = std::max(x[2] - shank, 0.0),
                     exact = std::sqrt(arc * arc - along * along) - depth;
        const double r = std::hypot(x[0], x[1]) / widened;
        return x[2] < 1e-12 ? r <= radius * (1 + 1e-12) : std::abs(r - exact) < 1e-9 * radius;
      });
      EXPECT_NEAR(tip, shank + nose, 1e-12);
    }
    EXPECT_GT(error[0], 0.0);
    EXPECT_LT(error[0], 0.01) << nose;
    EXPECT_GT(std::log2(error[0] / error[1]), 1.7) << nose;
  }
}

// Facets close the body, are turned outwards, and bound its volume, also after elements are gone.
TEST(Meshes, FacetsAreTheSurface) {
  fem::Mesh mesh = fem::make_mesh(fem::make_box({0, 0, 0}, {3, 2, 2}, {3, 2, 2}), Quadrature::one_point);
  fem::set_density(mesh, 1.0);
  const auto expect_surface = [&](std::size_t faces, double volume) {
    const std::vector<fem::Facet> facets = fem::surface_facets(mesh);
    EXPECT_EQ(facets.size(), faces);
    Vector3 sum = Vector3::Zero();
    double enclosed = 0.0;  // divergence theorem
    for (const fem::Facet& facet : facets) {
      const auto x = [&](std::size_t i) { return mesh.nodes.position[facet[i]]; };
      const Vector3 area = 0.5 * (x(2) - x(0)).cross(x(3) - x(1));
      sum += area;
      enclosed += area.dot(0.25 * (x(0) + x(1) + x(2) + x(3))) / 3.0;
    }
    EXPECT_LT(sum.norm(), 1e-14);
    EXPECT_NEAR(enclosed, volume, 1e-13);
  };
  expect_surface(32, 12.0);
  std::vector<std::uint8_t> removed(mesh.elements.size(), 0);
  for (std::size_t e = 0; e < removed.size(); ++e) {  // the corner at the origin
    removed[e] = std::ranges::any_of(mesh.elements.corners[e],
                                     [&](std::uint32_t a) { return mesh.nodes.position[a].norm() < 0.1; });
  }
  fem::remove_elements(mesh, removed);
  expect_surface(32, 11.0);
}

TEST(Meshes, TransformKeepsElementsUpright) {
  Hexahedra box = fem::make_box(Vector3::Zero(), Vector3(1, 2, 3), 1.0);
  Matrix3 mirror = Matrix3::Identity();
  mirror(1, 1) = -1.0;
  fem::transform(box, mirror, Vector3(10, 0, 0));
  fem::check(box, "mirrored");
  EXPECT_NEAR(volume_of(box), 6.0, 1e-14);
}

/// Share of the elements that the kernels take as rows, after a check that the groups are the elements in
/// their order, with the right slots.
double share_in_rows(const Hexahedra& hexahedra) {
  const fem::Mesh mesh = fem::make_mesh(hexahedra, fem::Quadrature::one_point);
  const fem::Blocks& blocks = mesh.blocks;
  std::size_t next = 0, in_rows = 0;
  for (std::size_t block = 0; block + 1 < blocks.first_group.size(); ++block) {
    for (std::size_t g = blocks.first_group[block]; g < blocks.first_group[block + 1]; ++g) {
      const fem::ElementGroup& group = blocks.groups[g];
      EXPECT_EQ(group.first, next);
      EXPECT_EQ(group.first / fem::Blocks::size, block);
      next += group.count;
      if (group.is_row != 0) in_rows += group.count;
      for (std::size_t l = 0; l < group.count; ++l) {
        for (std::size_t a = 0; a < 8; ++a) {
          EXPECT_EQ(blocks.slot_node[blocks.first_slot[block] + group.slot[a][l]],
                    mesh.elements.corners[group.first + l][a]);
          if (group.is_row != 0) {
            EXPECT_EQ(group.slot[a][l], group.slot[a][0] + l);
          }
        }
      }
    }
  }
  EXPECT_EQ(next, hexahedra.elements.size());
  return static_cast<double>(in_rows) / static_cast<double>(next);
}

// Structured meshes are rows but for a few elements, also beyond the mirror planes on which quarters are
// joined, and whichever direction is the long one.
TEST(Order, StructuredMeshesAreRows) {
  EXPECT_EQ(share_in_rows(fem::make_box(Vector3::Zero(), Vector3(16, 3, 2), {16, 3, 2})), 1.0);
  EXPECT_EQ(share_in_rows(fem::make_box(Vector3::Zero(), Vector3(3, 37, 2), {3, 37, 2})), 1.0);
  EXPECT_EQ(share_in_rows(fem::make_box(Vector3::Zero(), Vector3(3, 2, 21), {3, 2, 21})), 1.0);
  EXPECT_GT(share_in_rows(fem::make_cylinder(2.0, 10.0, 0.4)), 0.98);   // blocks end within rows
  EXPECT_GT(share_in_rows(fem::make_ogive(2.0, 6.6, 5.0, 0.5)), 0.95);  // the cap's rows are short
  EXPECT_EQ(share_in_rows(fem::make_box(Vector3::Zero(), Vector3(2, 2, 2), {2, 2, 2})), 0.0);
}

// A ring of elements is cut open somewhere; every element and node is there once.
TEST(Order, HoldsEveryElementAndNodeOnce) {
  for (const Hexahedra& mesh :
       {fem::make_tube(1.0, 2.0, 3.0, 0.4), fem::make_sphere(2.0, 0.4), fem::make_cylinder(2.0, 1.0, 0.4)}) {
    fem::StorageOrder order = fem::storage_order(mesh.nodes, mesh.elements);
    const auto is_permutation = [](std::vector<std::uint32_t>& numbers, std::size_t of) {
      std::ranges::sort(numbers);
      std::vector<std::uint32_t> all(of);
      std::iota(all.begin(), all.end(), 0U);
      return numbers == all;
    };
    EXPECT_TRUE(is_permutation(order.elements, mesh.elements.size()));
    EXPECT_TRUE(is_permutation(order.nodes, mesh.nodes.size()));
    share_in_rows(mesh);
  }
}

TEST(Checks, SayWhatIsWrong) {
  const Hexahedra good = fem::make_box(Vector3::Zero(), Vector3(3, 1, 1), 1.0);
  Hexahedra inverted = good;
  for (int a = 0; a < 4; ++a)
    std::swap(inverted.elements[1][static_cast<std::size_t>(a)],
              inverted.elements[1][static_cast<std::size_t>(a + 4)]);
  EXPECT_THAT(
      message_of<InputError>([&] { fem::check(inverted, "box"); }),
      AllOf(HasSubstr("box: element 1 is inverted or flat at corner 0: Jacobian -0.125 m^3 (volume -1 m^3)"),
            HasSubstr("the order of the corners")));
  Hexahedra degenerate = good;
  degenerate.elements[2][7] = degenerate.elements[2][6];
  EXPECT_THAT(message_of<InputError>([&] { fem::check(degenerate, "box"); }),
              HasSubstr("element 2 is degenerate: corners 6 and 7 are one node"));
  Hexahedra missing = good;
  missing.elements[0][3] = 99;
  EXPECT_THAT(message_of<InputError>([&] { fem::check(missing, "box"); }),
              HasSubstr("element 0 is wrong: node 99 does not exist, there are 16"));
  Hexahedra folded = good;  // positive volume, one corner turned inside out
  folded.nodes[folded.elements[0][6]] = Vector3(0.2, 0.2, 0.2);
  EXPECT_THAT(message_of<InputError>([&] { fem::check(folded, "box"); }),
              HasSubstr("element 0 is inverted or flat at corner 6"));
  Hexahedra unused = good;
  unused.nodes.emplace_back(5, 5, 5);
  EXPECT_THAT(message_of<InputError>([&] { fem::check(unused, "box"); }),
              HasSubstr("box: node 16 belongs to no element"));
  EXPECT_THAT(message_of<InputError>([&] { fem::check({}, "box"); }), HasSubstr("no hexahedra"));
  EXPECT_THAT(message_of<InputError>([&] { fem::make_box(Vector3::Zero(), Vector3(1, 0, 1), 0.1); }),
              HasSubstr("each edge must be positive, not 0 m"));
  EXPECT_THAT(message_of<InputError>([&] { fem::make_cylinder(1.0, 1.0, -0.1); }),
              HasSubstr("the size of an element must be positive, not -0.1 m"));
  EXPECT_THAT(message_of<InputError>([&] { fem::make_tube(1.0, 1.0, 1.0, 0.1); }),
              HasSubstr("the outer radius less the inner one"));
}

TEST(Removal, KeepsMassMomentumAndStateOfTheRest) {
  for (const Quadrature quadrature : both) {
    Body body(Solid{}.material(), distorted_box(3, 1.0, 0.2), quadrature);
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (Vector3& v : body.mesh.nodes.velocity)
      v = Vector3(uniform(generator), uniform(generator), uniform(generator));
    for (double& e : body.mesh.points.specific_internal_energy) e = uniform(generator);
    const fem::MeshTotals before = totals(body.mesh);
    // A layer of nine: four nodes at its corners of the cube vanish, and the rest of its outer face.
    std::vector<std::uint8_t> removed(27, 0);
    double mass = 0.0, energy = 0.0;
    Vector3 momentum = Vector3::Zero();
    const std::size_t n = points_per_element(quadrature);
    for (std::size_t e = 0; e < 27; ++e) {
      if (body.mesh.elements.id[e] >= 9) continue;
      removed[e] = 1;
      mass += fem::mass(body.mesh, e);
      for (std::size_t q = 0; q < n; ++q) {
        energy += body.mesh.points.mass[n * e + q] * body.mesh.points.specific_internal_energy[n * e + q];
      }
      double corners = 0.0;
      for (std::size_t a = 0; a < 8; ++a) {
        corners += fem::corner_mass(body.mesh, e, a);
        momentum +=
            fem::corner_mass(body.mesh, e, a) * body.mesh.nodes.velocity[body.mesh.elements.corners[e][a]];
      }
      EXPECT_NEAR(corners, fem::mass(body.mesh, e), 1e-12 * mass);
    }
    fem::remove_elements(body.mesh, removed);
    const fem::MeshTotals after = totals(body.mesh);
    EXPECT_EQ(body.mesh.elements.size(), 18U);
    EXPECT_EQ(body.mesh.nodes.size(), 48U);
    EXPECT_EQ(body.mesh.points.size(), 18U * n);
    EXPECT_NEAR(after.mass, before.mass - mass, 1e-13 * before.mass);
    EXPECT_LT((after.momentum - before.momentum + momentum).norm(), 1e-12 * before.momentum_scale);
    EXPECT_NEAR(after.internal_energy, before.internal_energy - energy, 1e-12 * before.mass);
    fem::internal_forces(body.mesh);  // the derived lists fit
    std::ranges::fill(removed, 1);
    removed.resize(18);
    fem::remove_elements(body.mesh, removed);
    EXPECT_EQ(body.mesh.nodes.size(), 0U);
    EXPECT_EQ(fem::critical_time_step(body.mesh, {}), std::numeric_limits<double>::infinity());
  }
}

}  // namespace
}  // namespace whipple::fem_test
