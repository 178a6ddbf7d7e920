// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// In which order elements and nodes are stored: the old index of each.
struct StorageOrder {
  std::vector<std::uint32_t> elements, nodes;
};

/// Neighbours in space become neighbours in memory. Elements that follow one another through opposite faces
/// are stored in rows of up to ElementGroup::size, nodes in lines, so that a corner of the elements of a row
/// runs over consecutive nodes: the kernels then load them without looking up each. The direction of the rows
/// (xi, eta or zeta, one for the whole mesh) is that with most elements in full rows. Nodes of no element are
/// left out.
/// @param position  m, of the nodes
StorageOrder storage_order(std::span<const Vector3> position, std::span<const Corners> corners);

}  // namespace whipple::fem
