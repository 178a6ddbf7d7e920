// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/fem/distribution.hpp"
#include "src/grid/block_grid.hpp"

/// Distribution of elements over the ranks: they are on the rank that owns the block of their centre, with copies of
/// the nodes that several ranks share (docs/theory/fem.md, section 10).
namespace whipple::solver {

/// Rank that holds all bars in files, as they are few.
constexpr int rank_of_bars_in_files = 0;

/// Returns the nodes of every element.
inline const std::vector<fem::Corners>& nodes_of_elements(const fem::Mesh& mesh) {
  return mesh.elements.corners;
}
inline const std::vector<std::array<std::uint32_t, 2>>& nodes_of_elements(const fem::Bars& bars) {
  return bars.elements.ends;
}

/// Computes the centres (m) of the elements of all bodies; centres outside of the domain are moved into it.
template <class Body>
std::vector<Vector3> centres_of(const std::vector<Body>& bodies, const grid::Geometry& geometry) {
  const Vector3 upper(geometry.upper(0), geometry.upper(1), geometry.upper(2));
  std::vector<Vector3> centres;
  for (const Body& body : bodies) {
    for (const auto& nodes : nodes_of_elements(body)) {
      Vector3 centre = Vector3::Zero();
      for (const std::uint32_t a : nodes)
        centre += body.nodes.position[a] / static_cast<double>(nodes.size());
      centres.push_back(centre.cwiseMax(geometry.lower).cwiseMin(upper));
    }
  }
  return centres;
}

/// Sends elements to the ranks that own the blocks of their centres if enough of them are on other ranks. Collective.
/// @returns whether elements were sent
template <class Body>
bool share_out(std::vector<Body>& bodies, const grid::BlockGrid& grid, MPI_Comm communicator) {
  // Fraction of a rank's elements with another owner above which elements are sent
  constexpr double astray = 0.05;
  const std::vector<int> owners = grid.owners(centres_of(bodies, grid.geometry()));
  const auto elsewhere = static_cast<double>(
      owners.size() - static_cast<std::size_t>(std::ranges::count(owners, parallel::rank(communicator))));
  if (!parallel::any(communicator, elsewhere > astray * static_cast<double>(owners.size()))) return false;
  std::size_t first = 0;
  for (Body& body : bodies) {
    const std::size_t count = body.elements.size();
    fem::migrate(body, std::span(owners).subspan(first, count), communicator);
    first += count;
  }
  return true;
}

}  // namespace whipple::solver
