// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/facets.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <iterator>

#include "src/core/parallel/threads.hpp"

namespace whipple::fem {
namespace {

/// Lists the corners of the six faces, counter-clockwise about the outward normal.
constexpr std::array<std::array<std::size_t, 4>, 6> corners_of_face = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Facet face(const Corners& corners, std::size_t number) {
  Facet facet;
  for (std::size_t i = 0; i < 4; ++i) facet[i] = corners[corners_of_face[number][i]];
  return facet;
}

/// Returns whether another element shares a face; three common nodes imply a common face.
bool is_shared(const Mesh& mesh, std::size_t element, const Facet& facet) {
  return std::ranges::any_of(mesh.corners_at(facet[0]), [&](std::uint32_t corner) {
    const std::size_t other = corner / 8;
    const auto has = [&](std::uint32_t node) {
      return std::ranges::find(mesh.elements.corners[other], node) != mesh.elements.corners[other].end();
    };
    return other != element && has(facet[1]) && has(facet[2]);
  });
}

/// Describes a face of an element by its sorted nodes, and the side of it on which the element is.
struct Side {
  Facet nodes;
  bool turned;
  std::uint32_t element;
  auto operator<=>(const Side&) const = default;
};

Side side_of(const Corners& corners, std::size_t number, std::uint32_t element) {
  Facet round = face(corners, number);
  std::ranges::rotate(round, std::ranges::min_element(round));
  const bool turned = round[1] > round[3];
  std::ranges::sort(round);
  return {round, turned, element};
}

}  // namespace

std::optional<Overlap> first_overlap(const Hexahedra& hexahedra) {
  std::vector<Side> sides;
  sides.reserve(6 * hexahedra.elements.size());
  for (std::uint32_t e = 0; e < hexahedra.elements.size(); ++e) {
    for (std::size_t f = 0; f < 6; ++f) sides.push_back(side_of(hexahedra.elements[e], f, e));
  }
  std::ranges::sort(sides);
  const auto twins = std::ranges::adjacent_find(
      sides, [](const Side& a, const Side& b) { return a.nodes == b.nodes && a.turned == b.turned; });
  if (twins == sides.end()) return std::nullopt;
  const Side& first = *twins;
  const Side& second = *std::next(twins);
  const auto sorted = [&](const Side& side) {
    Corners corners = hexahedra.elements[side.element];
    std::ranges::sort(corners);
    return corners;
  };
  return Overlap{second.element, first.element, sorted(first) == sorted(second)};
}

std::vector<Facet> surface_facets(const Mesh& mesh, std::span<const std::uint8_t> marked) {
  const auto all_marked = [&](const auto& nodes) {
    return marked.empty() || std::ranges::all_of(nodes, [&](std::uint32_t a) { return marked[a] != 0; });
  };
  std::vector<std::uint8_t> free(mesh.elements.size(), 0);          // one bit per face of each element
  const std::size_t first_face = is_flat(mesh.quadrature) ? 2 : 0;  // none across the plane
  parallel::for_each(free.size(), [&](std::size_t e) {
    const Corners& corners = mesh.elements.corners[e];
    for (std::size_t f = first_face; f < 6; ++f) {
      const Facet facet = face(corners, f);
      if (all_marked(facet) && !is_shared(mesh, e, facet)) {
        free[e] = static_cast<std::uint8_t>(free[e] | 1U << f);
      }
    }
  });
  std::vector<Facet> facets;
  for (std::size_t e = 0; e < free.size(); ++e) {
    for (std::size_t f = 0; f < 6; ++f) {
      if ((free[e] >> f & 1U) != 0) facets.push_back(face(mesh.elements.corners[e], f));
    }
  }
  return facets;
}

}  // namespace whipple::fem
