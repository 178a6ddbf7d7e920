// SPDX-License-Identifier: BSD-3-Clause
#include "src/base/error.hpp"

#include <cstdio>
#include <string_view>

namespace whipple {
namespace {
int report(const char* program, const char* kind, const char* message, ExitCode code) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s: %s: %s\n", program, kind, message);
  return static_cast<int>(code);
}
}  // namespace

int run_guarded(const char* program, int (*body)(int, char**), int argc, char** argv) {
  try {
    return body(argc, argv);
  } catch (const InputError& error) {
    const std::string_view message(error.what());
    // "case.toml:3:1: error: ..." says what it is by itself.
    if (message.substr(0, message.find('\n')).find(": error: ") != std::string_view::npos) {
      std::fflush(stdout);
      std::fprintf(stderr, "%s\n", error.what());
      return static_cast<int>(ExitCode::input);
    }
    return report(program, "error", error.what(), ExitCode::input);
  } catch (const StateError& error) {
    return report(program, "physics error", error.what(), ExitCode::state);
  } catch (const std::exception& error) {
    return report(program, "internal error (please report it)", error.what(), ExitCode::internal);
  }
}

}  // namespace whipple
