// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/structure_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "src/core/base/units.hpp"

namespace whipple::fit {
namespace {

/// Holds a volume of the cold curve: pressure, and energy of another structure minus that of the simulated one.
struct ColdDifference {
  double volume, pressure, difference;
};

/// Returns the differences by structure, in order of decreasing volume.
std::map<std::string, std::vector<ColdDifference>> cold_differences(std::span<const md::PointRecord> points) {
  std::map<std::string, std::vector<ColdDifference>> found;
  for (const md::ColdCurvePoint& point : md::select_as<md::ColdCurvePoint>(points)) {
    for (const md::ColdCurvePoint::Other& other : md::ColdCurvePoint::others()) {
      const std::optional<double>& energy = point.*other.specific_internal_energy;
      if (!energy) continue;
      found[std::string(word_of(other.structure))].push_back(
          {point.specific_volume, point.pressure, *energy - point.specific_internal_energy});
    }
  }
  for (auto& [structure, curve] : found) {
    std::ranges::sort(curve, [](const auto& a, const auto& b) { return a.volume > b.volume; });
  }
  return found;
}

/// Adds a remark on data at pressures beyond the validity of the potential; older databases do not contain it.
void add_validity_remark(Fit& fit, std::span<const md::PointRecord> points, const Observations& data) {
  const auto first = std::ranges::find_if(points, [](const md::PointRecord& point) {
    return point.done() && point.provenance.contains("validity_pressure");
  });
  if (first == points.end()) return;
  const std::string limit = first->origin("validity_pressure");
  const double pressure = units::parse_quantity(limit, "Pa");
  const auto beyond = [&](const auto& state) { return state.pressure.value > pressure; };
  const auto shocks = std::ranges::count_if(data.hugoniot, beyond);
  std::ptrdiff_t states = 0;
  for (const Isochore& isochore : data.isochores) states += std::ranges::count_if(isochore.states, beyond);
  if (shocks + states == 0) return;
  fit.remarks.push_back(fmt::format(
      "{} Hugoniot states and {} states of isochores are beyond the validity of the potential, {} ({})",
      shocks, states, limit, first->origin("validity_reason")));
}

}  // namespace

std::optional<StructureLimit> structure_limit(std::span<const md::PointRecord> points) {
  std::optional<StructureLimit> limit;
  for (const auto& [structure, curve] : cold_differences(points)) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (curve[i].pressure < 0.0 || curve[i].difference >= 0.0) continue;
      StructureLimit here{structure, curve[i].volume, curve[i].pressure};
      if (i > 0 && curve[i - 1].difference > 0.0) {
        const double weight = curve[i - 1].difference / (curve[i - 1].difference - curve[i].difference);
        here.volume = (1.0 - weight) * curve[i - 1].volume + weight * curve[i].volume;
        here.pressure = (1.0 - weight) * curve[i - 1].pressure + weight * curve[i].pressure;
      }
      if (!limit || here.pressure < limit->pressure) limit = here;
      break;
    }
  }
  return limit;
}

void add_structure_remark(Fit& fit, std::span<const md::PointRecord> points, const Observations& data) {
  add_validity_remark(fit, points, data);
  const std::optional<StructureLimit> limit = structure_limit(points);
  if (!limit) return;
  const auto shocks = std::ranges::count_if(
      data.hugoniot, [&](const HugoniotState& state) { return state.volume < limit->volume; });
  std::ptrdiff_t states = 0;
  for (const Isochore& isochore : data.isochores) {
    if (isochore.volume < limit->volume) states += static_cast<std::ptrdiff_t>(isochore.states.size());
  }
  fit.remarks.push_back(fmt::format(
      "beyond {:.0f} GPa (V/V0 = {:.3f}) the {} crystal of this potential has less energy than the simulated "
      "one: {} "
      "Hugoniot states and {} states of isochores there are of a crystal that is not stable",
      1e-9 * limit->pressure, limit->volume / data.reference_volume.value, limit->structure, shocks, states));
}

}  // namespace whipple::fit
