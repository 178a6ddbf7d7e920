// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/transfer/formulas.hpp"
#include "src/transfer/plain_nodes.hpp"
#include "src/transfer/point_values.hpp"

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
  const auto columns_of = [](const Matrix3& m) {
    std::array<Triple<double>, 3> columns;
    for (int a = 0; a < 3; ++a) columns[static_cast<std::size_t>(a)] = {m(0, a), m(1, a), m(2, a)};
    return columns;
  };
  std::array<Triple<double>, 3> columns = columns_of(c);
  const double loss = formulas::convect(columns, columns_of(gradient), dt);
  for (int a = 0; a < 3; ++a) {
    const Triple<double>& column = columns[static_cast<std::size_t>(a)];
    c.col(a) << column.x, column.y, column.z;
  }
  return loss;
}

/// Gathers for a point from the advanced nodes in the symplectic scheme (4.1
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
    Vector3 v = Vector3::Zero(), d = v, change = v;  // sum N v', N d, N (d - beta D)
    Matrix3 grad_v = Matrix3::Zero(), grad_d = grad_v,
            change_r = grad_v;  // the same with grad N, or with N r^T
    Vector3 loss = Vector3::Zero();
    double contact_heat = 0.0;
    for_each([&](const grid::Node& node, const AtNode& at) {
      const Vector3 v_i = vector(node.registers.first), d_i = vector(node.registers.second);
      const Vector3 difference = velocity + c * at.r - v_i;
      Vector3 change_i;
      for (int a = 0; a < 3; ++a) {
        const auto by_node = formulas::change_by_node(difference[a], d_i[a], node.registers.first[3]);
        change_i[a] = by_node.velocity;
        loss[a] += at.n * by_node.loss;
      }
      v += at.n * (v_i + d_i);
      grad_v += (v_i + d_i) * at.gradient.transpose();
      d += at.n * d_i;
      grad_d += d_i * at.gradient.transpose();
      change += at.n * change_i;
      change_r += at.n * change_i * at.r.transpose();
      contact_heat += at.n * node.registers.second[3];
    });
    double heat = 0.0;
    for (int a = 0; a < 3; ++a) heat += formulas::heat_of_velocity(loss[a], change[a]);
    if constexpr (affine) {
      const double per_inertia = carries_field(points, p) ? 1.0 / inertia : 0.0;
      for (int a = 0; a < 9; ++a) {
        const auto gained = formulas::change_of_field(change_r(a), per_inertia);
        heat -= gained.energy;
        c(a) += gained.field;
      }
      if (field == AffineField::deformed) heat += 0.5 * inertia * convect(c, grad_v, dt);
    }
    return {.grid_velocity = {lanes(v), columns(grad_v)},
            .increment = {lanes(d, contact_heat), columns(grad_d)},
            .velocity = lanes(velocity + change),
            .affine = columns(c),
            .heat = broadcast(heat)};
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
/// (src/transfer/register_kernels.hpp).
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

  /// Adds mass, momentum, sound speed and force of a point to a node (3.1
  /// to 3.3).
  static void add(const Payload& load, const AtNode& at, grid::Node& node) {
    node.registers.first += at.n * (load.a0 + at.r[0] * load.ax + at.r[1] * load.ay + at.r[2] * load.az);
    node.registers.second +=
        at.n * load.b0 + at.gradient[0] * load.bx + at.gradient[1] * load.by + at.gradient[2] * load.bz;
  }
  /// Adds mass and momentum only.
  static void add(Lanes load, const AtNode& at, grid::Node& node) { node.registers.first += at.n * load; }

 private:
  /// Returns the results of the points of a slot.
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

  /// Adds the contributions of the points of a slot to their nodes.
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
};

}  // namespace whipple::transfer::plain
