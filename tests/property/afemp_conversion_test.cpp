// SPDX-License-Identifier: BSD-3-Clause
// Conversion of elements to particles keeps mass, momentum, angular momentum and energy, whatever the motion
// and the shape of the elements; surface and transition of nodes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "src/afemp/conversion.hpp"
#include "src/afemp/transition.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/fem/structured.hpp"

// For the parameter output of GoogleTest
namespace whipple {
static void PrintTo(Arrangement arrangement, std::ostream* out) { *out << word_of(arrangement); }
}  // namespace whipple
namespace whipple::fem {
static void PrintTo(Quadrature quadrature, std::ostream* out) { *out << word_of(quadrature); }
}  // namespace whipple::fem

namespace whipple::afemp {
namespace {

constexpr double dx = 1e-3;              // m, cell
constexpr double inertia = dx * dx / 4;  // of quadratic B-splines

/// Returns a mesh with random state; `distortion` displaces its nodes by this fraction of an element.
fem::Mesh random_mesh(fem::Quadrature quadrature, double size, double distortion, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  fem::Hexahedra hexahedra = fem::make_box(Vector3(0, 0, 0), Vector3(4, 3, 5) * size, size);
  for (Vector3& x : hexahedra.nodes) {
    x += distortion * size * Vector3(uniform(random), uniform(random), uniform(random));
  }
  fem::Mesh mesh = fem::make_mesh(hexahedra, quadrature, 1, 0, 10);
  for_each_field<MaterialPoints>([&](const auto& field) {
    using Value = typename std::decay_t<decltype(mesh.points.*(field.values))>::value_type;
    if constexpr (std::is_same_v<Value, double>) {
      for (double& value : mesh.points.*(field.values)) {
        if (std::string(field.name) != "volume") value = 1.5 + uniform(random);
      }
    }
  });
  fem::set_density(mesh, 8000.0);
  for (auto& e : mesh.points.specific_internal_energy) e = 1e5 * (1.5 + uniform(random));
  for (auto& h : mesh.elements.hourglass_energy) h = 1e-4 * (1.5 + uniform(random));
  mark_surface(mesh, {});
  return mesh;
}

struct Sums {
  double mass = 0, energy = 0, volume = 0;
  Vector3 momentum = Vector3::Zero(), angular = Vector3::Zero(), moment = Vector3::Zero();
};

Vector3 axial(const Matrix3& c) { return {c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1)}; }

Sums sums(const fem::Mesh& mesh, const Particles& q) {
  Sums s;
  const fem::Nodes& n = mesh.nodes;
  const auto add = [&](double m, const Vector3& x, const Vector3& v, const Matrix3& c) {
    s.mass += m;
    s.momentum += m * v;
    s.moment += m * x;
    s.angular += m * (x.cross(v) + inertia * axial(c));
    s.energy += 0.5 * m * (v.squaredNorm() + inertia * c.squaredNorm());
  };
  for (std::size_t a = 0; a < n.size(); ++a)
    add(n.mass[a], n.position[a], n.velocity[a], n.affine_velocity[a]);
  for (std::size_t p = 0; p < q.size(); ++p) {
    add(q.mass[p], q.position[p], q.velocity[p], q.affine_velocity[p]);
    s.energy += q.mass[p] * q.specific_internal_energy[p];
    s.volume += q.volume[p] + q.void_volume[p];
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    s.energy += mesh.points.mass[i] * mesh.points.specific_internal_energy[i];
    s.volume += mesh.points.volume[i] + mesh.points.void_volume[i];
  }
  for (const double h : mesh.elements.hourglass_energy) s.energy += h;
  return s;
}

enum class Field { strain, rotation, shock, random };
void PrintTo(Field field, std::ostream* out) {
  *out << std::array{"strain", "rotation", "shock", "random"}.at(static_cast<std::size_t>(field));
}

class Conserves : public testing::TestWithParam<std::tuple<fem::Quadrature, Field, double, Arrangement>> {};

TEST_P(Conserves, MassMomentumAngularMomentumAndEnergy) {
  const auto [quadrature, field, distortion, arrangement] = GetParam();
  fem::Mesh mesh = random_mesh(quadrature, dx, distortion, 5);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  Matrix3 gradient;
  gradient << 3e4, 1e4, -2e4, 1e4, -2e4, 5e3, -2e4, 5e3, 1e4;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3& x = mesh.nodes.position[a];
    Vector3& v = mesh.nodes.velocity[a];
    v = Vector3(2000, -300, 6000);
    if (field == Field::strain) v += gradient * x;
    if (field == Field::rotation) v += Vector3(1e5, -4e4, 2e5).cross(x);
    if (field == Field::shock) v[2] *= x[2] > 2.3 * dx ? -1.0 : 1.0;
    if (field == Field::random) v += 500.0 * Vector3(normal(random), normal(random), normal(random));
    if (field == Field::random) mesh.nodes.affine_velocity[a] = 1e4 * Matrix3::Random();
  }
  std::vector<std::uint8_t> chosen(mesh.elements.size());
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = random() % 3 == 0 ? 1 : 0;
  const auto count = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), 1));
  Particles particles;
  const Sums before = sums(mesh, particles);
  const double converted_before = [&] {
    double m = 0;
    for (std::size_t e = 0; e < chosen.size(); ++e) m += chosen[e] ? fem::mass(mesh, e) : 0.0;
    return m;
  }();
  const ConversionBalance balance = convert_elements(mesh, chosen, inertia, particles, arrangement);
  const Sums after = sums(mesh, particles);

  EXPECT_EQ(balance.elements, count);
  EXPECT_EQ(particles.size(), 8 * count);
  EXPECT_NEAR(balance.mass, converted_before, 1e-13 * before.mass);
  EXPECT_NEAR(after.mass, before.mass, 1e-13 * before.mass);
  EXPECT_NEAR(after.volume, before.volume, 1e-13 * before.volume);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm());
  EXPECT_NEAR(after.energy, before.energy, 1e-13 * before.energy);
  EXPECT_LT((after.moment - before.moment).norm(), 1e-13 * before.moment.norm());
  EXPECT_GE(balance.kinetic_heat, 0.0);
  // The cap of the affine field acts only where neighbouring nodes differ randomly.
  if (field == Field::strain || field == Field::rotation) {
    EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm());
  }
  std::set<std::uint64_t> ids;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    EXPECT_EQ(particles.body[p], 1U);
    EXPECT_EQ(particles.generation[p], 0);
    ids.insert(particles.id[p]);
  }
  EXPECT_EQ(ids.size(), particles.size());
}

INSTANTIATE_TEST_SUITE_P(Motions, Conserves,
                         testing::Combine(testing::Values(fem::Quadrature::one_point, fem::Quadrature::b_bar),
                                          testing::Values(Field::strain, Field::rotation, Field::shock,
                                                          Field::random),
                                          testing::Values(0.0, 0.15),
                                          testing::Values(Arrangement::regular, Arrangement::layered)));

// In a linear field particles in a cube of one cell take C = 3/4 of the gradient, and 3/64 h^2 |G|^2 / 2 of
// kinetic energy per mass becomes heat (docs/theory/afemp.md, 3.7).
TEST(Conversion, HeatOfALinearFieldIsThatOfTheTheory) {
  fem::Mesh mesh = random_mesh(fem::Quadrature::one_point, dx, 0.0, 3);
  Matrix3 gradient;
  gradient << 1e4, 2e4, 0, -3e4, 5e3, 1e4, 0, 2e4, -1e4;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    mesh.nodes.velocity[a] = gradient * mesh.nodes.position[a];
  }
  const double mass = fem::totals(mesh).mass;
  Particles particles;
  const ConversionBalance balance =
      convert_elements(mesh, std::vector<std::uint8_t>(mesh.elements.size(), 1), inertia, particles);
  EXPECT_EQ(mesh.nodes.size(), 0U);
  EXPECT_EQ(mesh.elements.size(), 0U);
  EXPECT_NEAR(balance.kinetic_heat, mass * 3.0 / 64 * 0.5 * dx * dx * gradient.squaredNorm(),
              1e-9 * balance.kinetic_heat);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    EXPECT_LT((particles.affine_velocity[p] - 0.75 * gradient).norm(), 1e-9 * gradient.norm());
    EXPECT_LT((particles.velocity[p] - gradient * particles.position[p]).norm(), 1e-9 * gradient.norm() * dx);
    EXPECT_NEAR(particles.extent[p].xx, dx * dx / 16, 1e-12 * dx * dx);
  }
}

TEST(Conversion, NodesWithoutElementsVanishAndNewSurfaceIsMarked) {
  fem::Mesh mesh = random_mesh(fem::Quadrature::one_point, dx, 0.0, 3);
  std::size_t inside = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) inside += mesh.nodes.on_surface[a] == 0;
  EXPECT_EQ(inside, 3U * 2U * 4U);
  EXPECT_EQ(mesh.nodes.size(), 5U * 4U * 6U);
  // The corner element takes one node with it; an inner element none.
  std::vector<std::uint8_t> chosen(mesh.elements.size(), 0);
  for (std::size_t e = 0; e < chosen.size(); ++e) {
    for (const std::uint32_t a : mesh.elements.corners[e]) {
      if (mesh.nodes.position[a].norm() < 1e-9) chosen[e] = 1;
    }
  }
  Particles particles;
  EXPECT_EQ(convert_elements(mesh, chosen, inertia, particles).elements, 1U);
  EXPECT_EQ(mesh.nodes.size(), 5U * 4U * 6U - 1);
  std::size_t inside_now = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) inside_now += mesh.nodes.on_surface[a] == 0;
  EXPECT_EQ(inside_now, inside - 1);
  EXPECT_EQ(particles.id.front() / 8, 10U);
}

TEST(Thresholds, EachOfThemFindsItsElement) {
  fem::Mesh mesh = random_mesh(fem::Quadrature::one_point, dx, 0.0, 3);
  for (auto& strain : mesh.points.plastic_strain) strain = 0.1;
  for (auto& failed : mesh.points.failed) failed = 0;
  for (auto& c : mesh.points.sound_speed) c = 5000.0;
  for (auto& q : mesh.points.artificial_viscosity) q = 0.0;
  mesh.points.plastic_strain[7] = 0.6;
  mesh.points.failed[9] = 2;
  mesh.points.sound_speed[11] = 50000.0;
  mesh.nodes.position[0] += Vector3(0.8, 0.8, 0.8) * dx;  // the corner nearly meets its opposite one
  const double dt = fem::critical_time_step(mesh, 0, {});
  const auto found = [&](const Thresholds& thresholds) {
    std::vector<std::size_t> list;
    const auto flags = distorted_elements(mesh, thresholds, {}, dt);
    for (std::size_t e = 0; e < flags.size(); ++e) {
      if (flags[e] != 0) list.push_back(e);
    }
    return list;
  };
  using List = std::vector<std::size_t>;
  EXPECT_EQ(found({}), List{});
  EXPECT_EQ(found({.plastic_strain = 0.5}), List{7});
  EXPECT_EQ(found({.failed = true}), List{9});
  EXPECT_EQ(found({.time_step_ratio = 0.5}), List{11});
  EXPECT_EQ(found({.jacobian = 0.3}), List{0});
}

TEST(Transition, NodesNearParticlesAndOtherBodiesMoveWithTheGrid) {
  const grid::Geometry geometry{.lower = Vector3::Constant(-10 * dx),
                                .cells = {40, 40, 40},
                                .cell_size = dx,
                                .boundary = {},
                                .levels = {}};
  std::vector<fem::Mesh> meshes;
  meshes.push_back(random_mesh(fem::Quadrature::one_point, dx, 0.0, 3));
  fem::Hexahedra other = fem::make_box(Vector3(0, 0, 6.5) * dx, Vector3(4, 3, 8) * dx, dx);
  meshes.push_back(fem::make_mesh(other, fem::Quadrature::one_point, 2));
  fem::set_density(meshes[1], 8000.0);
  mark_surface(meshes[1], geometry);
  const auto marked = [&](std::size_t m) {
    std::size_t count = 0;
    for (const std::uint8_t flag : meshes[m].nodes.in_transition) count += flag;
    return count;
  };
  Particles particles;
  // The faces z = 5 and z = 6.5 are in adjacent cells; nothing else is in contact.
  EXPECT_EQ(mark_transition(meshes, {}, particles, geometry, inertia, parallel::world()), 0.0);
  EXPECT_EQ(marked(0), 5U * 4U);
  EXPECT_EQ(marked(1), 5U * 4U);
  // One cell further apart they are not; the affine field of the nodes becomes heat of the elements.
  double affine = 0;
  for (std::size_t a = 0; a < meshes[0].nodes.size(); ++a) {
    if (meshes[0].nodes.in_transition[a] == 0) continue;
    meshes[0].nodes.affine_velocity[a] = 1e4 * Matrix3::Identity();
    affine += 0.5 * meshes[0].nodes.mass[a] * inertia * 3e8;
  }
  for (Vector3& x : meshes[1].nodes.position) x[2] += dx;
  const double before = fem::totals(meshes[0]).internal_energy;
  EXPECT_NEAR(mark_transition(meshes, {}, particles, geometry, inertia, parallel::world()), affine,
              1e-12 * affine);
  EXPECT_NEAR(fem::totals(meshes[0]).internal_energy - before, affine, 1e-9 * affine);
  EXPECT_EQ(marked(0) + marked(1), 0U);
  // A particle next to a corner; an inner node would not be in its range.
  particles.position = {Vector3(-0.5, -0.5, -0.5) * dx};
  mark_transition(meshes, {}, particles, geometry, inertia, parallel::world());
  EXPECT_EQ(marked(0), 1U);
  // Nodes with prescribed velocities are excluded.
  const std::uint32_t corner = 0;
  fem::constrain(meshes[0], std::span(&corner, 1), fem::constraint::x, Vector3(1, 0, 0));
  mark_transition(meshes, {}, particles, geometry, inertia, parallel::world());
  EXPECT_EQ(marked(0), 0U);
}

}  // namespace
}  // namespace whipple::afemp
