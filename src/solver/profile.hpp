// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>

namespace whipple::solver {

/// Measures the wall-clock time of each stage of the step, named as in the step function.
class Profile {
 public:
  struct Stage {
    std::string name;
    double seconds = 0.0;
    long calls = 0;
  };

  /// Runs a stage and adds its time.
  template <class Work>
  decltype(auto) time(std::string_view name, Work&& work) {
    const Stopwatch stopwatch(stage(name));
    return work();
  }

  /// Moves a time (s) from the stage in which it was measured to the stage to which it belongs.
  void reassign(std::string_view from, std::string_view to, double seconds) {
    stage(from).seconds -= seconds;
    stage(to).seconds += seconds;
    ++stage(to).calls;
  }

  [[nodiscard]] const std::deque<Stage>& stages() const { return stages_; }
  void clear() { stages_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  class Stopwatch {
   public:
    explicit Stopwatch(Stage& stage) : stage_(stage) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() {
      stage_.seconds += std::chrono::duration<double>(Clock::now() - begin_).count();
      ++stage_.calls;
    }

   private:
    Stage& stage_;
    Clock::time_point begin_ = Clock::now();
  };

  Stage& stage(std::string_view name) {
    for (Stage& known : stages_) {
      if (known.name == name) return known;
    }
    return stages_.emplace_back(Stage{std::string(name)});
  }

  std::deque<Stage>
      stages_;  // references to its elements stay valid while stages within one another are added
};

}  // namespace whipple::solver
