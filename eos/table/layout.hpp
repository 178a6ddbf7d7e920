// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/base/registers.hpp"

namespace whipple::eos {
struct TableData;
}

/// Lays out a table for batch evaluation: the strips and their curves in one list, all data of a region in one
/// cache line, indices as floating-point numbers for use in lanes. This layout is not stored in files.
namespace whipple::eos::table {

/// Holds the curves of a strip over densities for which they are one polynomial.
struct alignas(64) Slab {
  std::array<Lanes, 6> curves;    ///< e_0 and edges 1 to 3 in powers of x - begin
  double begin = 0, end = 0;      ///< ln rho; the last slab has no end
  double top = 0, top_slope = 0;  ///< maximum z, linear over x - begin
  std::uint32_t first_region = 0, region_count = 1;
  std::uint32_t more_curves = 0;  ///< index of edges 4 to 7, if there are more than four regions
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
  /// Index of the slab that contains the lower end of each of equal bins of ln rho, with the last one repeated. The
  /// slab of a point is that of its bin or one of the next.
  std::vector<std::uint32_t> slab_of_bin;
  double begin = 0, end = 0, bins_per_length = 0;  ///< ln rho

  Layout() = default;
  explicit Layout(const TableData& data);
};

}  // namespace whipple::eos::table
