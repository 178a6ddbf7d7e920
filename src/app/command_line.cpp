// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/command_line.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/text.hpp"

namespace whipple::app {

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!subcommand->get_group().empty()) names.push_back(subcommand->get_name());
  }
  return names;
}

namespace {

/// Returns the outermost command with unconsumed arguments, or otherwise the innermost command that was parsed.
const CLI::App& faulty(const CLI::App& app) {
  const CLI::App* command = &app;
  while (command->remaining(false).empty() && !command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
  }
  return *command;
}

/// Returns the name of a command with those of its parents, "whipple eos hugoniot".
std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// Returns the error message for an argument that no option and no subcommand accepts.
std::string unexpected(const CLI::App& command, const std::string& argument) {
  if (argument.starts_with('-')) {
    const std::vector<std::string> names = option_names(command);
    const std::string name = argument.substr(0, argument.find('='));
    return fmt::format("unknown option '{}'{} (accepted: {})", name, did_you_mean(name, names), list(names));
  }
  const std::vector<std::string> names = subcommand_names(command);
  if (names.empty()) return fmt::format("unexpected argument '{}'", argument);
  return fmt::format("unknown subcommand '{}'{} (accepted: {})", argument, did_you_mean(argument, names),
                     list(names));
}

[[noreturn]] void report(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = faulty(app);
  const std::vector<std::string> rest = command.remaining(false);
  const std::string what = rest.empty() ? std::string(error.what()) : unexpected(command, rest.front());
  throw InputError(fmt::format("{}\nsee {} --help", what, full_name(command)));
}

}  // namespace

void add_verbosity(CLI::App& command) {
  if (command.get_allow_extras()) return;
  if (command.get_option_no_throw("--quiet") == nullptr) {
    command.add_flag_callback(
        "-q,--quiet",
        [] {
          log::set_level(log::Level::quiet);
          set_progress_visible(false);
        },
        "Warnings and results only");
  }
  if (command.get_option_no_throw("--verbose") == nullptr) {
    command.add_flag_callback("-v,--verbose", [] { log::set_level(log::Level::verbose); }, "Say more");
  }
  for (CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    add_verbosity(*subcommand);
  }
}

namespace {

/// Makes every option refuse an empty value, which a variable of the shell that is not set leaves, and numbers refuse NaN,
/// which lies in every range.
void refuse_empty_values(CLI::App& command) {
  for (CLI::Option* option : command.get_options(
           [](const CLI::Option* o) { return o->get_expected_max() > 0 && !o->get_positional(); })) {
    const bool is_number = option->get_type_name().starts_with("FLOAT");
    option->check([is_number](const std::string& value) -> std::string {
      if (value.empty()) return "is empty";
      const bool starts_nan = value.find_first_of("nN") == value.find_first_not_of("+-");
      return is_number && starts_nan ? "is not a number" : "";
    });
  }
  for (CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
    refuse_empty_values(*subcommand);
}

}  // namespace

int run_command_line(CLI::App& app, int argc, char** argv) {
  refuse_empty_values(app);
  if (argc < 2) {
    fmt::print(stderr, "{}", app.help());
    return static_cast<int>(ExitCode::input);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& end) {
    return end.get_exit_code();
  } catch (const CLI::Success& request) {  // --help, --version
    const CLI::App& command = faulty(app);
    for (const std::string& rest : command.remaining(false)) {  // help for what does not exist
      if (!rest.starts_with('-') && !command.get_allow_extras())
        throw InputError(fmt::format("{}\nsee {} --help", unexpected(command, rest), full_name(command)));
    }
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    report(app, error);
  }
  return static_cast<int>(ExitCode::success);
}

}  // namespace whipple::app
