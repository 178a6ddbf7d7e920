// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/analysis/measures.hpp"
#include "src/core/base/error.hpp"

namespace whipple::analysis {

PeakDecay::PeakDecay(const Snapshot& first, const Frame& frame, std::size_t body, double radius,
                     double face) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != body || frame.radius(first.position[i]) > radius) continue;
    id_.push_back(first.id[i]);
    depth_.push_back(frame.axial(first.position[i]) - face);
  }
  peak_.assign(id_.size(), 0.0);
}

void PeakDecay::add(const Snapshot& snapshot) {
  // The solver records the maximum pressure over all steps. The pressure in the snapshots alone misses the peak of a
  // front that passes between two of them.
  const std::vector<double>* pressure = snapshot.scalar("maximum_pressure");
  if (pressure == nullptr) pressure = snapshot.scalar("pressure");
  if (pressure == nullptr)
    throw InputError("the peak pressure needs the field maximum_pressure, or pressure, in the snapshots");
  for (std::size_t k = 0; k < id_.size(); ++k) {
    const auto found = std::ranges::lower_bound(snapshot.id, id_[k]);
    if (found == snapshot.id.end() || *found != id_[k]) continue;  // has left the domain
    peak_[k] = std::max(peak_[k], (*pressure)[static_cast<std::size_t>(found - snapshot.id.begin())]);
  }
}

Table PeakDecay::profile(double layer) const {
  Table table{.name = "peak_pressure",
              .meaning = "highest pressure of the material that began near the axis, by initial depth",
              .label = {},
              .labels = {},
              .columns = {}};
  std::vector<std::pair<double, double>> sums;  // peak, count
  for (std::size_t k = 0; k < id_.size(); ++k) {
    const auto bin = static_cast<std::size_t>(std::max(depth_[k], 0.0) / layer);
    if (bin >= sums.size()) sums.resize(bin + 1);
    sums[bin].first += peak_[k];
    sums[bin].second += 1.0;
  }
  for (std::size_t bin = 0; bin < sums.size(); ++bin) {
    if (sums[bin].second == 0.0) continue;
    table.append(
        {{"depth", "m", "initial depth, middle of the layer", (static_cast<double>(bin) + 0.5) * layer},
         {"peak_pressure", "Pa", "mean of the particles of the layer", sums[bin].first / sums[bin].second}});
  }
  return table;
}

double PeakDecay::mean_to(double depth) const {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < id_.size(); ++k) {
    if (depth_[k] > depth) continue;
    sum += peak_[k];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : nan;
}

Quantities PeakDecay::measures(double diameter) const {
  // ln P = a - n ln(depth / diameter) between 2 and 5 diameters.
  double n = 0, x_mean = 0, y_mean = 0, xx = 0, xy = 0;
  const auto each = [&](auto&& body) {
    for (std::size_t k = 0; k < id_.size(); ++k) {
      const double depth = depth_[k] / diameter;
      if (depth >= 2.0 && depth <= 5.0 && peak_[k] > 0.0) body(std::log(depth), std::log(peak_[k]));
    }
  };
  each([&](double x, double y) {
    n += 1.0;
    x_mean += x;
    y_mean += y;
  });
  x_mean /= n;
  y_mean /= n;
  each([&](double x, double y) {
    xx += (x - x_mean) * (x - x_mean);
    xy += (x - x_mean) * (y - y_mean);
  });
  const double slope = n > 2.0 ? xy / xx : nan;
  return {measured("peak_pressure_contact", mean_to(0.3 * diameter)),
          measured("peak_pressure_contact_wide", mean_to(0.6 * diameter)),
          measured("peak_pressure_exponent", -slope),
          measured("peak_pressure_4_diameters", std::exp(y_mean + slope * (std::log(4.0) - x_mean)))};
}

}  // namespace whipple::analysis
