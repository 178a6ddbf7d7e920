// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/surface_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::contact {

BlocksAtContact::BlocksAtContact(const grid::BlockGrid& grid) : geometry_(grid.geometry()) {
  blocks_.reserve(4 * grid.contact_slots().size());
  for (const std::uint32_t slot : grid.contact_slots()) {
    const grid::BlockCoordinate& c = grid.coordinate(slot);
    for (int n = 0; n < 27; ++n)
      blocks_.find_or_insert({{c[0] + n / 9 - 1, c[1] + n / 3 % 3 - 1, c[2] + n % 3 - 1}, c.level}, 1);
  }
}

bool BlocksAtContact::meet(const Vector3& lower, const Vector3& upper) const {
  if (blocks_.size() == 0) return false;
  const auto block_of = [&](const Vector3& x) {
    return floor_of_three(geometry_.in_cells(x) / geometry_.block().edges());
  };
  const std::array<std::int32_t, 3> first = block_of(lower), last = block_of(upper);
  for (std::int32_t i = first[0]; i <= last[0]; ++i) {
    for (std::int32_t j = first[1]; j <= last[1]; ++j) {
      for (std::int32_t k = first[2]; k <= last[2]; ++k) {
        if (blocks_.find({{i, j, k}}) != grid::BlockTable::none) return true;
      }
    }
  }
  return false;
}

void SurfacePoints::clear() {
  position.clear();
  area.clear();
  size.clear();
  field.clear();
  node.clear();
}

void SurfacePoints::add(const fem::Mesh& mesh, std::span<const fem::Facet> facets, std::uint8_t of_body,
                        double spacing, const BlocksAtContact* near) {
  point_of_node_.resize(std::max(point_of_node_.size(), mesh.nodes.size()), no_point);
  const std::size_t before = count();
  const auto new_point = [&](const Vector3& x, std::uint64_t id) {
    position.push_back(x);
    area.push_back(Vector3::Zero());
    size.push_back(0.0);
    field.push_back(of_body);
    node.push_back(id);
    return static_cast<std::uint32_t>(position.size() - 1);
  };
  const bool flat = fem::is_flat(mesh.quadrature);
  for (const fem::Facet& facet : facets) {
    std::array<Vector3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.nodes.position[facet[i]];
    if (near != nullptr && !near->meet(x[0].cwiseMin(x[1]).cwiseMin(x[2]).cwiseMin(x[3]),
                                       x[0].cwiseMax(x[1]).cwiseMax(x[2]).cwiseMax(x[3]))) {
      continue;
    }
    double edge = 0.0;
    for (std::size_t i = 0; i < 4; ++i) edge = std::max(edge, (x[(i + 1) % 4] - x[i]).norm());
    const int parts = std::max(1, static_cast<int>(std::ceil(edge / spacing - 1e-9)));
    // Trapezoidal rule over the bilinear facet, in natural coordinates
    const int parts_v = flat ? 0 : parts;  // an edge of a section is one row of points
    for (int i = 0; i <= parts; ++i) {
      for (int j = 0; j <= parts_v; ++j) {
        const double u = static_cast<double>(i) / parts, v = static_cast<double>(j) / parts;
        const bool at_end_u = i == 0 || i == parts, at_end_v = j == 0 || j == parts;
        const Vector3 along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
        Vector3 along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
        double share = (at_end_u ? 0.5 : 1.0) * (at_end_v ? 0.5 : 1.0) / (parts * parts);
        if (flat) {  // per depth, as that of particles
          along_v = Vector3::UnitZ();
          share = (at_end_u ? 0.5 : 1.0) / parts;
        }
        const Vector3 part = share * along_u.cross(along_v);
        std::uint32_t point = no_point;
        if (at_end_u && at_end_v) {
          const std::size_t corner = j == 0 ? (i == 0 ? 0U : 1U) : (i == 0 ? 3U : 2U);
          std::uint32_t& of_node = point_of_node_[facet[corner]];
          if (of_node == no_point) of_node = new_point(x[corner], mesh.nodes.id[facet[corner]]);
          point = of_node;
        } else {
          point = new_point((1 - v) * ((1 - u) * x[0] + u * x[1]) + v * ((1 - u) * x[3] + u * x[2]), no_node);
        }
        area[point] += part;
        size[point] += part.norm();
      }
    }
  }
  if (count() == before) return;
  for (const fem::Facet& facet : facets) {
    for (const std::uint32_t a : facet) point_of_node_[a] = no_point;
  }
}

void SurfacePoints::send_to_owners(const grid::BlockGrid& grid, grid::Stencil stencil,
                                   MPI_Comm communicator) {
  const auto ranks = static_cast<std::size_t>(parallel::size(communicator));
  if (ranks == 1) return;
  struct Point {
    Vector3 position, area;
    double size;
    std::uint64_t field, node;
  };
  std::vector<std::vector<std::byte>> outgoing(ranks);
  std::vector<int> reached;
  for (std::size_t p = 0; p < count(); ++p) {
    reached.clear();
    grid.owners_reached(position[p], stencil, reached);
    const Point point{position[p], area[p], size[p], field[p], node[p]};
    const auto* bytes = reinterpret_cast<const std::byte*>(&point);
    for (const int r : reached) {
      std::vector<std::byte>& to = outgoing[static_cast<std::size_t>(r)];
      to.insert(to.end(), bytes, bytes + sizeof(Point));
    }
  }
  clear();
  std::unordered_map<std::uint64_t, std::size_t> point_of_node;
  for (const std::vector<std::byte>& part : parallel::exchange_bytes(communicator, outgoing)) {
    for (std::size_t at = 0; at < part.size(); at += sizeof(Point)) {
      Point point;
      std::copy_n(part.data() + at, sizeof(Point), reinterpret_cast<std::byte*>(&point));
      if (point.node != no_node) {
        const auto [same, is_new] = point_of_node.emplace(point.node, count());
        if (!is_new) {
          area[same->second] += point.area;
          size[same->second] += point.size;
          continue;
        }
      }
      position.push_back(point.position);
      area.push_back(point.area);
      size.push_back(point.size);
      field.push_back(static_cast<std::uint8_t>(point.field));
      node.push_back(point.node);
    }
  }
}

PlacedPoints::PlacedPoints(const SurfacePoints& surface, const grid::BlockGrid& grid) : points(&surface) {
  if (grid.contact_slots().empty()) return;
  constexpr std::int32_t nowhere = -2;  // marks blocks that reach no contact slot
  grid::BlockTable known;
  known.reserve(64);
  for (std::size_t p = 0; p < surface.count(); ++p) {
    const std::optional<grid::BlockCoordinate> block = grid.block_of(surface.position[p]);
    if (!block) continue;
    std::int32_t& place = known.find_or_insert(*block, grid::BlockTable::none);
    if (place == grid::BlockTable::none) {
      Block added{.coordinate = *block, .slots = {}, .points = {}};
      bool meets = false;
      for (int n = 0; n < 27; ++n) {
        const std::int32_t slot = grid.slot_of(
            {{(*block)[0] + n / 9 - 1, (*block)[1] + n / 3 % 3 - 1, (*block)[2] + n % 3 - 1}, block->level});
        const bool own = slot != grid::BlockGrid::no_slot &&
                         static_cast<std::size_t>(slot) < grid.owned_slots() &&
                         grid.contact_number(static_cast<std::size_t>(slot)) != grid::BlockGrid::no_slot;
        added.slots[static_cast<std::size_t>(n)] = own ? slot : grid::BlockGrid::no_slot;
        meets = meets || own;
      }
      place = meets ? static_cast<std::int32_t>(blocks.size()) : nowhere;
      if (meets) blocks.push_back(std::move(added));
    }
    if (place != nowhere)
      blocks[static_cast<std::size_t>(place)].points.push_back(static_cast<std::uint32_t>(p));
  }
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    const grid::BlockCoordinate& c = blocks[b].coordinate;
    colours[static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))].push_back(b);
  }
}

}  // namespace whipple::contact
