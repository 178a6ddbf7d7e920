// SPDX-License-Identifier: BSD-3-Clause
#include "src/base/error.hpp"

#include <cstdio>

namespace whipple {

ExitCode exit_code(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return ExitCode::input;
  if (dynamic_cast<const StateError*>(&error) != nullptr) return ExitCode::state;
  return ExitCode::internal;
}

std::string message_for_user(const std::string& program, const std::exception& error) {
  const std::string message = error.what();
  switch (exit_code(error)) {
    case ExitCode::input:
      // "case.toml:3:1: error: ..." says what it is by itself.
      if (message.substr(0, message.find('\n')).find(": error: ") != std::string::npos) return message;
      return program + ": error: " + message;
    case ExitCode::state:
      return program + ": physics error: " + message;
    default:
      return program + ": internal error (please report it): " + message;
  }
}

int run_guarded(const char* program, int (*body)(int, char**), int argc, char** argv) {
  try {
    return body(argc, argv);
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", message_for_user(program, error).c_str());
    return static_cast<int>(exit_code(error));
  }
}

}  // namespace whipple
