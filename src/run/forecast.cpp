// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/forecast.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/material/fluid.hpp"
#include "src/solver/carriers/domains.hpp"

namespace whipple::run {
namespace {

/// Bounds the ratio of the initially allowed step to the mean step, without the initial growth: 0.58 to 1.22 in the
/// cases of the repository, more where elements are crushed.
constexpr double fewest_steps = 0.55, most_steps = 1.3;
/// Bounds the change of cost: contact, melting and failure make a step more expensive than initially, free flight makes
/// it cheaper.
constexpr double cheapest = 0.5, dearest = 2.0;
constexpr double usual_steps = 0.85;
constexpr double beside_steps = 2.0;  // s, at most: reading, tables, writing in small runs

/// Sets by how many layers of blocks activation precedes motion: whole blocks, and one further layer.
constexpr int layers_of_blocks = 2;

// Minimum number of steps and minimum time, because only many steps include an undisturbed one on a shared machine;
// maximum time.
constexpr int calibration_steps = 5;
constexpr double least_calibration = 0.25, calibration_time = 1.0;  // s
constexpr std::size_t samples = 20000;                              // of this rank, for the active fraction

struct Box {
  Vector3 lower = Vector3::Constant(1e300), upper = Vector3::Constant(-1e300);

  void include(const Vector3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  [[nodiscard]] bool empty() const { return !(lower.x() <= upper.x()); }
  /// Computes the gap along each axis, 0 where the boxes overlap; m.
  [[nodiscard]] Vector3 gap_to(const Box& b) const {
    return (b.lower - upper).cwiseMax(lower - b.upper).cwiseMax(Vector3::Zero());
  }
};

/// Estimates the mean active fraction of the particles and nodes over the run. Collective.
double moving_share(const solver::Simulation& s) {
  const cases::Case& setup = s.setup();
  if (s.next_event() <= s.state().time) return 1.0;  // nothing stays at rest
  const std::size_t count = s.bodies().size();
  std::vector<Box> moving(count);
  double fastest = 0.0, points = 0.0;
  const auto is_active = [](const solver::Point& point) {
    return point.is_stressed || !point.velocity.isZero(0.0);
  };
  const auto for_each_point = [&](const std::function<void(const solver::Point& point)>& visit) {
    for (const solver::Carrier* carrier : s.carriers()) carrier->for_each_point(visit);
  };
  for_each_point([&](const solver::Point& point) {
    points += 1.0;
    fastest = std::max(fastest, point.velocity.norm());
    if (is_active(point)) moving[point.body].include(point.position);
  });
  std::vector<double> extremes(6 * count + 1, fastest);
  for (std::size_t b = 0; b < count; ++b) {
    Vector3::Map(&extremes[6 * b]) = -moving[b].lower;
    Vector3::Map(&extremes[6 * b + 3]) = moving[b].upper;
  }
  parallel::maximum(s.communicator(), extremes);
  std::vector<Box> sources;
  for (std::size_t b = 0; b < count; ++b) {
    const Box box = {-Vector3::Map(&extremes[6 * b]), Vector3::Map(&extremes[6 * b + 3])};
    if (!box.empty()) sources.push_back(box);
  }
  if (sources.empty()) return 1.0;
  fastest = extremes.back();
  const auto every = std::max<std::size_t>(1, static_cast<std::size_t>(points) / samples);
  std::size_t seen = 0;
  std::array<double, 2> sums = {0.0, 0.0};  // fraction, points
  for_each_point([&](const solver::Point& point) {
    if (seen++ % every != 0) return;
    double way = std::numeric_limits<double>::infinity();
    Box here;
    here.include(point.position);
    for (const Box& source : sources) way = std::min(way, here.gap_to(source).norm());
    if (is_active(point)) way = 0.0;
    way = std::max(0.0, way - layers_of_blocks * s.grid().block_shape().edge * setup.domain.cell_size);
    // Each point stands for those that were skipped, on this rank.
    const auto weight = static_cast<double>(every);
    sums[0] += weight * std::max(0.0, 1.0 - way / (std::max(point.sound_speed, fastest) * setup.time.end));
    sums[1] += weight;
  });
  parallel::sum(s.communicator(), sums);
  return sums[1] > 0.0 ? sums[0] / sums[1] : 1.0;
}

/// Counts the steps up to a time if the first step is `first_step` times the allowed one and each grows by
/// `maximum_growth`.
double growing_steps(const cases::TimeControl& control, double time, double allowed) {
  const double first = control.first_step * allowed, growth = control.maximum_growth;
  if (!(first < allowed)) return time / allowed;
  if (!(growth > 1.0)) return time / first;
  const double grown = (allowed - first) / (growth - 1.0);  // duration of the smaller steps
  if (time < grown) return std::log1p(time * (growth - 1.0) / first) / std::log(growth);
  return std::log(allowed / first) / std::log(growth) + (time - grown) / allowed;
}

/// Counts the steps if steps also end at the times of snapshots.
double steps_between_snapshots(double steps, double snapshots) {
  return snapshots * std::ceil(steps / snapshots);
}

}  // namespace

SplittingForecast forecast_splitting(const solver::Simulation& s) {
  const cases::Case& setup = s.setup();
  const cases::Splitting& splitting = setup.splitting;
  SplittingForecast result;
  const double pieces = std::exp2(static_cast<double>(splitting.maximum_generations));
  std::array<double, 1> most = {0.0};
  bool any = false;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material& material = *setup.materials[b];
    const bool divided = solver::domains::may_divide(setup, b);
    any = any || divided;
    result.fluid_from_start =
        result.fluid_from_start || (divided && (fluidity(material) == Fluidity::always || material.burns()));
    most[0] += (divided ? pieces : 1.0) * static_cast<double>(s.bodies()[b].count);
  }
  parallel::sum(s.communicator(), most);
  if (!any) return result;
  result.generations = static_cast<double>(splitting.maximum_generations);
  result.most_particles = std::max(static_cast<double>(s.particle_count()),
                                   std::min(most[0], static_cast<double>(splitting.maximum_particles)));
  return result;
}

/// Returns the least and the greatest number of steps that the time step allows.
static std::pair<double, double> steps_with_inertia(solver::Simulation& s) {
  const cases::TimeControl& control = s.setup().time;
  const double end = control.end, allowed = s.accurate_time_step();
  const double least = growing_steps(control, end, allowed / fewest_steps);
  double most = growing_steps(control, end, allowed / most_steps);
  // The step size restarts at a small value when bodies come into contact: at most once per further body.
  most += static_cast<double>(s.bodies().size() - 1) * (most - end / allowed * most_steps);
  return {least, most};
}

/// Returns the number of load steps, and twice as many: how many are halved is not known.
static std::pair<double, double> load_steps(const solver::Simulation& s) {
  const auto steps = static_cast<double>(s.setup().quasi_static.steps);
  return {steps, 2.0 * steps};
}

Forecast forecast(solver::Simulation& s) {
  const cases::TimeControl& control = s.setup().time;
  const double end = control.end;
  const auto [least, most] = cases::has_inertia(control.scheme) ? steps_with_inertia(s) : load_steps(s);
  const double every = s.setup().output.snapshot_every;
  const double snapshots = every > 0.0 ? std::ceil(end / every * (1.0 - 1e-9)) : 1.0;
  Forecast result;
  result.least_steps = std::max(std::ceil(least), snapshots);
  result.most_steps = steps_between_snapshots(most, snapshots);
  result.moving_share = moving_share(s);
  const auto carriers = [&s] {
    return std::max(static_cast<double>(s.particle_count() + s.element_count()), 1.0);
  };
  const double at_start = carriers();
  s.advance(end);  // allocates the blocks
  using Clock = std::chrono::steady_clock;
  double quickest = std::numeric_limits<double>::infinity(), spent = 0.0;
  for (int step = 0; (step < calibration_steps || spent < least_calibration) && s.state().time < end &&
                     spent < calibration_time;
       ++step) {
    const auto begin = Clock::now();
    s.advance(end);
    const double taken = std::chrono::duration<double>(Clock::now() - begin).count();
    quickest = std::min(quickest, taken / carriers());  // other processes can only add to the time
    spent = parallel::maximum(s.communicator(), spent + taken);
  }
  if (!std::isfinite(quickest)) quickest = 0.0;
  quickest = parallel::maximum(s.communicator(), quickest);
  result.nanoseconds = 1e9 * quickest;
  const double of_step = quickest * at_start * result.moving_share;
  result.least_time = cheapest * usual_steps / fewest_steps * result.least_steps * of_step;
  result.most_time = dearest * usual_steps / most_steps * result.most_steps * of_step + beside_steps;
  return result;
}

}  // namespace whipple::run
