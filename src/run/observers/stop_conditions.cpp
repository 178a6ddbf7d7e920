// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/stop_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/input/document.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::run {
namespace {

constexpr std::int64_t steps_between_looks = 10;

std::string key(std::size_t condition, const char* name) {
  return fmt::format("stop.{}.{}", condition, name);
}

/// Returns all of a condition in words, to tell it from others.
std::string identity(const cases::Stop& stop) {
  return fmt::format("{} after {} s\n", stop.in_words(), stop.after);
}

/// Returns whether a condition is looked at in snapshots.
bool is_of_wall(const cases::Stop& stop) {
  return stop.when == cases::StopWhen::perforated || stop.when == cases::StopWhen::decided;
}

}  // namespace

void require_known_columns(const cases::Case& setup,
                           const std::vector<std::pair<std::string, std::string>>& overrides) {
  std::vector<InputFault> faults;
  for (std::size_t s = 0; s < setup.stops.size(); ++s) {
    const std::string& column = setup.stops[s].column;
    if (column.empty()) continue;
    std::vector<std::string> names;
    for (const HistoryColumn& known : history_columns(setup)) names.push_back(known.name);
    if (std::ranges::count(names, column) > 0) continue;
    faults.push_back({.key = key(s, "column"),
                      .text = fmt::format("'column': history.csv has no column \"{}\"{} (accepted: {})",
                                          column, did_you_mean(column, names), fmt::join(names, ", "))});
  }
  if (faults.empty()) return;
  input::Document document = input::Document::from_file(setup.file);  // knows the lines
  for (const auto& [key, value] : overrides) document.set(key, value);
  document.add(std::move(faults));
  document.finish_partly_read();
}

StopConditions::StopConditions(const cases::Case& setup, const io::RunDirectory& directory,
                               Snapshots& snapshots, const io::Ranks& ranks)
    : setup_(setup),
      folder_(directory.path()),
      snapshots_(snapshots),
      ranks_(ranks),
      seen_(setup.stops.size()),
      walls_(setup.stops.size()),
      judges_(setup.stops.size()) {
  for (HistoryColumn& column : history_columns(setup)) {
    for (std::size_t s = 0; s < seen_.size(); ++s)
      if (setup.stops[s].column == column.name) seen_[s].column = column;
  }
}

void StopConditions::resume(const Moment& moment, const io::CheckpointValues& values) {
  // A checkpoint of a run that had no conditions, or other ones, tells nothing about these: they begin here.
  if (!values.integers.contains("stop.conditions") || values.integer("stop.conditions") != conditions()) {
    look_at_sums(moment);
    return;
  }
  found_ = static_cast<int>(values.integer("stop.found"));
  before_ = now_ = values.real("stop.wall_time");
  for (std::size_t s = 0; s < seen_.size(); ++s) {
    seen_[s].was_above = values.integer(key(s, "was_above")) != 0;
    seen_[s].largest = values.real(key(s, "largest"));
    seen_[s].times = values.array(key(s, "times"));
    seen_[s].values = values.array(key(s, "values"));
  }
}

int StopConditions::ended_by(const cases::Case& setup, const io::CheckpointValues& values) {
  const auto text = values.texts.find("stop.ended_by");
  if (text == values.texts.end()) return 0;
  const auto stop = std::ranges::find(setup.stops, text->second, identity);
  return stop == setup.stops.end() ? 0 : static_cast<int>(stop - setup.stops.begin()) + 1;
}

std::int64_t StopConditions::conditions() const {
  std::string words;
  for (const cases::Stop& stop : setup_.stops) words += identity(stop);
  return seed_from(sha256(words));
}

void StopConditions::remember(io::CheckpointValues& values) {
  if (seen_.empty()) return;
  values.integers["stop.conditions"] = conditions();
  values.integers["stop.found"] = found_;
  if (ended_ > 0)
    values.texts["stop.ended_by"] = identity(setup_.stops[static_cast<std::size_t>(ended_ - 1)]);
  // All ranks write the same values: the clock of the first one counts.
  values.reals["stop.wall_time"] = std::stod(ranks_.broadcast(fmt::format("{}", now_)));
  for (std::size_t s = 0; s < seen_.size(); ++s) {
    values.integers[key(s, "was_above")] = seen_[s].was_above ? 1 : 0;
    values.reals[key(s, "largest")] = seen_[s].largest;
    values.arrays[key(s, "times")] = seen_[s].times;
    values.arrays[key(s, "values")] = seen_[s].values;
  }
}

void StopConditions::after_step(const Moment& moment) {
  now_ = before_ + moment.wall_time;
  ended_ = moment.requests.condition;
  if (moment.paused || found_ > 0 || moment.requests.condition > 0) return;
  look(moment);
}

void StopConditions::look_at_sums(const Moment& moment) {
  for (std::size_t s = 0; s < seen_.size() && found_ == 0; ++s) {
    if (holds(setup_.stops[s], seen_[s], moment) && moment.time() >= setup_.stops[s].after)
      found_ = static_cast<int>(s) + 1;
  }
}

void StopConditions::look(const Moment& moment) {
  if (moment.is_due(static_cast<double>(steps_between_looks))) look_at_sums(moment);
  const bool asks_for_walls = std::ranges::any_of(
      setup_.stops, [&](const cases::Stop& stop) { return is_of_wall(stop) && moment.time() >= stop.after; });
  if (!asks_for_walls) return;
  const std::int64_t last = snapshots_.complete_last();
  if (last == judged_ || last < 0) return;
  judged_ = last;
  ranks_.on_root([&] { look_at_walls(); });
  found_ = std::stoi(ranks_.broadcast(fmt::format("{}", found_)));
}

void StopConditions::ask(const Moment& /*moment*/, Requests& requests) const {
  requests.condition = std::max(requests.condition, found_);
  for (std::size_t s = 0; s < seen_.size() && requests.condition == 0; ++s) {
    const cases::Stop& stop = setup_.stops[s];
    if (stop.when == cases::StopWhen::wall_time && now_ >= stop.wall_time)
      requests.condition = static_cast<int>(s) + 1;
  }
}

/// Returns whether a condition on sums over all ranks holds. Collective.
bool StopConditions::holds(const cases::Stop& stop, Seen& seen, const Moment& moment) {
  const auto fell_below = [&](double value, double limit) {
    seen.was_above = seen.was_above || value > limit;
    return seen.was_above && value < limit;
  };
  switch (stop.when) {
    case cases::StopWhen::speed_below: {
      const Motion motion = motion_of(moment.simulation, body_of(stop));
      return motion.mass > 0.0 && fell_below(motion.momentum.norm() / motion.mass, stop.speed);
    }
    case cases::StopWhen::energy_below:
      return fell_below(motion_of(moment.simulation, body_of(stop)).energy, stop.energy);
    case cases::StopWhen::settled:
      return has_settled(stop, seen, moment.time(), seen.column->value(HistorySource(moment.simulation)));
    case cases::StopWhen::perforated:
    case cases::StopWhen::decided:
    case cases::StopWhen::wall_time:
      break;
  }
  return false;
}

bool StopConditions::has_settled(const cases::Stop& stop, Seen& seen, double time, double value) const {
  seen.largest = std::max(seen.largest, std::abs(value));
  seen.times.push_back(time);
  seen.values.push_back(value);
  // Keeps one entry at or before the begin of the window, so that the entries span all of it.
  std::size_t passed = 0;
  while (passed + 1 < seen.times.size() && seen.times[passed + 1] <= time - stop.over) ++passed;
  const auto count = static_cast<std::ptrdiff_t>(passed);
  seen.times.erase(seen.times.begin(), seen.times.begin() + count);
  seen.values.erase(seen.values.begin(), seen.values.begin() + count);
  if (time - seen.times.front() < stop.over || !(seen.largest > 0.0)) return false;
  const auto [least, most] = std::ranges::minmax(seen.values);
  return most - least <= stop.change * seen.largest;
}

/// Sets up the walls by the first snapshot.
void StopConditions::begin_walls() {
  const analysis::Snapshot first = analysis::read_snapshot(run_->snapshots.front());
  const analysis::Frame frame = analysis::find_frame(*run_, first);
  for (std::size_t s = 0; s < walls_.size(); ++s) {
    if (!is_of_wall(setup_.stops[s])) continue;
    walls_[s].emplace(*run_, first, frame, body_of(setup_.stops[s]));
    const std::string reason = walls_[s]->look(first).undecided;
    if (!reason.empty()) log::warning("whether {} cannot be decided: {}", setup_.stops[s].in_words(), reason);
    if (setup_.stops[s].when == cases::StopWhen::decided) judges_[s].emplace(*run_, first, frame, *walls_[s]);
  }
}

/// Judges the last snapshot, on the first rank; outcomes, which depend on the past, with all that were not judged yet.
void StopConditions::look_at_walls() {
  const analysis::Run run = analysis::read_run(folder_);
  if (!run_) {
    run_ = run;
    begin_walls();
  }
  const bool past_matters = std::ranges::any_of(judges_, [](const auto& judge) { return judge.has_value(); });
  const std::size_t from = past_matters ? fed_ : run.snapshots.size() - 1;
  fed_ = run.snapshots.size();
  for (std::size_t k = from; k < run.snapshots.size() && found_ == 0; ++k) {
    const analysis::Snapshot now = analysis::read_snapshot(run.snapshots[k]);
    for (std::size_t s = 0; s < walls_.size() && found_ == 0; ++s) {
      if (!walls_[s]) continue;
      const analysis::Wall::Remains left = walls_[s]->look(now);
      if (judges_[s]) judges_[s]->add(now, left);
      const bool holds = judges_[s] ? judges_[s]->decided() : left.undecided.empty() && !left.closed;
      if (holds && now.time >= setup_.stops[s].after) found_ = static_cast<int>(s) + 1;
    }
  }
}

/// Sums mass, momentum and kinetic energy of a body. Collective.
StopConditions::Motion StopConditions::motion_of(const solver::Simulation& simulation, std::size_t body) {
  std::array<double, 5> sums = {};
  for (const solver::Carrier* carrier : simulation.carriers()) {
    carrier->for_each_point([&](const solver::Point& point) {
      if (point.body != body) return;
      sums[0] += point.mass;
      sums[1] += 0.5 * point.mass * point.velocity.squaredNorm();
      for (std::size_t a = 0; a < 3; ++a) sums[2 + a] += point.mass * point.velocity[static_cast<int>(a)];
    });
  }
  parallel::sum(simulation.communicator(), sums);
  return {.mass = sums[0], .energy = sums[1], .momentum = Vector3(sums[2], sums[3], sums[4])};
}

std::size_t StopConditions::body_of(const cases::Stop& stop) const {
  return static_cast<std::size_t>(std::ranges::find(setup_.bodies, stop.body, &cases::Body::name) -
                                  setup_.bodies.begin());
}

}  // namespace whipple::run
