// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/grid_to_particles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/error.hpp"
#include "src/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;

Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

/// The matrix with these columns.
Matrix3 matrix(const std::array<Lanes, 3>& columns) {
  Matrix3 m;
  for (int a = 0; a < 3; ++a) store_vector(m.col(a).data(), columns[static_cast<std::size_t>(a)]);
  return m;
}

/// C_p <- C_p R^T (equation 4.9): only the rotation of the step, so the energy of the affine field stays.
void turn_affine_field(std::array<Lanes, 3>& columns, const Matrix3& gradient, double dt) {
  const Matrix3 quarter = 0.25 * dt * (gradient - gradient.transpose());  // half of the spin's increment
  const Matrix3 identity = Matrix3::Identity();
  const Matrix3 turned = matrix(columns) * (identity + quarter).inverse() * (identity - quarter);
  for (int a = 0; a < 3; ++a) columns[static_cast<std::size_t>(a)] = load_vector(turned.col(a).data());
}

/// Work of an external force m b on the mean of the grid velocities before and after the forces.
double external_work(Lanes new_velocity, Lanes increment, double mass, const Vector3& b, double dt) {
  return mass * dt * b.dot(vector(new_velocity - 0.5 * increment));
}

/// New velocity and affine field of a point, and position (4.4).
template <AffineField field, class Points>
[[gnu::always_inline]] inline void advance_point(Points& points, std::size_t p, double dt,
                                                 const Advance<>& advance) {
  store_vector(points.velocity[p].data(), advance.velocity);
  store_vector(points.position[p].data(),
               load_vector(points.position[p].data()) + dt * advance.grid_velocity.value);
  if constexpr (field == AffineField::none) return;
  std::array<Lanes, 3> columns = advance.affine;
  if constexpr (field == AffineField::turned) {
    turn_affine_field(columns, matrix(advance.grid_velocity.gradient), dt);
  }
  for (int a = 0; a < 3; ++a) {
    store_vector(points.affine_velocity[p].col(a).data(), columns[static_cast<std::size_t>(a)]);
  }
}

template <AffineField field>
[[gnu::always_inline]] inline TransferBalance update_particle(Particles& particles, std::size_t p, double dt,
                                                              const Advance<>& advance, Matrix3& gradient,
                                                              std::span<const Vector3> acceleration) {
  const SymmetricTensor& s = particles.deviatoric_stress[p];
  const double mean_stress = -(particles.pressure[p] + particles.artificial_viscosity[p]);
  const std::array<Lanes, 3> stress = {Lanes{s.xx + mean_stress, s.xy, s.zx, 0.0},
                                       Lanes{s.xy, s.yy + mean_stress, s.yz, 0.0},
                                       Lanes{s.zx, s.yz, s.zz + mean_stress, 0.0}};
  advance_point<field>(particles, p, dt, advance);
  // The mean of old and new grid velocity makes the exact work identity (4.6).
  Lanes power{};
  for (std::size_t a = 0; a < 3; ++a) {
    power += stress[a] * (advance.grid_velocity.gradient[a] - 0.5 * advance.increment.gradient[a]);
    store_vector(gradient.col(static_cast<int>(a)).data(), advance.grid_velocity.gradient[a]);
  }
  const double mass = particles.mass[p], heat = advance.heat[0];
  const double work = sum3(power) * particles.volume[p] * dt;
  const double heat_of_contact = advance.increment.value[3];  // docs/theory/contact.md, 4.6
  particles.specific_internal_energy[p] += work / mass + heat + heat_of_contact;
  TransferBalance balance{.work = work, .heat = mass * heat};
  if (!acceleration.empty()) {
    balance.external_work =
        external_work(advance.grid_velocity.value, advance.increment.value, mass, acceleration[p], dt);
  }
  return balance;
}

/// For the points of every slot take(kernels, slot, sum of the slot), on threads. @returns the sum of the
/// sums
template <class Sum, class Take>
Sum sum_over_slots(const BlockGrid& grid, BlockGrid::Points kind, Take&& take) {
  std::vector<Sum> of_slot(grid.slots());
  with_kernels([&](auto kernels) {
    parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
      if (!grid.members(kind, slot).empty()) take(kernels, slot, of_slot[slot]);
    });
  });
  Sum sum{};
  for (const Sum& part : of_slot) sum += part;
  return sum;
}

constexpr auto particle_kind = BlockGrid::Points::particles;

template <class Shape, AffineField field>
TransferBalance gather_all(Particles& particles, BlockGrid& grid, double dt,
                           std::span<Matrix3> velocity_gradient, std::span<const Vector3> acceleration) {
  return sum_over_slots<TransferBalance>(
      grid, particle_kind, [&]<class Kernels>(Kernels, std::size_t slot, TransferBalance& balance) {
        const auto take = [&](std::size_t p, const Advance<>& advance) WHIPPLE_INLINE {
          balance += update_particle<field>(particles, p, dt, advance, velocity_gradient[p], acceleration);
        };
        Kernels::template gather<Shape>(particles, grid, particle_kind, slot,
                                        typename Kernels::template Transfer<field>{dt}, take);
      });
}

template <class Shape, bool with_gradient>
double update_velocities(Particles& particles, BlockGrid& grid, double dt, double relaxation,
                         std::span<Vector3> displacement, std::span<Matrix3> velocity_gradient,
                         std::span<const Vector3> acceleration) {
  return sum_over_slots<double>(
      grid, particle_kind, [&]<class Kernels>(Kernels, std::size_t slot, double& work) {
        const auto take = [&](std::size_t p, const VelocityUpdate<>& update) WHIPPLE_INLINE {
          const Lanes after = update.after.value, increment = update.increment, before = after - increment;
          double* const velocity = particles.velocity[p].data();
          const Lanes old = load_vector(velocity);
          store_vector(velocity, old + increment - relaxation * (old - before));
          store_vector(displacement[p].data(), dt * after);
          particles.specific_internal_energy[p] += increment[3];  // of contact
          if constexpr (with_gradient) velocity_gradient[p] = matrix(update.after.gradient);
          if (!acceleration.empty()) {
            work += external_work(after, increment, particles.mass[p], acceleration[p], dt);
          }
        };
        Kernels::template gather<Shape>(particles, grid, particle_kind, slot, typename Kernels::Update{},
                                        take);
      });
}

/// Sums of the nodes' velocities, for every particle: take(p, sums).
template <class Take>
void gather_first(ShapeFunction shape, const Particles& particles, BlockGrid& grid, Take&& take) {
  with_shape(shape, [&]<class Shape>(Shape) {
    sum_over_slots<double>(grid, particle_kind, [&]<class Kernels>(Kernels, std::size_t slot, double&) {
      Kernels::template gather<Shape>(particles, grid, particle_kind, slot, typename Kernels::First{}, take);
    });
  });
}

}  // namespace

TransferBalance grid_to_particles(ShapeFunction shape, Particles& particles, BlockGrid& grid, double dt,
                                  AffineField affine, std::span<Matrix3> velocity_gradient,
                                  std::span<const Vector3> acceleration) {
  using enum AffineField;
  return with_shape(shape, [&]<class Shape>(Shape) {
    if (affine == none) return gather_all<Shape, none>(particles, grid, dt, velocity_gradient, acceleration);
    if constexpr (CarriesAffineField<Shape>) {
      return affine == deformed
                 ? gather_all<Shape, deformed>(particles, grid, dt, velocity_gradient, acceleration)
                 : gather_all<Shape, turned>(particles, grid, dt, velocity_gradient, acceleration);
    } else {
      throw InternalError("the affine transfer needs B-splines");
      return TransferBalance{};  // the other branch deduces the type
    }
  });
}

void TransitionNodes::resize(std::size_t n) {
  for (auto* values : {&mass, &sound_speed, &heat, &contact_heat}) values->resize(n);
  for (auto* values : {&position, &velocity, &force, &mean_velocity, &new_velocity}) values->resize(n);
  affine_velocity.resize(n);
}

namespace {

template <class Shape, AffineField field>
void move_nodes(TransitionNodes& nodes, BlockGrid& grid, double dt) {
  constexpr auto kind = BlockGrid::Points::guests;
  sum_over_slots<double>(grid, kind, [&]<class Kernels>(Kernels, std::size_t slot, double&) {
    const auto take = [&](std::size_t p, const Advance<>& advance) WHIPPLE_INLINE {
      advance_point<field>(nodes, p, dt, advance);
      store_vector(nodes.mean_velocity[p].data(),
                   advance.grid_velocity.value - 0.5 * advance.increment.value);
      store_vector(nodes.new_velocity[p].data(), advance.grid_velocity.value);
      nodes.heat[p] = nodes.mass[p] * advance.heat[0];
      nodes.contact_heat[p] = nodes.mass[p] * advance.increment.value[3];
    };
    Kernels::template gather<Shape>(nodes, grid, kind, slot, typename Kernels::template Transfer<field>{dt},
                                    take);
  });
}

}  // namespace

void grid_to_nodes(ShapeFunction shape, TransitionNodes& nodes, BlockGrid& grid, double dt,
                   AffineField affine) {
  using enum AffineField;
  with_shape(shape, [&]<class Shape>(Shape) {
    if constexpr (CarriesAffineField<Shape>) {
      if (affine == none) return move_nodes<Shape, none>(nodes, grid, dt);
      if (affine == deformed) return move_nodes<Shape, deformed>(nodes, grid, dt);
      return move_nodes<Shape, turned>(nodes, grid, dt);
    } else {
      throw InternalError("nodes of elements need B-splines");
    }
  });
}

double update_velocity(ShapeFunction shape, Particles& particles, BlockGrid& grid, double dt,
                       double relaxation, std::span<Vector3> displacement,
                       std::span<Matrix3> velocity_gradient, std::span<const Vector3> acceleration) {
  return with_shape(shape, [&]<class Shape>(Shape) {
    if (velocity_gradient.empty()) {
      return update_velocities<Shape, false>(particles, grid, dt, relaxation, displacement, velocity_gradient,
                                             acceleration);
    }
    return update_velocities<Shape, true>(particles, grid, dt, relaxation, displacement, velocity_gradient,
                                          acceleration);
  });
}

void gather_velocity_gradient(ShapeFunction shape, const Particles& particles, BlockGrid& grid,
                              std::span<Matrix3> velocity_gradient) {
  gather_first(shape, particles, grid, [&](std::size_t p, const ValueAndGradient<>& sums) WHIPPLE_INLINE {
    velocity_gradient[p] = matrix(sums.gradient);
  });
}

void gather_velocity(ShapeFunction shape, const Particles& particles, BlockGrid& grid,
                     std::span<Vector3> velocity) {
  gather_first(shape, particles, grid, [&](std::size_t p, const ValueAndGradient<>& sums) WHIPPLE_INLINE {
    store_vector(velocity[p].data(), sums.value);
  });
}

}  // namespace whipple::transfer
