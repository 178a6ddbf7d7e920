// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "src/analysis/frame.hpp"
#include "src/core/hdf5/hdf5.hpp"

/// Side views of a run for the page of `whipple report`: the item visible in each pixel, and the values of the fields
/// there. The page chooses the colours.
namespace whipple::analysis {

struct ViewOptions {
  int times = 0;               ///< maximum number, including the first and the last snapshot; 0: no views
  std::size_t columns = 1188;  ///< width of a picture, pixels; fewer if it is more than twice as high
};

/// Chooses the snapshots to be shown, more densely at the beginning, where the shock is. @returns their indices
std::vector<std::size_t> shown_snapshots(const std::vector<SnapshotEntry>& entries, int at_most);

/// Computes the diameters (m) of the spheres that represent material points with given edges. In dispersed debris with
/// a mean distance between points below five edges, the diameter is that mean distance, so that the rows of the initial
/// lattice do not appear as rings; from seven edges on, and in small fragments, it is the edge. In two dimensions the
/// edge of isolated points is limited to the median one.
/// @param edges  edge (m) of the cube or square that the material of each point fills
std::vector<double> drawn_diameters(const std::vector<Vector3>& positions, const std::vector<double>& edges,
                                    bool planar);

/// Draws the views and writes the group `views` (docs/manual/output.md).
void write_views(const Run& run, const Frame& frame, const ViewOptions& options, const hdf5::Group& root);

}  // namespace whipple::analysis
