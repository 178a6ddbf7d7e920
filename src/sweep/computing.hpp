// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/file_lock.hpp"
#include "src/core/base/words.hpp"
#include "src/core/process/pool.hpp"
#include "src/run/status.hpp"
#include "src/sweep/points.hpp"

namespace whipple::sweep {

/// Tells how the computation of a point ended.
enum class State : std::uint8_t { missing, done, failed };
constexpr std::array<Word<State>, 3> words(State) {
  return {{{State::missing, "missing"}, {State::done, "done"}, {State::failed, "failed"}}};
}

/// Holds what is stored of a finished point, in points/NAME.json of the study folder.
struct Record {
  State state = State::missing;
  int exit_code = 0;
  std::string message;     ///< of a failed point; of a run that a condition ended, its reason
  double wall_time = 0.0;  ///< s, of its last process
  std::optional<std::vector<std::string>>
      measured;  ///< options with which `whipple analyse` has measured the run; none: not measured
};

/// Holds a point that another process computes.
struct Elsewhere {
  std::string name;    ///< of the point
  std::string holder;  ///< "process 12 on node3"
};

/// Finds points by the digest of their input, and computes missing ones by `whipple run` and `whipple analyse`, some
/// side by side. A point that fails does not stop the others. Finished points whose stored measures are not those of the
/// study are measured again. A lock per point keeps other processes away from it while it is computed here.
class Computer {
 public:
  struct Options {
    bool retry = false;  ///< computes failed points once more
  };
  /// @param pool  created before any thread
  Computer(const Plan& plan, std::filesystem::path folder, process::Pool& pool, Options options);

  /// Returns how many points are computed side by side: as the study asks, as far as cores and memory allow.
  [[nodiscard]] std::size_t jobs() const { return jobs_; }

  /// Computes all points that are not finished and that no other process computes.
  /// @returns false if a signal ended it before
  /// @throws InputError if a program cannot be started
  bool compute(std::span<const Point> points);

  [[nodiscard]] Record record(const Point& point) const;
  /// Returns whether the stored measures are those of the study.
  [[nodiscard]] bool is_measured(const Record& record) const {
    return record.measured == plan_.study.computing.analyse;
  }
  /// Returns why a finished run could not be measured again; empty if it was not tried, or has succeeded.
  [[nodiscard]] std::string unmeasured(const Point& point) const;
  [[nodiscard]] std::filesystem::path run_folder(const Point& point) const {
    return folder_ / "points" / point.name();
  }
  /// Returns the number of points that this object computed.
  [[nodiscard]] std::size_t computed() const { return computed_; }
  /// Returns the points that other processes were computing when this one came to them.
  [[nodiscard]] const std::vector<Elsewhere>& elsewhere() const { return elsewhere_; }

 private:
  enum class Need : std::uint8_t { nothing, run, measures };
  struct Task {
    const Point* point;
    Need need;  // from the program that runs on
  };
  enum class Start : std::uint8_t { running, finished, run_is_held, is_elsewhere };
  enum class End : std::uint8_t { unfinished, finished, needs_measures };
  [[nodiscard]] Need need_of(const Record& record) const;
  [[nodiscard]] Start start(std::size_t tag, Task& task);
  [[nodiscard]] std::vector<std::string> run_program(const Point& point,
                                                     const std::optional<run::RunStatus>& status) const;
  End ended(const Task& task, const process::Pool::Ended& end);
  End measured(const Point& point, const std::string& fault, int code);
  void finish(const Point& point, Record record);
  void tell(const Point& point, std::size_t finished, std::size_t total) const;
  [[nodiscard]] std::filesystem::path record_file(const Point& point) const;
  [[nodiscard]] std::filesystem::path log_file(const Point& point) const;
  [[nodiscard]] std::string last_words(const Point& point) const;

  const Plan& plan_;
  std::filesystem::path folder_;
  std::filesystem::path program_;  // this one, as it was called at the start
  process::Pool& pool_;
  Options options_;
  bool measures_ = true;  // some result is a measure of whipple analyse
  std::size_t jobs_ = 1, computed_ = 0, failed_ = 0;
  std::map<std::string, std::unique_ptr<const FileLock>> locks_;  // of the points under way, by name
  std::map<std::string, std::string> unmeasured_;                 // why, by name
  std::vector<Elsewhere> elsewhere_;
};

}  // namespace whipple::sweep
