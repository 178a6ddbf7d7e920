// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/root.hpp"
#include "eos/table/kernel.hpp"
#include "src/base/error.hpp"
#include "src/base/vector_math.hpp"

namespace whipple::eos {
namespace {

using Strip = TableData::Strip;
using Region = TableData::Region;

/// Points that pass through the stages of an evaluation together.
constexpr std::size_t block_size = 32;
constexpr std::size_t least_bins = 256;
constexpr double fraction_unit = 1.0 / 65535;

constexpr std::string_view density_bound = "density outside the table";
constexpr std::string_view energy_bound = "specific internal energy above the table";
constexpr std::string_view number_bound = "density and specific internal energy must be finite";

/// Region of a strip that holds z: edges that the strip does not have lie at infinity.
std::size_t region_of(const Lanes& edges, double z) {
  const int above = _mm256_movemask_pd(_mm256_cmp_pd(_mm256_set1_pd(z), __m256d(edges), _CMP_GT_OQ));
  return static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(above) & 0xeU));
}

/// Melted and vaporised fraction.
struct Fractions {
  double melted, vaporised;
};

Fractions fractions(const TableData& data, const Region& region, double tx, double ty) {
  const table::Piece x = table::piece(tx, region.fraction_nx), y = table::piece(ty, region.fraction_ny);
  const auto* row = &data.fractions[region.first_fraction + x.index * (region.fraction_ny + 1) + y.index];
  const auto* next = row + region.fraction_ny + 1;
  const double u = x.local, v = std::min(std::max(y.local, 0.0), 1.0);
  const auto mix = [&](std::size_t i) {
    const double lower = row[0][i] + v * (row[1][i] - row[0][i]);
    const double upper = next[0][i] + v * (next[1][i] - next[0][i]);
    return (lower + u * (upper - lower)) * fraction_unit;
  };
  return {mix(0), mix(1)};
}

}  // namespace

std::size_t TableData::size() const {
  return strips.size() * sizeof(Strip) + intervals.size() * sizeof(Interval) + cells.size() * sizeof(double) +
         fractions.size() * sizeof(fractions[0]);
}

Table::Table(TableData data) : data_(std::move(data)) {
  const auto refuse = [](const char* what) {
    throw InputError(fmt::format("table of an equation of state: {}", what));
  };
  if (data_.strips.empty()) refuse("has no strips");
  if (!(data_.thermal_energy > 0) || !(data_.least_sound_speed > 0) || !(data_.least_temperature > 0)) {
    refuse("least thermal energy, sound speed and temperature must be positive");
  }
  for (std::size_t i = 0; i < data_.strips.size(); ++i) {
    const Strip& s = data_.strips[i];
    if (!(s.begin < s.end) || (i > 0 && s.begin != data_.strips[i - 1].end)) refuse("its strips have gaps");
    if (s.intervals == 0 || s.first_interval + std::size_t{s.intervals} > data_.intervals.size())
      refuse("a strip names curves that are not there");
    if (s.region_count == 0 || s.region_count > TableData::greatest_regions)
      refuse("a strip has no regions, or too many");
    for (std::size_t k = 0; k < s.region_count; ++k) {
      const Region& r = s.regions[k];
      if (r.nx == 0 || r.ny == 0 ||
          (r.first_cell + std::size_t{r.nx} * r.ny) * TableData::cell_size > data_.cells.size())
        refuse("a region names cells that are not there");
      if (r.fraction_nx == 0 || r.fraction_ny == 0 ||
          r.first_fraction + (std::size_t{r.fraction_nx} + 1) * (r.fraction_ny + 1) > data_.fractions.size())
        refuse("a region names phase fractions that are not there");
      if (r.phase >= data_.phases.size()) refuse("a region names a phase that is not there");
    }
  }
  begin_ = data_.strips.front().begin;
  end_ = data_.strips.back().end;
  // Bins so narrow that each holds the ends of at most two strips.
  double shortest = end_ - begin_;
  for (Strip& s : data_.strips) {
    s.inverse_length = 1 / (s.end - s.begin);
    shortest = std::min(shortest, s.end - s.begin);
  }
  std::size_t bins = least_bins;
  while ((end_ - begin_) / static_cast<double>(bins) > 0.9 * shortest) bins *= 2;
  bins_per_length_ = static_cast<double>(bins) / (end_ - begin_);
  for (std::size_t bin = 0, s = 0; bin < bins; ++bin) {
    // A little less than the lower end of the bin: it may be rounded.
    const double lower = begin_ + (static_cast<double>(bin) - 1e-6) / bins_per_length_;
    while (s + 1 < data_.strips.size() && data_.strips[s].end <= lower) ++s;
    strip_of_bin_.push_back(static_cast<std::uint32_t>(s));
  }
}

double Table::minimum_density() const { return std::exp(begin_); }
double Table::maximum_density() const { return std::exp(end_) * (1 - 1e-14); }

inline const Strip& Table::strip(double x) const {
  const double last_bin = static_cast<double>(strip_of_bin_.size() - 1);
  const auto bin =
      static_cast<std::int32_t>(std::min(std::max(0.0, (x - begin_) * bins_per_length_), last_bin));
  const Strip* s = &data_.strips[strip_of_bin_[static_cast<std::size_t>(bin)]];
  const Strip* last = &data_.strips.back();
  s += static_cast<int>(x >= s->end) & static_cast<int>(s < last);
  s += static_cast<int>(x >= s->end) & static_cast<int>(s < last);
  return *s;
}

double Table::base_energy(double density) const {
  const double x = std::log(density);
  if (!(x >= begin_ && x <= end_)) {
    throw StateError(fmt::format("table of {}: {} ({:.6g} kg/m^3; {:.6g} to {:.6g} kg/m^3)", data_.origin,
                                 density_bound, density, minimum_density(), maximum_density()));
  }
  const Strip& s = strip(x);
  return table::curves(data_, s, (x - s.begin) * s.inverse_length).value[0];
}

double Table::minimum_energy(double density) const { return base_energy(density) + data_.thermal_energy; }

double Table::maximum_energy(double density) const {
  const double base = base_energy(density), x = std::log(density);
  const Strip& s = strip(x);
  return base + std::exp(s.top + s.top_slope * (x - s.begin));
}

std::string Table::constants() const {
  std::string text =
      fmt::format("# table of model {}, requested error {:.2g}:\n", data_.origin, data_.requested_error);
  for (std::size_t at = 0; at < data_.constants.size();) {
    const std::size_t end = std::min(data_.constants.find('\n', at), data_.constants.size());
    text += fmt::format("# {}\n", data_.constants.substr(at, end - at));
    at = end + 1;
  }
  return text;
}

RangeReport Table::evaluate(const Batch& batch) const {
  using Numbers = std::array<double, block_size>;
  RangeReport report;
  const auto broken = [&](std::size_t point, std::string_view bound) {
    if (report.out_of_range++ == 0) {
      report.first = point;
      report.bound = bound;
    }
  };
  const std::size_t n = batch.density.size();
  const bool with_fractions = !batch.melted_fraction.empty() || !batch.vaporised_fraction.empty();
  const double bottom = std::log(data_.thermal_energy), coldest = data_.thermal_energy;
  const Lanes least_squared = broadcast(data_.least_sound_speed * data_.least_sound_speed);
  std::array<const Strip*, block_size> strips;
  std::array<const Region*, block_size> regions;
  std::array<table::Curves, block_size> base;
  alignas(32) Numbers rho, x, inside, tx, thermal, z, y, low, width, inverse_width, inverse_thermal;
  alignas(32) Numbers e1, e2, l1, l2, w1, w2, nx, ny, local_x, local_y, inverse_length, p, T, c;
  alignas(32) std::array<std::int32_t, block_size> rows, cells;
  std::array<table::AlongX, block_size> sums;
  const double* all_cells = data_.cells.data();

  for (std::size_t first = 0; first < n; first += block_size) {
    const std::size_t count = std::min(block_size, n - first), padded = (count + 3) / 4 * 4;
    for (std::size_t i = 0; i < padded; ++i) rho[i] = batch.density[first + std::min(i, count - 1)];
    for (std::size_t i = 0; i < padded; i += 4) store(&x[i], natural_log(load(&rho[i])));

    for (std::size_t i = 0; i < padded; ++i) {
      inside[i] = std::min(std::max(begin_, x[i]), end_);  // begin_ for NaN
      strips[i] = &strip(inside[i]);
      inverse_length[i] = strips[i]->inverse_length;
      tx[i] = (inside[i] - strips[i]->begin) * inverse_length[i];
    }
    for (std::size_t i = 0; i < padded; ++i) base[i] = table::curves(data_, *strips[i], tx[i]);
    for (std::size_t i = 0; i < padded; ++i) {
      double e = batch.specific_internal_energy[first + std::min(i, count - 1)] - base[i].value[0];
      // One test for the usual point; NaN fails it.
      if (!(x[i] >= begin_ && x[i] <= end_ && e >= coldest)) {
        const bool bad = !std::isfinite(x[i]) || !std::isfinite(e), outside = bad || x[i] != inside[i];
        if (i < count && outside) broken(first + i, bad ? number_bound : density_bound);
        if (i < count && !outside) ++report.below_cold_curve;
        e = outside ? State::unknown : coldest;
      }
      thermal[i] = e;
    }
    for (std::size_t i = 0; i < padded; i += 4) {
      store(&z[i], natural_log(load(&thermal[i])));
      store(&inverse_thermal[i], 1.0 / load(&thermal[i]));
    }
    for (std::size_t i = 0; i < padded; ++i) {
      const Strip& s = *strips[i];
      table::Curves& edge = base[i];
      const std::size_t k = region_of(edge.value, z[i]);
      e1[i] = edge.slope[0];
      e2[i] = edge.curvature[0];
      // The lowest edge is the bottom, the uppermost the top; as in table::edges, without its stores.
      edge.value[0] = bottom;
      edge.slope[0] = edge.curvature[0] = 0;
      const bool uppermost = k + 1 == s.region_count;
      const std::size_t above = uppermost ? k : k + 1;
      const double top = s.top + s.top_slope * (inside[i] - s.begin);
      const double high = uppermost ? top : edge.value[above];
      const double high_slope = uppermost ? s.top_slope : edge.slope[above];
      const double high_curvature = uppermost ? 0.0 : edge.curvature[above];
      if (uppermost && z[i] > top) {
        if (i < count) broken(first + i, energy_bound);
        inverse_thermal[i] = State::unknown;  // spreads to all results
        z[i] = top;
      }
      const Region& region = s.regions[k];
      regions[i] = &region;
      nx[i] = region.nx;
      ny[i] = region.ny;
      rows[i] = static_cast<std::int32_t>(region.ny);
      cells[i] = static_cast<std::int32_t>(region.first_cell);
      low[i] = edge.value[k];
      width[i] = high - edge.value[k];
      l1[i] = edge.slope[k];
      l2[i] = edge.curvature[k];
      w1[i] = high_slope - edge.slope[k];
      w2[i] = high_curvature - edge.curvature[k];
    }
    for (std::size_t i = 0; i < padded; i += 4) {
      const Lanes inverse = 1.0 / maximum(load(&width[i]), broadcast(table::least_width));
      store(&inverse_width[i], inverse);
      const Lanes height = (load(&z[i]) - load(&low[i])) * inverse;
      store(&y[i], height);
      const table::Pieces px = table::pieces(load(&tx[i]), load(&nx[i])),
                          py = table::pieces(height, load(&ny[i]));
      store(&local_x[i], px.local);
      store(&local_y[i], py.local);
      const auto integers = [&](auto& values) { return reinterpret_cast<__m128i*>(&values[i]); };
      const __m128i row = _mm_mullo_epi32(px.index, _mm_load_si128(integers(rows)));
      _mm_store_si128(integers(cells),
                      _mm_add_epi32(_mm_load_si128(integers(cells)), _mm_add_epi32(row, py.index)));
    }
    for (std::size_t i = 0; i < padded; ++i)
      table::along_x(all_cells + TableData::cell_size * static_cast<std::size_t>(cells[i]), local_x[i],
                     sums[i]);
    for (std::size_t i = 0; i < padded; i += 4) {
      const table::Polynomial<Lanes> s = table::along_y(&sums[i], load(&local_y[i]));
      const Lanes by_x = load(&nx[i]) * load(&inverse_length[i]), by_y = load(&ny[i]);
      const auto slopes = table::slopes<Lanes>(
          {s.x * by_x, s.y * by_y, s.xx * by_x * by_x, s.xy * by_x * by_y, s.yy * by_y * by_y},
          {load(&y[i]), load(&inverse_width[i]), load(&inverse_thermal[i]), load(&e1[i]), load(&e2[i]),
           load(&l1[i]), load(&l2[i]), load(&w1[i]), load(&w2[i])});
      const auto result = table::thermal<Lanes>(load(&rho[i]), slopes);
      store(&p[i], result.pressure);
      store(&T[i], result.temperature);
      // The floor comes first: a NaN in the second operand stays.
      store(&c[i], sqrt(maximum(least_squared, result.squared_sound_speed)));
    }
    const auto at = static_cast<std::ptrdiff_t>(first);
    std::copy_n(p.begin(), count, batch.pressure.begin() + at);
    std::copy_n(T.begin(), count, batch.temperature.begin() + at);
    std::copy_n(c.begin(), count, batch.sound_speed.begin() + at);
    if (!with_fractions) continue;
    for (std::size_t i = 0; i < count; ++i) {
      const Fractions f = std::isnan(T[i]) ? Fractions{State::unknown, State::unknown}
                                           : fractions(data_, *regions[i], tx[i], y[i]);
      if (!batch.melted_fraction.empty()) batch.melted_fraction[first + i] = f.melted;
      if (!batch.vaporised_fraction.empty()) batch.vaporised_fraction[first + i] = f.vaporised;
    }
  }
  return report;
}

State Table::state(double density, double e) const {
  const double base_value = base_energy(density), x = std::log(density);
  const Strip& s = strip(x);
  const double tx = (x - s.begin) * s.inverse_length;
  const table::Curves base = table::curves(data_, s, tx);
  const double top = maximum_energy(density);
  if (!(e <= top)) {
    throw StateError(fmt::format("table of {}: {} ({:.6g} J/kg at {:.6g} kg/m^3; at most {:.6g} J/kg)",
                                 data_.origin, energy_bound, e, density, top));
  }
  const double thermal = std::max(e - base_value, data_.thermal_energy);
  table::Edges edges;
  table::edges(s, x, std::log(data_.thermal_energy), base, edges);
  const double z = std::log(thermal);
  const std::size_t k = region_of(base.value, z);
  const Region& region = s.regions[k];
  const double inverse_width = 1 / std::max(edges.value[k + 1] - edges.value[k], table::least_width);
  const double y = (z - edges.value[k]) * inverse_width;
  const table::Piece cx = table::piece(tx, region.nx), cy = table::piece(y, region.ny);
  const double* coefficients =
      data_.cells.data() + TableData::cell_size * (region.first_cell + cx.index * region.ny + cy.index);
  const table::Polynomial<double> S = table::polynomial(coefficients, cx.local, cy.local);
  const double by_x = region.nx * s.inverse_length, by_y = region.ny;
  const auto d = table::slopes<double>(
      {S.x * by_x, S.y * by_y, S.xx * by_x * by_x, S.xy * by_x * by_y, S.yy * by_y * by_y},
      {y, inverse_width, 1 / thermal, base.slope[0], base.curvature[0], edges.slope[k], edges.curvature[k],
       edges.slope[k + 1] - edges.slope[k], edges.curvature[k + 1] - edges.curvature[k]});
  const auto r = table::thermal<double>(density, d);

  State state;
  state.density = density;
  state.specific_internal_energy = e;
  state.temperature = r.temperature;
  state.pressure = r.pressure;
  state.sound_speed = std::max(std::sqrt(std::max(r.squared_sound_speed, 0.0)), data_.least_sound_speed);
  state.specific_entropy = table::polynomial_value(coefficients, cx.local, cy.local);
  // dT/de = -T^2 s_ee; (dp/de)_V = -T (rho s_xe + p s_ee)
  state.heat_capacity = -1 / (r.temperature * r.temperature * d.ee);
  state.gruneisen = -r.temperature * (density * d.xe + r.pressure * d.ee) / density;
  state.isothermal_bulk_modulus = density * (r.squared_sound_speed - state.gruneisen * state.gruneisen *
                                                                         state.heat_capacity * r.temperature);
  const Fractions f = fractions(data_, region, tx, y);
  state.melted_fraction = f.melted;
  state.vaporised_fraction = f.vaporised;
  state.phase = data_.phases[region.phase];
  derive(state);
  return state;
}

State Table::state_at_temperature(double density, double temperature) const {
  const double least = minimum_energy(density), greatest = maximum_energy(density);
  const double coldest = state(density, least).temperature, hottest = state(density, greatest).temperature;
  // The coldest state has the least temperature of the table within its error.
  if (!(temperature >= std::min(coldest, data_.least_temperature) && temperature <= hottest)) {
    throw StateError(
        fmt::format("table of {}: temperature outside the table ({:.6g} K at {:.6g} kg/m^3; {:.6g} to "
                    "{:.6g} K)",
                    data_.origin, temperature, density, data_.least_temperature, hottest));
  }
  if (temperature <= coldest) return state(density, least);
  return state(density, find_root([&](double e) { return state(density, e).temperature - temperature; },
                                  least, greatest, "energy at the temperature"));
}

}  // namespace whipple::eos
