// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace whipple {

/// Exit codes of every executable of the project.
enum class ExitCode : int {
  success = 0,
  input = 2,     ///< the user's input is wrong; nothing was started, nothing was overwritten
  state = 3,     ///< the physics left its range; the last state was saved
  internal = 4,  ///< a defect of this program
};

/// One fault of an input, with its place.
struct InputFault {
  std::string file = {};  ///< empty: the input is not from a file
  unsigned line = 0;      ///< from 1; 0: not in the file (--set)
  unsigned column = 0;
  std::string key = {};  ///< as --set takes it, "body.0.shape"; empty: of no key
  std::string text;

  /// Returns "file:line:column: error: text", with the key for a place outside of files.
  [[nodiscard]] std::string message() const;
};

/// The user's input is wrong. The message names what, where, the offending value and what is accepted;
/// it may hold several lines, one per error of the input.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message);
  explicit InputError(std::vector<InputFault> faults);

  /// Returns the faults one by one; at least one.
  [[nodiscard]] const std::vector<InputFault>& faults() const { return *faults_; }

 private:
  std::shared_ptr<const std::vector<InputFault>> faults_;
};

/// A physical state left the range of its model (NaN, negative volume, equation of state out of range).
/// The message names step, time, body, particle and the state.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A broken invariant of the program itself.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The code of the kind of an error; what is none of the three is a defect.
ExitCode exit_code(const std::exception& error);

/// Returns the text of an error for the user: "program: error: message", or the message as it is if it names its place
/// in a file ("case.toml:3:1: error: message").
std::string message_for_user(const std::string& program, const std::exception& error);

/// Runs `body` and turns the three kinds of errors into the exit codes above; prints the message for the
/// user to standard error.
/// @param program name printed before the message
/// @param body    returns the exit code of the undisturbed case
int run_guarded(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace whipple
