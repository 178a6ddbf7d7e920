// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "src/core/base/resource_error.hpp"
#include "src/core/base/surroundings.hpp"

namespace whipple {

namespace {

std::string all_messages(const std::vector<InputFault>& faults) {
  std::string all;
  for (const InputFault& fault : faults) all += (all.empty() ? "" : "\n") + fault.message();
  return all;
}

}  // namespace

std::string InputFault::message() const {
  if (file.empty()) return key.empty() ? text : fmt::format("{}: error: {}", key, text);
  if (line == 0) return fmt::format("{} (--set): error: {}", file, text);
  return fmt::format("{}:{}:{}: error: {}", file, line, column, text);
}

InputError::InputError(const std::string& message) : InputError(std::vector{InputFault{.text = message}}) {}

InputError::InputError(std::vector<InputFault> faults)
    : std::runtime_error(all_messages(faults)),
      faults_(std::make_shared<const std::vector<InputFault>>(std::move(faults))) {}

ExitCode exit_code(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return ExitCode::input;
  // A path rejected by the system is not a defect of the program.
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error) != nullptr) return ExitCode::input;
  if (dynamic_cast<const StateError*>(&error) != nullptr) return ExitCode::state;
  if (dynamic_cast<const ResourceError*>(&error) != nullptr) return ExitCode::state;
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return ExitCode::state;
  return ExitCode::internal;
}

std::string message_for_user(const std::string& program, const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return program + ": error: the memory that this process may use is exhausted";
  }
  const std::string message = error.what();
  switch (exit_code(error)) {
    case ExitCode::input:
      // "case.toml:3:1: error: ..." is already complete.
      if (message.substr(0, message.find('\n')).find(": error: ") != std::string::npos) return message;
      return program + ": error: " + message;
    case ExitCode::state:
      return program +
             (dynamic_cast<const StateError*>(&error) != nullptr ? ": physics error: " : ": error: ") +
             message;
    default:
      return program + ": internal error (please report it): " + message;
  }
}

namespace {

int report(const char* program, const std::exception& error) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s\n", message_for_user(program, error).c_str());
  return static_cast<int>(exit_code(error));
}

InputError unwritten_output(int error) {
  return InputError(fmt::format("cannot write to the standard output{}{}", error != 0 ? ": " : "",
                                error != 0 ? std::strerror(error) : ""));
}

}  // namespace

int run_guarded(const char* program, int (*body)(int, char**), int argc, char** argv) {
  repair_surroundings();
  try {
    const int code = body(argc, argv);
    // The output is buffered: write errors only appear on flushing.
    errno = 0;
    const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    return written || code != 0 ? code : report(program, unwritten_output(errno));
  } catch (const std::system_error& error) {  // thrown by {fmt} if standard output cannot be written
    if (std::ferror(stdout) != 0) return report(program, unwritten_output(error.code().value()));
    return report(program, error);
  } catch (const std::exception& error) {
    return report(program, error);
  }
}

}  // namespace whipple
