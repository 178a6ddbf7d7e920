// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "src/core/base/words.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/control.hpp"

namespace whipple::run {

/// Describes whether a request is executed.
enum class Verdict : std::uint8_t { accepted, refused };
constexpr std::array<Word<Verdict>, 2> words(Verdict) {
  return {{{Verdict::accepted, "accepted"}, {Verdict::refused, "refused"}}};
}

/// Holds the answer of a run to a request: a line of steering.csv.
struct Answer {
  Verdict verdict = Verdict::accepted;
  std::string detail;  ///< accepted: the former value, if the request replaces one; refused: the reason
};

/// Reads requests from the folder control/ of a run: files *.toml with one request each, in the order of their names,
/// one after every step. Each request is answered by a line of steering.csv; invalid requests have no other effect.
/// Used on the first rank only.
class DirectoryControl : public RunControl {
 public:
  /// Creates the folder.
  /// @param interval  wall time between two readings of the folder
  explicit DirectoryControl(const io::RunDirectory& directory,
                            std::chrono::duration<double> interval = std::chrono::seconds(1));

  void ask(const Moment& moment, Requests& requests) override;
  /// Refuses the requests that arrived too late.
  void end(const Moment& moment) override;

  /// Defines the header of the table of answers, steering.csv.
  static constexpr const char* header = "time [s],step,file,request,value,answer,detail";

 private:
  void look();
  /// Removes a file from the folder, answers its request, and returns the action.
  /// @param too_late  reason for refusing all requests; empty: admissible requests are accepted
  Request take(const std::filesystem::path& file, const Moment& moment, const std::string& too_late = "");
  void write(const Moment& moment, const std::string& file, const RequestWords& words,
             const Answer& answer) const;

  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_, table_;
  std::chrono::duration<double> interval_;
  std::deque<std::filesystem::path> waiting_;  // files
  Clock::time_point next_look_;
};

/// Puts a request into the folder control/ of a run and waits for its answer.
/// @param patience  s to wait; a run answers at the end of the current step
/// @returns the answer; nothing if none arrived in that time
/// @throws InputError if the request is invalid, or the run is not active or ends before it has executed the request
std::optional<Answer> steer(const std::filesystem::path& run, const std::string& word,
                            const std::string& value, std::chrono::duration<double> patience = {});

}  // namespace whipple::run
