// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"

namespace whipple::app {

/// Lists the long names of the options of a command, with their dashes.
std::vector<std::string> option_names(const CLI::App& command);

/// Lists the subcommands of a command that its help shows.
std::vector<std::string> subcommand_names(const CLI::App& command);

/// Adds --quiet and --verbose to a command and to all its subcommands except those that pass their arguments on.
void add_verbosity(CLI::App& command);

/// Adds an option whose value is a word of an enumeration.
template <class Enum>
CLI::Option* add_word_option(CLI::App& command, const std::string& names, Enum& value,
                             const std::string& meaning) {
  return command
      .add_option_function<std::string>(
          names, [&value](const std::string& word) { value = value_of<Enum>(word).value(); }, meaning)
      ->check(CLI::IsMember(word_list<Enum>()));
}

/// Parses the command line and runs the subcommand that it names.
/// @returns the exit code; a command selects another one by throwing CLI::RuntimeError(code)
/// @throws InputError if the arguments are wrong, with the nearest subcommand or option
int run_command_line(CLI::App& app, int argc, char** argv);

}  // namespace whipple::app
