// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/sesame.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"

namespace whipple::eos {
namespace {

constexpr std::string_view density_bound = "density outside the table";
constexpr std::string_view energy_bound = "specific internal energy above the table";
constexpr std::string_view number_bound = "density and specific internal energy must be finite";

/// Limits of the repair of a table whose energy does not increase with temperature (`raise_energies`).
constexpr double most_raised = 0.01;     // of the steps
constexpr double greatest_raise = 0.02;  // of the temperature

/// Limit of the pressure of the reference state over rho c^2, above which the material is a gas.
constexpr double greatest_condensed_pressure = 0.1;

/// Returns slopes of a piecewise cubic: those of the parabola through three points.
std::vector<double> slopes_of(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> quotient(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) quotient[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  if (n == 2) return {quotient[0], quotient[0]};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    slope[i] = (h1 * quotient[i - 1] + h0 * quotient[i]) / (h0 + h1);
  }
  slope[0] = 2 * quotient[0] - slope[1];
  slope[n - 1] = 2 * quotient[n - 2] - slope[n - 2];
  return slope;
}

/// Returns slopes of a piecewise cubic that is monotone wherever the points are: those of the parabola through
/// three points, limited to three times the smaller difference quotient, zero where these differ in sign (Fritsch
/// and Carlson, SIAM J. Numer. Anal. 17 (1980) 238; Hyman, SIAM J. Sci. Stat. Comput. 4 (1983) 645).
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> slope = slopes_of(x, y);
  const std::size_t n = x.size();
  const auto quotient = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  for (std::size_t i = 0; i < n; ++i) {
    const double a = quotient(i > 0 ? i - 1 : 0), b = quotient(std::min(i, n - 2));
    const double most = a * b > 0 ? 3 * std::min(std::abs(a), std::abs(b)) : 0.0;
    slope[i] = a > 0 ? std::clamp(slope[i], 0.0, most) : std::clamp(slope[i], -most, 0.0);
  }
  return slope;
}

/// Returns slopes of a piecewise cubic through positive values, limited so that it stays positive: its Bernstein
/// coefficients are y_i, y_i + h m_i/3, y_(i+1) - h m_(i+1)/3 and y_(i+1).
std::vector<double> positive_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> slope = slopes_of(x, y);
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (i > 0) slope[i] = std::min(slope[i], 3 * y[i] / (x[i] - x[i - 1]));
    if (i + 1 < y.size()) slope[i] = std::max(slope[i], -3 * y[i] / (x[i + 1] - x[i]));
  }
  return slope;
}

}  // namespace

Sesame::Sesame(const SesameMaterial& material, double reference_temperature, std::string origin)
    : origin_(std::move(origin)),
      number_(material.number),
      comment_(material.comment),
      density_(material.total.density),
      temperature_(material.total.temperature),
      reference_density_(material.reference_density),
      reference_temperature_(reference_temperature) {
  SesameGrid grid = material.total;
  const std::size_t nr = density_.size(), nt = temperature_.size();
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: material {}: {}", origin_, number_, what));
  };
  if (nr < 2 || nt < 2 || grid.pressure.size() != nr * nt || grid.energy.size() != nr * nt ||
      (!grid.helmholtz.empty() && grid.helmholtz.size() != nr * nt)) {
    refuse("table 301 needs two densities and temperatures at least, and one value for each pair");
  }
  const EnergyRepair repair = raise_energies(grid);
  if (repair.raised > 0) {
    const std::string what = fmt::format(
        "the energy does not rise with the temperature in {} of {} steps; the largest raise that cures it is "
        "that of "
        "{:.3g} K, at {:.6g} kg/m^3 and {:.6g} K",
        repair.raised, repair.steps, repair.largest, repair.density, repair.temperature);
    if (static_cast<double>(repair.raised) > most_raised * static_cast<double>(repair.steps) ||
        repair.fraction > greatest_raise) {
      refuse(
          fmt::format("{}: more than {:g} % of the steps, or than {:g} % of the temperature, are not cured",
                      what, 100 * most_raised, 100 * greatest_raise));
    }
    log::warning("{}: material {}: {}: raised", origin_, number_, what);
  }
  for (std::size_t j = 1; j < nt; ++j) {
    for (std::size_t i = 0; i < nr; ++i) {
      const double low = grid.energy[(j - 1) * nr + i], high = grid.energy[j * nr + i];
      if (high > low) continue;
      refuse(
          fmt::format("the energy must rise with the temperature; at {:.6g} kg/m^3 it goes from {:.9g} J/kg "
                      "at {:.6g} K to {:.9g} J/kg at {:.6g} K",
                      density_[i], low, temperature_[j - 1], high, temperature_[j]));
    }
  }
  const auto add_row = [&](std::vector<Node>& nodes, std::size_t j, const std::vector<double>& values,
                           const std::vector<double>& slopes) {
    for (std::size_t i = 0; i < nr; ++i) nodes[i * nt + j] = {values[i], slopes[i]};
  };
  const auto row_of = [&](const std::vector<double>& values, std::size_t j) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(j * nr);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(nr));
  };
  // Slopes of the energy: those of the coldest row plus those of the steps between rows. The cubics of the steps
  // are positive, so that e also increases with T between the densities.
  energies_.resize(nr * nt);
  pressures_.resize(nr * nt);
  std::vector<double> slopes;
  for (std::size_t j = 0; j < nt; ++j) {
    const std::vector<double> energies = row_of(grid.energy, j), pressures = row_of(grid.pressure, j);
    if (j == 0) {
      slopes = slopes_of(density_, energies);
    } else {
      std::vector<double> step = row_of(grid.energy, j - 1);
      for (std::size_t i = 0; i < nr; ++i) step[i] = energies[i] - step[i];
      const std::vector<double> more = positive_slopes(density_, step);
      for (std::size_t i = 0; i < nr; ++i) slopes[i] += more[i];
    }
    add_row(energies_, j, energies, slopes);
    add_row(pressures_, j, pressures, monotone_slopes(density_, pressures));
  }
  if (!grid.helmholtz.empty()) {
    entropies_.resize(nr * nt);
    for (std::size_t j = 0; j < nt; ++j) {
      std::vector<double> s(nr, 0.0);  // at T = 0: third law
      for (std::size_t i = 0; i < nr && temperature_[j] > 0; ++i)
        s[i] = (material.total.energy[j * nr + i] - grid.helmholtz[j * nr + i]) / temperature_[j];
      add_row(entropies_, j, s, monotone_slopes(density_, s));
    }
  }
  if (!inside(reference_density_) ||
      !(reference_temperature_ >= temperature_.front() && reference_temperature_ <= temperature_.back())) {
    refuse(fmt::format(
        "the reference state, {:.6g} kg/m^3 and {:.6g} K, lies outside the table: {:.6g} to {:.6g} "
        "kg/m^3, {:.6g} to {:.6g} K",
        reference_density_, reference_temperature_, density_.front(), density_.back(), temperature_.front(),
        temperature_.back()));
  }
  const State reference = state_at_temperature(reference_density_, reference_temperature_);
  const double squared = reference.sound_speed * reference.sound_speed;
  if (!(squared > 0)) refuse("the reference state has no sound speed: the square is not positive");
  reference_energy_ = reference.specific_internal_energy;
  least_squared_sound_speed_ = squared * least_sound_speed_ratio * least_sound_speed_ratio;
  condensed_ = std::abs(reference.pressure) < greatest_condensed_pressure * reference_density_ * squared;
}

Sesame::Cell Sesame::cell(double density) const {
  const std::size_t nt = temperature_.size();
  const auto above = std::upper_bound(density_.begin() + 1, density_.end() - 1, density);
  const auto i = static_cast<std::size_t>(above - density_.begin()) - 1;
  const double h = density_[i + 1] - density_[i], t = (density - density_[i]) / h, u = 1 - t;
  Cell cell;
  cell.e0 = &energies_[i * nt];
  cell.e1 = cell.e0 + nt;
  cell.p0 = &pressures_[i * nt];
  cell.p1 = cell.p0 + nt;
  cell.index = i;
  cell.value0 = u * u * (1 + 2 * t);
  cell.slope0 = h * t * u * u;
  cell.value1 = t * t * (1 + 2 * u);
  cell.slope1 = -h * t * t * u;
  cell.by_value0 = -6 * t * u / h;
  cell.by_slope0 = u * (1 - 3 * t);
  cell.by_value1 = 6 * t * u / h;
  cell.by_slope1 = t * (3 * t - 2);
  return cell;
}

Sesame::Cell Sesame::checked_cell(double density) const {
  if (!inside(density)) {
    throw StateError(fmt::format("{}: {} ({:.6g} kg/m^3; {:.6g} to {:.6g} kg/m^3)", origin_, density_bound,
                                 density, density_.front(), density_.back()));
  }
  return cell(density);
}

std::size_t Sesame::row(const Cell& cell, double e) const {
  std::size_t low = 0, high = temperature_.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (energy(cell, middle) <= e ? low : high) = middle;
  }
  return low;
}

Sesame::Result Sesame::result(const Cell& cell, double density, std::size_t row, double share) const {
  const auto slope = [&](std::size_t j) {
    return cell.by_value0 * cell.p0[j].value + cell.by_slope0 * cell.p0[j].slope +
           cell.by_value1 * cell.p1[j].value + cell.by_slope1 * cell.p1[j].slope;
  };
  const double step = temperature_[row + 1] - temperature_[row];
  const double p = value(cell, cell.p0, cell.p1, row), next = value(cell, cell.p0, cell.p1, row + 1);
  Result r;
  r.temperature = temperature_[row] + share * step;
  r.pressure = p + share * (next - p);
  r.pressure_by_density = slope(row) + share * (slope(row + 1) - slope(row));
  r.pressure_by_temperature = (next - p) / step;
  r.heat_capacity = (energy(cell, row + 1) - energy(cell, row)) / step;
  // c^2 = (dp/drho)_T + T (dp/dT)^2 / (rho^2 C_v)
  r.squared_sound_speed = r.pressure_by_density + r.temperature * r.pressure_by_temperature *
                                                      r.pressure_by_temperature /
                                                      (density * density * r.heat_capacity);
  return r;
}

double Sesame::minimum_energy(double density) const { return energy(checked_cell(density), 0); }

double Sesame::maximum_energy(double density) const {
  return energy(checked_cell(density), temperature_.size() - 1);
}

RangeReport Sesame::evaluate(const Batch& batch) const {
  RangeReport report;
  const std::size_t last = temperature_.size() - 1;
  for (std::size_t k = 0; k < batch.density.size(); ++k) {
    const double rho = batch.density[k], e = batch.specific_internal_energy[k];
    const auto broken = [&](std::string_view bound) {
      if (report.out_of_range++ == 0) {
        report.first = k;
        report.bound = bound;
      }
      batch.pressure[k] = batch.temperature[k] = batch.sound_speed[k] = State::unknown;
    };
    if (!batch.melted_fraction.empty()) batch.melted_fraction[k] = 0;
    if (!batch.vaporised_fraction.empty()) batch.vaporised_fraction[k] = 0;
    if (!std::isfinite(rho) || !std::isfinite(e)) {
      broken(number_bound);
      continue;
    }
    if (!inside(rho)) {
      broken(density_bound);
      continue;
    }
    const Cell c = cell(rho);
    if (e > energy(c, last)) {
      broken(energy_bound);
      continue;
    }
    const std::size_t j = row(c, e);
    const double low = energy(c, j);
    if (e < low) ++report.below_cold_curve;
    const double share = std::max(0.0, (e - low) / (energy(c, j + 1) - low));
    const Result r = result(c, rho, j, share);
    batch.pressure[k] = r.pressure;
    batch.temperature[k] = r.temperature;
    batch.sound_speed[k] = std::sqrt(std::max(least_squared_sound_speed_, r.squared_sound_speed));
  }
  return report;
}

/// Returns the entropy; on the isochore ds = C_v dT/T is linear in ln T where C_v is constant, through the table
/// values.
double Sesame::entropy(const Cell& c, std::size_t row, double temperature) const {
  if (entropies_.empty()) return State::unknown;
  const Node* s0 = &entropies_[c.index * temperature_.size()];
  const Node* s1 = s0 + temperature_.size();
  const double low = value(c, s0, s1, row), high = value(c, s0, s1, row + 1);
  const double T0 = temperature_[row], T1 = temperature_[row + 1];
  const double share = T0 > 0 ? std::log(temperature / T0) / std::log(T1 / T0) : temperature / T1;
  return low + share * (high - low);
}

State Sesame::full(const Cell& c, double density, double e, std::size_t row, double share) const {
  const Result r = result(c, density, row, share);
  State state;
  state.density = density;
  state.specific_internal_energy = e;
  state.temperature = r.temperature;
  state.pressure = r.pressure;
  state.sound_speed = std::sqrt(std::max(least_squared_sound_speed_, r.squared_sound_speed));
  state.specific_entropy = entropy(c, row, r.temperature);
  state.heat_capacity = r.heat_capacity;
  state.gruneisen = r.pressure_by_temperature / (density * r.heat_capacity);
  state.isothermal_bulk_modulus = density * r.pressure_by_density;
  state.phase = "tabulated";
  derive(state);
  return state;
}

State Sesame::state(double density, double e) const {
  const Cell c = checked_cell(density);
  const double top = energy(c, temperature_.size() - 1);
  if (!(e <= top)) {
    throw StateError(fmt::format("{}: {} ({:.6g} J/kg at {:.6g} kg/m^3; at most {:.6g} J/kg)", origin_,
                                 energy_bound, e, density, top));
  }
  const std::size_t j = row(c, e);
  const double low = energy(c, j);
  return full(c, density, e, j, std::max(0.0, (e - low) / (energy(c, j + 1) - low)));
}

State Sesame::state_at_temperature(double density, double temperature) const {
  const Cell c = checked_cell(density);
  if (!(temperature >= temperature_.front() && temperature <= temperature_.back())) {
    throw StateError(fmt::format("{}: temperature outside the table ({:.6g} K; {:.6g} to {:.6g} K)", origin_,
                                 temperature, temperature_.front(), temperature_.back()));
  }
  const auto above = std::upper_bound(temperature_.begin() + 1, temperature_.end() - 1, temperature);
  const auto j = static_cast<std::size_t>(above - temperature_.begin()) - 1;
  const double share = (temperature - temperature_[j]) / (temperature_[j + 1] - temperature_[j]);
  const double low = energy(c, j), high = energy(c, j + 1);
  return full(c, density, low + share * (high - low), j, share);
}

std::string Sesame::constants() const {
  return fmt::format("# SESAME material {} of {}, table 301 of {} densities and {} temperatures: {}\n",
                     number_, origin_, density_.size(), temperature_.size(), comment_);
}

}  // namespace whipple::eos
