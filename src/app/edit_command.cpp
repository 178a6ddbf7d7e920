// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/edit_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/input/text_edit.hpp"
#include "src/core/process/paths.hpp"
#include "src/editor/case_file.hpp"
#include "src/editor/editor.hpp"
#include "src/material/material_file.hpp"
#include "src/monitor/server.hpp"

namespace whipple::app {
namespace {

struct EditOptions {
  std::string file;
  std::vector<std::string> assignments;
  bool dry_run = false;
  std::uint16_t port = 0;
  int minutes = 0;
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
  const editor::CaseFile file(regular_file(options.file));
  const editor::CaseFile::Content before = file.read();
  static_cast<void>(cases::read_case(options.file, changes));
  std::string text = before.text, report;
  for (const auto& [key, value] : changes) {
    input::TextEdit done = input::set_in_text(text, options.file, key, value);
    report += fmt::format("{}:{}: {}: {} -> {}\n", options.file, done.line, key,
                          done.before.empty() ? "(not given)" : done.before, done.after);
    text = std::move(done.text);
  }
  if (!options.dry_run && file.write(text, before.digest).empty()) {
    throw InputError(
        fmt::format("{}: error: was changed by another program meanwhile: nothing written", options.file));
  }
  fmt::print("{}", report);
}

/// Serves the page that edits the case, which need not exist.
void serve_page(const EditOptions& options) {
  if (options.dry_run)
    throw InputError("--dry-run belongs to KEY=VALUE: the page writes when it is asked to save");
  const std::filesystem::path folder = std::filesystem::absolute(options.file).parent_path();
  require_folder(folder);
  if (!options.file.ends_with(".toml")) {
    throw InputError(fmt::format("{}: the name of a case ends with .toml", options.file));
  }
  nlohmann::json materials = nlohmann::json::array();
  for (const LibraryMaterial& material : library_materials()) {
    materials.push_back(material.file.filename().string());
  }
  const editor::CaseFile file(regular_file(options.file));
  static_cast<void>(file.read());  // or it cannot be read
  monitor::Server server(options.port);
  const monitor::Access access{.host = server.host(), .token = monitor::random_token()};
  editor::Editor editor(file, access,
                        {.schema = cases::case_schema(),
                         .suggestions = {{"material", materials}},
                         .cases = process::find_data("cases"),
                         .program = process::own_executable(),
                         .page = process::find_data("web/editor"),
                         .viewer = process::find_data("web/viewer"),
                         .monitor = process::find_data("web/monitor")});
  // The key is in the fragment of the URL (after #), which browsers do not send.
  fmt::print("Open http://{}/#{} in a browser of this machine; Ctrl-C ends the editor.\n", access.host,
             access.token);
  std::fflush(stdout);
  server.serve(editor, std::chrono::minutes(options.minutes), [] { return true; });
}

}  // namespace

void add_edit_command(CLI::App& app) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = app.add_subcommand(
      "edit", "Change a case: values in its text, or all of it in the browser; comments stay");
  command->add_option("case", options->file, "The case (CASE.toml)")->required();
  command
      ->add_option("assignments", options->assignments,
                   "KEY=VALUE, as of whipple run --set; none: a page with text, form and preview")
      ->type_name("KEY=VALUE");
  command->add_flag("--dry-run", options->dry_run, "Print the changes, write nothing");
  command->add_option("--port", options->port, "Port of 127.0.0.1 for the page (default: one that is free)")
      ->check(CLI::Range(1024, 65535));
  command
      ->add_option("--idle", options->minutes,
                   "End when no page has asked for so many minutes (default: never)")
      ->type_name("MINUTES")
      ->check(CLI::Range(1, 100000));
  command->footer(
      "With KEY=VALUE the file is written only if the changed case passes all checks; the page may save an "
      "unfinished one.\n"
      "Example:\n  whipple edit case.toml domain.cell_size='0.5 mm' body.0.velocity.2='4 km/s'\n"
      "  whipple edit new.toml");
  command->callback([options] { options->assignments.empty() ? serve_page(*options) : edit(*options); });
}

}  // namespace whipple::app
