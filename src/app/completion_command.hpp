// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace whipple::app {

/// Lists candidates for an argument. @param before  the positional words that precede it
using Candidates = std::function<std::vector<std::string>(const std::vector<std::string>& before)>;

/// Offers candidates for an argument that takes other words too, or whose words depend on those before it. Must be called
/// before the command line is parsed.
void offer(const CLI::Option* option, Candidates candidates);

/// Offers the names of the material library for an argument that takes files too.
void offer_materials(const CLI::Option* option);

/// Lists what may stand in the place of the last of these words: subcommands, options, or the words that an option
/// accepts or that are offered for it, those that begin with it. "--format=v" is completed to "--format=vtu", the three
/// words "--format", "=", "v", as bash passes them, to "vtu". An empty list leaves the place to file names.
/// @param words  the command line without the program; the last one is the word to be completed, which may be empty
std::vector<std::string> completions(const CLI::App& app, const std::vector<std::string>& words);

/// Adds `whipple completion SHELL`, which prints what bash, zsh or fish read, and the hidden `whipple complete`, which
/// these call for the candidates.
void add_completion_command(CLI::App& app);

}  // namespace whipple::app
