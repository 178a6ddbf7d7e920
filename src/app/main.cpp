// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "eos/models/simulated_crystal.hpp"
#include "md_fitting/simulated_crystal/worker_source.hpp"
#include "src/app/analyse_command.hpp"
#include "src/app/bench_command.hpp"
#include "src/app/build_info.hpp"
#include "src/app/cite_command.hpp"
#include "src/app/command_line.hpp"
#include "src/app/compare_command.hpp"
#include "src/app/completion_command.hpp"
#include "src/app/describe_command.hpp"
#include "src/app/edit_command.hpp"
#include "src/app/eos_command.hpp"
#include "src/app/export_command.hpp"
#include "src/app/fit_command.hpp"
#include "src/app/import_command.hpp"
#include "src/app/man_command.hpp"
#include "src/app/materials_command.hpp"
#include "src/app/md_command.hpp"
#include "src/app/measure_command.hpp"
#include "src/app/monitor_command.hpp"
#include "src/app/report_command.hpp"
#include "src/app/run_command.hpp"
#include "src/app/shield_command.hpp"
#include "src/app/steer_command.hpp"
#include "src/app/step_mesher.hpp"
#include "src/app/sweep_command.hpp"
#include "src/app/units_command.hpp"
#include "src/app/version_command.hpp"
#include "src/app/view_command.hpp"
#include "src/core/base/error.hpp"
#include "src/solids/step.hpp"

namespace {

/// Sets passive waiting of threads. libgomp reads this setting when it is loaded, before `main`, so the program
/// restarts itself. Threads that busy-wait occupy the cores that other threads need on a shared machine, and a run
/// takes several times as long.
void wait_passively(char** arguments) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  std::error_code fault;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", fault);
  execv(program.c_str(), arguments);  // on failure the program continues unchanged
}

/// Returns whether a subcommand uses threads.
bool has_threads(std::string_view command) {
  constexpr std::array<std::string_view, 7> commands = {"run",  "check", "analyse", "report",
                                                        "view", "bench", "shield"};
  return std::ranges::find(commands, command) != commands.end();
}

int whipple_main(int argc, char** argv) {
  using namespace whipple::app;
  // The equations of state do not depend on any other program: the source of crystal simulations is injected here.
  whipple::eos::set_isochore_source(whipple::md::worker_source);
  whipple::solids::set_step_mesher(triangulate_by_gmsh);
  CLI::App app{
      "From atoms to debris clouds: equations of state from molecular dynamics, and the material point\n"
      "method for hypervelocity impact",
      "whipple"};
  app.set_version_flag("--version", fmt::format("whipple {}", build_info().version));
  app.require_subcommand(1);

  add_run_command(app);
  add_check_command(app);
  add_sweep_command(app);
  add_shield_command(app);
  add_edit_command(app);
  add_status_command(app);
  add_steer_command(app);
  add_export_command(app);
  add_import_command(app);
  add_md_command(app);
  add_fit_command(app);
  add_compare_command(app);
  add_analyse_command(app);
  add_measure_command(app);
  add_report_command(app);
  add_view_command(app);
  add_monitor_command(app);
  add_eos_command(app);
  add_describe_command(app);
  add_materials_command(app);
  add_cite_command(app);
  add_units_command(app);
  add_bench_command(app);
  add_version_command(app);
  add_completion_command(app);
  add_man_command(app);

  add_verbosity(app);
  app.footer(
      "Example:\n  whipple run cases/copper_disk_on_aluminium/case.toml -o run/disk\n"
      "Exit codes: 0 done, 2 wrong input, 3 the physics left its range, 4 a defect of this program");
  return run_command_line(app, argc, argv);
}

/// Rewrites "whipple help run" as "whipple run --help".
std::vector<char*> arguments_of(int argc, char** argv) {
  static char help[] = "--help";
  std::vector<char*> arguments(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == std::string_view("help")) {
    arguments.erase(arguments.begin() + 1);
    arguments.push_back(help);
  }
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && has_threads(argv[1])) wait_passively(argv);
  // A run goes on when whoever read its messages has left.
  if (argc > 1 && argv[1] == std::string_view("run")) std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ,
              SIG_IGN);  // the maximum file size is reported as a write error, like a full disk
  // Large arrays are returned to the system when they are freed. By default, glibc raises this threshold up to 32 MB
  // and keeps the freed gaps, which costs a tenth more memory in a cloud of 140,000 particles.
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  // Smaller arrays are kept: every step allocates and frees some, and mapping new pages costs more than the work on
  // them.
  mallopt(M_TRIM_THRESHOLD, 32 << 20);
  std::vector<char*> arguments = arguments_of(argc, argv);
  return whipple::run_guarded("whipple", whipple_main, static_cast<int>(arguments.size()) - 1,
                              arguments.data());
}
