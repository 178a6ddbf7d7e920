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

/// Whether a request is followed.
enum class Verdict : std::uint8_t { accepted, refused };
constexpr std::array<Word<Verdict>, 2> words(Verdict) {
  return {{{Verdict::accepted, "accepted"}, {Verdict::refused, "refused"}}};
}

/// The answer of a run to a request: a line of steering.csv.
struct Answer {
  Verdict verdict = Verdict::accepted;
  std::string
      detail;  ///< of an accepted request the number that it replaces, if any; of a refused one the reason
};

/// Takes requests from the folder control/ of a run: files *.toml with one request each, in the order of their
/// names, one at every border between steps. Each is answered by a line of steering.csv; one that is wrong is
/// answered there and nothing else happens. Of the first rank.
class DirectoryControl : public RunControl {
 public:
  /// Makes the folder. @param interval  of wall time between two looks into it
  explicit DirectoryControl(const io::RunDirectory& directory,
                            std::chrono::duration<double> interval = std::chrono::seconds(1));

  void ask(const Moment& moment, Requests& requests) override;
  /// Refuses the requests that came too late.
  void end(const Moment& moment) override;

  /// The head of the table of answers, steering.csv.
  static constexpr const char* header = "time [s],step,file,request,value,answer,detail";

 private:
  void look();
  /// Removes a file of the folder, answers it, and returns what is to be done.
  /// @param too_late  why nothing is followed any more; empty: what the run can follow is followed
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
/// @param patience  s to wait; a run answers at the end of the step under way
/// @returns the answer; nothing if none came in that time
/// @throws InputError if the request is wrong, or the run does not go on or ends before it has followed it
std::optional<Answer> steer(const std::filesystem::path& run, const std::string& word,
                            const std::string& value, std::chrono::duration<double> patience = {});

}  // namespace whipple::run
