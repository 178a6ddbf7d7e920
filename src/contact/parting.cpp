// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/parting.hpp"

#include <algorithm>

namespace whipple::contact {

bool near_planes(const grid::BlockGrid& grid, std::uint32_t slot) {
  const grid::Geometry& geometry = grid.geometry(slot);
  constexpr int reach = 2;  // cells
  for (std::size_t a = 0; a < 3; ++a) {
    const int edge = grid.block_shape().along(a), first = grid.coordinate(slot)[a] * edge,
              last = first + edge - 1;
    const auto reflects = [&](std::size_t face) {
      return geometry.boundary[face] != grid::Boundary::outflow;
    };
    if (reflects(2 * a) && first <= reach) return true;
    if (reflects(2 * a + 1) && last >= geometry.cells[a] - reach) return true;
  }
  return false;
}

bool parts(const grid::BlockGrid& grid, std::uint32_t slot, std::size_t node, std::size_t a, std::size_t b,
           std::span<const Vector3> normals, double dt) {
  const grid::Node *first = nullptr, *second = nullptr;
  std::size_t number = 0, reached = 0;
  // The sides of a crack have separate motions, which this test does not consider.
  if (grid.wholes(slot) != grid.fields(slot)) return false;
  grid.fields(slot).for_each([&](unsigned field) {
    const grid::Node* of_field = grid.nodes(slot, field) + node;
    reached += of_field->sums.mass() > 0.0 ? 1 : 0;
    if (number == a) first = of_field;
    if (number == b) second = of_field;
    ++number;
  });
  if (reached != 2) return false;
  const auto velocity = [](const grid::Node& n) -> Vector3 { return n.sums.momentum() / n.sums.mass(); };
  const auto increment = [&](const grid::Node& n) -> Vector3 { return dt / n.sums.mass() * n.sums.force(); };
  const Vector3 apart = velocity(*second) - velocity(*first), pulled = increment(*second) - increment(*first);
  return std::ranges::all_of(normals, [&](const Vector3& normal) {
    return normal.dot(pulled) >= 0.0 && normal.dot(apart + pulled) >= 0.0;
  });
}

}  // namespace whipple::contact
