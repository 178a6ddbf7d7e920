// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace whipple::app {

/// Lists what may stand in the place of the last of these words: subcommands, options, or the words that an option
/// accepts, those that begin with it. An empty list leaves the place to file names.
/// @param words  the command line without the program; the last one is the word to be completed, which may be empty
std::vector<std::string> completions(const CLI::App& app, const std::vector<std::string>& words);

/// Adds `whipple completion SHELL`, which prints what bash, zsh or fish read, and the hidden `whipple complete`, which
/// these call for the candidates.
void add_completion_command(CLI::App& app);

}  // namespace whipple::app
