// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/view_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "src/analysis/run.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/process/paths.hpp"
#include "src/io/run_directory.hpp"
#include "src/view/page.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string run, output, clouds;
  bool force = false;
  double megabytes = 20.0;
  view::PageOptions page;
};

void run_view(ViewOptions options) {
  const fs::path output =
      options.output.empty() ? fs::path(options.run) / "report" / "view.html" : fs::path(options.output);
  if (!options.output.empty()) require_new_file(output, options.force);
  options.page.most_bytes = 1e6 * options.megabytes;
  const analysis::Run run = analysis::read_run(options.run);
  const view::Page page = view::make_page(run, options.page, process::find_data("web/viewer"));
  if (options.output.empty()) make_folder(output.parent_path());
  io::write_text_atomically(output, page.html);
  log::info("wrote {}: {} times, {}, {}", output.string(), page.times,
            page.one_of == 1 ? "all particles" : fmt::format("about one of {} particles", page.one_of),
            format_bytes(static_cast<double>(page.html.size())));
  if (options.clouds.empty()) return;
  const std::size_t count = view::write_clouds(run, options.page.fields, options.clouds);
  log::info("wrote {} files *.wpv.gz to {}", count, options.clouds);
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", "A run in three dimensions, as one HTML page");
  command->add_option("run", options->run, "The run directory")->required();
  command
      ->add_option("-o,--output", options->output,
                   "The page (default: report/view.html in the run directory)")
      ->type_name("FILE.html");
  command->add_flag("--force", options->force, "Replace the page named by -o");
  command->add_option("--times", options->page.times, "Snapshots in the page, spread evenly")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--fields", options->page.fields,
                   "Fields in the page, e.g. speed,temperature (default: all)")
      ->type_name("NAME,...")
      ->delimiter(',');
  command
      ->add_option("--megabytes", options->megabytes,
                   "Greatest size of the page: particles are left out beyond it")
      ->check(CLI::Range(0.1, 2000.0))
      ->capture_default_str();
  command->add_option("--bits", options->page.bits, "Bits of each value of a field: 8 make the page smaller")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str();
  command
      ->add_option("--wpv", options->clouds, "Also every snapshot in full detail, to be opened in the page")
      ->type_name("FOLDER");
  command->footer(
      "Example:\n  whipple view run/disk -o disk.html --times 20 --fields speed,pressure,phase\n"
      "The page needs WebGL 2 and neither other files nor a network.");
  command->callback([options] { run_view(*options); });
}

}  // namespace whipple::app
