// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/report_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/analysis/frame.hpp"
#include "src/analysis/run.hpp"
#include "src/app/analyse_command.hpp"
#include "src/app/planar_impact.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/scripts.hpp"
#include "src/io/run_directory.hpp"
#include "src/view/page.hpp"

namespace whipple::app {
namespace {

struct ReportOptions {
  std::vector<std::string> runs;
  std::string output;
  std::vector<std::string> figures;
  AnalysisWords analysis;
  int dots_per_inch = 300;
  double view_megabytes = 4.0;
};

/// Writes view.html for the page if the run allows it. Returns its path, empty if it was not written.
std::string write_view(const analysis::Run& run, double megabytes, const std::filesystem::path& output) {
  if (megabytes <= 0.0) return "";
  try {
    view::PageOptions options;
    options.most_bytes = 1e6 * megabytes;
    options.bits = 8;  // the resolution of the colour map; the page of `whipple view` has 16
    const std::filesystem::path file = output / "view.html";
    io::write_text_atomically(file, view::make_page(run, options, process::find_data("web/viewer")).html);
    return file.string();
  } catch (const InputError& error) {
    log::warning("no view in three dimensions: {}", error.what());
    return "";
  }
}

/// Writes planar_impact.json for the page.
void write_planar_impacts(const analysis::Run& run, const std::filesystem::path& output) {
  const int axis = analysis::find_frame(run, analysis::read_snapshot(run.snapshots.front())).axis;
  const cases::Case setup = cases::read_case(run.folder / "run.toml", {});
  io::write_text_atomically(output / "planar_impact.json", json_text(planar_impacts(setup, axis), 1));
}

/// Measures a run and draws its views. Returns the path of the three-dimensional view, empty without one.
std::string measure(const std::string& folder, const ReportOptions& options,
                    const std::filesystem::path& output, bool with_view) {
  const analysis::Run run = analysis::read_run(folder);
  if (run.snapshots.empty()) return "";  // the report shows its input and history only
  AnalysisWords words = options.analysis;
  log::info("{}: measures and views of {} snapshots", folder, run.snapshots.size());
  constexpr double panel_width = 4.5;  // inches, slightly more than the width of one of several panels
  words.views.columns = static_cast<std::size_t>(std::lround(panel_width * options.dots_per_inch));
  run_analysis(folder, words, output);
  write_planar_impacts(run, output);
  if (with_view && options.view_megabytes > 0.0) log::info("{}: page in three dimensions", folder);
  return with_view ? write_view(run, options.view_megabytes, output) : "";
}

int run_report(const ReportOptions& options) {
  for (const std::string& run : options.runs) {
    if (!std::filesystem::is_directory(run)) {
      throw InputError(fmt::format("{}: error: is not a folder; expected the output of whipple run", run));
    }
  }
  const bool one = options.runs.size() == 1;
  const std::filesystem::path output =
      options.output.empty() ? options.runs.front() + "/report" : options.output;
  std::vector<std::string> arguments = options.runs;
  arguments.insert(arguments.end(),
                   {"--dpi", std::to_string(options.dots_per_inch), "--output", output.string()});
  for (const std::string& run : options.runs) {
    const std::string view = measure(run, options, one ? output : std::filesystem::path(run) / "report", one);
    if (!view.empty()) arguments.insert(arguments.end(), {"--view", view});
  }
  log::info("{}: figures and page", output.string());
  for (const std::string& figure : options.figures) arguments.insert(arguments.end(), {"--figure", figure});
  return process::run_script("report", arguments);
}

}  // namespace

void add_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
      "report", "Measures, figures and tables of a run, or of several side by side, as one HTML page");
  command->add_option("run", options->runs, "The run directory; several: a page that compares them")
      ->required();
  command->add_option("-o,--output", options->output,
                      "Folder of the page (default: report/ in the first run directory)");
  command->add_option("--figure", options->figures, "A figure to show before the pictures (repeatable)")
      ->type_name("TITLE=FILE.png")
      ->allow_extra_args(false);
  add_analysis_options(*command, options->analysis);
  options->analysis.views.times = 6;
  command->add_option("--times", options->analysis.views.times, "Pictures at so many times")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--dpi", options->dots_per_inch, "Dots per inch of the pictures")
      ->check(CLI::Range(20, 1200))
      ->capture_default_str();
  command
      ->add_option("--view-megabytes", options->view_megabytes,
                   "Greatest size of the view in three dimensions (0: none)")
      ->check(CLI::Range(0.0, 2000.0))
      ->capture_default_str();
  command->footer(
      "Example:\n  whipple report run/copper_disk_on_aluminium --figure Hugoniot=compare.png\n  whipple "
      "report run/a run/b run/c -o compared");
  command->callback([options] {
    const int code = run_report(*options);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app
