// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/element_kernels/element_registers.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/mesh.hpp"

/// Groups of elements, one element per lane, and the nodal fields of their block.
namespace whipple::fem {

/// Describes elements that are processed together, one per lane: elements of an ElementGroup from a given lane
/// on. Values in lanes without an element are unspecified.
template <class Vector>
struct Group {
  const ElementGroup& all;
  std::size_t lane;
  std::size_t count;  ///< number of valid lanes
  std::size_t first;  ///< first element

  Group(const ElementGroup& group, std::size_t first_lane)
      : all(group),
        lane(first_lane),
        count(std::min<std::size_t>(width<Vector>, group.count - first_lane)),
        first(group.first + first_lane) {}

  /// Returns the element of a lane; the last element for lanes without one.
  [[nodiscard]] std::size_t index(std::size_t l) const { return first + std::min(l, count - 1); }

  /// Loads one number per element.
  [[nodiscard]] WHIPPLE_INLINE Vector load(const std::vector<double>& from) const {
    return whipple::load<Vector>(&from[first], count);
  }
  WHIPPLE_INLINE void store(std::vector<double>& to, Vector values) const {
    whipple::store(&to[first], values, count);
  }
};

/// Returns the groups of a block.
WHIPPLE_INLINE inline std::span<const ElementGroup> groups_of(const Mesh& mesh, std::size_t block) {
  const Blocks& blocks = mesh.blocks;
  return std::span(blocks.groups)
      .subspan(blocks.first_group[block], blocks.first_group[block + 1] - blocks.first_group[block]);
}

/// Calls f(Group) for the elements of a group.
template <class Vector, class Function>
WHIPPLE_INLINE inline void for_each_part(const ElementGroup& all, Function&& f) {
  for (std::size_t lane = 0; lane < all.count; lane += width<Vector>) f(Group<Vector>(all, lane));
}

/// Holds a nodal field at the slots of a block; not initialised. The slots are followed by space for the corners of a
/// group.
template <class Vector>
class BlockField {
 public:
  /// Copies an eighth of the field, as required by `modes`.
  WHIPPLE_INLINE void copy(const Mesh& mesh, std::size_t block, const std::vector<Vector3>& field) {
    const Blocks& blocks = mesh.blocks;
    const std::uint32_t first = blocks.first_slot[block], end = blocks.first_slot[block + 1];
    const auto put = [&](std::uint32_t s, std::size_t i, Vector x)
                         WHIPPLE_INLINE { store(&at_[i][s - first], 0.125 * x, width<Vector>); };
    for (std::uint32_t s = first; s < end; s += width<Vector>) {
      const std::uint32_t* const node = &blocks.slot_node[s];
      if (s + width<Vector> <= end &&
          node[width<Vector> - 1] - node[0] == width<Vector> - 1) {  // ascending: contiguous
        const Triple<Vector> c = load_vectors_of_group<Vector>(field[node[0]].data());
        put(s, 0, c.x), put(s, 1, c.y), put(s, 2, c.z);
        continue;
      }
      std::array<Lanes, width<Vector>> rows;
      for (std::uint32_t l = 0; l < width<Vector>; ++l) {
        rows[l] = load_vector(field[blocks.slot_node[std::min(s + l, end - 1)]].data());
      }
      const auto c = transposed(rows);
      for (std::size_t i = 0; i < 3; ++i) put(s, i, c[i]);
    }
  }
  /// Advances the slots by a time dt (s) with velocities, by exactly the operations of `move_nodes`.
  WHIPPLE_INLINE void advance(const Mesh& mesh, std::size_t block, double dt, const BlockField& velocity) {
    const std::uint32_t count = mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::uint32_t s = 0; s < count; s += width<Vector>) {
        const Vector there = load<Vector>(&at_[i][s]) + dt * load<Vector>(&velocity.at_[i][s]);
        store(&at_[i][s], there, width<Vector>);
      }
    }
  }
  void zero(const Mesh& mesh, std::size_t block) {
    const std::uint32_t count = mesh.blocks.first_slot[block + 1] - mesh.blocks.first_slot[block];
    for (auto& component : at_) std::fill_n(component, count, 0.0);
  }
  /// Copies the values at the slots.
  WHIPPLE_INLINE void copy_to(std::span<Vector3> values) const {
    std::size_t s = 0;
    for (; s + width<Vector> <= values.size(); s += width<Vector>) {
      const auto along = [&](std::size_t i) WHIPPLE_INLINE { return load<Vector>(&at_[i][s]); };
      store_vectors(values[s].data(), Triple<Vector>{along(0), along(1), along(2)});
    }
    for (; s < values.size(); ++s) values[s] = Vector3(at_[0][s], at_[1][s], at_[2][s]);
  }

  /// Provides the values of a group as modes.
  class OfGroup {
   public:
    WHIPPLE_INLINE OfGroup(BlockField& field, const Group<Vector>& group) : field_(field), group_(group) {
      if (group.all.is_row != 0) return;
      for (std::size_t a = 0; a < 8; ++a) {
        for (auto& component : field.at_) {
          const Vector corner = load_from_places<Vector>(component, &group.all.slot[a][group.lane]);
          store(&component[group.all.place[a] + group.lane], corner, width<Vector>);
        }
      }
    }
    /// Returns one component of the field as modes, few enough to stay in registers.
    [[nodiscard]] WHIPPLE_INLINE std::array<Vector, 7> component(std::size_t i) const {
      std::array<Vector, 8> u;
      for (std::size_t a = 0; a < 8; ++a) {
        u[a] = load<Vector>(&field_.at_[i][group_.all.place[a] + group_.lane]);
      }
      return modes_of_eighths(u);
    }
    /// Returns the mean of one component at the corners.
    [[nodiscard]] WHIPPLE_INLINE Vector mean(std::size_t i) const {
      Vector sum{};
      for (std::size_t a = 0; a < 8; ++a) {
        sum += load<Vector>(&field_.at_[i][group_.all.place[a] + group_.lane]);
      }
      return sum;
    }
    [[nodiscard]] WHIPPLE_INLINE Modes<Vector> modes() const {
      return modes_by_components(component(0), component(1), component(2));
    }

   private:
    const BlockField& field_;
    const Group<Vector>& group_;
  };
  [[nodiscard]] WHIPPLE_INLINE OfGroup of(const Group<Vector>& group) { return OfGroup(*this, group); }

  /// Adds the corner values of a field given by its modes.
  WHIPPLE_INLINE void add(const Group<Vector>& group, const Modes<Vector>& field) {
    const std::array<Triple<Vector>, 8> corners = corners_of(field);
    add_component(at_[0], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].x; });
    add_component(at_[1], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].y; });
    add_component(at_[2], group, [&](std::size_t a) WHIPPLE_INLINE { return corners[a].z; });
  }

  /// Adds a value to one component at all corners.
  WHIPPLE_INLINE void add_constant(const Group<Vector>& group, std::size_t i, Vector value) {
    add_component(at_[i], group, [&](std::size_t) WHIPPLE_INLINE { return value; });
  }

 private:
  template <class Share>
  WHIPPLE_INLINE static void add_component(double* to, const Group<Vector>& group, const Share& share) {
    // Corners at the back and at the front of elements along a direction, edge by edge.
    const auto add_lines = [&](const std::array<std::size_t, 4>& back,
                               const std::array<std::size_t, 4>& front) WHIPPLE_INLINE {
      for (std::size_t edge = 0; edge < 4; ++edge) {
        add_to_line(to + group.all.place[back[edge]] + group.lane, share(back[edge]), share(front[edge]),
                    group.count);
      }
    };
    switch (group.all.along) {
      case 1:
        return add_lines({0, 3, 4, 7}, {1, 2, 5, 6});
      case 2:
        return add_lines({0, 1, 4, 5}, {3, 2, 7, 6});
      case 3:
        return add_lines({0, 1, 2, 3}, {4, 5, 6, 7});
      default:
        break;
    }
    std::array<Vector, 8> shares;
    for (std::size_t a = 0; a < 8; ++a) shares[a] = share(a);
    for (std::size_t l = 0; l < group.count; ++l) {
      for (std::size_t a = 0; a < 8; ++a) to[group.all.slot[a][group.lane + l]] += shares[a][l];
    }
  }

  double at_[3][ElementGroup::gathered_place(8)];  // NOLINT: without initialisation
};

/// Lists the rows of the points of a group.
template <class Vector>
using Rows = std::array<std::size_t, width<Vector>>;

}  // namespace whipple::fem
