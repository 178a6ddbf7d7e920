// SPDX-License-Identifier: BSD-3-Clause
// Evaluates a batch of states of a table. Points pass through the stages block by block: four at once where their data
// are contiguous, one by one where each reads a different location. No stage depends on the chain of look-ups of a
// single point.
#include <algorithm>
#include <array>
#include <cmath>

#include "eos/table/four_points.hpp"
#include "eos/table/table.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::eos {
namespace {

constexpr std::size_t block_size = 32;
constexpr double fraction_unit = 1.0 / 65535;

constexpr std::string_view number_bound = "density and specific internal energy must be finite";

using Numbers = std::array<double, block_size>;
using Integers = std::array<std::int32_t, block_size>;

/// Returns the index of the interval, of n equal ones, that contains a position from 0 to n; NaN gives the first.
Lanes piece_of(Lanes position, Lanes n) {
  const Lanes within = minimum(maximum(position, Lanes{}), n - 1.0);
  return whole_part(within);
}

/// Holds the edges of the regions at the density of a point: curve 0 is e_0, the uppermost edge the top of the table.
struct Edges {
  alignas(32) std::array<double, 12> value, slope, half_curvature;
};

class Block {
 public:
  Block(const TableData& data, const table::Layout& layout)
      : data_(data),
        layout_(layout),
        bottom_(std::log(data.thermal_energy)),
        least_squared_(data.least_sound_speed * data.least_sound_speed) {
    for (Edges& e : edges_) e.value = e.slope = e.half_curvature = {};
  }

  /// Evaluates `count` points starting at `first` of their batch, in arrays padded to `padded` numbers.
  void evaluate(const double* density, const double* energy, std::size_t first, std::size_t count,
                std::size_t padded, double* pressure, double* temperature, double* sound_speed,
                RangeReport& report) {
    for (std::size_t i = 0; i < padded; i += 4) find_bins(density, i);
    for (std::size_t i = 0; i < padded; ++i) evaluate_curves(i);
    for (std::size_t i = 0; i < padded; i += 4) find_heights(energy, i, first, count, report);
    for (std::size_t i = 0; i < padded; i += 4) find_cells(i, first, count, report);
    for (std::size_t i = 0; i < padded; ++i) {
      const auto cell = static_cast<std::size_t>(cells_[i]);
      table::along_x(data_.cells.data() + TableData::cell_size * cell, local_x_[i], sums_[i]);
    }
    for (std::size_t i = 0; i < padded; i += 4) {
      const table::Thermal<Lanes> result = table::thermal<Lanes>(load(density + i), slopes(i));
      store(pressure + i, result.pressure);
      store(temperature + i, result.temperature);
      // The floor is the first operand: a NaN in the second operand is preserved.
      store(sound_speed + i, sqrt(maximum(broadcast(least_squared_), result.squared_sound_speed)));
    }
  }

  /// Returns the melted and vaporised fractions of the points evaluated last, in lanes 0 and 1.
  void fractions(std::size_t padded, Lanes* result) const {
    alignas(16) std::array<std::int32_t, 4> corner, row;
    alignas(32) std::array<double, 4> u, v;
    for (std::size_t i = 0; i < padded; i += 4) {
      const auto grid =
          transposed({load(&regions_[i]->fraction_nx), load(&regions_[i + 1]->fraction_nx),
                      load(&regions_[i + 2]->fraction_nx), load(&regions_[i + 3]->fraction_nx)});
      const Lanes nx = grid[0], ny = grid[1], first = grid[2];
      const Lanes x = load(&strip_x_[i]) * nx, y = load(&y_[i]) * ny;
      const Lanes ix = piece_of(x, nx), iy = piece_of(y, ny);
      store(corner.data(), truncated(first + ix * (ny + 1.0) + iy));
      store(row.data(), truncated(ny + 1.0));
      store(u.data(), x - ix);
      store(v.data(), minimum(maximum(y - iy, Lanes{}), broadcast(1.0)));
      for (std::size_t j = 0; j < 4; ++j) {
        // Both fractions of two neighbours along y are contiguous.
        const auto pair = [&](std::int32_t at) {
          return load_short(&data_.fractions[static_cast<std::size_t>(at)][0]);
        };
        const Lanes lower = pair(corner[j]), upper = pair(corner[j] + row[j]);
        const Lanes mixed = lower + u[j] * (upper - lower);
        const Lanes next = __builtin_shufflevector(mixed, mixed, 2, 3, 0, 0);
        result[i + j] = (mixed + v[j] * (next - mixed)) * fraction_unit;
      }
    }
  }

 private:
  void find_bins(const double* density, std::size_t i) {
    const Lanes x = natural_log(load(density + i));
    const Lanes inside = minimum(maximum(x, broadcast(layout_.begin)), broadcast(layout_.end));
    store(&x_[i], x);
    store(&inside_[i], inside);  // the lower end for NaN
    store(&bins_[i], truncated((inside - layout_.begin) * layout_.bins_per_length));
  }

  void evaluate_curves(std::size_t i) {
    const double x = inside_[i];
    const table::Slab* slab = &layout_.slabs[layout_.slab_of_bin[static_cast<std::size_t>(bins_[i])]];
    while (x >= slab->end) ++slab;
    slabs_[i] = slab;
    Edges& edges = edges_[i];
    const double t = x - slab->begin;
    const auto add = [&](const std::array<Lanes, 6>& curves, std::size_t first) {
      Lanes value, slope, half_curvature;
      table::horner([&](std::size_t j) { return curves[j]; }, broadcast(t), value, slope, half_curvature);
      store(&edges.value[first], value);
      store(&edges.slope[first], slope);
      store(&edges.half_curvature[first], half_curvature);
    };
    add(slab->curves, 0);
    if (slab->region_count > 4) add(layout_.more_curves[slab->more_curves], 4);
    edges.value[slab->region_count] = slab->top + slab->top_slope * t;
    edges.slope[slab->region_count] = slab->top_slope;
    edges.half_curvature[slab->region_count] = 0;
  }

  /// Gathers one number of the four points starting at i.
  template <class Number>
  Lanes gathered(std::size_t i, Number&& number) const {
    return Lanes{number(i), number(i + 1), number(i + 2), number(i + 3)};
  }

  void find_heights(const double* energy, std::size_t i, std::size_t first, std::size_t count,
                    RangeReport& report) {
    const double coldest = data_.thermal_energy;
    Lanes thermal = load(energy + i) - gathered(i, [&](std::size_t j) { return edges_[j].value[0]; });
    // One test for the usual points, which fails for NaN.
    if (bits((load(&x_[i]) == load(&inside_[i])) & (thermal >= coldest)) != all_lanes) {
      for (std::size_t j = i; j < i + 4; ++j) {
        const double e = thermal[j - i];
        const bool bad = !std::isfinite(x_[j]) || !std::isfinite(e), outside = bad || x_[j] != inside_[j];
        if (j < count && outside) broken(report, first + j, bad ? number_bound : table::density_bound);
        if (j < count && !outside && e < coldest) ++report.below_cold_curve;
        thermal[j - i] = outside ? State::unknown : std::max(e, coldest);
      }
    }
    store(&z_[i], natural_log(thermal));
    store(&inverse_thermal_[i], 1.0 / thermal);
  }

  /// Returns the number of the region of a point, counted from the bottom.
  std::size_t region_of(std::size_t i, std::size_t first, std::size_t count, RangeReport& report) {
    const Edges& edges = edges_[i];
    const std::uint32_t n = slabs_[i]->region_count;
    const Lanes z = broadcast(z_[i]);
    const auto above = [&](std::size_t edge) { return bits(z > load(&edges.value[edge])); };
    unsigned passed = above(1);
    if (n > 4) passed |= above(5) << 4;
    const auto k = static_cast<std::size_t>(__builtin_popcount(passed & ((1u << n) - 1)));
    if (k < n) return k;
    if (i < count) broken(report, first + i, table::energy_bound);
    inverse_thermal_[i] = State::unknown;  // propagates to all results
    z_[i] = edges.value[n];
    return n - 1;
  }

  void find_cells(std::size_t i, std::size_t first, std::size_t count, RangeReport& report) {
    std::array<std::size_t, 4> k;
    for (std::size_t j = 0; j < 4; ++j) {
      k[j] = region_of(i + j, first, count, report);
      regions_[i + j] = &layout_.regions[slabs_[i + j]->first_region + k[j]];
    }
    const auto edge = [&](auto quantity, std::size_t upper) {
      return gathered(i, [&](std::size_t j) { return (edges_[j].*quantity)[k[j - i] + upper]; });
    };
    // The lowest edge is the bottom; e_0 is stored in its place.
    const LanesMask lowest = gathered(0, [&](std::size_t j) { return static_cast<double>(k[j]); }) == 0.0;
    const Lanes low = select(lowest, broadcast(bottom_), edge(&Edges::value, 0));
    const Lanes slope = select(lowest, Lanes{}, edge(&Edges::slope, 0));
    const Lanes half = select(lowest, Lanes{}, edge(&Edges::half_curvature, 0));
    const Lanes inverse = 1.0 / maximum(edge(&Edges::value, 1) - low, broadcast(table::least_width));
    const Lanes y = (load(&z_[i]) - low) * inverse;
    store(&y_[i], y);
    store(&inverse_width_[i], inverse);
    store(&low_slope_[i], slope);
    store(&low_curvature_[i], 2.0 * half);
    store(&width_slope_[i], edge(&Edges::slope, 1) - slope);
    store(&width_curvature_[i], 2.0 * (edge(&Edges::half_curvature, 1) - half));

    const auto strip = transposed({load(&regions_[i]->begin), load(&regions_[i + 1]->begin),
                                   load(&regions_[i + 2]->begin), load(&regions_[i + 3]->begin)});
    const Lanes inverse_length = strip[1], nx = strip[2], ny = strip[3];
    const Lanes strip_x = (load(&inside_[i]) - strip[0]) * inverse_length;
    const Lanes px = strip_x * nx, py = y * ny;
    const Lanes ix = piece_of(px, nx), iy = piece_of(py, ny);
    store(&strip_x_[i], strip_x);
    store(&local_x_[i], px - ix);
    store(&local_y_[i], py - iy);
    store(&cells_per_x_[i], nx * inverse_length);
    store(&cells_per_y_[i], ny);
    const Lanes first_cell = gathered(i, [&](std::size_t j) { return regions_[j]->first_cell; });
    store(&cells_[i], truncated(first_cell + ix * ny + iy));
  }

  /// Returns the derivatives of the entropy with respect to ln rho and e.
  [[nodiscard]] table::Slopes<Lanes> slopes(std::size_t i) const {
    const table::Polynomial<Lanes> s = table::along_y(&sums_[i], load(&local_y_[i]));
    const Lanes by_x = load(&cells_per_x_[i]), by_y = load(&cells_per_y_[i]);
    const Lanes base_slope = gathered(i, [&](std::size_t j) { return edges_[j].slope[0]; });
    const Lanes base_half = gathered(i, [&](std::size_t j) { return edges_[j].half_curvature[0]; });
    return table::slopes<Lanes>(
        {s.x * by_x, s.y * by_y, s.xx * by_x * by_x, s.xy * by_x * by_y, s.yy * by_y * by_y},
        {load(&y_[i]), load(&inverse_width_[i]), load(&inverse_thermal_[i]), base_slope, 2.0 * base_half,
         load(&low_slope_[i]), load(&low_curvature_[i]), load(&width_slope_[i]), load(&width_curvature_[i])});
  }

  static void broken(RangeReport& report, std::size_t point, std::string_view bound) {
    if (report.out_of_range++ > 0) return;
    report.first = point;
    report.bound = bound;
  }

  const TableData& data_;
  const table::Layout& layout_;
  double bottom_, least_squared_;
  alignas(32) Numbers x_, inside_, z_, y_, inverse_thermal_, inverse_width_, low_slope_, low_curvature_,
      width_slope_, width_curvature_, strip_x_, local_x_, local_y_, cells_per_x_, cells_per_y_;
  alignas(32) Integers bins_, cells_;
  std::array<const table::Slab*, block_size> slabs_;
  std::array<const table::RegionRecord*, block_size> regions_;
  std::array<Edges, block_size> edges_;
  std::array<table::AlongX, block_size> sums_;
};

}  // namespace

RangeReport Table::evaluate(const Batch& batch) const {
  RangeReport report;
  Block block(data_, layout_);
  const bool with_fractions = !batch.melted_fraction.empty() || !batch.vaporised_fraction.empty();
  std::array<Lanes, block_size> fractions;
  Numbers density, energy, pressure, temperature, sound_speed;  // for a last block that is not full
  for (std::size_t first = 0; first < batch.density.size(); first += block_size) {
    const std::size_t count = std::min(block_size, batch.density.size() - first);
    const std::size_t padded = (count + 3) / 4 * 4;
    const double *from_density = &batch.density[first], *from_energy = &batch.specific_internal_energy[first];
    double *p = &batch.pressure[first], *T = &batch.temperature[first], *c = &batch.sound_speed[first];
    if (count == padded) {
      block.evaluate(from_density, from_energy, first, count, padded, p, T, c, report);
    } else {
      for (std::size_t i = 0; i < padded; ++i) {
        density[i] = from_density[std::min(i, count - 1)];
        energy[i] = from_energy[std::min(i, count - 1)];
      }
      block.evaluate(density.data(), energy.data(), first, count, padded, pressure.data(), temperature.data(),
                     sound_speed.data(), report);
      std::copy_n(pressure.begin(), count, p);
      std::copy_n(temperature.begin(), count, T);
      std::copy_n(sound_speed.begin(), count, c);
    }
    if (!with_fractions) continue;
    block.fractions(padded, fractions.data());
    for (std::size_t i = 0; i < count; ++i) {
      const bool known = !std::isnan(T[i]);
      if (!batch.melted_fraction.empty())
        batch.melted_fraction[first + i] = known ? fractions[i][0] : State::unknown;
      if (!batch.vaporised_fraction.empty())
        batch.vaporised_fraction[first + i] = known ? fractions[i][1] : State::unknown;
    }
  }
  return report;
}

}  // namespace whipple::eos
