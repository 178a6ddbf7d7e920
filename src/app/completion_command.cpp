// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/completion_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "src/app/command_line.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

enum class Shell { bash, zsh, fish };
constexpr auto words(Shell /*unused*/) {
  return std::array{Word<Shell>{Shell::bash, "bash"}, Word<Shell>{Shell::zsh, "zsh"},
                    Word<Shell>{Shell::fish, "fish"}};
}

constexpr std::string_view bash_text = R"(_whipple() {
  local IFS=$'\n'
  COMPREPLY=($("${COMP_WORDS[0]}" complete -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -F _whipple whipple
)";

constexpr std::string_view zsh_text = R"(#compdef whipple
_whipple() {
  local -a candidates
  candidates=("${(@f)$("${words[1]}" complete -- "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  if [[ -n ${candidates[1]} ]]; then compadd -a candidates; else _files; fi
}
if [[ ${funcstack[1]} = _whipple ]]; then _whipple "$@"; else compdef _whipple whipple; fi
)";

constexpr std::string_view fish_text = R"(function __whipple_complete
    set -l words (commandline -opc) (commandline -ct)
    $words[1] complete -- $words[2..-1] 2>/dev/null
end
complete -c whipple -a '(__whipple_complete)'
)";

std::string_view script_of(Shell shell) {
  switch (shell) {
    case Shell::zsh:
      return zsh_text;
    case Shell::fish:
      return fish_text;
    case Shell::bash:
      break;
  }
  return bash_text;
}

const CLI::App* subcommand_of(const CLI::App& command, const std::string& name) {
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (subcommand->get_name() == name) return subcommand;
  }
  return nullptr;
}

const CLI::Option* option_of(const CLI::App& command, const std::string& name) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() || !option->check_name(name)) continue;
    return option;
  }
  return nullptr;
}

std::map<const CLI::Option*, Candidates>& offers() {
  static std::map<const CLI::Option*, Candidates> all;
  return all;
}

/// Returns the words that are offered for an option, otherwise those that it accepts, as its help shows them:
/// "TEXT:{vtu,csv}".
std::vector<std::string> accepted(const CLI::Option& option, const std::vector<std::string>& before) {
  if (const auto found = offers().find(&option); found != offers().end()) return found->second(before);
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

/// Returns the words of the next positional argument; the last one may take all that follow.
std::vector<std::string> accepted_positional(const CLI::App& command,
                                             const std::vector<std::string>& before) {
  std::size_t at = 0;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    if (at == before.size() || option->get_expected_max() > 1) return accepted(*option, before);
    ++at;
  }
  return {};
}

bool is_equals_sign(const std::string& word) { return word.size() == 1 && word.front() == '='; }

}  // namespace

void offer(const CLI::Option* option, Candidates candidates) { offers()[option] = std::move(candidates); }

void offer_materials(const CLI::Option* option) {
  offer(option, [](const std::vector<std::string>& /*before*/) {
    std::vector<std::string> names;
    for (const LibraryMaterial& material : library_materials())
      names.push_back(material.file.stem().string());
    return names;
  });
}

std::vector<std::string> completions(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  const CLI::Option* waiting = nullptr;  // an option whose value comes next
  std::vector<std::string> before;       // positional words of the command
  std::string last = words.empty() || is_equals_sign(words.back()) ? std::string() : words.back();
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (waiting != nullptr) {
      if (!is_equals_sign(word)) waiting = nullptr;
    } else if (word.starts_with('-')) {
      const CLI::Option* option = option_of(*command, word);
      if (option != nullptr && option->get_items_expected_max() > 0) waiting = option;
    } else if (const CLI::App* subcommand = subcommand_of(*command, word)) {
      command = subcommand;
      before.clear();
    } else {
      before.push_back(word);
    }
  }
  std::string start;  // what precedes the candidates in the last word: "--format="
  if (const std::size_t sign = last.find('='); last.starts_with("--") && sign != std::string::npos) {
    waiting = option_of(*command, last.substr(0, sign));
    start = last.substr(0, sign + 1);
    last.erase(0, sign + 1);
    if (waiting == nullptr) return {};
  }
  std::vector<std::string> candidates;
  if (waiting != nullptr) {
    candidates = accepted(*waiting, before);
  } else if (last.starts_with('-')) {
    candidates = option_names(*command);
  } else if (candidates = subcommand_names(*command); candidates.empty()) {
    candidates = accepted_positional(*command, before);
  }
  std::erase_if(candidates, [&](const std::string& candidate) { return !candidate.starts_with(last); });
  std::ranges::sort(candidates);
  for (std::string& candidate : candidates) candidate.insert(0, start);
  return candidates;
}

void add_completion_command(CLI::App& app) {
  auto shell = std::make_shared<Shell>(Shell::bash);
  CLI::App* command = app.add_subcommand("completion", "Completion of command lines for a shell");
  add_word_option(*command, "shell", *shell, "The shell")->required();
  command->footer("Example:\n  source <(whipple completion bash)");
  command->callback([shell] { fmt::print("{}", script_of(*shell)); });

  CLI::App* complete = app.add_subcommand("complete", "Candidates for the last word of a command line");
  complete->group("");  // not in the help: shells call it
  auto typed = std::make_shared<std::vector<std::string>>();
  complete->add_option("words", *typed, "The command line without the program");
  complete->callback([&app, typed] {
    for (const std::string& candidate : completions(app, *typed)) fmt::print("{}\n", candidate);
  });
}

}  // namespace whipple::app
