// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/crystal_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double gas_constant = 8.31446261815324;  // J/(mol K), exact in the SI of 2019

/// Ratio that converts the mid-interval error of the energy to the error of the pressure. The slope of a cubic
/// through values and slopes at the ends of an interval h has an error of up to 0.0962 h^3/24 times the fourth
/// derivative, its value in the middle h^4/384 times it; the factor 3 allows for a variable fourth derivative. (The
/// slope is exact in the middle to this order and gives no estimate.)
constexpr double slope_by_value = 3.0 * 0.0962 * 384.0 / 24.0;
/// Fractions of the errors of an interval that remain in its halves: third order in the width, and second for
/// gamma, with a margin for a variable second derivative.
constexpr double cubic_share = 1.0 / 8.0, line_share = 1.5 / 4.0;

/// Rounds a volume ratio, so that equal volumes of different intervals compare equal.
double rounded(double ratio) { return std::round(ratio * 1e9) / 1e9; }

}  // namespace

CrystalSurface::CrystalSurface(std::unique_ptr<IsochoreSource> source, const Settings& settings)
    : source_(std::move(source)),
      settings_(settings),
      static_volume_(source_->static_volume()),
      heat_capacity_(3.0 * gas_constant / source_->molar_mass()),
      cells_(static_cast<std::size_t>(
          std::lround((settings.greatest_ratio - settings.least_ratio) / settings.spacing))) {
  // g: weighted least squares of E - E_c - c T = g T^2/2.
  const std::vector<double> ratio = {1.0};
  const SimulatedIsochore isochore = source_->isochores(ratio).front();
  double numerator = 0.0;
  double denominator = 0.0;
  for (const SimulatedIsochore::State& state : isochore.states) {
    const double weight = 1.0 / (state.energy_error * state.energy_error);
    const double half = 0.5 * state.temperature * state.temperature;
    const double excess = state.energy - isochore.cold_energy - heat_capacity_ * state.temperature;
    numerator += weight * half * excess;
    denominator += weight * half * half;
  }
  anharmonic_ = numerator / denominator;
  nodes_.emplace(1.0, node_of(isochore));
}

CrystalSurface::~CrystalSurface() = default;

CrystalSurface::Node CrystalSurface::node_of(const SimulatedIsochore& isochore) const {
  Node node{isochore.volume, isochore.cold_energy, isochore.cold_pressure};
  // gamma: weighted least squares of P - P_c = c gamma T/V.
  double numerator = 0.0;
  double denominator = 0.0;
  for (const SimulatedIsochore::State& state : isochore.states) {
    const double weight = 1.0 / (state.pressure_error * state.pressure_error);
    const double heat = heat_capacity_ * state.temperature / node.volume;
    numerator += weight * heat * (state.pressure - node.cold_pressure);
    denominator += weight * heat * heat;
  }
  node.gruneisen = numerator / denominator;
  for (const SimulatedIsochore::State& state : isochore.states) {
    const double t = state.temperature;
    const double pressure = node.cold_pressure + heat_capacity_ * node.gruneisen * t / node.volume;
    const double energy = node.cold_energy + t * (heat_capacity_ + 0.5 * anharmonic_ * t);
    // At given energy, an error of E is one of T, and hence an error of P = rho gamma E.
    node.misfit =
        std::fmax(node.misfit, std::abs(state.pressure - pressure) +
                                   std::abs(node.gruneisen * (state.energy - energy) / node.volume));
  }
  return node;
}

void CrystalSurface::fetch(const std::vector<double>& ratios) const {
  std::vector<double> missing;
  for (const double ratio : ratios) {
    if (!nodes_.contains(ratio)) missing.push_back(ratio);
  }
  if (missing.empty()) return;
  const std::vector<SimulatedIsochore> isochores = source_->isochores(missing);
  for (std::size_t i = 0; i < missing.size(); ++i) nodes_.emplace(missing[i], node_of(isochores[i]));
}

CrystalSurface::Leaf CrystalSurface::leaf_between(const Node& a, const Node& b) const {
  // Cubic Hermite polynomial through phi and phi' = -P_c.
  const double h = b.volume - a.volume;
  const double mean = (b.cold_energy - a.cold_energy) / h;
  const double begin = -a.cold_pressure;
  const double end = -b.cold_pressure;
  return {a.volume,
          b.volume,
          a.cold_energy,
          begin,
          (3.0 * mean - 2.0 * begin - end) / h,
          (begin + end - 2.0 * mean) / (h * h),
          a.gruneisen,
          (b.gruneisen - a.gruneisen) / h};
}

void CrystalSurface::divide(double low, double high, int level, Cell& cell) const {
  const double middle = rounded(0.5 * (low + high));
  fetch({low, middle, high});
  const Node& a = nodes_.at(low);
  const Node& m = nodes_.at(middle);
  const Node& b = nodes_.at(high);
  const Point guess = leaf_between(a, b).at(m.volume);
  const double cold = slope_by_value * std::abs(m.cold_energy - guess.cold_energy) / (b.volume - a.volume);
  const double thermal =
      std::abs(m.gruneisen - guess.gruneisen) * heat_capacity_ * settings_.greatest_temperature / m.volume;
  const double misfit = std::max({a.misfit, m.misfit, b.misfit});
  const double error = cubic_share * cold + line_share * thermal + misfit;
  if (error <= settings_.tolerance) {
    cell.leaves.push_back(leaf_between(a, m));
    cell.leaves.push_back(leaf_between(m, b));
    cell.error = std::fmax(cell.error, error);
    return;
  }
  if (misfit > settings_.tolerance || level == settings_.divisions) {
    throw StateError(fmt::format(
        "the estimated error of the pressure between V/Vs = {:.4g} and {:.4g} is {:.3g} GPa, of which "
        "{:.3g} GPa is what the law of the crystal leaves of the simulated states; the tolerance is "
        "{:.3g} GPa",
        low, high, 1e-9 * error, 1e-9 * misfit, 1e-9 * settings_.tolerance));
  }
  divide(low, middle, level + 1, cell);
  divide(middle, high, level + 1, cell);
}

std::unique_ptr<CrystalSurface::Cell> CrystalSurface::work_out(std::size_t index) const {
  auto cell = std::make_unique<Cell>();
  const auto ratio = [&](std::size_t i) {
    return i == cells_.size() ? settings_.greatest_ratio
                              : rounded(settings_.least_ratio + settings_.spacing * static_cast<double>(i));
  };
  try {
    divide(ratio(index), ratio(index + 1), 1, *cell);
  } catch (const std::exception& error) {
    cell->fault = error.what();
  }
  return cell;
}

const CrystalSurface::Cell* CrystalSurface::cell(double volume) const {
  const double ratio = volume / static_volume_;
  if (!(ratio >= settings_.least_ratio && ratio <= settings_.greatest_ratio)) return nullptr;
  const auto place = static_cast<std::size_t>((ratio - settings_.least_ratio) / settings_.spacing);
  const std::size_t index = std::min(place, cells_.size() - 1);
  if (const Cell* known = cells_[index].load(std::memory_order_acquire)) return known;
  const std::lock_guard lock(mutex_);
  if (const Cell* known = cells_[index].load(std::memory_order_acquire)) return known;
  owned_.push_back(work_out(index));
  cells_[index].store(owned_.back().get(), std::memory_order_release);
  return owned_.back().get();
}

}  // namespace whipple::eos
