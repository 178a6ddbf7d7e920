// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "src/analysis/run.hpp"
#include "src/app/build_info.hpp"
#include "src/app/command_line.hpp"
#include "src/case/build/placement.hpp"
#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/core/base/words.hpp"
#include "src/core/input/overlay.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/process/mpirun.hpp"
#include "src/core/process/paths.hpp"
#include "src/decks/import.hpp"
#include "src/run/check.hpp"
#include "src/run/restart.hpp"
#include "src/run/run.hpp"
#include "src/run/signal_control.hpp"
#include "src/view/cloud.hpp"
#include "src/view/page.hpp"

namespace whipple::app {
namespace {

using solver::Device;

struct Arguments {
  std::string case_file;
  std::string output;
  std::string restart;
  std::string start_from;
  std::vector<std::string> set;
  std::string wall_time;
  std::string replay;
  int threads = 0;
  int ranks = 0;
  Device device = Device::cpu;
  double bandwidth = 0.0;  // bytes/s, of a graphics processor
  bool force = false;
};

run::RunOptions run_options(const Arguments& arguments) {
  run::RunOptions options{
      .case_file = arguments.case_file,
      .output_directory = arguments.output,
      .start_from = arguments.start_from,
      .restart = !arguments.restart.empty(),
      .force = arguments.force,
      .threads = arguments.threads,
      .wall_time = arguments.wall_time.empty()
                       ? 0.0
                       : option_quantity("--wall-time", arguments.wall_time, "s", range::positive()),
      .replay = arguments.replay,
      .program = fmt::format("whipple {} ({})", build_info().version, build_info().revision),
      .overrides = {}};
  if (options.restart) {
    if (!arguments.replay.empty())
      throw InputError("--replay repeats a run from its start: it cannot join --restart");
    if (!arguments.start_from.empty())
      throw InputError("--start-from begins another run with its state: it cannot join --restart");
    if (!arguments.output.empty())
      throw InputError("--restart DIR resumes in DIR: -o cannot name another one");
    if (!arguments.case_file.empty()) {
      throw InputError(
          "--restart DIR reads the case from DIR/run.toml: omit CASE.toml, change keys with --set");
    }
    options.output_directory = arguments.restart;
  } else if (arguments.case_file.empty()) {
    throw InputError("expected a case file (CASE.toml) or --restart DIR");
  }
  decks::require_no_deck(arguments.case_file);
  for (const std::string& entry : arguments.set) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError(fmt::format("--set {}: expected key=value, for example --set time.end='5 us'", entry));
    }
    if (options.restart && run::is_fixed(entry.substr(0, equals))) {
      throw InputError(
          fmt::format("--set {}: grid, bodies and gauges are those of the checkpoint; start over with "
                      "whipple run CASE.toml",
                      entry));
    }
    options.overrides.emplace_back(entry.substr(0, equals), entry.substr(equals + 1));
  }
  return options;
}

/// Runs the same command on MPI ranks of this machine.
int run_on_ranks(const Arguments& arguments) {
  std::vector<std::string> program = {process::own_executable().filename().string(), "run"};
  if (!arguments.case_file.empty()) program.push_back(arguments.case_file);
  const auto pass = [&](const char* option, const std::string& value) {
    if (!value.empty()) program.insert(program.end(), {option, value});
  };
  pass("--output", arguments.output);
  pass("--restart", arguments.restart);
  pass("--start-from", arguments.start_from);
  pass("--wall-time", arguments.wall_time);
  pass("--replay", arguments.replay);
  for (const std::string& entry : arguments.set) pass("--set", entry);
  if (arguments.threads > 0) pass("--threads", std::to_string(arguments.threads));
  if (arguments.device != Device::cpu) pass("--device", std::string(word_of(arguments.device)));
  if (arguments.force) program.emplace_back("--force");
  if (log::level() == log::Level::quiet) program.emplace_back("--quiet");
  if (log::level() == log::Level::verbose) program.emplace_back("--verbose");
  // Ranks that wait for one another terminate themselves; the launcher allows them the time to do so.
  constexpr double margin = 60.0;  // s
  return process::mpirun(arguments.ranks, program, {}, run::SignalControl::longest_end + margin);
}

/// Runs the case on the ranks of this process.
int run_here(const Arguments& arguments) {
  try {
    if (arguments.device == Device::reference) kernel_set() = KernelSet::plain;
    solver::default_device() = arguments.device;
    return run::run_case(run_options(arguments), parallel::world());
  } catch (const std::exception& error) {
    log::record_error(error.what());  // also to log.txt, if the run directory exists
    if (parallel::size(parallel::world()) > 1) {
      parallel::end_all_ranks(parallel::world(), message_for_user("whipple", error),
                              static_cast<int>(exit_code(error)));
    }
    throw;
  }
}

/// Examines a case for `whipple check`.
run::CaseCheck examine(const Arguments& arguments, bool with_forecast) {
  std::optional<run::DeviceQuestion> device;
  if (arguments.device == Device::gpu) device = run::DeviceQuestion{arguments.bandwidth};
  if (arguments.device != Device::cpu && !device)
    throw InputError("--device: check estimates cpu and gpu; the others are for comparisons");
  return run::examine_case(run_options(arguments), with_forecast, parallel::world(), device);
}

nlohmann::json faults_json(const InputError& error) {
  nlohmann::json faults = nlohmann::json::array();
  for (const InputFault& fault : error.faults()) {
    faults.push_back({{"file", fault.file},
                      {"line", fault.line},
                      {"column", fault.column},
                      {"key", fault.key},
                      {"text", fault.text}});
  }
  return faults;
}

/// Prints that a case is right if its particles would take more memory than a limit, bytes.
/// @throws InputError if it is wrong, after its faults were printed
bool takes_more_memory(const Arguments& arguments, double limit, bool as_json) {
  try {
    const run::RunOptions options = run_options(arguments);
    const double memory = cases::expected_memory(cases::read_case(options.case_file, options.overrides));
    if (memory <= limit) return false;
    const std::string text = fmt::format("the particles take up to {}, more than {}: they were not built",
                                         format_bytes(memory), format_bytes(limit));
    const nlohmann::json found = {{"faults", nlohmann::json::array()}, {"unbuilt", text}};
    fmt::print("{}\n", as_json ? json_text(found, 1) : text);
    return true;
  } catch (const InputError& error) {
    if (as_json) fmt::print("{}\n", json_text(nlohmann::json{{"faults", faults_json(error)}}, 1));
    throw;
  }
}

/// Prints what a case would run, or its faults as data.
/// @throws the error of a wrong case, after its faults were printed
void print_check_as_json(const Arguments& arguments, bool with_forecast) {
  using nlohmann::json;
  const auto print = [](const json& text) { fmt::print("{}\n", json_text(text, 1)); };
  try {
    print(run::check_json(examine(arguments, with_forecast)));
  } catch (const InputError& error) {
    print({{"faults", faults_json(error)}});
    throw;
  }
}

constexpr std::string_view cloud_ending = ".wpv";
constexpr std::size_t most_particles_of_cloud = 200000;  // that a browser draws with ease

/// Writes a page that shows the initial bodies of a case: the first snapshot of a run of one very small step.
/// `FILE.wpv`: that snapshot alone, for a page that draws it.
void write_preview(const Arguments& arguments, const std::string& page_file) {
  const TemporaryFolder folder;
  run::RunOptions options = run_options(arguments);
  options.output_directory = folder.path() / "start";
  options.overrides.insert(options.overrides.end(),
                           {{"time.end", "1e-15 s"}, {"output.snapshot_every", "0 s"}});
  const log::Level level = log::level();
  log::set_level(log::Level::quiet);  // the remarks have been printed
  set_progress_visible(false);
  run::run_case(options, parallel::world());
  log::set_level(level);
  analysis::Run start = analysis::read_run(options.output_directory);
  start.snapshots.resize(1);
  if (page_file.ends_with(cloud_ending)) {
    const analysis::Snapshot snapshot = analysis::read_snapshot(start.snapshots.front());
    const view::CloudOptions detail = {.fields = {},
                                       .one_of = 1 + (snapshot.size() - 1) / most_particles_of_cloud};
    write_text_atomically(page_file, view::pack_cloud(start, snapshot, detail));
    return;
  }
  const view::Page page = view::make_page(start, {}, process::find_data("web/viewer"));
  write_text_atomically(page_file, page.html);
  fmt::print("wrote {}: {}\n", page_file,
             page.one_of == 1 ? "all particles" : fmt::format("about one of {} particles", page.one_of));
}

/// Checks that a path is not a folder, and where it is nothing, whether a case that comes with the program is meant.
/// @throws InputError for a folder, with the case file in it; for such a case, with its place
void require_case_file(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path) && path.is_relative() && !path.empty()) {
    const std::optional<std::filesystem::path> own = process::data_if_there(path);
    if (own) {
      throw InputError(fmt::format("{}: there is no such file here; the one that comes with the program: {}",
                                   path.string(), own->string()));
    }
  }
  if (!std::filesystem::is_directory(path)) return;
  if (std::filesystem::exists(path / "run.toml")) {
    throw InputError(
        fmt::format("{0} is the folder of a run: to go on with it, whipple run --restart {0}; its case is "
                    "{0}/run.toml",
                    path.string()));
  }
  const std::filesystem::path inside = path / "case.toml";
  throw InputError(fmt::format("{} is a folder: give the case file{}", path.string(),
                               std::filesystem::exists(inside) ? ", " + inside.string() : " in it"));
}

void add_common(CLI::App& command, Arguments& arguments) {
  command.add_option("case", arguments.case_file, "The case (CASE.toml)");
  command
      .add_option("--set", arguments.set,
                  "Override a key of the case, e.g. domain.cell_size='0.3 mm' (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--threads", arguments.threads,
                  "Threads of each rank (default: OMP_NUM_THREADS, SLURM_CPUS_PER_TASK, or its part of the "
                  "processors that "
                  "this process may use)")
      ->check(CLI::Range(1, 4096));
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("run", "Simulate a case, or resume an interrupted run");
  add_common(*command, *arguments);
  command->add_option("-o,--output", arguments->output,
                      "Run directory (default: run/NAME); must be new or empty");
  command->add_option("--restart", arguments->restart, "Go on from the latest checkpoint of a run directory")
      ->type_name("DIR");
  command
      ->add_option("--start-from", arguments->start_from,
                   "Begin at time 0 with the latest checkpoint of another run with the same grid and bodies, "
                   "such as a state of rest under gravity (time.scheme = \"quasi_static\"); velocities of "
                   "the case are added")
      ->type_name("DIR");
  command->add_flag(
      "--force", arguments->force,
      "Remove the outputs of an earlier run in the run directory; with --restart: resume although "
      "rows of history.csv are missing");
  command
      ->add_option(
          "--ranks", arguments->ranks,
          "Start this command on so many MPI ranks of this machine (elsewhere: mpirun whipple run …)")
      ->check(CLI::Range(1, 4096));
  add_word_option(
      *command, "--device", arguments->device,
      "cpu: kernels for the registers of the processor | reference: plain loops over single numbers, five "
      "times slower, to compare with | gpu: a graphics processor, which keeps the particles | emulated: the "
      "kernels of a graphics processor on the threads of this machine, to compare with")
      ->default_str("cpu");
  command
      ->add_option("--wall-time", arguments->wall_time,
                   "Write a checkpoint and end after this time, e.g. '2 hour'")
      ->type_name("TIME");
  command
      ->add_option(
          "--replay", arguments->replay,
          "Repeat the requests to an earlier run (its steering.csv) after the same steps; others are ignored")
      ->type_name("FILE");
  command->footer(
      "Example:\n  whipple run cases/copper_disk_on_aluminium/case.toml -o run/disk --set time.end='5 us'\n"
      "  whipple run --restart run/disk\n"
      "Signals: INT and TERM write a checkpoint and end the run, USR1 writes one and continues.\n"
      "Exit codes: 0 done, 2 wrong input, 3 the physics left its range, or a disk or memory failed\n"
      "  (state saved), 128 + signal when stopped, 124 at the limit of wall time");
  command->callback([arguments] {
    require_case_file(arguments->case_file);
    const int code = arguments->ranks > 0 ? run_on_ranks(*arguments) : run_here(*arguments);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

void add_check_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Validate a case; print what would run: bodies, particles, memory, steps, time");
  add_common(*command, *arguments);
  auto preview = std::make_shared<std::string>();
  command
      ->add_option("--preview", *preview,
                   "Write a page that shows the bodies at the start in three dimensions")
      ->type_name("FILE.html");
  command->add_flag("--force", arguments->force, "Replace the page");
  command->footer(
      "Example:\n  whipple check cases/copper_disk_on_aluminium/case.toml --threads 2\n"
      "  whipple check cases/copper_disk_on_aluminium/case.toml --preview disk.html");
  add_word_option(
      *command, "--device", arguments->device,
      "cpu | gpu: also whether a graphics processor computes the case, the memory that it needs, and a "
      "lower bound of its time")
      ->default_str("cpu");
  command
      ->add_option(
          "--bandwidth", arguments->bandwidth,
          "Bytes per second that copies reach on the graphics processor, e.g. 4.3TB (default: measured; "
          "without one 4.3TB)")
      ->type_name("BYTES")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"GB", 1e9}, {"TB", 1e12}}))
      ->check(CLI::PositiveNumber);
  auto text = std::make_shared<std::string>();
  command
      ->add_option("--text", *text,
                   "Check this text as the content of CASE.toml, which an editor has not written yet")
      ->type_name("FILE");
  auto most = std::make_shared<double>(0.0);
  command
      ->add_option(
          "--most-memory", *most,
          "Check the keys only if the particles would take more memory, e.g. 2GB (default: no limit)")
      ->type_name("BYTES")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"MB", 1e6}, {"GB", 1e9}}))
      ->check(CLI::PositiveNumber);
  auto json = std::make_shared<bool>(false);
  auto brief = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "The same for programs (SI), with the faults of a wrong case as data");
  command->add_flag("--brief", *brief, "Without steps and time, which take a second to measure");
  command->callback([arguments, preview, json, brief, text, most] {
    if (arguments->case_file.empty()) throw InputError("expected a case file (CASE.toml)");
    require_case_file(arguments->case_file);
    if (!preview->empty() && !preview->ends_with(".html") && !preview->ends_with(cloud_ending)) {
      throw InputError(fmt::format(
          "--preview {}: a page for the browser: its name ends with .html (or .wpv: its particles alone)",
          *preview));
    }
    require_new_file(*preview, arguments->force);
    std::optional<input::Overlay> edited;
    if (!text->empty()) edited.emplace(arguments->case_file, read_text(*text));
    if (*most > 0.0 && takes_more_memory(*arguments, *most, *json)) return;
    if (*json) {
      print_check_as_json(*arguments, !*brief);
    } else {
      fmt::print("{}", run::check_text(examine(*arguments, !*brief)));
    }
    if (!preview->empty()) write_preview(*arguments, *preview);
  });
}

}  // namespace whipple::app
