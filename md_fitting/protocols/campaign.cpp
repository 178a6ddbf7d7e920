// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/data_set/store_order.hpp"
#include "md_fitting/protocols/budget.hpp"
#include "md_fitting/protocols/point_team.hpp"
#include "md_fitting/protocols/point_text.hpp"
#include "md_fitting/protocols/shared_numbers.hpp"
#include "md_fitting/protocols/task_list.hpp"
#include "md_fitting/protocols/task_status.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"

namespace whipple::md {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::optional<PointRecord> find_point(const std::filesystem::path& store, const std::string& key) {
  if (!std::filesystem::exists(store)) return std::nullopt;
  for (PointRecord& point : read_store(store)) {
    if (point.key == key) return std::move(point);
  }
  return std::nullopt;
}

PointRecord unfinished(const Task& task) {
  PointRecord point;
  point.key = task.key;
  point.protocol = task.protocol;
  point.conditions = task.conditions;
  point.provenance = task.provenance;
  return point;
}

/// Computes one task, or one more segment of it (> 0); an error yields a failed point.
PointRecord compute_point(const Task& task, const PointRecord* dependency, int segment) {
  PointRecord point = unfinished(task);
  const auto begin = Clock::now();
  try {
    TaskResult result = segment > 0 ? task.extend(dependency, segment) : task.compute(dependency);
    for (const auto& [name, estimate] : result.results) {
      if (!std::isfinite(estimate.value) || !std::isfinite(estimate.error)) {
        throw StateError(fmt::format("{} is not finite", name));
      }
    }
    point.status = PointStatus::done;
    point.results = std::move(result.results);
    point.message = with_validity(std::move(result.message), point);
    point.blocks = std::move(result.blocks);
    point.provenance["lammps_commands"] = std::move(result.transcript);
  } catch (const LammpsError& error) {
    point.status = PointStatus::failed;
    point.message = error.what();
  } catch (const StateError& error) {
    point.status = PointStatus::failed;
    point.message = error.what();
  } catch (const InputError& error) {  // a range or a style that only this point uses
    point.status = PointStatus::failed;
    point.message = error.what();
  }
  point.wall_seconds = seconds_since(begin);
  return point;
}

/// Continues a point until it reaches the target accuracy, storing it after every segment. A segment that fails
/// leaves the stored point unchanged.
/// @param compute  computes a segment of the point
PointRecord continue_point(const Task& task, PointRecord point, const std::filesystem::path& store,
                           const std::function<PointRecord(int segment)>& compute) {
  while (wants_more(point, task.precision)) {
    const PointRecord segment = compute(point.segments());
    if (!segment.done()) {
      log::warning("{} is not continued: {}", short_label(point), segment.message);
      break;
    }
    point = join(point, segment);
    if (!append_point(store, point)) break;  // another process has stored more segments
  }
  return point;
}

/// Waits until a task is stored or given up. Returns false if the work is being stopped.
bool wait_for(std::size_t task, SharedNumbers& shared) {
  while (shared.read(SharedNumbers::stop) == 0) {
    if (shared.read(SharedNumbers::of_task(task)) != 0) return true;
    std::this_thread::sleep_for(100ms);
  }
  return false;
}

/// Counts the points of this rank, or of the team that it leads.
struct Counts {
  int computed = 0, failed = 0, blocked = 0;
};

/// Computes the orders announced by the leader of the team, until it dismisses the team.
void follow(std::span<const Task> tasks, const std::filesystem::path& store, const PointTeam& team) {
  while (const auto order = team.wait()) {
    // An exception here need not occur on the leader, which waits in the point for this rank. It terminates all ranks.
    const Task& task = tasks[static_cast<std::size_t>(order->task)];
    std::optional<PointRecord> dependency;
    if (!task.dependency.empty()) dependency = find_point(store, task.dependency);
    static_cast<void>(
        compute_point(task, dependency ? &*dependency : nullptr, static_cast<int>(order->segment)));
  }
}

/// Takes tasks from the common queue of all leaders and computes them with the team.
class Leader {
 public:
  Leader(std::span<const Task> tasks, std::span<const TaskStatus> status, std::vector<std::size_t> queue,
         const std::filesystem::path& store, const PointTeam& team)
      : tasks_(tasks),
        status_(status),
        queue_(std::move(queue)),
        store_(store),
        team_(team),
        shared_(team.leaders(), tasks.size()) {
    MPI_Comm_rank(team.leaders(), &rank_);
    if (rank_ == 0) {
      progress_.emplace("md", static_cast<double>(tasks.size()));
      progress_->start_from(static_cast<double>(tasks.size() - queue_.size()));
    }
  }

  /// Computes tasks until the queue is empty. @throws any error that prevents points from being stored; the other
  /// leaders then stop
  void work() {
    try {
      while (shared_.read(SharedNumbers::stop) == 0) {
        const long place = shared_.add(SharedNumbers::next_task, 1);
        if (place >= static_cast<long>(queue_.size())) break;
        if (!work_on(queue_[static_cast<std::size_t>(place)])) break;
      }
    } catch (...) {
      shared_.add(SharedNumbers::stop, 1);
      throw;
    }
    finished_ = Clock::now();
    // Rank 0 continues to show the progress of the others.
    while (rank_ == 0 && shared_.read(SharedNumbers::stop) == 0 &&
           shared_.read(SharedNumbers::finished) < static_cast<long>(queue_.size())) {
      show("waiting for the last points");
      std::this_thread::sleep_for(200ms);
    }
    show("done");
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] double busy() const { return busy_; }  ///< s, in points
  /// Returns the processor time (s) of this rank spent on points, by protocol.
  [[nodiscard]] const std::map<std::string, double>& processor_time() const { return processor_time_; }
  /// Returns the time (s) spent waiting for other teams, including that since the last point of this team.
  [[nodiscard]] double waiting() const { return waiting_ + seconds_since(finished_); }

 private:
  void show(const std::string& remark) {
    if (!progress_) return;
    const auto before = static_cast<double>(tasks_.size() - queue_.size());
    progress_->update(before + static_cast<double>(shared_.read(SharedNumbers::finished)), remark);
  }

  /// Returns the point that a task needs. Another team is computing it, or it is in the database, because tasks
  /// that others depend on come earlier in the queue. Returns nothing if it failed.
  std::optional<PointRecord> needed_by(const Task& task, bool& stopped) {
    const auto place = std::find_if(queue_.begin(), queue_.end(),
                                    [&](std::size_t i) { return tasks_[i].key == task.dependency; });
    const auto begin = Clock::now();
    stopped = place != queue_.end() && !wait_for(*place, shared_);
    waiting_ += seconds_since(begin);
    if (stopped) return std::nullopt;
    std::optional<PointRecord> found = find_point(store_, task.dependency);
    if (found && !found->done()) found.reset();
    return found;
  }

  void finish(std::size_t index) {
    shared_.add(SharedNumbers::of_task(index), 1);  // notifies waiting teams that the task is finished
    shared_.add(SharedNumbers::finished, 1);
  }

  /// Computes a task; returns false if the work is being stopped.
  bool work_on(std::size_t index) {
    const Task& task = tasks_[index];
    show(short_label(unfinished(task)));
    std::optional<PointRecord> dependency;
    if (!task.dependency.empty()) {
      bool stopped = false;
      dependency = needed_by(task, stopped);
      if (stopped) return false;
      if (!dependency) {
        ++counts_.blocked;
        log::warning("{} not computed: the point it depends on failed", short_label(unfinished(task)));
        finish(index);
        return true;
      }
    }
    const auto compute = [&](int segment) {
      team_.announce({static_cast<long>(index), segment});
      const double begin = processor_seconds();
      PointRecord part = compute_point(task, dependency ? &*dependency : nullptr, segment);
      processor_time_[task.protocol] += processor_seconds() - begin;
      busy_ += part.wall_seconds;
      return part;
    };
    std::optional<PointRecord> present;
    if (status_[index] == TaskStatus::to_continue) present = find_point(store_, task.key);
    PointRecord point = present ? *present : compute(0);
    if (!present && !append_point(store_, point)) {
      log::detail("{} was stored by another process meanwhile", point.label());
    }
    point = continue_point(task, std::move(point), store_, compute);
    ++(point.done() ? counts_.computed : counts_.failed);
    finish(index);
    if (point.done()) {
      log::info("{}", summarize(point));
    } else {
      log::warning("{}", summarize(point));
    }
    show(short_label(point));
    return true;
  }

  std::span<const Task> tasks_;
  std::span<const TaskStatus> status_;
  std::vector<std::size_t> queue_;
  const std::filesystem::path& store_;
  const PointTeam& team_;
  SharedNumbers shared_;
  std::optional<Progress> progress_;
  Counts counts_;
  double busy_ = 0.0, waiting_ = 0.0;
  std::map<std::string, double> processor_time_;
  Clock::time_point finished_ = Clock::now();
  int rank_ = 0;
};

/// Normalises the database on rank 0; a full disk leaves it unchanged.
void put_in_order(const std::filesystem::path& store, MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  MPI_Barrier(communicator);
  if (rank != 0) return;
  try {
    normalise_store(store);
  } catch (const InputError& error) {
    log::warning("the store stays as it is: {}", error.what());
  }
}

/// Counts the points on isotherms and isochores of a plan that have melted, on all ranks. Melting is expected in a
/// shock, so points of the Hugoniot are not counted.
int count_molten(std::span<const Task> tasks, const std::filesystem::path& store, MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  int count = 0;
  if (rank == 0 && std::filesystem::exists(store)) {
    std::set<std::string> solids;
    for (const Task& task : tasks) {
      const std::optional<PointKind> kind = value_of<PointKind>(task.protocol);
      if (kind == PointKind::isotherm || kind == PointKind::isochore) solids.insert(task.key);
    }
    try {
      for (const PointRecord& point : read_store(store)) {
        if (solids.contains(point.key) && !is_solid(point)) ++count;
      }
    } catch (const InputError& error) {
      log::warning("{}", error.what());
    }
  }
  MPI_Bcast(&count, 1, MPI_INT, 0, communicator);
  return count;
}

/// What one rank contributes to the summary.
struct Share {
  Counts counts;
  int code = 0;
  double busy = 0.0, waiting = 0.0, elapsed = 0.0;  ///< s, of the leader of a team
  std::map<std::string, double> processor_time;     ///< s, of the leader, by protocol
};

/// Computes the queue with the team of this rank.
Share compute(std::span<const Task> tasks, std::span<const TaskStatus> status, std::vector<std::size_t> queue,
              const std::filesystem::path& store, const PointTeam& team) {
  Share share;
  if (!team.leads()) {
    follow(tasks, store, team);
    return share;
  }
  Leader leader(tasks, status, std::move(queue), store, team);
  try {
    leader.work();
  } catch (const std::exception& error) {
    // The points finished so far are in the database: the error that stopped the work is not a fault of the plan.
    const bool defect = exit_code(error) == ExitCode::internal;
    share.code = static_cast<int>(defect ? ExitCode::internal : ExitCode::state);
    log::warning("the work stopped before its end: {}", error.what());
  }
  share.counts = leader.counts();
  team.dismiss();
  MPI_Barrier(team.leaders());  // the leader waits until the others have finished
  share.busy = leader.busy(), share.waiting = leader.waiting();
  share.processor_time = leader.processor_time();
  return share;
}

/// Adds up what the ranks contribute. Collective.
void sum_over_ranks(Share own, std::span<const Task> tasks, int ranks_per_point, MPI_Comm communicator,
                    CampaignSummary& summary) {
  const std::array<int, 3> counts = {own.counts.computed, own.counts.failed, own.counts.blocked};
  std::array<int, 3> total{};
  MPI_Allreduce(counts.data(), total.data(), 3, MPI_INT, MPI_SUM, communicator);
  MPI_Allreduce(&own.code, &summary.code, 1, MPI_INT, MPI_MAX, communicator);
  summary.computed = total[0], summary.failed = total[1], summary.blocked = total[2];
  const std::array<double, 3> times = {own.busy, own.waiting, own.elapsed};
  std::array<double, 3> all{};
  MPI_Allreduce(times.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, communicator);
  summary.busy = all[0], summary.waiting = all[1], summary.elapsed = all[2];
  for (const Task& task : tasks) summary.processor_time[task.protocol] = 0.0;
  for (auto& [protocol, seconds] : summary.processor_time) {
    // The ranks of a team compute, or wait in a busy loop, as long as their leader.
    const double own_seconds = ranks_per_point * own.processor_time[protocol];
    MPI_Allreduce(&own_seconds, &seconds, 1, MPI_DOUBLE, MPI_SUM, communicator);
  }
  std::erase_if(summary.processor_time, [](const auto& each) { return each.second == 0.0; });
}

}  // namespace

CampaignSummary run_campaign(std::span<const Task> tasks, const std::filesystem::path& store,
                             MPI_Comm communicator, bool retry_failed, int ranks_per_point) {
  const auto begin = Clock::now();
  const PointTeam team(communicator, ranks_per_point);
  const std::vector<TaskStatus> status = read_status(tasks, store, communicator);
  CampaignSummary summary;
  std::vector<std::size_t> queue;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (status[i] == TaskStatus::done) {
      ++summary.present;
    } else if (status[i] == TaskStatus::failed && !retry_failed) {
      ++summary.left;
    } else {
      queue.push_back(i);
    }
  }
  if (!queue.empty()) {
    Share own = compute(tasks, status, std::move(queue), store, team);
    put_in_order(store, communicator);
    if (team.leads()) own.elapsed = seconds_since(begin);
    sum_over_ranks(std::move(own), tasks, ranks_per_point, communicator, summary);
  } else {
    put_in_order(store, communicator);  // an earlier call may have been killed before it did so
  }
  summary.molten = count_molten(tasks, store, communicator);
  return summary;
}

}  // namespace whipple::md
