// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/man_command.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "src/app/build_info.hpp"

namespace whipple::app {
namespace {

/// Returns a text as roff shows it: backslashes, hyphens of options, and no request at the beginning of a line.
std::string plain(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((i == 0 || text[i - 1] == '\n') && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\') {
      result += "\\e";
    } else if (text[i] == '-') {
      result += "\\-";
    } else {
      result += text[i];
    }
  }
  return result;
}

/// Returns the line of usage and meaning of one option or positional argument.
std::string entry(const CLI::Option& option) {
  const std::string name = option.get_name(false, true);
  const std::string type = option.get_items_expected_max() > 0 ? " " + option.get_type_name() : "";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(name), plain(type), plain(option.get_description()));
}

/// Appends a command and those below it, each a section.
void append(const CLI::App& command, const std::string& parents, std::string& page) {
  const std::string name = parents + command.get_name();
  page += fmt::format(".SS \"{}\"\n{}\n", plain(name), plain(command.get_description()));
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty() || option->get_positional()) page += entry(*option);
  }
  if (const std::string footer = command.get_footer(); !footer.empty()) {
    page += fmt::format(".PP\n.nf\n{}\n.fi\n", plain(footer));
  }
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!subcommand->get_group().empty()) append(*subcommand, name + " ", page);
  }
}

std::string manual_page(const CLI::App& app) {
  std::string page =
      fmt::format(".TH WHIPPLE 1 \"\" \"whipple {}\" \"User Commands\"\n", build_info().version);
  page += fmt::format(".SH NAME\nwhipple \\- {}\n",
                      "equations of state from molecular dynamics, and hypervelocity impact");
  page += ".SH SYNOPSIS\n.B whipple\n\\fISUBCOMMAND\\fR [\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n";
  page += fmt::format(".SH DESCRIPTION\n{}\n", plain(app.get_description()));
  page += ".SH SUBCOMMANDS\n";
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!subcommand->get_group().empty()) append(*subcommand, "", page);
  }
  page +=
      ".SH EXIT STATUS\n0 done, 2 wrong input, 3 the physics left its range or a resource is exhausted, "
      "4 a defect of this program\n";
  return page;
}

}  // namespace

void add_man_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("man", "The manual page, in roff");
  command->footer("Example:\n  whipple man | man -l -");
  command->callback([&app] { fmt::print("{}", manual_page(app)); });
}

}  // namespace whipple::app
