// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "src/analysis/frame.hpp"
#include "src/core/hdf5/hdf5.hpp"

/// Side views of a run for the page of `whipple report`: what is seen in each pixel, and the values of the fields there.
/// Colours are given by the page.
namespace whipple::analysis {

struct ViewOptions {
  int times = 0;               ///< at most so many, the first and the last snapshot among them; 0: no views
  std::size_t columns = 1188;  ///< width of a picture, pixels
};

/// Chooses snapshots to be shown, closer together at the beginning, where the shock is. @returns their numbers
std::vector<std::size_t> shown_snapshots(const std::vector<SnapshotEntry>& entries, int at_most);

/// Computes the diameter (m) of the spheres that stand for points of material of given edges. In debris that has spread,
/// but whose points are nearer to one another than five edges in the mean, it is their mean distance, so that the
/// rows of the lattice on which they began do not show as rings; from seven edges on, and in small fragments, it is the
/// edge, of what is alone in a plane at most the median one.
/// @param edges  edge (m) of the cube, or square, of each point's material
std::vector<double> drawn_diameters(const std::vector<Vector3>& positions, const std::vector<double>& edges,
                                    bool planar);

/// Draws the views and writes the group `views` (docs/manual/output.md).
void write_views(const Run& run, const Frame& frame, const ViewOptions& options, const hdf5::Group& root);

}  // namespace whipple::analysis
