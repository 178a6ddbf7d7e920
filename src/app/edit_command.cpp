// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/edit_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/input/text_edit.hpp"

namespace whipple::app {
namespace {

struct EditOptions {
  std::string file;
  std::vector<std::string> assignments;
  bool dry_run = false;
};

void edit(const EditOptions& options) {
  std::vector<std::pair<std::string, std::string>> changes;
  for (const std::string& entry : options.assignments) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError(fmt::format("{}: expected KEY=VALUE, for example time.end='5 us'", entry));
    }
    changes.emplace_back(entry.substr(0, equals), entry.substr(equals + 1));
  }
  const std::string before = read_text(options.file);
  static_cast<void>(cases::read_case(options.file, changes));
  std::string text = before, report;
  for (const auto& [key, value] : changes) {
    input::TextEdit done = input::set_in_text(text, options.file, key, value);
    report += fmt::format("{}:{}: {}: {} -> {}\n", options.file, done.line, key,
                          done.before.empty() ? "(not given)" : done.before, done.after);
    text = std::move(done.text);
  }
  if (!options.dry_run) {
    if (read_text(options.file) != before) {
      throw InputError(
          fmt::format("{}: error: was changed by another program meanwhile: nothing written", options.file));
    }
    // A symbolic link is preserved: its target is written and keeps its permissions.
    const std::filesystem::path file = std::filesystem::canonical(options.file);
    const std::filesystem::perms permissions = std::filesystem::status(file).permissions();
    write_text_atomically(file, text);
    std::filesystem::permissions(file, permissions);
  }
  fmt::print("{}", report);
}

}  // namespace

void add_edit_command(CLI::App& app) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = app.add_subcommand("edit", "Change values in the text of a case file; comments stay");
  command->add_option("case", options->file, "The case (CASE.toml)")->required();
  command->add_option("assignments", options->assignments, "KEY=VALUE, as of whipple run --set")
      ->required()
      ->type_name("KEY=VALUE");
  command->add_flag("--dry-run", options->dry_run, "Print the changes, write nothing");
  command->footer(
      "The file is written only if the changed case passes all checks.\n"
      "Example:\n  whipple edit case.toml domain.cell_size='0.5 mm' body.0.velocity.2='4 km/s'");
  command->callback([options] { edit(*options); });
}

}  // namespace whipple::app
