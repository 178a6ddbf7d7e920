// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/layout.hpp"

#include <algorithm>
#include <limits>

#include "eos/table/table.hpp"

namespace whipple::eos::table {
namespace {

/// Limits of the number of bins. Bins are shorter than the shortest slab, so that a point examines two slabs.
constexpr std::size_t least_bins = 256, greatest_bins = 16384;

/// Converts coefficients of t to those of t/length.
std::array<Lanes, 6> scaled(const TableData::Interval& interval, double length) {
  std::array<Lanes, 6> result;
  double scale = 1;
  for (std::size_t j = 0; j < 6; ++j, scale /= length) result[j] = interval[j] * scale;
  return result;
}

}  // namespace

Layout::Layout(const TableData& data) : begin(data.strips.front().begin), end(data.strips.back().end) {
  double shortest = end - begin;
  for (const TableData::Strip& strip : data.strips) {
    const auto first_region = static_cast<std::uint32_t>(regions.size());
    for (std::size_t k = 0; k < strip.region_count; ++k) {
      const TableData::Region& r = strip.regions[k];
      regions.push_back({.begin = strip.begin,
                         .inverse_length = strip.inverse_length,
                         .nx = static_cast<double>(r.nx),
                         .ny = static_cast<double>(r.ny),
                         .first_cell = static_cast<double>(r.first_cell),
                         .fraction_nx = static_cast<double>(r.fraction_nx),
                         .fraction_ny = static_cast<double>(r.fraction_ny),
                         .first_fraction = static_cast<double>(r.first_fraction)});
    }
    const double length = (strip.end - strip.begin) / strip.intervals;
    shortest = std::min(shortest, length);
    for (std::uint32_t i = 0; i < strip.intervals; ++i) {
      const TableData::Interval* blocks = &data.intervals[strip.first_interval + i * strip.blocks()];
      Slab& slab = slabs.emplace_back();
      slab.curves = scaled(blocks[0], length);
      slab.begin = strip.begin + i * length;
      slab.end = i + 1 < strip.intervals ? strip.begin + (i + 1) * length : strip.end;
      slab.top = strip.top + strip.top_slope * (slab.begin - strip.begin);
      slab.top_slope = strip.top_slope;
      slab.first_region = first_region;
      slab.region_count = strip.region_count;
      if (strip.blocks() > 1) {
        slab.more_curves = static_cast<std::uint32_t>(more_curves.size());
        more_curves.push_back(scaled(blocks[1], length));
      }
    }
  }
  slabs.back().end = std::numeric_limits<double>::infinity();
  std::size_t bins = least_bins;
  while ((end - begin) / static_cast<double>(bins) > 0.9 * shortest && bins < greatest_bins) bins *= 2;
  bins_per_length = static_cast<double>(bins) / (end - begin);
  for (std::size_t bin = 0, s = 0; bin <= bins; ++bin) {
    // Slightly less than the lower end of the bin, which may be rounded.
    const double lower = begin + (static_cast<double>(bin) - 1e-6) / bins_per_length;
    while (slabs[s].end <= lower) ++s;
    slab_of_bin.push_back(static_cast<std::uint32_t>(s));
  }
}

}  // namespace whipple::eos::table
