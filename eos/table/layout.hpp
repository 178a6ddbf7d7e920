// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/simd.hpp"

namespace whipple::eos {
struct TableData;
}

/// A table as a batch reads it: the strips and their curves in one list, everything of a region in one cache
/// line, indices as numbers that compute in lanes. Nothing here is stored in a file.
namespace whipple::eos::table {

/// Densities over which the curves of a strip are one polynomial.
struct alignas(64) Slab {
  std::array<Lanes, 6> curves;    ///< e_0 and edges 1 to 3 in powers of x - begin
  double begin = 0, end = 0;      ///< ln rho; the last slab has no end
  double top = 0, top_slope = 0;  ///< greatest z, linear over x - begin
  std::uint32_t first_region = 0, region_count = 1;
  std::uint32_t more_curves = 0;  ///< index of edges 4 to 7, where there are more than four regions
};

struct alignas(64) RegionRecord {
  double begin, inverse_length;  ///< of the strip
  double nx, ny, first_cell;
  double fraction_nx, fraction_ny, first_fraction;
};

struct Layout {
  std::vector<Slab> slabs;  ///< in the order of the density, without gaps
  std::vector<std::array<Lanes, 6>> more_curves;
  std::vector<RegionRecord> regions;
  /// The slab that holds the lower end of each of equal bins of ln rho, and the last one once more. The slab
  /// of a point is that of its bin or one of the next.
  std::vector<std::uint32_t> slab_of_bin;
  double begin = 0, end = 0, bins_per_length = 0;  ///< ln rho

  Layout() = default;
  explicit Layout(const TableData& data);
};

}  // namespace whipple::eos::table
