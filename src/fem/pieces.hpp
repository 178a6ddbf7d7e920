// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/fem/distribution.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// Holds the connected pieces of a mesh over all ranks: elements with a common node belong to one piece.
struct Pieces {
  std::vector<std::uint32_t> of_node;  ///< number of the piece of each node of this rank
  std::size_t count = 0;               ///< of all ranks
};

/// Finds the pieces of meshes. Pieces are numbered by their numbers of elements, most first, then by their lowest
/// element ids: on any number of ranks alike. Collective.
/// @param wanted  whether to search each mesh; the others have no pieces
std::vector<Pieces> find_pieces(std::span<const Mesh> meshes, std::span<const std::uint8_t> wanted,
                                const SharedNodes& shared, MPI_Comm communicator);

}  // namespace whipple::fem
