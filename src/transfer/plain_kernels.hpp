// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/transfer/register_kernels.hpp"

/// The transfers as plain loops over points and their nodes, one number at a
/// time, as docs/theory/mpm.md, 3 to 5, writes them: the reference that the
/// kernels for registers are compared with (`--device reference`).
namespace whipple::transfer::plain {

inline Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }
inline Lanes lanes(const Vector3 &v, double fourth = 0.0) {
  return Lanes{v[0], v[1], v[2], fourth};
}
inline std::array<Lanes, 3> columns(const Matrix3 &m) {
  return {lanes(m.col(0)), lanes(m.col(1)), lanes(m.col(2))};
}

/// Shape function N of a node at a point, its slopes S (1/m) and the vector r
/// from the point to the node (m).
struct AtNode {
  double n;
  Vector3 gradient, r;
};

/// A shape function as numbers: the loops are the same for all.
struct Functions {
  ShapeFunction kind;
  grid::Stencil stencil;
  std::size_t count, count_z; ///< nodes in x and y, and along z
  double second_moment; ///< sum of N r r^T along one direction, in dx^2; 0: the
                        ///< functions carry no affine field
};
template <class Shape> constexpr Functions functions() {
  double second_moment = 0.0;
  if constexpr (CarriesAffineField<Shape>)
    second_moment = Shape::second_moment;
  return {Shape::kind, Shape::stencil, static_cast<std::size_t>(Shape::count),
          count_z<Shape>, second_moment};
}

constexpr int most_nodes = 4; ///< that a point reaches along a direction
/// Returns N, S and r of the nodes along a direction, `Functions::count` of
/// them.
/// @param from_first  position in cells from the first node
/// @param half_size   of the particle's domain, in cells; only GIMP uses it
AxisWeights<most_nodes> along_axis(ShapeFunction kind, double from_first,
                                   double half_size, const Cells &cells);
/// Returns those of the one node that a plane has along z.
AxisWeights<most_nodes> across_plane();

/// Nodes of a block and of those around it, for points of one velocity field.
class NodesAround {
public:
  NodesAround(grid::BlockGrid &grid, std::size_t slot, unsigned field,
              grid::Stencil stencil);
  /// Returns a node by its place, counted from the lower corner of the block.
  [[nodiscard]] grid::Node &at(int x, int y, int z) const;

private:
  grid::BlockGrid &grid_;
  std::size_t slot_;
  unsigned field_;
  grid::BlockShape block_;
  grid::ReachMap map_, map_z_;
};

/// Calls f(node, AtNode) for the nodes of a point.
template <class Points, class Function>
void for_each_node(const Functions &functions, const Points &points,
                   std::size_t p, const grid::PlaceInStencil &place,
                   const Cells &cells, const NodesAround &nodes, Function &&f) {
  Vector3 half = Vector3::Zero();
  if constexpr (requires { points.extent; }) {
    if (!points.extent.empty())
      half = half_sizes(points.extent[p], cells.size);
  }
  const auto along = [&](std::size_t direction) {
    if (direction == 2 && functions.stencil.planar)
      return across_plane();
    return along_axis(functions.kind, place.from_first(direction),
                      half[static_cast<Eigen::Index>(direction)],
                      cells.along(direction));
  };
  const auto x = along(0), y = along(1), z = along(2);
  const std::array<int, 3> first = place.first_node(functions.stencil);
  for (std::size_t i = 0; i < functions.count; ++i) {
    for (std::size_t j = 0; j < functions.count; ++j) {
      for (std::size_t k = 0; k < functions.count_z; ++k) {
        f(nodes.at(first[0] + static_cast<int>(i),
                   first[1] + static_cast<int>(j),
                   first[2] + static_cast<int>(k)),
          AtNode{.n = x.weight[i] * y.weight[j] * z.weight[k],
                 .gradient = {x.derivative[i] * y.weight[j] * z.weight[k],
                              x.weight[i] * y.derivative[j] * z.weight[k],
                              x.weight[i] * y.weight[j] * z.derivative[k]},
                 .r = {x.distance[i], y.distance[j], z.distance[k]}});
      }
    }
  }
}

/// Convects an affine field with a step (4.8). @returns its loss of |C|^2
inline double convect(Matrix3 &c, const Matrix3 &gradient, double dt) {
  const Matrix3 deformation = Matrix3::Identity() + dt * gradient;
  if (deformation.determinant() <= 0.1)
    return 0.0;
  const Matrix3 carried = c * deformation.inverse();
  const double before = c.squaredNorm(), after = carried.squaredNorm();
  const double cap = after > before ? std::sqrt(before / after) : 1.0;
  c = cap * carried;
  return before - c.squaredNorm();
}

/// What a point takes of the advanced nodes in the symplectic scheme (4.1
/// to 4.5, 4.8).
template <bool affine> struct Transfer {
  AffineField field;
  double dt;

  using Result = Advance<>;
  /// @param inertia  per mass, of the affine field (m^2)
  template <class Points, class ForEachNode>
  Result of(const Points &points, std::size_t p, double inertia,
            const ForEachNode &for_each) const {
    const Vector3 velocity = points.velocity[p];
    Matrix3 c = Matrix3::Zero();
    if constexpr (affine)
      c = points.affine_velocity[p];
    Vector3 v = Vector3::Zero(), d = v,
            change = v; // sum N v', N d, N (d - beta D)
    Matrix3 grad_v = Matrix3::Zero(), grad_d = grad_v,
            change_r = grad_v; // the same with grad N, or with N r^T
    double loss = 0.0, contact_heat = 0.0;
    for_each([&](const grid::Node &node, const AtNode &at) {
      const Vector3 v_i = vector(node.registers.first),
                    d_i = vector(node.registers.second);
      const double beta = node.registers.first[3];
      const Vector3 difference = velocity + c * at.r - v_i,
                    change_i = d_i - beta * difference;
      v += at.n * (v_i + d_i);
      grad_v += (v_i + d_i) * at.gradient.transpose();
      d += at.n * d_i;
      grad_d += d_i * at.gradient.transpose();
      change += at.n * change_i;
      change_r += at.n * change_i * at.r.transpose();
      loss += at.n * (0.5 * d_i.squaredNorm() +
                      beta * difference.dot(difference - d_i));
      contact_heat += at.n * node.registers.second[3];
    });
    loss -= 0.5 * change.squaredNorm();
    if constexpr (affine) {
      if (carries_field(points, p)) {
        loss -= 0.5 * change_r.squaredNorm() / inertia;
        c += change_r / inertia;
      }
      if (field == AffineField::deformed)
        loss += 0.5 * inertia * convect(c, grad_v, dt);
    }
    return {.grid_velocity = {lanes(v), columns(grad_v)},
            .increment = {lanes(d, contact_heat), columns(grad_d)},
            .velocity = lanes(velocity + change),
            .affine = columns(c),
            .heat = broadcast(loss)};
  }

private:
  /// Some nodes of elements carry no affine field.
  template <class Points>
  static bool carries_field(const Points &points, std::size_t p) {
    if constexpr (requires { points.unrelaxed; })
      return p >= points.unrelaxed;
    return true;
  }
};

/// New velocity of the grid and its increment (5.1).
struct Update {
  using Result = VelocityUpdate<>;
  template <class Points, class ForEachNode>
  Result of(const Points &, std::size_t, double,
            const ForEachNode &for_each) const {
    VelocityUpdate<> sums{};
    for_each([&](const grid::Node &node, const AtNode &at) {
      const Lanes after = node.registers.first + node.registers.second;
      sums.after.value += at.n * after;
      for (std::size_t a = 0; a < 3; ++a)
        sums.after.gradient[a] +=
            at.gradient[static_cast<Eigen::Index>(a)] * after;
      sums.increment += at.n * node.registers.second;
    });
    return sums;
  }
};

/// Sums of the first register of the nodes.
struct First {
  using Result = ValueAndGradient<>;
  template <class Points, class ForEachNode>
  Result of(const Points &, std::size_t, double,
            const ForEachNode &for_each) const {
    ValueAndGradient<> sums{};
    for_each([&](const grid::Node &node, const AtNode &at) {
      sums.value += at.n * node.registers.first;
      for (std::size_t a = 0; a < 3; ++a) {
        sums.gradient[a] +=
            at.gradient[static_cast<Eigen::Index>(a)] * node.registers.first;
      }
    });
    return sums;
  }
};

/// The entries, as those of the kernels for registers
/// (src/transfer/kernels/entries.inl).
struct Kernels {
  template <bool affine> using Transfer = plain::Transfer<affine>;
  using Update = plain::Update;
  using First = plain::First;

  template <class Shape, class Sums, class Points, class Take>
  static void gather(const Points &points, grid::BlockGrid &grid,
                     grid::BlockGrid::Points kind, std::size_t slot,
                     double slope_smoothing, const Sums &sums,
                     const Take &take) {
    const std::vector<typename Sums::Result> results = sums_of_slot(
        functions<Shape>(), points, grid, kind, slot, slope_smoothing, sums);
    const std::span<const std::uint32_t> members = grid.members(kind, slot);
    for (std::size_t place = 0; place < members.size(); ++place)
      take(place, members[place], results[place]);
  }

  template <class Shape, class What>
  static void scatter(const What &what, grid::BlockGrid &grid, std::size_t slot,
                      double slope_smoothing) {
    add_slot<CarriesAffineField<Shape>>(functions<Shape>(), what, grid, slot,
                                        slope_smoothing);
  }

private:
  /// Returns what each point of a slot takes from its nodes.
  template <class Sums, class Points>
  static std::vector<typename Sums::Result>
  sums_of_slot(const Functions &functions, const Points &points,
               grid::BlockGrid &grid, grid::BlockGrid::Points kind,
               std::size_t slot, double slope_smoothing, const Sums &sums) {
    const std::span<const grid::PlaceInStencil> places = grid.places(kind);
    const Cells cells(grid, slot, slope_smoothing);
    const double inertia = functions.second_moment * cells.size * cells.size;
    std::vector<typename Sums::Result> results;
    grid.for_each_field(
        kind, slot,
        [&](std::span<const std::uint32_t> members, unsigned field) {
          const NodesAround nodes(grid, slot, field, functions.stencil);
          for (const std::uint32_t p : members) {
            results.push_back(sums.of(points, p, inertia, [&](auto &&f) {
              for_each_node(functions, points, p, places[p], cells, nodes, f);
            }));
          }
        });
    return results;
  }

  /// Adds what the points of a slot bring to their nodes.
  template <bool affine, class What>
  static void add_slot(const Functions &functions, const What &what,
                       grid::BlockGrid &grid, std::size_t slot,
                       double slope_smoothing) {
    const std::span<const grid::PlaceInStencil> places =
        grid.places(What::kind);
    const Cells cells(grid, slot, slope_smoothing);
    grid.for_each_field(
        What::kind, slot,
        [&](std::span<const std::uint32_t> members, unsigned field) {
          const NodesAround nodes(grid, slot, field, functions.stencil);
          for (const std::uint32_t p : members) {
            const auto load = what.template load<affine>(p);
            for_each_node(functions, what.points, p, places[p], cells, nodes,
                          [&](grid::Node &node, const AtNode &at) {
                            add(load, at, node);
                          });
          }
        });
  }
  /// Adds mass, momentum, sound speed and force of a point to a node (3.1
  /// to 3.3).
  static void add(const Payload &load, const AtNode &at, grid::Node &node) {
    node.registers.first += at.n * (load.a0 + at.r[0] * load.ax +
                                    at.r[1] * load.ay + at.r[2] * load.az);
    node.registers.second += at.n * load.b0 + at.gradient[0] * load.bx +
                             at.gradient[1] * load.by +
                             at.gradient[2] * load.bz;
  }
  /// Adds mass and momentum only.
  static void add(Lanes load, const AtNode &at, grid::Node &node) {
    node.registers.first += at.n * load;
  }
};

} // namespace whipple::transfer::plain
