// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace whipple::contact {

void SurfacePoints::clear() {
  position.clear();
  area.clear();
  size.clear();
  field.clear();
}

void SurfacePoints::add(const fem::Mesh& mesh, std::span<const fem::Facet> facets, std::uint8_t of_body,
                        double spacing) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> point_of_node(mesh.nodes.size(), none);
  const auto new_point = [&](const Vector3& x) {
    position.push_back(x);
    area.push_back(Vector3::Zero());
    size.push_back(0.0);
    field.push_back(of_body);
    return static_cast<std::uint32_t>(position.size() - 1);
  };
  for (const fem::Facet& facet : facets) {
    std::array<Vector3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.nodes.position[facet[i]];
    double edge = 0.0;
    for (std::size_t i = 0; i < 4; ++i) edge = std::max(edge, (x[(i + 1) % 4] - x[i]).norm());
    const int parts = std::max(1, static_cast<int>(std::ceil(edge / spacing - 1e-9)));
    // Trapezoidal rule over the bilinear facet, in its natural coordinates.
    for (int i = 0; i <= parts; ++i) {
      for (int j = 0; j <= parts; ++j) {
        const double u = static_cast<double>(i) / parts, v = static_cast<double>(j) / parts;
        const bool at_end_u = i == 0 || i == parts, at_end_v = j == 0 || j == parts;
        const Vector3 along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
        const Vector3 along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
        const Vector3 part =
            (at_end_u ? 0.5 : 1.0) * (at_end_v ? 0.5 : 1.0) / (parts * parts) * along_u.cross(along_v);
        std::uint32_t point = none;
        if (at_end_u && at_end_v) {
          const std::size_t corner = j == 0 ? (i == 0 ? 0U : 1U) : (i == 0 ? 3U : 2U);
          std::uint32_t& of_node = point_of_node[facet[corner]];
          if (of_node == none) of_node = new_point(x[corner]);
          point = of_node;
        } else {
          point = new_point((1 - v) * ((1 - u) * x[0] + u * x[1]) + v * ((1 - u) * x[3] + u * x[2]));
        }
        area[point] += part;
        size[point] += part.norm();
      }
    }
  }
}

PlacedPoints::PlacedPoints(const SurfacePoints& surface, const grid::BlockGrid& grid) : points(&surface) {
  in_slot.begin.assign(grid.slots() + 1, 0);
  std::vector<std::int32_t> slot_of(surface.count());
  for (std::size_t p = 0; p < surface.count(); ++p) {
    slot_of[p] = grid.slot_at(surface.position[p]);
    if (slot_of[p] == grid::BlockGrid::no_slot) continue;
    const auto slot = static_cast<std::size_t>(slot_of[p]);
    if (grid.meets_contact(slot)) {
      ++in_slot.begin[slot + 1];
    } else {
      slot_of[p] = grid::BlockGrid::no_slot;
    }
  }
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    if (in_slot.begin[s + 1] > 0) {
      const grid::BlockCoordinate& c = grid.coordinate(s);
      colours[static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))].push_back(
          static_cast<std::uint32_t>(s));
    }
    in_slot.begin[s + 1] += in_slot.begin[s];
  }
  in_slot.points.resize(in_slot.begin.back());
  std::vector<std::uint32_t> next(in_slot.begin.begin(), in_slot.begin.end() - 1);
  for (std::size_t p = 0; p < surface.count(); ++p) {
    if (slot_of[p] == grid::BlockGrid::no_slot) continue;
    in_slot.points[next[static_cast<std::size_t>(slot_of[p])]++] = static_cast<std::uint32_t>(p);
  }
}

}  // namespace whipple::contact
