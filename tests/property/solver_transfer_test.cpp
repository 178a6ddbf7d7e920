// SPDX-License-Identifier: BSD-3-Clause
// Properties of grid and transfers on random particles: conservation, mirror planes equal to real images,
// identity of work and heat, independence of how blocks are stored.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/contact/grid_update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/particles_to_grid.hpp"
#include "src/transfer/transition_nodes.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {
namespace {

struct NodeSums {
  double mass = 0;
  Vector3 momentum = Vector3::Zero(), force = Vector3::Zero(), angular = Vector3::Zero(),
          torque = Vector3::Zero();
};

NodeSums node_sums(grid::BlockGrid& grid) {
  NodeSums sums;
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    for (int i = 0; i < grid::nodes_per_block; ++i) {
      const grid::Node& node = grid.nodes(s)[i];
      const grid::BlockCoordinate& c = grid.coordinate(s);
      const Vector3 x =
          grid.geometry().lower + dx * Vector3(c[0] * 4 + i / 16, c[1] * 4 + i / 4 % 4, c[2] * 4 + i % 4);
      const Vector3 momentum = node.sums.momentum();
      sums.mass += node.sums.mass();
      sums.momentum += momentum;
      sums.force += node.sums.force();
      sums.angular += x.cross(momentum);
      sums.torque += x.cross(node.sums.force());
    }
  }
  return sums;
}

template <class Shape>
class Transfer : public testing::Test {};
using Shapes = testing::Types<Linear, Gimp, ConvectedGimp, QuadraticBSpline, CubicBSpline>;
TYPED_TEST_SUITE(Transfer, Shapes);

TYPED_TEST(Transfer, MassAndMomentumArriveOnTheGridAndForcesSumToZero) {
  const Particles q = random_particles(500, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 1);
  grid::BlockGrid grid(geometry(), parallel::world());
  bin<TypeParam>(grid, q);
  particles_to_grid(smoothed<TypeParam>(), q, grid);
  const NodeSums sums = node_sums(grid);
  double mass = 0;
  Vector3 momentum = Vector3::Zero();
  for (std::size_t p = 0; p < q.size(); ++p) {
    mass += q.mass[p];
    momentum += q.mass[p] * q.velocity[p];
  }
  EXPECT_NEAR(sums.mass, mass, 1e-11 * mass);
  EXPECT_LT((sums.momentum - momentum).norm(), 1e-10);
  EXPECT_LT(sums.force.norm(), 1e-10);
}

template <class Shape>
class AffineTransfer : public testing::Test {};
using AffineShapes = testing::Types<QuadraticBSpline, CubicBSpline>;
TYPED_TEST_SUITE(AffineTransfer, AffineShapes);

TYPED_TEST(AffineTransfer, AngularMomentumWithTheAffineFieldsArrivesOnTheGrid) {
  const Particles q = random_particles(500, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 2);
  grid::BlockGrid grid(geometry(), parallel::world());
  bin<TypeParam>(grid, q);
  particles_to_grid(smoothed<TypeParam>(), q, grid);
  Vector3 angular = Vector3::Zero();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Matrix3& c = q.affine_velocity[p];
    const Vector3 spin(c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1));
    angular += q.mass[p] * (q.position[p].cross(q.velocity[p]) + affine_inertia(TypeParam::kind, dx) * spin);
  }
  EXPECT_LT((node_sums(grid).angular - angular).norm(), 1e-9 * angular.norm());
}

double total_energy(const Particles& q, ShapeFunction shape) {
  double sum = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    sum += 0.5 * q.mass[p] *
           (q.velocity[p].squaredNorm() + affine_inertia(shape, dx) * q.affine_velocity[p].squaredNorm());
  }
  for (std::size_t p = 0; p < q.size(); ++p) sum += q.mass[p] * q.specific_internal_energy[p];
  return sum;
}

/// One symplectic transfer cycle; checks the exact identities of section 4 of docs/theory/mpm.md.
/// @param bonded     as of BlockGrid::bond_at_planes
/// @param smoothing  of the slopes
/// @returns heat of the contact with images, as a fraction of the energies
template <class Shape>
double check_energy_identities(const Relaxation& relaxation, AffineField affine,
                               std::array<grid::Boundary, 6> boundary, const Vector3& lower,
                               const std::array<grid::FieldSet, 6>* bonded = nullptr,
                               double smoothing = 1.3) {
  Particles q = random_particles(700, lower, Vector3(8, 6.5, 11.8), 3);
  if (affine == AffineField::none) {
    for (Matrix3& c : q.affine_velocity) c.setZero();
  }
  grid::BlockGrid grid(geometry(boundary), parallel::world());
  if (bonded != nullptr) grid.bond_at_planes(*bonded);
  bool meets_images = false;
  for (std::size_t face = 0; face < 6; ++face) meets_images = meets_images || grid.is_apart_at(face);
  bin<Shape>(grid, q);
  particles_to_grid(smoothed<Shape>(smoothing), q, grid);
  contact::GridUpdate update;
  constexpr double dt = 0.05;
  update.mirror_contact().find_surfaces(Shape::kind, q, {}, grid, dt);
  const double before = total_energy(q, Shape::kind);
  Vector3 momentum_before = Vector3::Zero(), momentum_after = Vector3::Zero();
  for (std::size_t p = 0; p < q.size(); ++p) momentum_before += q.mass[p] * q.velocity[p];
  const GridBalance balance = advance(update, grid, dt, relaxation);
  std::vector<Matrix3> gradient(q.size());
  const std::vector<double> energy = q.specific_internal_energy;
  const TransferBalance transfer =
      grid_to_particles({smoothed<Shape>(smoothing), dt, affine, {}, {}}, q, grid, gradient);
  for (std::size_t p = 0; p < q.size(); ++p) momentum_after += q.mass[p] * q.velocity[p];

  const double scale = std::abs(before) + balance.before;
  EXPECT_NEAR(total_energy(q, Shape::kind), before, 1e-12 * scale);
  if (!meets_images) {  // the energies of the nodes are those before contact
    EXPECT_NEAR(balance.after - balance.before, -transfer.work, 1e-12 * scale);
  }
  const double heat = update.take_contact_heat();
  // (Where a no-slip wall meets another plane, both couple the same components.)
  EXPECT_GE(heat, std::ranges::count(boundary, grid::Boundary::no_slip) > 0 ? -1e-4 * scale : -1e-14 * scale);
  EXPECT_GE(transfer.heat, 0.0);
  EXPECT_LT((momentum_after - momentum_before - balance.wall_impulse).norm(), 1e-10 * scale);
  return heat / scale;
}

TYPED_TEST(Transfer, EnergyAndMomentumAreExactForEveryMemberOfTheFamily) {
  using enum AffineField;
  for (const Relaxation& relaxation :
       {Relaxation{.kappa = 0.2}, Relaxation{.kappa = 5.0}, Relaxation{.fixed = 1.0},
        Relaxation{.fixed = 0.0}, Relaxation{.fixed = 0.37}}) {
    for (const AffineField affine : {none, deformed, turned}) {
      if (affine != none && !CarriesAffineField<TypeParam>) continue;
      check_energy_identities<TypeParam>(relaxation, affine, {}, Vector3(-1.2, -0.3, 4));
    }
  }
}

// Force and work use the same slopes, whatever these are, and so does the torque of a symmetric force.
TEST(SmoothSlopes, KeepEnergyMomentumAndAngularMomentumForAnySmoothing) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(0.0, 2.0);
  const Particles q = random_particles(500, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 1);
  for (const double smoothing : {0.0, any(random), any(random), 2.0}) {
    check_energy_identities<QuadraticBSpline>({}, AffineField::deformed, {}, Vector3(-1.2, -0.3, 4), nullptr,
                                              smoothing);
    check_energy_identities<QuadraticBSpline>({}, AffineField::turned, {grid::Boundary::symmetry},
                                              Vector3(-2, -1, 3), nullptr, smoothing);
    grid::BlockGrid grid(geometry(), parallel::world());
    bin<QuadraticBSpline>(grid, q);
    particles_to_grid(smoothed<QuadraticBSpline>(smoothing), q, grid);
    const NodeSums sums = node_sums(grid);
    EXPECT_LT(sums.force.norm(), 1e-10) << smoothing;
    EXPECT_LT(sums.torque.norm(), 1e-9) << smoothing;
  }
}

// Nodes of elements among particles receive from the grid what a particle without stress receives that is subject to
// the same force by an external acceleration; all identities therefore hold for them as well.
TYPED_TEST(AffineTransfer, NodesMoveLikeParticlesUnderTheSameForce) {
  constexpr std::size_t all = 700, first = 300;  // those from `first` on are nodes
  constexpr double dt = 0.05;
  const std::array<grid::Boundary, 6> planes = {grid::Boundary::symmetry, grid::Boundary::symmetry};
  Particles q = random_particles(all, Vector3(-2, -0.3, 4), Vector3(9, 6.5, 11.8), 6);
  std::vector<Vector3> acceleration(all, Vector3::Zero());
  TransitionNodes nodes;
  nodes.resize(all - first);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const std::size_t p = first + n;
    q.deviatoric_stress[p] = {};
    q.pressure[p] = q.artificial_viscosity[p] = 0;
    acceleration[p] = 0.3 * q.velocity[(7 * p) % all];
    nodes.mass[n] = q.mass[p];
    nodes.sound_speed[n] = q.sound_speed[p];
    nodes.position[n] = q.position[p];
    nodes.velocity[n] = q.velocity[p];
    nodes.affine_velocity[n] = q.affine_velocity[p];
    nodes.force[n] = q.mass[p] * acceleration[p];
  }
  const std::vector<double> energy = q.specific_internal_energy;
  Particles alone = q;
  std::vector<std::uint32_t> order(first);
  std::iota(order.begin(), order.end(), 0U);
  SortBuffers buffers;
  reorder(alone, order, buffers);
  const auto step = [&](Particles& particles, TransitionNodes* guests) {
    grid::BlockGrid grid(geometry(planes), parallel::world());
    grid.adapt(q.position, q.velocity, 0.0, TypeParam::stencil);
    const std::size_t count = guests ? guests->size() : 0;
    grid.activate(q.position, q.velocity, 0.0, TypeParam::stencil, count);
    ASSERT_TRUE(grid.bin(particles.position, TypeParam::stencil,
                         guests ? std::span<const Vector3>(guests->position) : std::span<const Vector3>()));
    particles_to_grid(smoothed<TypeParam>(), particles, grid,
                      std::span(acceleration).first(particles.size()));
    if (guests) nodes_to_grid(TypeParam::kind, *guests, grid);
    contact::GridUpdate update;
    advance(update, grid, dt, {.kappa = 0.7});
    std::vector<Matrix3> gradient(particles.size());
    grid_to_particles({smoothed<TypeParam>(),
                       dt,
                       AffineField::deformed,
                       {},
                       std::span(acceleration).first(particles.size())},
                      particles, grid, gradient);
    if (guests) grid_to_nodes(smoothed<TypeParam>(), *guests, grid, dt, AffineField::deformed);
  };
  step(q, nullptr);
  step(alone, &nodes);
  for (std::size_t p = 0; p < first; ++p) {
    EXPECT_LT((alone.velocity[p] - q.velocity[p]).norm(), 1e-11) << p;
    EXPECT_NEAR(alone.specific_internal_energy[p], q.specific_internal_energy[p], 1e-11) << p;
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const std::size_t p = first + n;
    EXPECT_LT((nodes.velocity[n] - q.velocity[p]).norm(), 1e-11) << p;
    EXPECT_LT((nodes.position[n] - q.position[p]).norm(), 1e-11) << p;
    EXPECT_LT((nodes.affine_velocity[n] - q.affine_velocity[p]).norm(), 1e-10) << p;
    EXPECT_NEAR(nodes.heat[n] / nodes.mass[n], q.specific_internal_energy[p] - energy[p], 1e-11) << p;
    EXPECT_GE(nodes.heat[n], 0.0) << p;
  }
}

TYPED_TEST(Transfer, EnergyAndMomentumAreExactAtPlanesWallsAndCorners) {
  using enum grid::Boundary;
  constexpr AffineField affine = CarriesAffineField<TypeParam> ? AffineField::deformed : AffineField::none;
  const Vector3 corner(-2, -1, 3);
  const auto check = [&](const Relaxation& relaxation, AffineField with_affine,
                         const std::array<grid::Boundary, 6>& boundary) {
    check_energy_identities<TypeParam>(relaxation, with_affine, boundary, corner);
  };
  check({}, affine, {symmetry, outflow, outflow, outflow, outflow, outflow});
  check({}, affine, {symmetry, outflow, symmetry, outflow, symmetry, outflow});
  check({.fixed = 1.0}, affine, {no_slip, outflow, symmetry, outflow, no_slip, outflow});
  check({}, AffineField::none, {symmetry, outflow, no_slip, outflow, symmetry, outflow});
  check({}, affine, {separating, outflow, outflow, outflow, outflow, outflow});
  check({}, affine, {separating, outflow, symmetry, outflow, separating, outflow});
  // Contact with images, both close (material overlaps them) and as far as the particles fly in the step
  double heat = 0.0;
  for (const double away : {0.0, 0.05, 0.3, 0.6}) {
    const Vector3 lower = corner + Vector3::Constant(away * dx);
    const auto apart = [&](const Relaxation& relaxation, AffineField with_affine,
                           const std::array<grid::Boundary, 6>& boundary,
                           std::array<grid::FieldSet, 6> bonded) {
      heat += check_energy_identities<TypeParam>(relaxation, with_affine, boundary, lower, &bonded);
    };
    const grid::FieldSet first = grid::FieldSet::of(0);
    const std::array<grid::FieldSet, 6> none{};
    apart({}, affine, {symmetry, outflow, outflow, outflow, outflow, outflow}, none);
    apart({}, affine, {symmetry, outflow, symmetry, outflow, symmetry, outflow}, none);
    apart({}, affine, {symmetry, outflow, symmetry, outflow, symmetry, outflow},
          {first, {}, {}, {}, first, {}});
    apart({.fixed = 1.0}, affine, {no_slip, outflow, symmetry, outflow, no_slip, outflow},
          {first, {}, {}, {}, {}, {}});
    apart({.fixed = 0.0}, AffineField::none, {symmetry, outflow, no_slip, outflow, separating, outflow},
          none);
  }
  EXPECT_GT(heat, 0.0);
}

// Folding equals real images: half of the particles with a plane compared with all of them with their images.
TYPED_TEST(Transfer, MirrorPlaneEqualsATransferOfRealImages) {
  using enum grid::Boundary;
  Particles half = random_particles(400, Vector3(-2, 0.5, 4.5), Vector3(1, 5, 10), 4);
  grid::BlockGrid grid(geometry({symmetry, outflow, outflow, outflow, outflow, outflow}), parallel::world());

  constexpr bool affine = CarriesAffineField<TypeParam>;
  constexpr AffineField carried = affine ? AffineField::deformed : AffineField::none;
  if (!affine) std::ranges::fill(half.affine_velocity, Matrix3::Zero().eval());

  // The full problem: a domain with its lower corner further left, particles and images about x = -2.
  Particles full = half;
  resize(full, 2 * half.size());
  for (std::size_t p = 0; p < half.size(); ++p) {
    const std::size_t image = half.size() + p;
    for_each_field(half, [&](const auto& field) {
      const auto& from = field.of(half);
      if (!from.empty()) field.of(full)[image] = from[p];
    });
    const Matrix3 mirror = Vector3(-1, 1, 1).asDiagonal();
    full.position[image][0] = -4 - half.position[p][0];
    full.velocity[image] = mirror * half.velocity[p];
    full.affine_velocity[image] = mirror * half.affine_velocity[p] * mirror;
    full.deviatoric_stress[image] =
        SymmetricTensor::from(mirror * half.deviatoric_stress[p].matrix() * mirror);
  }
  grid::Geometry wide = geometry();
  wide.lower[0] = -2 - 20 * dx;
  wide.cells[0] = 42;
  grid::BlockGrid full_grid(wide, parallel::world());

  constexpr double dt = 0.05;
  std::vector<Matrix3> half_gradient(half.size()), full_gradient(full.size());
  const auto cycle = [&](Particles& q, grid::BlockGrid& g, std::vector<Matrix3>& gradient) {
    bin<TypeParam>(g, q);
    particles_to_grid(smoothed<TypeParam>(), q, g);
    advance(g, dt, {});
    grid_to_particles({smoothed<TypeParam>(), dt, carried, {}, {}}, q, g, gradient);
  };
  cycle(half, grid, half_gradient);
  cycle(full, full_grid, full_gradient);
  for (std::size_t p = 0; p < half.size(); ++p) {
    EXPECT_LT((half.velocity[p] - full.velocity[p]).norm(), 1e-11);
    EXPECT_LT((half.position[p] - full.position[p]).norm(), 1e-12);
    EXPECT_LT((half_gradient[p] - full_gradient[p]).norm(), 1e-10);
    EXPECT_LT((half.affine_velocity[p] - full.affine_velocity[p]).norm(), 1e-10);
    EXPECT_NEAR(half.specific_internal_energy[p], full.specific_internal_energy[p], 1e-11);
  }
}

// Two planes one cell apart, as in a column of one cell: each folds onto nodes of the other.
TYPED_TEST(Transfer, PlanesOneCellApartEqualRealImages) {
  using enum grid::Boundary;
  Particles thin = random_particles(300, Vector3(0, -1, 4.5), Vector3(3, -1 + dx, 7), 6);
  grid::Geometry column = geometry({outflow, outflow, symmetry, symmetry, outflow, outflow});
  column.cells[1] = 1;
  grid::BlockGrid grid(column, parallel::world());

  constexpr bool affine = CarriesAffineField<TypeParam>;
  constexpr AffineField carried = affine ? AffineField::deformed : AffineField::none;
  if (!affine) std::ranges::fill(thin.affine_velocity, Matrix3::Zero().eval());

  // Seven adjacent cells, each the image of its neighbours: all cells that share a node with the column in the middle
  constexpr int copies = 7;
  Particles full = thin;
  resize(full, copies * thin.size());
  for (int copy = 0; copy < copies; ++copy) {
    const int shift = copy <= 3 ? copy : 3 - copy;  // cells: the column itself first
    const bool mirrored = shift % 2 != 0;
    const Matrix3 mirror = Vector3(1, mirrored ? -1 : 1, 1).asDiagonal();
    for (std::size_t p = 0; p < thin.size(); ++p) {
      const std::size_t image = static_cast<std::size_t>(copy) * thin.size() + p;
      for_each_field(thin, [&](const auto& field) {
        const auto& from = field.of(thin);
        if (!from.empty()) field.of(full)[image] = from[p];
      });
      const double depth = thin.position[p][1] + 1;
      full.position[image][1] = -1 + shift * dx + (mirrored ? dx - depth : depth);
      full.velocity[image] = mirror * thin.velocity[p];
      full.affine_velocity[image] = mirror * thin.affine_velocity[p] * mirror;
      full.deviatoric_stress[image] =
          SymmetricTensor::from(mirror * thin.deviatoric_stress[p].matrix() * mirror);
    }
  }
  grid::Geometry wide = geometry();
  wide.lower[1] = -1 - 8 * dx;
  grid::BlockGrid full_grid(wide, parallel::world());

  constexpr double dt = 0.05;
  const double energy = total_energy(thin, TypeParam::kind);
  Vector3 momentum = Vector3::Zero();
  for (std::size_t p = 0; p < thin.size(); ++p) momentum -= thin.mass[p] * thin.velocity[p];
  std::vector<Matrix3> gradient(thin.size()), full_gradient(full.size());
  const auto cycle = [&](Particles& q, grid::BlockGrid& g, std::vector<Matrix3>& l) {
    bin<TypeParam>(g, q);
    particles_to_grid(smoothed<TypeParam>(), q, g);
    const GridBalance balance = advance(g, dt, {});
    grid_to_particles({smoothed<TypeParam>(), dt, carried, {}, {}}, q, g, l);
    return balance;
  };
  const GridBalance balance = cycle(thin, grid, gradient);
  cycle(full, full_grid, full_gradient);
  for (std::size_t p = 0; p < thin.size(); ++p) {
    EXPECT_LT((thin.velocity[p] - full.velocity[p]).norm(), 1e-11);
    EXPECT_LT((gradient[p] - full_gradient[p]).norm(), 1e-10);
    EXPECT_LT((thin.affine_velocity[p] - full.affine_velocity[p]).norm(), 1e-10);
    EXPECT_NEAR(thin.specific_internal_energy[p], full.specific_internal_energy[p], 1e-11);
    momentum += thin.mass[p] * thin.velocity[p];
  }
  EXPECT_NEAR(total_energy(thin, TypeParam::kind), energy, 1e-12 * balance.before);
  EXPECT_LT((momentum - balance.wall_impulse).norm(), 1e-10 * balance.before);
}

// A position on the edge between two stencils (the centre of a cell, where lattices place particles): the nodes that
// the transfer reaches must be in activated blocks, however the division by the cell size is rounded.
TYPED_TEST(Transfer, NodesOfEveryStencilAreActiveWhereTheDivisionRounds) {
  const std::vector<Vector3> velocity = {Vector3::Zero()};
  for (const double cell_size : {0.0003, 0.0007, 0.00076}) {
    grid::Geometry fine = geometry();
    fine.lower.setZero();
    fine.cells = {400, 8, 8};
    fine.cell_size = cell_size;
    for (int half_cells = 1; half_cells < 800; ++half_cells) {
      const std::vector<Vector3> x = {Vector3(0.5 * half_cells, 2.5, 2.5) * cell_size};
      grid::BlockGrid grid(fine, parallel::world());
      grid.adapt(x, velocity, 0.0, TypeParam::stencil);
      grid.activate(x, velocity, 0.0, TypeParam::stencil);
      ASSERT_TRUE(grid.bin(x, TypeParam::stencil)) << half_cells << " " << cell_size;
      for (std::size_t slot = 0; slot < grid.slots(); ++slot) {
        if (grid.particles_in(slot).empty()) continue;
        const grid::PlaceInStencil& place = grid.places(grid::BlockGrid::Points::particles)[0];
        const int first = place.first_node(TypeParam::stencil)[0];
        for (const int node : {first, first + TypeParam::count - 1}) {
          const int block = node < 0 ? 0 : node < grid.block_shape().edge ? 1 : 2;
          EXPECT_NE(grid.neighbours(slot)[static_cast<std::size_t>(grid::neighbour_index(block, 1, 1))],
                    grid::BlockGrid::no_slot)
              << half_cells << " half cells of " << cell_size << " m";
        }
      }
    }
  }
}

// Galilean invariance: heat, work and velocity gradients do not depend on a common velocity.
TYPED_TEST(Transfer, IsGalileanInvariant) {
  Particles at_rest = random_particles(500, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 5);
  constexpr bool affine = CarriesAffineField<TypeParam>;
  constexpr AffineField carried = affine ? AffineField::deformed : AffineField::none;
  if (!affine) std::ranges::fill(at_rest.affine_velocity, Matrix3::Zero().eval());
  Particles moving = at_rest;
  const Vector3 common(30, -20, 10);
  for (Vector3& v : moving.velocity) v += common;
  std::vector<Matrix3> g1(at_rest.size()), g2(at_rest.size());
  const auto cycle = [](Particles& q, std::vector<Matrix3>& gradient) {
    grid::BlockGrid grid(geometry(), parallel::world());
    bin<TypeParam>(grid, q);
    particles_to_grid(smoothed<TypeParam>(), q, grid);
    advance(grid, 0.02, {});
    return grid_to_particles({smoothed<TypeParam>(), 0.02, carried, {}, {}}, q, grid, gradient);
  };
  const TransferBalance b1 = cycle(at_rest, g1);
  const TransferBalance b2 = cycle(moving, g2);
  EXPECT_NEAR(b1.heat, b2.heat, 1e-9 * b1.heat);
  EXPECT_NEAR(b1.work, b2.work, 1e-9 * std::abs(b1.work) + 1e-9);
  for (std::size_t p = 0; p < at_rest.size(); ++p) {
    EXPECT_LT((g1[p] - g2[p]).norm(), 1e-10);
    EXPECT_LT((moving.velocity[p] - common - at_rest.velocity[p]).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace whipple::transfer
