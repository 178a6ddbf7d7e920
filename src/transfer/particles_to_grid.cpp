// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/particles_to_grid.hpp"

#include "src/parallel/threads.hpp"
#include "src/transfer/node_access.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {
namespace {

/// What one point brings to a node: first += N (a0 + a_x r_x + a_y r_y + a_z r_z),
/// second += N b0 + sum over directions of dN/dx_a b_a.
struct Payload {
  Lanes a0, ax, ay, az;
  Lanes b0, bx, by, bz;
};

Lanes column(const Matrix3& m, int axis, double factor) {
  return Lanes{0.0, factor * m(0, axis), factor * m(1, axis), factor * m(2, axis)};
}

/// Mass and momentum, with the sound speed.
template <class Points>
Payload inertia(const Points& points, std::size_t p) {
  const double m = points.mass[p];
  const Vector3& v = points.velocity[p];
  const Matrix3& c = points.affine_velocity[p];
  Payload out{};
  out.a0 = Lanes{m, m * v[0], m * v[1], m * v[2]};
  out.ax = column(c, 0, m);
  out.ay = column(c, 1, m);
  out.az = column(c, 2, m);
  out.b0 = Lanes{m * points.sound_speed[p], 0.0, 0.0, 0.0};
  return out;
}

/// The internal force on node i is -V sigma . grad N_i, sigma = s - (p + q) I.
Payload payload(const Particles& particles, std::size_t p, std::span<const Vector3> acceleration) {
  const double m = particles.mass[p];
  const SymmetricTensor& s = particles.deviatoric_stress[p];
  const double mean = -(particles.pressure[p] + particles.artificial_viscosity[p]);
  const double minus_volume = -particles.volume[p];
  Payload out = inertia(particles, p);
  if (!acceleration.empty()) {
    const Vector3& b = acceleration[p];
    out.b0 += Lanes{0.0, m * b[0], m * b[1], m * b[2]};
  }
  out.bx = minus_volume * Lanes{0.0, s.xx + mean, s.xy, s.zx};
  out.by = minus_volume * Lanes{0.0, s.xy, s.yy + mean, s.yz};
  out.bz = minus_volume * Lanes{0.0, s.zx, s.yz, s.zz + mean};
  return out;
}

/// What the points bring, as the kernel asks for it: everything of particles, mass and momentum of particles
/// with given velocities, or everything of nodes of elements.
struct OfParticles {
  const Particles& points;
  static std::span<const std::uint32_t> members(const grid::BlockGrid& grid, std::size_t slot) {
    return grid.particles_in(slot);
  }
};
struct Everything : OfParticles {
  std::span<const Vector3> acceleration;
  [[nodiscard]] Payload operator()(std::size_t p) const { return payload(points, p, acceleration); }
};
struct Momentum : OfParticles {
  std::span<const Vector3> velocity;
  [[nodiscard]] Lanes operator()(std::size_t p) const {
    const Vector3 momentum = points.mass[p] * velocity[p];
    return Lanes{points.mass[p], momentum[0], momentum[1], momentum[2]};
  }
};
struct OfNodes {
  const TransitionNodes& points;
  static std::span<const std::uint32_t> members(const grid::BlockGrid& grid, std::size_t slot) {
    return grid.guests_in(slot);
  }
  [[nodiscard]] Payload operator()(std::size_t p) const {
    Payload out = inertia(points, p);
    const Vector3& f = points.force[p];
    out.b0 += Lanes{0.0, f[0], f[1], f[2]};
    return out;
  }
};

template <class Shape, class Content, class Access>
void scatter(const Content& content, std::span<const std::uint32_t> members, const grid::Geometry& geometry,
             const grid::BlockCoordinate& block, Access& access) {
  constexpr int count = Shape::count;
  for (const std::uint32_t p : members) {
    const auto [wx, wy, wz] = weights_at<Shape>(content.points, p, geometry, block);
    const Payload load = content(p);
    for (std::size_t i = 0; i < count; ++i) {
      const Lanes a_x = load.a0 + wx.distance[i] * load.ax;
      for (std::size_t j = 0; j < count; ++j) {
        const double w = wx.weight[i] * wy.weight[j];
        const Lanes a = w * (a_x + wy.distance[j] * load.ay);
        const Lanes a_z = w * load.az;
        const Lanes b = w * load.b0 + (wx.derivative[i] * wy.weight[j]) * load.bx +
                        (wx.weight[i] * wy.derivative[j]) * load.by;
        const Lanes b_z = w * load.bz;
        for (std::size_t k = 0; k < count; ++k) {
          grid::Node* node = access.node(wx.first + static_cast<int>(i), wy.first + static_cast<int>(j),
                                         wz.first + static_cast<int>(k));
          node->first += wz.weight[k] * a + (wz.weight[k] * wz.distance[k]) * a_z;
          node->second += wz.weight[k] * b + wz.derivative[k] * b_z;
        }
      }
    }
  }
}

template <class Shape, class Access>
void scatter(const Momentum& content, std::span<const std::uint32_t> members, const grid::Geometry& geometry,
             const grid::BlockCoordinate& block, Access& access) {
  constexpr int count = Shape::count;
  for (const std::uint32_t p : members) {
    const auto [wx, wy, wz] = weights_at<Shape>(content.points, p, geometry, block);
    const Lanes load = content(p);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const Lanes a = (wx.weight[i] * wy.weight[j]) * load;
        for (std::size_t k = 0; k < count; ++k) {
          access
              .node(wx.first + static_cast<int>(i), wy.first + static_cast<int>(j),
                    wz.first + static_cast<int>(k))
              ->first += wz.weight[k] * a;
        }
      }
    }
  }
}

template <class Shape, class Content>
void scatter_all(const Content& content, grid::BlockGrid& grid) {
  for (const std::vector<std::uint32_t>& colour : grid.colours()) {
    parallel::for_each_uneven(colour.size(), [&](std::size_t i) {
      const std::size_t slot = colour[i];
      const std::span<const std::uint32_t> members = Content::members(grid, slot);
      if (members.size() < direct_access_below) {
        DirectAccess access(grid, slot);
        scatter<Shape>(content, members, grid.geometry(), grid.coordinate(slot), access);
      } else {
        ReachCopy copy;
        copy.clear();
        scatter<Shape>(content, members, grid.geometry(), grid.coordinate(slot), copy);
        copy.add_to(grid, slot);
      }
    });
  }
}

}  // namespace

void particles_to_grid(ShapeFunction shape, const Particles& particles, grid::BlockGrid& grid,
                       std::span<const Vector3> acceleration) {
  grid.clear();
  with_shape(shape,
             [&]<class Shape>(Shape) { scatter_all<Shape>(Everything{{particles}, acceleration}, grid); });
}

void nodes_to_grid(ShapeFunction shape, const TransitionNodes& nodes, grid::BlockGrid& grid) {
  with_shape(shape, [&]<class Shape>(Shape) {
    if constexpr (CarriesAffineField<Shape>) scatter_all<Shape>(OfNodes{nodes}, grid);
  });
}

void momentum_to_grid(ShapeFunction shape, const Particles& particles, std::span<const Vector3> velocity,
                      grid::BlockGrid& grid) {
  const std::span<grid::Node> nodes = grid.all_nodes();
  parallel::for_each(nodes.size(), [&](std::size_t i) { nodes[i].first = broadcast(0.0); });
  with_shape(shape, [&]<class Shape>(Shape) { scatter_all<Shape>(Momentum{{particles}, velocity}, grid); });
}

}  // namespace whipple::transfer
