// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/grid_to_particles.hpp"

#include <cmath>
#include <vector>

#include "src/base/error.hpp"
#include "src/parallel/threads.hpp"
#include "src/transfer/node_access.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;

Lanes lanes(const Vector3& v) { return Lanes{v[0], v[1], v[2], 0.0}; }
Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

/// Broadcast of the last lane (the node's beta).
Lanes last(Lanes v) { return __builtin_shuffle(v, (__v4di){3, 3, 3, 3}); }

/// Sums over the nodes of a particle (docs/theory/mpm.md, equations 4.2 to 4.7); lane 3 of each is
/// meaningless.
struct Moments {
  Lanes velocity = broadcast(0.0);            // sum N v
  Lanes increment = broadcast(0.0);           // sum N d
  Lanes relaxed = broadcast(0.0);             // sum N beta D
  Lanes loss = broadcast(0.0);                // sum N [beta D (D - d) + d d / 2], per component
  std::array<Lanes, 3> velocity_gradient{};   // sum dN/dx_a v
  std::array<Lanes, 3> increment_gradient{};  // sum dN/dx_a d
  std::array<Lanes, 3> increment_moment{};    // sum N d r_a
  std::array<Lanes, 3> relaxed_moment{};      // sum N beta D r_a
};

/// D = a_p(x_i) - v_i is the difference of the particle's affine field and the grid's velocity at node i.
template <class Shape, bool affine, class Access>
Moments gather(const std::array<AxisWeights<Shape::count>, 3>& weights, Lanes v,
               const std::array<Lanes, 3>& c, Access& access) {
  const auto& [wx, wy, wz] = weights;
  Moments m;
  for (std::size_t i = 0; i < Shape::count; ++i) {
    for (std::size_t j = 0; j < Shape::count; ++j) {
      Lanes field = v;
      if constexpr (affine) field += wx.distance[i] * c[0] + wy.distance[j] * c[1];
      Lanes v0 = broadcast(0.0), vz = v0, d0 = v0, d1 = v0, dz = v0, b0 = v0, b1 = v0, loss = v0;
      for (std::size_t k = 0; k < Shape::count; ++k) {
        const Node* node = access.node(wx.first + static_cast<int>(i), wy.first + static_cast<int>(j),
                                       wz.first + static_cast<int>(k));
        const Lanes vi = node->first;
        const Lanes d = node->second;
        Lanes difference = field - vi;
        if constexpr (affine) difference += wz.distance[k] * c[2];
        const Lanes relaxed = last(vi) * difference;
        v0 += wz.weight[k] * vi;
        vz += wz.derivative[k] * vi;
        d0 += wz.weight[k] * d;
        dz += wz.derivative[k] * d;
        b0 += wz.weight[k] * relaxed;
        loss += wz.weight[k] * (relaxed * (difference - d) + 0.5 * d * d);
        if constexpr (affine) {
          const double moment = wz.weight[k] * wz.distance[k];
          d1 += moment * d;
          b1 += moment * relaxed;
        }
      }
      const double w = wx.weight[i] * wy.weight[j];
      const double gx = wx.derivative[i] * wy.weight[j];
      const double gy = wx.weight[i] * wy.derivative[j];
      m.velocity += w * v0;
      m.increment += w * d0;
      m.relaxed += w * b0;
      m.loss += w * loss;
      m.velocity_gradient[0] += gx * v0;
      m.velocity_gradient[1] += gy * v0;
      m.velocity_gradient[2] += w * vz;
      m.increment_gradient[0] += gx * d0;
      m.increment_gradient[1] += gy * d0;
      m.increment_gradient[2] += w * dz;
      if constexpr (affine) {
        m.increment_moment[0] += (w * wx.distance[i]) * d0;
        m.increment_moment[1] += (w * wy.distance[j]) * d0;
        m.increment_moment[2] += w * d1;
        m.relaxed_moment[0] += (w * wx.distance[i]) * b0;
        m.relaxed_moment[1] += (w * wy.distance[j]) * b0;
        m.relaxed_moment[2] += w * b1;
      }
    }
  }
  return m;
}

/// C_p <- C_p R^T (equation 4.9): only the rotation of the step, so the energy of the affine field stays.
void turn_affine_field(Matrix3& c, const Matrix3& gradient, double dt) {
  const Matrix3 quarter = 0.25 * dt * (gradient - gradient.transpose());  // half of the spin's increment
  const Matrix3 identity = Matrix3::Identity();
  c = c * (identity + quarter).inverse() * (identity - quarter);
}

/// C_p <- C_p (I + dt L)^-1, never growing (equation 4.8): v_p belongs to the new position, so C_p must be
/// carried there. @returns the loss of |C|^2
double advect_affine_field(Matrix3& c, const Matrix3& gradient, double dt) {
  const Matrix3 deformation = Matrix3::Identity() + dt * gradient;
  if (deformation.determinant() <= 0.1)
    return 0.0;  // a deformation that large in a step has no meaningful inverse
  const double before = c.squaredNorm();
  Matrix3 carried = c * deformation.inverse();
  const double after = carried.squaredNorm();
  const double cap = after > before ? std::sqrt(before / after) : 1.0;
  c = cap * carried;
  return before - cap * cap * after;
}

/// Work of an external force m b on the mean of the grid velocities before and after the forces.
double external_work(const Moments& m, double mass, const Vector3& b, double dt) {
  return mass * dt * b.dot(vector(m.velocity + 0.5 * m.increment));
}

/// What the grid did to a point in the step.
struct Advance {
  Moments moments;
  Matrix3 gradient;       ///< of the new grid velocity
  Matrix3 mean_gradient;  ///< of the mean of old and new grid velocity
  double heat = 0.0;      ///< J/kg
};

/// Velocity and affine field (4.3), heat of the transfer (4.5), position (4.4).
template <class Shape, AffineField field, class Points, class Access>
Advance advance_point(Points& points, std::size_t p, const grid::Geometry& geometry,
                      const grid::BlockCoordinate& block, double dt, Access& access) {
  constexpr bool affine = field != AffineField::none;
  Matrix3& c = points.affine_velocity[p];
  std::array<Lanes, 3> columns{};
  [[maybe_unused]] double inertia = 0.0;  // sum N r r^T along one direction
  if constexpr (affine) {
    inertia = Shape::second_moment * geometry.cell_size * geometry.cell_size;
    for (int a = 0; a < 3; ++a) columns[static_cast<std::size_t>(a)] = lanes(c.col(a));
  }
  Advance out;
  Moments& m = out.moments;
  m = gather<Shape, affine>(weights_at<Shape>(points, p, geometry, block), lanes(points.velocity[p]), columns,
                            access);
  points.velocity[p] += vector(m.increment - m.relaxed);
  points.position[p] += dt * vector(m.velocity + m.increment);
  out.heat = sum3(m.loss + m.increment * (m.relaxed - 0.5 * m.increment) - 0.5 * m.relaxed * m.relaxed);
  for (int a = 0; a < 3; ++a) {
    const auto ua = static_cast<std::size_t>(a);
    out.gradient.col(a) = vector(m.velocity_gradient[ua] + m.increment_gradient[ua]);
    out.mean_gradient.col(a) = vector(m.velocity_gradient[ua] + 0.5 * m.increment_gradient[ua]);
    if constexpr (affine) {
      const Lanes dc = m.increment_moment[ua] / inertia;
      const Lanes bc = m.relaxed_moment[ua] / inertia;
      out.heat += inertia * sum3(dc * (bc - 0.5 * dc) - 0.5 * bc * bc);
      c.col(a) += vector(dc - bc);
    }
  }
  if constexpr (field == AffineField::deformed) {
    out.heat += 0.5 * inertia * advect_affine_field(c, out.gradient, dt);
  }
  if constexpr (field == AffineField::turned) turn_affine_field(c, out.gradient, dt);
  return out;
}

template <class Shape, AffineField field, class Access>
TransferBalance update_particle(Particles& particles, std::size_t p, const grid::Geometry& geometry,
                                const grid::BlockCoordinate& block, double dt, Matrix3& gradient,
                                Access& access, std::span<const Vector3> acceleration) {
  const Advance advance = advance_point<Shape, field>(particles, p, geometry, block, dt, access);
  gradient = advance.gradient;
  const Matrix3& mean_gradient = advance.mean_gradient;  // the exact work identity (4.6)
  const SymmetricTensor& s = particles.deviatoric_stress[p];
  const double mean_stress = -(particles.pressure[p] + particles.artificial_viscosity[p]);
  const double power =
      (s.xx + mean_stress) * mean_gradient(0, 0) + (s.yy + mean_stress) * mean_gradient(1, 1) +
      (s.zz + mean_stress) * mean_gradient(2, 2) + s.xy * (mean_gradient(0, 1) + mean_gradient(1, 0)) +
      s.yz * (mean_gradient(1, 2) + mean_gradient(2, 1)) + s.zx * (mean_gradient(2, 0) + mean_gradient(0, 2));
  const double mass = particles.mass[p];
  const double work = power * particles.volume[p] * dt;
  particles.specific_internal_energy[p] += work / mass + advance.heat;
  TransferBalance balance{.work = work, .heat = mass * advance.heat};
  if (!acceleration.empty()) {
    balance.external_work = external_work(advance.moments, mass, acceleration[p], dt);
  }
  return balance;
}

/// Calls f(point, slot, block coordinate, access to the nodes) for the points of every block, as listed by
/// `members`.
template <class Function>
void for_each_point(BlockGrid& grid,
                    std::span<const std::uint32_t> (BlockGrid::*members_of)(std::size_t) const,
                    Function&& f) {
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    const std::span<const std::uint32_t> members = (grid.*members_of)(slot);
    if (members.empty()) return;
    const grid::BlockCoordinate& block = grid.coordinate(slot);
    if (members.size() < direct_access_below) {
      DirectAccess access(grid, slot);
      for (const std::uint32_t p : members) f(p, slot, block, access);
    } else {
      ReachCopy copy;
      copy.load(grid, slot);
      for (const std::uint32_t p : members) f(p, slot, block, copy);
    }
  });
}

template <class Function>
void for_each_particle(BlockGrid& grid, Function&& f) {
  for_each_point(grid, &BlockGrid::particles_in, f);
}

template <class Shape, AffineField field>
TransferBalance gather_all(Particles& particles, BlockGrid& grid, double dt,
                           std::span<Matrix3> velocity_gradient, std::span<const Vector3> acceleration) {
  std::vector<TransferBalance> of_slot(grid.slots());
  for_each_particle(
      grid, [&](std::size_t p, std::size_t slot, const grid::BlockCoordinate& block, auto& access) {
        of_slot[slot] += update_particle<Shape, field>(particles, p, grid.geometry(), block, dt,
                                                       velocity_gradient[p], access, acceleration);
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
  for_each_particle(
      grid, [&](std::size_t p, std::size_t slot, const grid::BlockCoordinate& block, auto& access) {
        const Moments m = gather<Shape, false>(weights_at<Shape>(particles, p, grid.geometry(), block),
                                               lanes(particles.velocity[p]), {}, access);
        Vector3& v = particles.velocity[p];
        v += vector(m.increment) - relaxation * (v - vector(m.velocity));
        displacement[p] = dt * vector(m.velocity + m.increment);
        if constexpr (with_gradient) {
          for (std::size_t a = 0; a < 3; ++a) {
            velocity_gradient[p].col(static_cast<int>(a)) =
                vector(m.velocity_gradient[a] + m.increment_gradient[a]);
          }
        }
        if (!acceleration.empty()) {
          work_of_slot[slot] += external_work(m, particles.mass[p], acceleration[p], dt);
        }
      });
  double work = 0.0;
  for (const double part : work_of_slot) work += part;
  return work;
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
  for (auto* values : {&mass, &sound_speed, &heat}) values->resize(n);
  for (auto* values : {&position, &velocity, &force, &mean_velocity, &new_velocity}) values->resize(n);
  affine_velocity.resize(n);
}

namespace {

template <class Shape, AffineField field>
void move_nodes(TransitionNodes& nodes, BlockGrid& grid, double dt) {
  for_each_point(grid, &BlockGrid::guests_in,
                 [&](std::size_t p, std::size_t, const grid::BlockCoordinate& block, auto& access) {
                   const Advance advance =
                       advance_point<Shape, field>(nodes, p, grid.geometry(), block, dt, access);
                   const Moments& m = advance.moments;
                   nodes.mean_velocity[p] = vector(m.velocity + 0.5 * m.increment);
                   nodes.new_velocity[p] = vector(m.velocity + m.increment);
                   nodes.heat[p] = nodes.mass[p] * advance.heat;
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
  with_shape(shape, [&]<class Shape>(Shape) {
    for_each_particle(
        grid, [&](std::size_t p, std::size_t, const grid::BlockCoordinate& block, auto& access) {
          const Moments m = gather<Shape, false>(weights_at<Shape>(particles, p, grid.geometry(), block),
                                                 lanes(particles.velocity[p]), {}, access);
          for (std::size_t a = 0; a < 3; ++a) {
            velocity_gradient[p].col(static_cast<int>(a)) = vector(m.velocity_gradient[a]);
          }
        });
  });
}

void gather_velocity(ShapeFunction shape, const Particles& particles, BlockGrid& grid,
                     std::span<Vector3> velocity) {
  with_shape(shape, [&]<class Shape>(Shape) {
    for_each_particle(
        grid, [&](std::size_t p, std::size_t, const grid::BlockCoordinate& block, auto& access) {
          velocity[p] = vector(gather<Shape, false>(weights_at<Shape>(particles, p, grid.geometry(), block),
                                                    Lanes{}, {}, access)
                                   .velocity);
        });
  });
}

}  // namespace whipple::transfer
