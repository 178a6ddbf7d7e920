// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/data_set/points.hpp"
#include "md_fitting/data_set/run_cost.hpp"

namespace whipple::fit {
namespace {

using md::PointRecord;

/// Returns equidistant values with exact end points.
std::vector<double> spaced(double least, double most, std::int64_t count) {
  if (least == most) return {least};
  std::vector<double> values;
  for (std::int64_t i = 0; i + 1 < count; ++i) {
    values.push_back(least + (most - least) * static_cast<double>(i) / static_cast<double>(count - 1));
  }
  values.push_back(most);
  return values;
}

std::pair<double, double> ends(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

/// Interpolates linearly between the entries, constant beyond them.
double interpolated(const std::map<double, double>& table, double x) {
  const auto above = table.lower_bound(x);
  if (above == table.end()) return table.rbegin()->second;
  if (above == table.begin() || above->first == x) return above->second;
  const auto below = std::prev(above);
  const double share = (x - below->first) / (above->first - below->first);
  return (1.0 - share) * below->second + share * above->second;
}

bool same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b) + 1e-9; }

}  // namespace

Ranges::Ranges(const md::Plan& plan, std::span<const PointRecord> points) : plan_(plan), points_(points) {
  if (points.empty()) return;
  static_volume_ = points.front().origin_number("static_specific_volume");
  const auto structure = value_of<md::CrystalStructure>(points.front().origin("structure"));
  if (structure) atoms_per_cell_ = md::atoms_per_cell(*structure);
}

const md::IsochorePlan& Ranges::nearest_isochore(double volume_ratio) const {
  return *std::min_element(plan_.isochores.begin(), plan_.isochores.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.volume_ratio - volume_ratio) < std::abs(b.volume_ratio - volume_ratio);
  });
}

md::RunShape Ranges::shape_of(const PlannedPoint& point) const {
  const auto shape = [](const md::RunSize& size, std::int64_t length, std::int64_t replicas) {
    return md::RunShape{.cells = static_cast<double>(size.cells),
                        .length = static_cast<double>(length),
                        .equilibration_steps = static_cast<double>(size.equilibration_steps),
                        .steps = static_cast<double>(size.steps),
                        .replicas = static_cast<double>(replicas)};
  };
  const auto cube = [&](const md::RunSize& size) { return shape(size, size.cells, 1); };
  if (point.protocol == md::PointKind::hugoniot) return cube(plan_.hugoniot->size);
  if (point.protocol == md::PointKind::isochore) return cube(nearest_isochore(point.volume_ratio).size);
  if (point.protocol != md::PointKind::coexistence) return cube(plan_.zero_pressure->size);
  const md::CoexistencePlan& melting = plan_.coexistences.front();
  return shape(melting.size, melting.length, melting.replicas);
}

std::vector<double> Ranges::isochore_ratios() const {
  std::vector<double> ratios;
  for (const md::IsochorePlan& isochore : plan_.isochores) ratios.push_back(isochore.volume_ratio);
  const auto [least, most] = ends(ratios);
  return spaced(least, most, plan_.adaptive->candidates);
}

std::vector<PlannedPoint> Ranges::isochore(double volume_ratio) const {
  std::map<double, double> coldest;
  std::map<double, double> hottest;
  for (const md::IsochorePlan& isochore : plan_.isochores) {
    const auto [least, most] = ends(isochore.temperature);
    coldest[isochore.volume_ratio] = least;
    hottest[isochore.volume_ratio] = most;
  }
  std::vector<PlannedPoint> points;
  for (const double temperature : spaced(interpolated(coldest, volume_ratio),
                                         interpolated(hottest, volume_ratio), plan_.adaptive->candidates)) {
    points.push_back({md::PointKind::isochore, volume_ratio, temperature, 0.0});
  }
  return points;
}

std::vector<PlannedPoint> Ranges::hugoniot() const {
  const auto [least, most] = ends(plan_.hugoniot->volume_ratio);
  std::vector<PlannedPoint> points;
  for (const double ratio : spaced(least, most, plan_.adaptive->candidates)) {
    points.push_back({md::PointKind::hugoniot, ratio, 0.0, 0.0});
  }
  return points;
}

std::vector<PlannedPoint> Ranges::coexistence() const {
  if (plan_.coexistences.empty() || plan_.coexistences.front().pressure.empty()) return {};
  const md::CoexistencePlan& melting = plan_.coexistences.front();
  std::map<double, double> guesses;
  for (std::size_t i = 0; i < melting.pressure.size(); ++i) {
    guesses[melting.pressure[i]] = melting.first_guess[i];
  }
  std::vector<PlannedPoint> points;
  for (const double pressure :
       spaced(guesses.begin()->first, guesses.rbegin()->first, plan_.adaptive->candidates)) {
    points.push_back({md::PointKind::coexistence, 0.0, interpolated(guesses, pressure), pressure});
  }
  return points;
}

bool Ranges::present(const PlannedPoint& point) const {
  return std::any_of(points_.begin(), points_.end(), [&](const PointRecord& record) {
    if (record.kind() != point.protocol) return false;
    if (point.protocol == md::PointKind::coexistence)
      return same(condition(record, &md::CoexistencePoint::pressure), point.pressure);
    if (point.protocol == md::PointKind::zero_pressure_volume) {
      return same(condition(record, &md::ZeroPressurePoint::temperature), point.temperature);
    }
    return same(condition(record, &md::StatePoint::specific_volume), point.volume_ratio * static_volume_) &&
           (point.protocol == md::PointKind::hugoniot ||
            same(condition(record, &md::StatePoint::temperature), point.temperature));
  });
}

std::vector<PlannedPoint> Ranges::start() const {
  std::vector<PlannedPoint> wanted;
  for (const double temperature : plan_.zero_pressure->temperature) {
    wanted.push_back({md::PointKind::zero_pressure_volume, 0.0, temperature, 0.0});
  }
  /// Selects `count` of the points, spread over all of them.
  const auto spread = [&](const std::vector<PlannedPoint>& points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double place = static_cast<double>(i * (points.size() - 1)) / static_cast<double>(count - 1);
      wanted.push_back(points[static_cast<std::size_t>(std::lround(place))]);
    }
  };
  spread(hugoniot(), std::min<std::size_t>(5, hugoniot().size()));  // the ends may be outside the window
  const std::vector<double> ratios = isochore_ratios();
  spread(isochore(ratios.back()), 3);
  spread(isochore(ratios.front()), 3);
  const std::vector<PlannedPoint> melting = coexistence();
  if (!melting.empty()) wanted.push_back(melting.front());
  std::erase_if(wanted, [&](const PlannedPoint& point) { return present(point); });
  return wanted;
}

std::vector<Candidate> Ranges::candidates(std::span<const double> isochore_volumes) const {
  std::vector<Candidate> all;
  const auto add = [&](const std::vector<PlannedPoint>& points) {
    Candidate candidate;
    for (const PlannedPoint& point : points) {
      if (present(point)) continue;
      candidate.points.push_back(point);
      candidate.cost += cost(point);
    }
    if (!candidate.points.empty()) all.push_back(candidate);
  };
  for (const PlannedPoint& point : hugoniot()) add({point});
  for (const double ratio : isochore_ratios()) {
    const std::vector<PlannedPoint> states = isochore(ratio);
    const bool known = std::any_of(isochore_volumes.begin(), isochore_volumes.end(),
                                   [&](double volume) { return same(volume, ratio * static_volume_); });
    if (known) {
      for (const PlannedPoint& point : states) add({point});
    } else {
      add({states.front(), states[states.size() / 2], states.back()});
    }
  }
  for (const PlannedPoint& point : coexistence()) add({point});
  return all;
}

double Ranges::cost(const PlannedPoint& point) const {
  return md::atom_steps(point.protocol, atoms_per_cell_, shape_of(point));
}

double Ranges::spent() const {
  double sum = 0.0;
  for (const PointRecord& point : points_) {
    sum += md::atom_steps(point.kind(), atoms_per_cell_, md::run_shape(point.provenance)) * point.segments();
  }
  return sum;
}

double Ranges::sampling(const PlannedPoint& point) const { return md::sampling(shape_of(point)); }

double Ranges::sampling(const PointRecord& point) {
  return md::sampling(md::run_shape(point.provenance)) * point.segments();
}

md::Plan Ranges::plan_of(std::span<const PlannedPoint> points) const {
  md::Plan plan;
  plan.title = plan_.title;
  plan.element = plan_.element;
  plan.potential = plan_.potential;
  plan.structure = plan_.structure;
  plan.pair_style = plan_.pair_style;
  plan.pair_coeff = plan_.pair_coeff;
  plan.validity_pressure = plan_.validity_pressure;
  plan.seed = plan_.seed;
  plan.ranks_per_point = plan_.ranks_per_point;
  plan.folder = plan_.folder;
  plan.zero_pressure = plan_.zero_pressure;  // required by Hugoniot points; free if in the database
  for (const PlannedPoint& point : points) {
    if (point.protocol == md::PointKind::hugoniot) {
      if (!plan.hugoniot) plan.hugoniot = md::HugoniotPlan{{}, plan_.hugoniot->size, {}};
      plan.hugoniot->volume_ratio.push_back(point.volume_ratio);
    } else if (point.protocol == md::PointKind::isochore) {
      plan.isochores.push_back(
          {point.volume_ratio, {point.temperature}, nearest_isochore(point.volume_ratio).size, {}});
    } else if (point.protocol == md::PointKind::coexistence) {
      if (plan.coexistences.empty()) {
        plan.coexistences.push_back(plan_.coexistences.front());
        plan.coexistences.front().pressure.clear();
        plan.coexistences.front().first_guess.clear();
      }
      plan.coexistences.front().pressure.push_back(point.pressure);
      plan.coexistences.front().first_guess.push_back(point.temperature);
    }
  }
  return plan;
}

}  // namespace whipple::fit
