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

#include "src/transfer/plain_nodes.hpp"
#include "src/transfer/register_kernels.hpp"

/// The transfers as plain loops over points and their nodes, one number at a
/// time, as docs/theory/mpm.md, 3 to 5, writes them: the reference that the
/// kernels for registers are compared with (`--device reference`).
namespace whipple::transfer::plain {

inline Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }
inline Lanes lanes(const Vector3& v, double fourth = 0.0) { return Lanes{v[0], v[1], v[2], fourth}; }
inline std::array<Lanes, 3> columns(const Matrix3& m) {
  return {lanes(m.col(0)), lanes(m.col(1)), lanes(m.col(2))};
}

/// Convects an affine field with a step (4.8). @returns its loss of |C|^2
inline double convect(Matrix3& c, const Matrix3& gradient, double dt) {
  const Matrix3 deformation = Matrix3::Identity() + dt * gradient;
  if (deformation.determinant() <= 0.1) return 0.0;
  const Matrix3 carried = c * deformation.inverse();
  const double before = c.squaredNorm(), after = carried.squaredNorm();
  const double cap = after > before ? std::sqrt(before / after) : 1.0;
  c = cap * carried;
  return before - c.squaredNorm();
}

/// What a point takes of the advanced nodes in the symplectic scheme (4.1
/// to 4.5, 4.8).
template <bool affine>
struct Transfer {
  AffineField field;
  double dt;

  using Result = Advance<>;
  /// @param inertia  per mass, of the affine field (m^2)
  template <class Points, class ForEachNode>
  Result of(const Points& points, std::size_t p, double inertia, const ForEachNode& for_each) const {
    const Vector3 velocity = points.velocity[p];
    Matrix3 c = Matrix3::Zero();
    if constexpr (affine) c = points.affine_velocity[p];
    Vector3 v = Vector3::Zero(), d = v,
            change = v;  // sum N v', N d, N (d - beta D)
    Matrix3 grad_v = Matrix3::Zero(), grad_d = grad_v,
            change_r = grad_v;  // the same with grad N, or with N r^T
    double loss = 0.0, contact_heat = 0.0;
    for_each([&](const grid::Node& node, const AtNode& at) {
      const Vector3 v_i = vector(node.registers.first), d_i = vector(node.registers.second);
      const double beta = node.registers.first[3];
      const Vector3 difference = velocity + c * at.r - v_i, change_i = d_i - beta * difference;
      v += at.n * (v_i + d_i);
      grad_v += (v_i + d_i) * at.gradient.transpose();
      d += at.n * d_i;
      grad_d += d_i * at.gradient.transpose();
      change += at.n * change_i;
      change_r += at.n * change_i * at.r.transpose();
      loss += at.n * (0.5 * d_i.squaredNorm() + beta * difference.dot(difference - d_i));
      contact_heat += at.n * node.registers.second[3];
    });
    loss -= 0.5 * change.squaredNorm();
    if constexpr (affine) {
      if (carries_field(points, p)) {
        loss -= 0.5 * change_r.squaredNorm() / inertia;
        c += change_r / inertia;
      }
      if (field == AffineField::deformed) loss += 0.5 * inertia * convect(c, grad_v, dt);
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
  static bool carries_field(const Points& points, std::size_t p) {
    if constexpr (requires { points.unrelaxed; }) return p >= points.unrelaxed;
    return true;
  }
};

/// New velocity of the grid and its increment (5.1).
struct Update {
  using Result = VelocityUpdate<>;
  template <class Points, class ForEachNode>
  Result of(const Points&, std::size_t, double, const ForEachNode& for_each) const {
    VelocityUpdate<> sums{};
    for_each([&](const grid::Node& node, const AtNode& at) {
      const Lanes after = node.registers.first + node.registers.second;
      sums.after.value += at.n * after;
      for (std::size_t a = 0; a < 3; ++a)
        sums.after.gradient[a] += at.gradient[static_cast<Eigen::Index>(a)] * after;
      sums.increment += at.n * node.registers.second;
    });
    return sums;
  }
};

/// Sums of the first register of the nodes.
struct First {
  using Result = ValueAndGradient<>;
  template <class Points, class ForEachNode>
  Result of(const Points&, std::size_t, double, const ForEachNode& for_each) const {
    ValueAndGradient<> sums{};
    for_each([&](const grid::Node& node, const AtNode& at) {
      sums.value += at.n * node.registers.first;
      for (std::size_t a = 0; a < 3; ++a) {
        sums.gradient[a] += at.gradient[static_cast<Eigen::Index>(a)] * node.registers.first;
      }
    });
    return sums;
  }
};

/// The entries, as those of the kernels for registers
/// (src/transfer/kernels/entries.inl).
struct Kernels {
  template <bool affine>
  using Transfer = plain::Transfer<affine>;
  using Update = plain::Update;
  using First = plain::First;

  template <class Shape, class Sums, class Points, class Take>
  static void gather(const Points& points, grid::BlockGrid& grid, grid::BlockGrid::Points kind,
                     std::size_t slot, double slope_smoothing, const Sums& sums, const Take& take) {
    const std::vector<typename Sums::Result> results =
        sums_of_slot(functions<Shape>(), points, grid, kind, slot, slope_smoothing, sums);
    const std::span<const std::uint32_t> members = grid.members(kind, slot);
    for (std::size_t place = 0; place < members.size(); ++place) take(place, members[place], results[place]);
  }

  template <class Shape, class What>
  static void scatter(const What& what, grid::BlockGrid& grid, std::size_t slot, double slope_smoothing) {
    add_slot<CarriesAffineField<Shape>>(functions<Shape>(), what, grid, slot, slope_smoothing);
  }

 private:
  /// Returns what each point of a slot takes from its nodes.
  template <class Sums, class Points>
  static std::vector<typename Sums::Result> sums_of_slot(const Functions& functions, const Points& points,
                                                         grid::BlockGrid& grid, grid::BlockGrid::Points kind,
                                                         std::size_t slot, double slope_smoothing,
                                                         const Sums& sums) {
    const std::span<const grid::PlaceInStencil> places = grid.places(kind);
    const Cells cells(grid, slot, slope_smoothing);
    const double inertia = functions.second_moment * cells.size * cells.size;
    std::vector<typename Sums::Result> results;
    grid.for_each_field(kind, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
      const NodesAround nodes(grid, slot, field, functions.stencil);
      for (const std::uint32_t p : members) {
        results.push_back(sums.of(points, p, inertia, [&](auto&& f) {
          for_each_node(functions, points, p, places[p], cells, nodes, f);
        }));
      }
    });
    return results;
  }

  /// Adds what the points of a slot bring to their nodes.
  template <bool affine, class What>
  static void add_slot(const Functions& functions, const What& what, grid::BlockGrid& grid, std::size_t slot,
                       double slope_smoothing) {
    const std::span<const grid::PlaceInStencil> places = grid.places(What::kind);
    const Cells cells(grid, slot, slope_smoothing);
    grid.for_each_field(What::kind, slot, [&](std::span<const std::uint32_t> members, unsigned field) {
      const NodesAround nodes(grid, slot, field, functions.stencil);
      for (const std::uint32_t p : members) {
        const auto load = what.template load<affine>(p);
        for_each_node(functions, what.points, p, places[p], cells, nodes,
                      [&](grid::Node& node, const AtNode& at) { add(load, at, node); });
      }
    });
  }
  /// Adds mass, momentum, sound speed and force of a point to a node (3.1
  /// to 3.3).
  static void add(const Payload& load, const AtNode& at, grid::Node& node) {
    node.registers.first += at.n * (load.a0 + at.r[0] * load.ax + at.r[1] * load.ay + at.r[2] * load.az);
    node.registers.second +=
        at.n * load.b0 + at.gradient[0] * load.bx + at.gradient[1] * load.by + at.gradient[2] * load.bz;
  }
  /// Adds mass and momentum only.
  static void add(Lanes load, const AtNode& at, grid::Node& node) { node.registers.first += at.n * load; }
};

}  // namespace whipple::transfer::plain
