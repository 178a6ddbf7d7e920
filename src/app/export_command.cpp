// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/export_command.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/analysis/run.hpp"
#include "src/app/command_line.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/io/run_directory.hpp"
#include "src/io/snapshot_table.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

enum class Format { vtu, csv };
constexpr auto words(Format /*unused*/) {
  return std::array{Word<Format>{Format::vtu, "vtu"}, Word<Format>{Format::csv, "csv"}};
}

using Snapshots = std::vector<std::pair<fs::path, double>>;  // files with their times

struct ExportOptions {
  std::string run, output;
  Format format = Format::vtu;
  std::vector<std::string> fields;
  bool last = false;
};

/// Returns the index of a series of VTU files with their times, for ParaView.
std::string index_text(const std::vector<std::pair<std::string, double>>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const auto& [name, time] : files)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, name);
  return text + "</Collection>\n</VTKFile>\n";
}

/// Exports the files of one kind and returns their number.
std::size_t export_series(const Snapshots& snapshots, const ExportOptions& options) {
  std::vector<std::pair<std::string, double>> written;
  for (const auto& [file, time] : snapshots) {
    const io::SnapshotTable table = io::read_snapshot_table(file, time, options.fields);
    const bool vtu = options.format == Format::vtu;
    const std::string name = file.stem().string() + (vtu ? ".vtu" : ".csv");
    io::write_text_atomically(fs::path(options.output) / name,
                              vtu ? io::vtu_text(table) : io::csv_text(table));
    written.emplace_back(name, time);
  }
  if (options.format == Format::vtu && !written.empty()) {
    const std::string series = fs::path(written.front().first).stem().stem().string() + ".pvd";
    io::write_text_atomically(fs::path(options.output) / series, index_text(written));
  }
  return written.size();
}

void run_export(const ExportOptions& options) {
  const analysis::Run run = analysis::read_run(options.run);
  if (run.snapshots.empty()) throw InputError(fmt::format("{}: error: has no snapshots", options.run));
  if (fs::exists(options.output) && !(fs::is_directory(options.output) && fs::is_empty(options.output))) {
    throw InputError(fmt::format("{}: error: exists and is not an empty folder", options.output));
  }
  Snapshots particles, elements;
  for (const analysis::SnapshotEntry& entry : run.snapshots) {
    if (options.last && &entry != &run.snapshots.back()) continue;
    if (fs::exists(entry.file)) particles.emplace_back(entry.file, entry.time);
    if (const fs::path beside = analysis::elements_file(entry); fs::exists(beside))
      elements.emplace_back(beside, entry.time);
  }
  for (const Snapshots* series : {&particles, &elements}) {  // wrong fields are rejected before writing
    if (!series->empty())
      static_cast<void>(
          io::read_snapshot_table(series->front().first, series->front().second, options.fields));
  }
  make_folder(options.output);
  const std::size_t count = export_series(particles, options) + export_series(elements, options);
  log::info("wrote {} file{} to {}", count, count == 1 ? "" : "s", options.output);
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command =
      app.add_subcommand("export", "Snapshots of a run as files of VTK (VTU) or CSV for other programs");
  command->add_option("run", options->run, "The run directory")->required();
  command->add_option("-o,--output", options->output, "A new or empty folder")
      ->required()
      ->type_name("FOLDER");
  add_word_option(*command, "--format", options->format, "Of the files")->default_str("vtu");
  command
      ->add_option("--fields", options->fields, "Fields in the files, e.g. velocity,pressure (default: all)")
      ->type_name("NAME,...")
      ->delimiter(',');
  command->add_flag("--last", options->last, "The last snapshot only");
  command->footer(
      "Example:\n  whipple export run/disk -o disk_vtu --fields velocity,pressure,body\n"
      "In ParaView, open the file *.pvd: it has the times.");
  command->callback([options] { run_export(*options); });
}

}  // namespace whipple::app
