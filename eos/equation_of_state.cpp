// SPDX-License-Identifier: BSD-3-Clause
#include "eos/equation_of_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace whipple::eos {
namespace {

constexpr std::size_t block_size = 64;  ///< number of points whose first evaluation is kept on the stack

template <class Value>
std::span<Value> part(std::span<Value> of, std::size_t begin, std::size_t count) {
  return of.empty() ? of : of.subspan(begin, count);
}

/// Integrates at most `block_size` points.
RangeReport integrate_block(const EquationOfState& eos, const Batch& batch, std::span<double> energy,
                            std::span<const double> half_change) {
  const std::size_t n = energy.size();
  std::array<double, block_size> before, first_energy, first_pressure, distension;
  std::copy_n(energy.begin(), n, before.begin());
  std::ranges::copy(batch.distension,
                    distension.begin());  // both evaluations start from the distension before the step
  for (std::size_t k = 0; k < n; ++k) {
    energy[k] = first_energy[k] = before[k] - half_change[k] * batch.pressure[k];
  }
  RangeReport range = eos.evaluate(batch);
  for (std::size_t k = 0; k < n; ++k) {
    first_pressure[k] = batch.pressure[k];
    energy[k] = before[k] - half_change[k] * first_pressure[k];
  }
  std::copy_n(distension.begin(), batch.distension.size(), batch.distension.begin());
  range.merge(eos.evaluate(batch));
  for (std::size_t k = 0; k < n; ++k) {
    const double h = half_change[k], span = energy[k] - first_energy[k];
    const double slope = (batch.pressure[k] - first_pressure[k]) / (span != 0.0 ? span : 1.0);
    const bool resolved = std::abs(span) > 1e-9 * std::abs(energy[k]) && h * slope > least_work_slope;
    const double gain = h * (first_pressure[k] - batch.pressure[k]) / (resolved ? 1.0 + h * slope : 1.0);
    energy[k] += gain;
    batch.pressure[k] += resolved ? slope * gain : 0.0;
  }
  return range;
}

}  // namespace

RangeReport EquationOfState::integrate(const Batch& batch, std::span<double> energy,
                                       std::span<const double> half_change) const {
  RangeReport range;
  for (std::size_t begin = 0; begin < energy.size(); begin += block_size) {
    const std::size_t count = std::min(block_size, energy.size() - begin);
    const auto of = [&](auto values) { return part(values, begin, count); };
    const Batch block = {of(batch.density),
                         of(batch.specific_internal_energy),
                         of(batch.pressure),
                         of(batch.temperature),
                         of(batch.sound_speed),
                         of(batch.melted_fraction),
                         of(batch.vaporised_fraction),
                         of(batch.distension)};
    RangeReport met = integrate_block(*this, block, of(energy), of(half_change));
    if (met.first != RangeReport::none) met.first += begin;
    range.merge(met);
  }
  return range;
}

}  // namespace whipple::eos
