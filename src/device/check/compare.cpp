// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/compare.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

namespace whipple::device::check {
namespace {

/// Components that belong together, with their name.
struct Group {
  const char* name;
  std::uint32_t first, count = 1;
};
constexpr std::array groups = {Group{"position", position, 3},
                               Group{"velocity", velocity, 3},
                               Group{"affine field", affine, 9},
                               Group{"deviatoric stress", deviator, 6},
                               Group{"extent", extent, 6},
                               Group{"mass", mass},
                               Group{"volume", volume},
                               Group{"void volume", void_volume},
                               Group{"energy", energy},
                               Group{"pressure", pressure},
                               Group{"artificial viscosity", artificial_viscosity},
                               Group{"heating viscosity", heating_viscosity},
                               Group{"temperature", temperature},
                               Group{"sound speed", sound_speed},
                               Group{"plastic strain", plastic_strain},
                               Group{"melted fraction", melted},
                               Group{"vaporised fraction", vaporised},
                               Group{"failure", failed},
                               Group{"maximum pressure", maximum_pressure},
                               Group{"maximum temperature", maximum_temperature},
                               Group{"melting time", melting_time},
                               Group{"threshold factor", threshold_factor},
                               Group{"unresolved energy", unresolved},
                               Group{"heat allowance", allowance},
                               Group{"closing rate", closing_rate},
                               Group{"damage", damage},
                               Group{"fragment size", fragment_size},
                               Group{"cold work", cold_work},
                               Group{"generation", generation}};

double largest_magnitude(const PointsOnHost& points, const Group& group) {
  double largest = 0.0;
  for (std::uint32_t c = group.first; c < group.first + group.count; ++c) {
    for (const double x : points.numbers[c]) largest = std::max(largest, std::fabs(x));
  }
  return largest;
}

/// Returns x over a scale; infinity unless it is a number.
double relative(double x, double scale) {
  if (!std::isfinite(x)) return INFINITY;
  return scale > 0.0 ? x / scale : x;
}

void sort(std::vector<Difference>& list) {
  std::ranges::stable_sort(list, std::ranges::greater{}, &Difference::of_bound);
}

bool is_within(const std::vector<Difference>& sorted) {
  return sorted.empty() || sorted.front().of_bound() <= 1.0;
}

/// A run of a state.
struct Steps {
  Result first, last;
  double seconds = 0.0;
};

Totals totals_of(Engine& engine) {
  const EndOfStep measured = engine.measure();
  Totals totals{};
  std::copy_n(measured.sum.begin(), stored_sums, totals.begin());
  return totals;
}

/// Sorts particles by origin.
PointsOnHost sorted(const PointsOnHost& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&](std::uint32_t p) { return points.origin[p]; });
  PointsOnHost result;
  for (const std::uint32_t p : order) {
    result.body.push_back(points.body[p]);
    result.origin.push_back(points.origin[p]);
  }
  for (std::size_t c = 0; c < state_components; ++c) {
    result.numbers[c].reserve(points.size());
    for (const std::uint32_t p : order) result.numbers[c].push_back(points.numbers[c][p]);
  }
  return result;
}

Steps run(const StoredState& state, const MakeEngine& make, std::size_t steps) {
  const auto engine = make(state.problem, state.start);
  Steps all;
  const auto perform = [&](std::size_t from, std::size_t to) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = from; i < to; ++i) {
      engine->step({.dt = state.steps[i].dt,
                    .end = state.steps[i].end,
                    .acceleration = {},
                    .least_closing_speed = 0.0,
                    .looks_at_fill = i % 20 == 0,
                    .sorts = i % 20 == 0});
    }
    all.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  perform(0, 1);
  all.first.totals = totals_of(*engine);
  PointsOnHost points;
  engine->download(points);
  const std::vector<std::uint32_t> of_start = points.origin;  // places in this download are the next origins
  all.first.points = sorted(points);
  perform(1, steps);
  all.last.totals = totals_of(*engine);
  engine->download(points);
  for (std::uint32_t& origin : points.origin) origin = of_start[origin];
  all.last.points = sorted(points);
  return all;
}

bool same_bits(const PointsOnHost& a, const PointsOnHost& b) {
  if (a.body != b.body || a.origin != b.origin) return false;
  for (std::size_t c = 0; c < state_components; ++c) {
    if (std::memcmp(a.numbers[c].data(), b.numbers[c].data(), a.size() * sizeof(double)) != 0) return false;
  }
  return true;
}

}  // namespace

std::vector<Difference> differences(const PointsOnHost& points, const PointsOnHost& expected,
                                    const Bounds& bounds) {
  if (points.origin != expected.origin || points.body != expected.body)
    return {{"particles", 1.0, bounds.all}};
  std::vector<Difference> list;
  for (const Group& group : groups) {
    const double scale = largest_magnitude(expected, group);
    const bool flows = group.first == deviator || group.first == plastic_strain;
    Difference of = {group.name, 0.0, flows ? bounds.flow : bounds.all};
    for (std::uint32_t c = group.first; c < group.first + group.count; ++c) {
      for (std::size_t p = 0; p < points.size(); ++p) {
        of.largest =
            std::max(of.largest, relative(std::fabs(points.numbers[c][p] - expected.numbers[c][p]), scale));
      }
    }
    if (of.largest > 0.0) list.push_back(of);
  }
  sort(list);
  return list;
}

std::vector<Difference> differences(const Totals& totals, const Totals& expected, const Problem& problem,
                                    const Bounds& bounds) {
  using S = StepSums;
  const double energy = std::fabs(expected[S::kinetic]) + std::fabs(expected[S::affine_kinetic]) +
                        std::fabs(expected[S::internal]) + std::fabs(expected[S::unresolved_]);
  double length = 0.0;
  const std::array<double, 3> lower = {problem.lower.x, problem.lower.y, problem.lower.z};
  for (std::size_t a = 0; a < 3; ++a) {
    length =
        std::max({length, std::fabs(lower[a]), std::fabs(lower[a] + problem.cells[a] * problem.cell_size)});
  }
  std::vector<Difference> list;
  const auto of = [&](const char* name, std::size_t first, std::size_t count, double scale) {
    Difference found = {name, 0.0, bounds.all};
    for (std::size_t k = first; k < first + count; ++k)
      found.largest = std::max(found.largest, relative(std::fabs(totals[k] - expected[k]), scale));
    if (found.largest > 0.0) list.push_back(found);
  };
  of("mass", S::total_mass, 1, expected[S::total_mass]);
  of("momentum", S::momentum, 3, expected[S::momentum_scale]);
  of("angular momentum", S::angular_momentum, 3, length * expected[S::momentum_scale]);
  of("kinetic energy", S::kinetic, 1, energy);
  of("affine kinetic energy", S::affine_kinetic, 1, energy);
  of("internal energy", S::internal, 1, energy);
  of("unresolved energy", S::unresolved_, 1, energy);
  sort(list);
  return list;
}

bool Comparison::passes() const {
  return is_within(first) && is_within(first_sums) && is_within(last) && is_within(last_sums) && repeats;
}

Comparison compare(const StoredState& state, const MakeEngine& make, std::size_t steps, bool twice) {
  Comparison result;
  result.steps = std::min(steps, state.steps.size());
  const Steps once = run(state, make, result.steps);
  result.seconds = once.seconds;
  result.first = differences(once.first.points, state.first.points, bounds_of_first);
  result.first_sums = differences(once.first.totals, state.first.totals, state.problem, bounds_of_first);
  if (result.steps == state.steps.size()) {
    result.last = differences(once.last.points, state.last.points, bounds_of_last);
    result.last_sums = differences(once.last.totals, state.last.totals, state.problem, bounds_of_last);
  }
  result.twice = twice;
  if (!twice) return result;
  const Steps again = run(state, make, result.steps);
  result.repeats = same_bits(once.first.points, again.first.points) &&
                   same_bits(once.last.points, again.last.points) && once.last.totals == again.last.totals;
  return result;
}

}  // namespace whipple::device::check
