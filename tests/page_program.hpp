// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "src/core/base/error.hpp"

/// Programs that write a page of docs/generated: `NAME FILE.md`. They take minutes to hours, so that the page is refused
/// before the work.
namespace whipple::tests {

/// Returns the page that a program of pages is to write, its first argument.
/// @param most   arguments that the program takes, the page included
/// @param usage  one line, printed as the error for any other number of arguments and for options
/// @throws InputError on such arguments or if the page cannot be written; a page that is there stays as it is
[[nodiscard]] inline std::string page_of(int argc, char** argv, int most, const char* usage) {
  if (argc < 2 || argc - 1 > most || argv[1][0] == '-') throw InputError(usage);
  std::string page = argv[1];
  const bool was_there = std::filesystem::exists(page);
  if (!std::ofstream(page, std::ios::app)) throw InputError("cannot write to " + page);
  if (!was_there) std::filesystem::remove(page);
  return page;
}

/// Runs a program of pages by `write(argc, argv)`. @returns its exit code: 0 with --help, which prints `usage`
inline int run_page_program(const char* name, const char* usage, int (*write)(int, char**), int argc,
                            char** argv) {
  if (argc == 2 && argv[1] == std::string("--help")) {
    std::puts(usage);
    return 0;
  }
  return run_guarded(name, write, argc, argv);
}

}  // namespace whipple::tests
