// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// Holds the storage order of elements and nodes: the old index of each.
struct StorageOrder {
  std::vector<std::uint32_t> elements, nodes;
};

/// Returns an order in which neighbours in space are neighbours in memory. Elements connected through opposite faces
/// are stored in rows of up to ElementGroup::size, and nodes in lines, so that each corner of the elements of a row
/// runs over consecutive nodes: the kernels then load them without indirection. The direction of the rows (xi, eta or
/// zeta, one for the whole mesh) is that with most elements in full rows. Nodes without elements are excluded.
/// @param position  m, of the nodes
StorageOrder storage_order(std::span<const Vector3> position, std::span<const Corners> corners);

}  // namespace whipple::fem
