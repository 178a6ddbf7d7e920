// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <thread>

#include "src/base/error.hpp"
#include "src/base/log.hpp"
#include "src/base/progress.hpp"
#include "src/base/units.hpp"

namespace whipple::md {
namespace {

using namespace std::chrono_literals;

/// Whole numbers that all ranks can change at any time (one-sided communication), kept by rank 0.
class SharedNumbers {
 public:
  enum Index : MPI_Aint { next_task, finished, stop, first_task };

  /// @param tasks numbers of its own for each task: whether its turn is over
  SharedNumbers(MPI_Comm communicator, std::size_t tasks) {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    const MPI_Aint count = first_task + static_cast<MPI_Aint>(tasks);
    const MPI_Aint bytes = rank == 0 ? count * static_cast<MPI_Aint>(sizeof(long)) : 0;
    long* memory = nullptr;
    MPI_Win_allocate(bytes, sizeof(long), MPI_INFO_NULL, communicator, &memory, &window_);
    MPI_Win_lock_all(0, window_);
    if (rank == 0) std::fill(memory, memory + count, 0L);
    MPI_Win_sync(window_);
    MPI_Barrier(communicator);
  }
  SharedNumbers(const SharedNumbers&) = delete;
  SharedNumbers& operator=(const SharedNumbers&) = delete;
  ~SharedNumbers() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  /// Adds and returns the former value.
  long add(MPI_Aint index, long increment) {
    long former = 0;
    MPI_Fetch_and_op(&increment, &former, MPI_LONG, 0, index, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return former;
  }
  long read(MPI_Aint index) { return add(index, 0); }
  static MPI_Aint of_task(std::size_t task) { return first_task + static_cast<MPI_Aint>(task); }

 private:
  MPI_Win window_ = MPI_WIN_NULL;
};

std::optional<PointRecord> find_point(const std::filesystem::path& store, const std::string& key) {
  if (!std::filesystem::exists(store)) return std::nullopt;
  for (PointRecord& point : read_store(store)) {
    if (point.key == key) return std::move(point);
  }
  return std::nullopt;
}

/// What rank 0 finds in the store, told to all: 'd' done, 'c' done but to be continued, 'f' failed, ' '
/// missing, one letter per task.
std::string read_status(std::span<const Task> tasks, const std::filesystem::path& store,
                        MPI_Comm communicator, int rank) {
  std::string status(tasks.size(), ' ');
  std::string fault;
  if (rank == 0) {
    try {
      std::map<std::string, PointRecord> found;
      if (std::filesystem::exists(store)) {
        for (PointRecord& point : read_store(store)) found[point.key] = std::move(point);
      }
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const auto known = found.find(tasks[i].key);
        if (known == found.end()) continue;
        if (!known->second.done()) {
          status[i] = 'f';
        } else {
          status[i] = wants_more(known->second, tasks[i].precision) ? 'c' : 'd';
        }
      }
    } catch (const InputError& error) {
      fault = error.what();
    }
  }
  int length = static_cast<int>(fault.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
  fault.resize(static_cast<std::size_t>(length));
  MPI_Bcast(fault.data(), length, MPI_CHAR, 0, communicator);
  if (length > 0) throw InputError(fault);
  MPI_Bcast(status.data(), static_cast<int>(status.size()), MPI_CHAR, 0, communicator);
  return status;
}

PointRecord unfinished(const Task& task) {
  PointRecord point;
  point.key = task.key;
  point.protocol = task.protocol;
  point.conditions = task.conditions;
  point.provenance = task.provenance;
  return point;
}

/// Computes one task, or one more segment of it (> 0); what goes wrong in it becomes a failed point.
PointRecord compute_point(const Task& task, const PointRecord* dependency, int segment) {
  PointRecord point = unfinished(task);
  const auto begin = std::chrono::steady_clock::now();
  try {
    TaskResult result = segment > 0 ? task.extend(dependency, segment) : task.compute(dependency);
    for (const auto& [name, estimate] : result.results) {
      if (!std::isfinite(estimate.value) || !std::isfinite(estimate.error)) {
        throw StateError(fmt::format("{} is not finite", name));
      }
    }
    point.status = "done";
    point.message = std::move(result.message);
    point.results = std::move(result.results);
    point.provenance["lammps_commands"] = std::move(result.transcript);
  } catch (const LammpsError& error) {
    point.status = "failed";
    point.message = error.what();
  } catch (const StateError& error) {
    point.status = "failed";
    point.message = error.what();
  } catch (const InputError& error) {  // a range or a style that only this point asks for
    point.status = "failed";
    point.message = error.what();
  }
  point.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return point;
}

/// Continues a point until it is as exact as wanted, storing it after every segment. A segment that fails
/// leaves what is there.
PointRecord continue_point(const Task& task, const PointRecord* dependency, PointRecord point,
                           const std::filesystem::path& store) {
  while (wants_more(point, task.precision)) {
    const PointRecord segment = compute_point(task, dependency, point.segments());
    if (!segment.done()) {
      log::warning("{} is not continued: {}", short_label(point), segment.message);
      break;
    }
    point = join(point, segment);
    if (!append_point(store, point)) break;  // another process went further
  }
  return point;
}

/// Waits until the turn of a task is over: stored, or given up. False: the work is being stopped.
bool wait_for(std::size_t task, SharedNumbers& shared) {
  while (shared.read(SharedNumbers::stop) == 0) {
    if (shared.read(SharedNumbers::of_task(task)) != 0) return true;
    std::this_thread::sleep_for(100ms);
  }
  return false;
}

struct UsualUnit {
  const char* si;
  const char* usual;
};
constexpr std::array usual_units = {UsualUnit{"Pa", "GPa"},     UsualUnit{"J/kg", "MJ/kg"},
                                    UsualUnit{"m", "angstrom"}, UsualUnit{"m^3/kg", "cm^3/g"},
                                    UsualUnit{"m/s", "km/s"},   UsualUnit{"m^2", "angstrom^2"}};

}  // namespace

std::string format_result(const std::string& quantity, const Estimate& estimate) {
  std::string unit(unit_of(quantity));
  double factor = 1.0;
  for (const UsualUnit& one : usual_units) {
    if (unit == one.si) {
      factor = units::convert(1.0, one.si, one.usual);
      unit = one.usual;
      break;
    }
  }
  const double value = factor * estimate.value;
  const double error = factor * estimate.error;
  const std::string tail = unit.empty() ? "" : " " + unit;
  // Errors below the digits of the value are those of a root search, not of a measurement.
  if (!(error > 0.5e-6 * std::abs(value))) return fmt::format("{} = {:.7g}{}", quantity, value, tail);
  // Two digits of the error, but no more than seven of the value: a lattice constant is known to any digit.
  const int digits_of_value =
      6 - static_cast<int>(std::floor(std::log10(std::fmax(std::abs(value), 1e-300))));
  const int digits_of_error = 1 - static_cast<int>(std::floor(std::log10(error)));
  const int decimals = std::clamp(std::min(digits_of_error, digits_of_value), 0, 12);
  return fmt::format("{} = {:.{}f} +- {:.{}f}{}", quantity, value, decimals, error, decimals, tail);
}

std::string short_label(const PointRecord& point) {
  std::string text = point.protocol;
  const char* joint = " at ";
  for (const auto& [name, value] : point.conditions) {
    text += joint + format_result(name, {value, 0.0});
    joint = ", ";
  }
  return text;
}

std::string summarize(const PointRecord& point) {
  std::string text = short_label(point);
  if (!point.done()) return fmt::format("{} FAILED: {}", text, point.message);
  const char* joint = ": ";
  for (const auto& [name, estimate] : point.results) {
    if (name == "solid" || name == "error_correlation") continue;
    text += joint + format_result(name, estimate);
    joint = ", ";
  }
  if (!point.message.empty()) text += " (" + point.message + ")";
  return text + fmt::format(" [{:.1f} s]", point.wall_seconds);
}

CampaignSummary run_campaign(std::span<const Task> tasks, const std::filesystem::path& store,
                             MPI_Comm communicator, bool retry_failed) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  const std::string status = read_status(tasks, store, communicator, rank);
  CampaignSummary summary;
  std::vector<std::size_t> queue;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (status[i] == 'd') {
      ++summary.present;
    } else if (status[i] == 'f' && !retry_failed) {
      ++summary.left;
    } else {
      queue.push_back(i);
    }
  }
  if (queue.empty()) return summary;
  const auto place_of = [&](const std::string& key) {
    return std::find_if(queue.begin(), queue.end(), [&](std::size_t i) { return tasks[i].key == key; });
  };

  std::string fault;
  std::array<int, 3> counts{};  // computed, failed, blocked by this rank
  {
    SharedNumbers shared(communicator, tasks.size());
    std::optional<Progress> progress;
    if (rank == 0) {
      progress.emplace("md", static_cast<double>(tasks.size()));
      progress->start_from(static_cast<double>(tasks.size() - queue.size()));
    }
    const auto show = [&](const std::string& remark) {
      if (!progress) return;
      const auto before = static_cast<double>(tasks.size() - queue.size());
      progress->update(before + static_cast<double>(shared.read(SharedNumbers::finished)), remark);
    };
    try {
      while (shared.read(SharedNumbers::stop) == 0) {
        const long place = shared.add(SharedNumbers::next_task, 1);
        if (place >= static_cast<long>(queue.size())) break;
        const std::size_t index = queue[static_cast<std::size_t>(place)];
        const Task& task = tasks[index];
        show(short_label(unfinished(task)));
        std::optional<PointRecord> dependency;
        if (!task.dependency.empty()) {
          // Tasks that others need stand earlier in the queue: another rank is computing it, or it is in the
          // store.
          const auto place_of_it = place_of(task.dependency);
          if (place_of_it != queue.end() && !wait_for(*place_of_it, shared)) break;
          dependency = find_point(store, task.dependency);
          if (!dependency || !dependency->done()) {
            ++counts[2];
            log::warning("{} not computed: the point it depends on failed", short_label(unfinished(task)));
            shared.add(SharedNumbers::of_task(index),
                       1);  // whoever waits for it learns that it will not come
            shared.add(SharedNumbers::finished, 1);
            continue;
          }
        }
        const PointRecord* const needed = dependency ? &*dependency : nullptr;
        std::optional<PointRecord> present;
        if (status[index] == 'c') present = find_point(store, task.key);
        PointRecord point = present ? *present : compute_point(task, needed, 0);
        if (!present && !append_point(store, point))
          log::detail("{} was stored by another process meanwhile", point.label());
        point = continue_point(task, needed, std::move(point), store);
        ++counts[point.done() ? 0 : 1];
        shared.add(SharedNumbers::of_task(index), 1);
        shared.add(SharedNumbers::finished, 1);
        if (point.done()) {
          log::info("{}", summarize(point));
        } else {
          log::warning("{}", summarize(point));
        }
        show(short_label(point));
      }
    } catch (const std::exception& error) {
      fault = error.what();
      shared.add(SharedNumbers::stop, 1);
    }
    // Rank 0 goes on showing the progress of the others.
    while (rank == 0 && shared.read(SharedNumbers::stop) == 0 &&
           shared.read(SharedNumbers::finished) < static_cast<long>(queue.size())) {
      show("waiting for the last points");
      std::this_thread::sleep_for(200ms);
    }
    show("done");
    if (!fault.empty()) log::warning("rank {}: {}", rank, fault);
    const int own = fault.empty() ? 0 : 1;
    int any = 0;
    MPI_Allreduce(&own, &any, 1, MPI_INT, MPI_MAX, communicator);
    if (any != 0)
      throw InputError("the campaign stopped; the points finished so far are in " + store.string());
  }
  std::array<int, 3> total{};
  MPI_Allreduce(counts.data(), total.data(), 3, MPI_INT, MPI_SUM, communicator);
  summary.computed = total[0];
  summary.failed = total[1];
  summary.blocked = total[2];
  return summary;
}

}  // namespace whipple::md
