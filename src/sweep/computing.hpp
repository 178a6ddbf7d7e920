// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/core/process/pool.hpp"
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
};

/// Finds points by the digest of their input, and computes missing ones by `whipple run` and `whipple analyse`, some
/// side by side. A point that fails does not stop the others.
class Computer {
 public:
  struct Options {
    bool retry = false;  ///< computes failed points once more
  };
  /// @param pool  created before any thread
  Computer(const Plan& plan, std::filesystem::path folder, process::Pool& pool, Options options);

  /// Returns how many points are computed side by side: as the study asks, as far as cores and memory allow.
  [[nodiscard]] std::size_t jobs() const { return jobs_; }

  /// Computes all points that are not finished.
  /// @returns false if a signal ended it before
  bool compute(std::span<const Point> points);

  [[nodiscard]] Record record(const Point& point) const;
  [[nodiscard]] std::filesystem::path run_folder(const Point& point) const {
    return folder_ / "points" / point.name();
  }
  /// Returns the number of points that this object computed.
  [[nodiscard]] std::size_t computed() const { return computed_; }

 private:
  enum class Stage : std::uint8_t { run, analyse };
  struct Task {
    const Point* point;
    Stage stage;
  };
  [[nodiscard]] bool start(std::size_t tag, Task& task);
  /// @returns whether the task goes on with another program
  bool ended(Task& task, int code);
  void finish(const Point& point, Record record);
  [[nodiscard]] std::filesystem::path record_file(const Point& point) const;
  [[nodiscard]] std::filesystem::path log_file(const Point& point) const;
  [[nodiscard]] std::string last_words(const Point& point) const;

  const Plan& plan_;
  std::filesystem::path folder_;
  std::filesystem::path program_;  // this one, as it was called at the start
  process::Pool& pool_;
  Options options_;
  bool measures_ = true;  // some result is a measure of whipple analyse
  std::size_t jobs_ = 1, computed_ = 0;
};

}  // namespace whipple::sweep
