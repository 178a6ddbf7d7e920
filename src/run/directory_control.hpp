// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <string>

#include "src/io/run_directory.hpp"
#include "src/run/control.hpp"

namespace whipple::run {

/// Takes requests from the folder control/ of a run: files *.toml with one request each, in the order of their
/// names, one at every border between steps. Each is answered by a line of steering.csv; one that is wrong is
/// answered there and nothing else happens. Of the first rank.
class DirectoryControl : public RunControl {
 public:
  /// Makes the folder. @param interval  of wall time between two looks into it
  explicit DirectoryControl(const io::RunDirectory& directory,
                            std::chrono::duration<double> interval = std::chrono::seconds(1));

  void ask(const Moment& moment, Requests& requests) override;

 private:
  void look();
  /// Removes a file of the folder, answers it, and returns what is to be done.
  [[nodiscard]] Request take(const std::filesystem::path& file, const Moment& moment);
  void answer(const Moment& moment, const RequestWords& words, const std::string& result) const;

  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_, table_;
  std::chrono::duration<double> interval_;
  std::deque<std::filesystem::path> waiting_;  // files
  Clock::time_point next_look_;
};

/// Puts a request into the folder control/ of a run and waits for its answer.
/// @param patience  s to wait; a run answers at the end of the step under way
/// @returns the answer, "accepted ..." or "refused: ..."; empty if none came in that time
/// @throws InputError if the request is wrong or the run does not go on
std::string steer(const std::filesystem::path& run, const std::string& word, const std::string& value,
                  std::chrono::duration<double> patience = {});

}  // namespace whipple::run
