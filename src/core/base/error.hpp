// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace whipple {

/// Lists the exit codes of all executables of the project.
enum class ExitCode : int {
  success = 0,
  input = 2,     ///< invalid user input; nothing was started or overwritten
  state = 3,     ///< the physical state left the valid range; the last state was saved
  internal = 4,  ///< a defect of this program
};

/// Describes one fault of an input, with its location.
struct InputFault {
  std::string file = {};  ///< empty: the input is not from a file
  unsigned line = 0;      ///< from 1; 0: not in the file (--set)
  unsigned column = 0;
  std::string key = {};  ///< as used by --set, "body.0.shape"; empty: no key
  std::string text;

  /// Returns "file:line:column: error: text", with the key for a location outside of files.
  [[nodiscard]] std::string message() const;
};

/// Reports invalid user input. The message states the item, its location, the offending value and the accepted values;
/// it may contain several lines, one per error of the input.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message);
  explicit InputError(std::vector<InputFault> faults);

  /// Returns the individual faults; at least one.
  [[nodiscard]] const std::vector<InputFault>& faults() const { return *faults_; }

 private:
  std::shared_ptr<const std::vector<InputFault>> faults_;
};

/// Reports a physical state outside of the range of its model (NaN, negative volume, equation of state out of range).
/// The message states step, time, body, particle and the state.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports a violated invariant of the program.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Returns the exit code of an error; any error other than the three kinds is a defect.
ExitCode exit_code(const std::exception& error);

/// Returns the text of an error for the user: "program: error: message", or the message unchanged if it contains its
/// location in a file ("case.toml:3:1: error: message").
std::string message_for_user(const std::string& program, const std::exception& error);

/// Runs `body` and converts the three kinds of errors to the exit codes above; prints the message for the user to
/// standard error.
/// @param program name printed before the message
/// @param body    returns the exit code if no error occurs
int run_guarded(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace whipple
