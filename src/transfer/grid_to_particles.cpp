// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/grid_to_particles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/error.hpp"
#include "src/parallel/threads.hpp"
#include "src/transfer/node_access.hpp"
#include "src/transfer/node_sums.hpp"
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

/// a x b in lanes 0 to 2, 0 in lane 3.
inline Lanes cross(Lanes a, Lanes b) {
  const auto rotated = [](Lanes x) { return __builtin_shuffle(x, (__v4di){1, 2, 0, 3}); };
  return rotated(a * rotated(b) - rotated(a) * b);
}

inline double squared_norm(const std::array<Lanes, 3>& columns) {
  return sum3(columns[0] * columns[0] + columns[1] * columns[1] + columns[2] * columns[2]);
}

/// C_p <- C_p (I + dt L)^-1, never growing (equation 4.8): v_p belongs to the new position, so C_p must be
/// carried there. @returns the loss of |C|^2
[[gnu::always_inline]] inline double advect_affine_field(std::array<Lanes, 3>& c,
                                                         const std::array<Lanes, 3>& gradient, double dt) {
  const Lanes f0 = Lanes{1.0, 0.0, 0.0, 0.0} + dt * gradient[0];
  const Lanes f1 = Lanes{0.0, 1.0, 0.0, 0.0} + dt * gradient[1];
  const Lanes f2 = Lanes{0.0, 0.0, 1.0, 0.0} + dt * gradient[2];
  const std::array<Lanes, 3> rows = {cross(f1, f2), cross(f2, f0), cross(f0, f1)};  // of the adjugate
  const double determinant = sum3(f0 * rows[0]);
  if (determinant <= 0.1) return 0.0;  // a deformation that large in a step has no meaningful inverse
  const double before = squared_norm(c), inverse = 1.0 / determinant;
  const std::array<Lanes, 3> scaled = {inverse * c[0], inverse * c[1], inverse * c[2]};
  std::array<Lanes, 3> carried;
  for (std::size_t a = 0; a < 3; ++a) {
    carried[a] = broadcast(rows[0][a]) * scaled[0] + broadcast(rows[1][a]) * scaled[1] +
                 broadcast(rows[2][a]) * scaled[2];
  }
  const double after = squared_norm(carried);
  // Without a branch, which nothing would foretell. (0/0 is not less than 1.)
  const double cap = std::sqrt(std::min(1.0, before / after));
  for (std::size_t a = 0; a < 3; ++a) c[a] = cap * carried[a];
  return before - cap * cap * after;
}

/// Work of an external force m b on the mean of the grid velocities before and after the forces.
double external_work(Lanes new_velocity, Lanes increment, double mass, const Vector3& b, double dt) {
  return mass * dt * b.dot(vector(new_velocity - 0.5 * increment));
}

/// What the grid did to a point in the step, beside its new velocity, affine field and position.
struct Advance {
  ValueAndGradient velocity;   ///< of the grid after the forces
  ValueAndGradient increment;  ///< of it
  double heat;                 ///< J/kg
};

/// Velocity and affine field (4.3), heat of the transfer (4.5), position (4.4).
template <class Shape, AffineField field, class Points, class Stencil>
[[gnu::always_inline]] inline Advance advance_point(Points& points, std::size_t p, const BlockFrame& frame,
                                                    const Weights<Shape::count>& weights, double dt,
                                                    const Stencil& nodes) {
  constexpr bool affine = field != AffineField::none;
  std::array<Lanes, 3> c{};
  if constexpr (affine) {
    for (int a = 0; a < 3; ++a) {
      c[static_cast<std::size_t>(a)] = load_vector(points.affine_velocity[p].col(a).data());
    }
  }
  const Lanes velocity = load_vector(points.velocity[p].data());
  const Moments m = gather<affine>(weights, velocity, c, nodes);
  store_vector(points.velocity[p].data(), velocity + m.change.value);
  store_vector(points.position[p].data(), load_vector(points.position[p].data()) + dt * m.velocity.value);
  Lanes heat_lanes = 0.5 * (m.loss - m.change.value * m.change.value);
  double heat = 0.0;
  if constexpr (affine) {
    // sum N r r^T along one direction
    const double inertia = Shape::second_moment * frame.cell_size * frame.cell_size;
    const double per_inertia = frame.per_cell_size * frame.per_cell_size / Shape::second_moment;
    for (std::size_t a = 0; a < 3; ++a) {
      const Lanes change = per_inertia * m.change.gradient[a];
      heat_lanes -= 0.5 * change * m.change.gradient[a];
      c[a] += change;
    }
    if constexpr (field == AffineField::deformed) {
      heat = 0.5 * inertia * advect_affine_field(c, m.velocity.gradient, dt);
    } else {
      turn_affine_field(c, matrix(m.velocity.gradient), dt);
    }
    for (int a = 0; a < 3; ++a) {
      store_vector(points.affine_velocity[p].col(a).data(), c[static_cast<std::size_t>(a)]);
    }
  }
  return {m.velocity, m.increment, heat + sum3(heat_lanes)};
}

template <class Shape, AffineField field, class Access>
[[gnu::always_inline]] inline TransferBalance update_particle(Particles& particles, std::size_t p,
                                                              const BlockFrame& frame,
                                                              const Weights<Shape::count>& weights, double dt,
                                                              Matrix3& gradient, Access& access,
                                                              std::span<const Vector3> acceleration) {
  const SymmetricTensor& s = particles.deviatoric_stress[p];
  const double mean_stress = -(particles.pressure[p] + particles.artificial_viscosity[p]);
  const std::array<Lanes, 3> stress = {Lanes{s.xx + mean_stress, s.xy, s.zx, 0.0},
                                       Lanes{s.xy, s.yy + mean_stress, s.yz, 0.0},
                                       Lanes{s.zx, s.yz, s.zz + mean_stress, 0.0}};
  const auto nodes = access.stencil(weights.first_node());
  const Advance advance = advance_point<Shape, field>(particles, p, frame, weights, dt, nodes);
  // The mean of old and new grid velocity makes the exact work identity (4.6).
  Lanes power{};
  for (std::size_t a = 0; a < 3; ++a) {
    power += stress[a] * (advance.velocity.gradient[a] - 0.5 * advance.increment.gradient[a]);
    store_vector(gradient.col(static_cast<int>(a)).data(), advance.velocity.gradient[a]);
  }
  const double mass = particles.mass[p];
  const double work = sum3(power) * particles.volume[p] * dt;
  const double heat_of_contact = advance.increment.value[3];  // docs/theory/contact.md, 4.6
  particles.specific_internal_energy[p] += work / mass + advance.heat + heat_of_contact;
  TransferBalance balance{.work = work, .heat = mass * advance.heat};
  if (!acceleration.empty()) {
    balance.external_work =
        external_work(advance.velocity.value, advance.increment.value, mass, acceleration[p], dt);
  }
  return balance;
}

/// f(point, slot, frame of the block, weights, access to the nodes) for points of one block.
template <class Shape, class Points, class Access, class Function>
WHIPPLE_KERNEL void for_members(const Points& points, std::span<const std::uint32_t> members,
                                std::size_t slot, const BlockFrame& frame, Access& access,
                                const Function& f) {
  for_each_with_weights<Shape>(points, members, frame,
                               [&](std::size_t p, const Weights<Shape::count>& weights)
                                   __attribute__((always_inline)) { f(p, slot, frame, weights, access); });
}

/// Calls f(point, slot, frame of the block, weights, access to the nodes) for the points of every block.
/// @tparam Content  what the points read of a node: grid::Node, or Lanes for its first register
template <class Shape, class Content, class Points, class Function>
void for_each_point(const Points& points, BlockGrid& grid, BlockGrid::Points kind, Function&& f) {
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    if (grid.members(kind, slot).empty()) return;
    const BlockFrame frame(grid.geometry(), grid.coordinate(slot));
    read_nodes<Shape, Content>(grid, kind, slot, [&](std::span<const std::uint32_t> members, auto& access) {
      for_members<Shape>(points, members, slot, frame, access, f);
    });
  });
}

template <class Shape, class Content, class Function>
void for_each_particle(const Particles& particles, BlockGrid& grid, Function&& f) {
  for_each_point<Shape, Content>(particles, grid, BlockGrid::Points::particles, f);
}

template <class Shape, AffineField field>
TransferBalance gather_all(Particles& particles, BlockGrid& grid, double dt,
                           std::span<Matrix3> velocity_gradient, std::span<const Vector3> acceleration) {
  std::vector<TransferBalance> of_slot(grid.slots());
  for_each_particle<Shape, Node>(particles, grid,
                                 [&](std::size_t p, std::size_t slot, const BlockFrame& frame,
                                     const Weights<Shape::count>& weights, auto& access) {
                                   of_slot[slot] += update_particle<Shape, field>(
                                       particles, p, frame, weights, dt, velocity_gradient[p], access,
                                       acceleration);
                                 });
  TransferBalance total;
  for (const TransferBalance& part : of_slot) total += part;
  return total;
}

template <class Shape, bool with_gradient>
double update_velocities(Particles& particles, BlockGrid& grid, double dt, double relaxation,
                         std::span<Vector3> displacement, std::span<Matrix3> velocity_gradient,
                         std::span<const Vector3> acceleration) {
  std::vector<double> work_of_slot(grid.slots(), 0.0);
  for_each_particle<Shape, Node>(
      particles, grid,
      [&](std::size_t p, std::size_t slot, const BlockFrame&, const Weights<Shape::count>& weights,
          auto& access) {
        const auto nodes = access.stencil(weights.first_node());
        const Lanes increment =
            gather_value<false>(weights, [&](auto... node) { return nodes(node...).second; }).value;
        const ValueAndGradient after = gather_value<with_gradient>(
            weights, [&](auto... node) { return nodes(node...).first + nodes(node...).second; });
        const Lanes before = after.value - increment;
        double* const velocity = particles.velocity[p].data();
        const Lanes old = load_vector(velocity);
        store_vector(velocity, old + increment - relaxation * (old - before));
        store_vector(displacement[p].data(), dt * after.value);
        particles.specific_internal_energy[p] += increment[3];  // of contact
        if constexpr (with_gradient) velocity_gradient[p] = matrix(after.gradient);
        if (!acceleration.empty()) {
          work_of_slot[slot] += external_work(after.value, increment, particles.mass[p], acceleration[p], dt);
        }
      });
  double work = 0.0;
  for (const double part : work_of_slot) work += part;
  return work;
}

/// Sums of the nodes' velocities, for every particle: take(p, sums).
template <bool with_gradient, class Take>
void gather_first(ShapeFunction shape, const Particles& particles, BlockGrid& grid, Take&& take) {
  with_shape(shape, [&]<class Shape>(Shape) {
    for_each_particle<Shape, Lanes>(particles, grid,
                                    [&](std::size_t p, std::size_t, const BlockFrame&,
                                        const Weights<Shape::count>& weights, auto& access) {
                                      const auto nodes = access.stencil(weights.first_node());
                                      take(p, gather_value<with_gradient>(weights, [&](auto... node) {
                                             return first_register(nodes(node...));
                                           }));
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
  for_each_point<Shape, Node>(
      nodes, grid, BlockGrid::Points::guests,
      [&](std::size_t p, std::size_t, const BlockFrame& frame, const Weights<Shape::count>& weights,
          auto& access) {
        const auto around = access.stencil(weights.first_node());
        const Advance advance =
            p < nodes.unrelaxed
                ? advance_point<Shape, AffineField::none>(nodes, p, frame, weights, dt, around)
                : advance_point<Shape, field>(nodes, p, frame, weights, dt, around);
        store_vector(nodes.mean_velocity[p].data(), advance.velocity.value - 0.5 * advance.increment.value);
        store_vector(nodes.new_velocity[p].data(), advance.velocity.value);
        nodes.heat[p] = nodes.mass[p] * advance.heat;
        nodes.contact_heat[p] = nodes.mass[p] * advance.increment.value[3];
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
  gather_first<true>(shape, particles, grid, [&](std::size_t p, const ValueAndGradient& sums) {
    velocity_gradient[p] = matrix(sums.gradient);
  });
}

void gather_velocity(ShapeFunction shape, const Particles& particles, BlockGrid& grid,
                     std::span<Vector3> velocity) {
  gather_first<false>(shape, particles, grid, [&](std::size_t p, const ValueAndGradient& sums) {
    store_vector(velocity[p].data(), sums.value);
  });
}

}  // namespace whipple::transfer
