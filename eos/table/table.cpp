// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/root.hpp"
#include "eos/table/four_points.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::eos {
namespace {

using Strip = TableData::Strip;
using Region = TableData::Region;

constexpr double fraction_unit = 1.0 / 65535;

/// Returns the region of a strip that contains z.
std::size_t region_of(const Strip& strip, const table::Curves& edges, double z) {
  std::size_t k = 0;
  while (k + 1 < strip.region_count && z > edges.value[k + 1]) ++k;
  return k;
}

/// Holds melted and vaporised fraction.
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
    refuse("minimum thermal energy, sound speed and temperature must be positive");
  }
  for (std::size_t i = 0; i < data_.strips.size(); ++i) {
    const Strip& s = data_.strips[i];
    if (!(s.begin < s.end) || (i > 0 && s.begin != data_.strips[i - 1].end)) refuse("its strips have gaps");
    if (s.intervals == 0 || s.first_interval + std::size_t{s.intervals} * s.blocks() > data_.intervals.size())
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
  for (Strip& s : data_.strips) s.inverse_length = 1 / (s.end - s.begin);
  layout_ = table::Layout(data_);
}

table::Point Table::point(std::vector<double>& numbers) const {
  const auto here = [&] { return static_cast<std::uint32_t>(numbers.size()); };
  const auto append = [&](const std::array<Lanes, 6>& curves) {
    for (const Lanes& of_power : curves) {
      numbers.insert(numbers.end(), {of_power[0], of_power[1], of_power[2], of_power[3]});
    }
  };
  table::Point point = {.begin = layout_.begin,
                        .end = layout_.end,
                        .bins_per_length = layout_.bins_per_length,
                        .thermal_energy = data_.thermal_energy,
                        .bottom = std::log(data_.thermal_energy),
                        .least_squared = data_.least_sound_speed * data_.least_sound_speed};
  point.slabs = here();
  for (const table::Slab& slab : layout_.slabs) {
    append(slab.curves);
    numbers.insert(numbers.end(), {slab.begin, slab.end, slab.top, slab.top_slope, double(slab.first_region),
                                   double(slab.region_count), double(slab.more_curves), 0.0});
  }
  point.more_curves = here();
  for (const std::array<Lanes, 6>& curves : layout_.more_curves) append(curves);
  point.regions = here();
  for (const table::RegionRecord& r : layout_.regions) {
    numbers.insert(numbers.end(), {r.begin, r.inverse_length, r.nx, r.ny, r.first_cell, r.fraction_nx,
                                   r.fraction_ny, r.first_fraction});
  }
  point.slab_of_bin = here();
  numbers.insert(numbers.end(), layout_.slab_of_bin.begin(), layout_.slab_of_bin.end());
  point.cells = here();
  numbers.insert(numbers.end(), data_.cells.begin(), data_.cells.end());
  point.fractions = here();
  for (const auto& [melted, vaporised] : data_.fractions) numbers.push_back(melted * 65536.0 + vaporised);
  return point;
}

double Table::minimum_density() const { return std::exp(layout_.begin); }
double Table::maximum_density() const { return std::exp(layout_.end) * (1 - 1e-14); }

const Strip& Table::strip(double x) const {
  const auto above = std::ranges::upper_bound(data_.strips, x, {}, &Strip::begin);
  return above == data_.strips.begin() ? *above : *(above - 1);
}

double Table::base_energy(double density) const {
  const double x = std::log(density);
  if (!(x >= layout_.begin && x <= layout_.end)) {
    throw StateError(fmt::format("table of {}: {} ({:.6g} kg/m^3; {:.6g} to {:.6g} kg/m^3)", data_.origin,
                                 table::density_bound, density, minimum_density(), maximum_density()));
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

State Table::state(double density, double e) const {
  const double base_value = base_energy(density), x = std::log(density);
  const Strip& s = strip(x);
  const double tx = (x - s.begin) * s.inverse_length;
  const table::Curves base = table::curves(data_, s, tx);
  const double top = maximum_energy(density);
  if (!(e <= top)) {
    throw StateError(fmt::format("table of {}: {} ({:.6g} J/kg at {:.6g} kg/m^3; at most {:.6g} J/kg)",
                                 data_.origin, table::energy_bound, e, density, top));
  }
  const double thermal = std::max(e - base_value, data_.thermal_energy);
  const table::Curves edges = table::edges(s, x, std::log(data_.thermal_energy), base);
  const double z = std::log(thermal);
  const std::size_t k = region_of(s, edges, z);
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
  // The coldest state has the lowest temperature of the table within its error.
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
