// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/sweep_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/file_lock.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/process.hpp"
#include "src/sweep/report.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = ".lock";

struct SweepArguments {
  std::string study, output;
  std::string slurm;
  int point = -1;
  bool dry_run = false, retry = false, json = false, no_figures = false;
};

constexpr int ended_from_outside = 3;  // exit code

fs::path folder_of(const SweepArguments& arguments) {
  return arguments.output.empty() ? fs::path("run") / fs::path(arguments.study).stem()
                                  : fs::path(arguments.output);
}

fs::path owner_file(const fs::path& folder) { return folder / "study.txt"; }

std::string owner_text(const fs::path& study) { return fs::canonical(study).string() + "\n"; }

/// Checks that a folder is not that of another study.
/// @throws InputError naming the other study
void require_owner(const fs::path& folder, const fs::path& study) {
  const fs::path owner = owner_file(folder);
  if (!fs::exists(owner)) return;
  const std::string other = read_text(owner);
  if (other == owner_text(study)) return;
  throw InputError(fmt::format("{} is the folder of the study {}: give another one with -o", folder.string(),
                               other.substr(0, other.find('\n'))));
}

/// Checks that a folder is new, or that of this study, and notes whose it is.
/// @throws InputError if it is the folder of another study or holds other files
void claim_folder(const fs::path& folder, const fs::path& study) {
  require_owner(folder, study);
  if (fs::exists(owner_file(folder))) return;
  const bool is_empty = std::ranges::all_of(
      fs::directory_iterator(folder),
      [](const fs::directory_entry& entry) { return entry.path().filename() == lock_name; });
  if (!is_empty) {
    if (fs::exists(owner_file(folder))) return require_owner(folder, study);  // by another task, a moment ago
    throw InputError(
        fmt::format("{} is not empty and no folder of a study: give another one with -o", folder.string()));
  }
  write_text_atomically(owner_file(folder), owner_text(study));
}

/// Returns a text as one word of a shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Writes the script of a job array: one task per point.
void write_slurm(const SweepArguments& arguments, const sweep::Plan& plan, const fs::path& folder) {
  if (plan.study.find)
    throw InputError(
        "--slurm: the points of [find] depend on each other: run whipple sweep in one job instead");
  const fs::path file = folder / "array.sh";
  const std::string text = fmt::format(
      "#!/bin/sh\n#SBATCH --array=0-{}\n#SBATCH --cpus-per-task={}\n#SBATCH {}\n"
      "exec {} sweep {} -o {} --point \"$SLURM_ARRAY_TASK_ID\"\n",
      plan.points.size() - 1, plan.study.computing.threads, arguments.slurm,
      quoted(process::own_executable().string()), quoted(fs::absolute(arguments.study).string()),
      quoted(fs::absolute(folder).string()));
  write_text_atomically(file, text);
  fmt::print("wrote {}: sbatch {}; then whipple sweep {} -o {} collects the table\n", file.string(),
             file.string(), arguments.study, folder.string());
}

void print_plan(const sweep::Plan& plan, const sweep::Computer& computer) {
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const sweep::Point& point = plan.points[i];
    std::string values;
    for (std::size_t v = 0; v < plan.variables.size(); ++v)
      values += fmt::format(" {}={}", plan.variables[v].name, toml_string(point.texts[v]));
    fmt::print("{} {} {}{}{}{}\n", i, point.name(), word_of(computer.record(point).state), values,
               point.cell_size.empty() ? "" : " cell_size=" + point.cell_size,
               point.offset == 0.0 ? "" : fmt::format(" offset={}", point.offset));
  }
  log::info("{} points, {} side by side, up to {} each", plan.points.size(), computer.jobs(),
            format_bytes(plan.most_memory));
}

/// Tells the user that a signal ended the study. @returns the exit code
int ended_by(int signal) {
  log::warning("ended by signal {}: the same command goes on", signal);
  return 128 + signal;
}

/// Computes one point, as a task of a job array: others compute other points in the same folder.
int compute_point(const SweepArguments& arguments, const sweep::Plan& plan, sweep::Computer& computer,
                  const process::Pool& pool) {
  if (arguments.point >= static_cast<int>(plan.points.size()))
    throw InputError(
        fmt::format("--point {}: the study has the points 0 to {}", arguments.point, plan.points.size() - 1));
  const sweep::Point& point = plan.points[static_cast<std::size_t>(arguments.point)];
  const bool complete = computer.compute({&point, 1});
  if (!complete) return ended_by(pool.stopped_by());
  for (const sweep::Elsewhere& other : computer.elsewhere())
    throw InputError(fmt::format("--point {}: {} is being computed by {}", arguments.point,
                                 computer.run_folder(point).string(), other.holder));
  const sweep::Record record = computer.record(point);
  return record.state == sweep::State::missing ? ended_from_outside : record.exit_code;
}

/// Tells the user which points have no results yet. @returns the exit code
int tell_missing(std::span<const sweep::Point> points, const sweep::Computer& computer) {
  std::vector<std::string> elsewhere;
  for (const sweep::Elsewhere& other : computer.elsewhere()) {
    elsewhere.push_back(other.name);
    log::warning("{} is being computed by {}", other.name, other.holder);
  }
  const auto is_stopped = [&](const sweep::Point& point) {
    return computer.record(point).state == sweep::State::missing &&
           std::ranges::count(elsewhere, point.name()) == 0;
  };
  const auto stopped = std::ranges::count_if(points, is_stopped);
  if (stopped > 0) log::warning("{} points were ended from outside: the same command goes on", stopped);
  if (!elsewhere.empty())
    log::warning("{} points are being computed elsewhere: the same command collects them later",
                 elsewhere.size());
  return stopped > 0 || !elsewhere.empty() ? ended_from_outside : 0;
}

/// Tells what a study came to, before its figures.
struct Outcome {
  int exit_code = 0;
  bool has_tables = false;
};

Outcome compute_study(const SweepArguments& arguments, const fs::path& folder) {
  process::Pool pool;  // before any thread
  const auto is_asked_to_end = [&pool] { return pool.is_asked_to_end(); };
  const std::optional<sweep::Plan> prepared = sweep::make_plan(arguments.study, is_asked_to_end);
  if (!prepared) return {ended_by(pool.stopped_by())};
  const sweep::Plan& plan = *prepared;
  sweep::Computer computer(plan, folder, pool, {.retry = arguments.retry});
  if (arguments.dry_run) {
    print_plan(plan, computer);
    return {};
  }
  require_no_file(folder);
  make_folder(folder);
  if (arguments.point >= 0) {
    claim_folder(folder, arguments.study);
    return {compute_point(arguments, plan, computer, pool)};
  }
  const FileLock lock(folder / lock_name, fmt::format("the folder of the study {}", folder.string()),
                      FileLock::IfHeld::refuse);
  claim_folder(folder, arguments.study);
  if (!arguments.slurm.empty()) {
    write_slurm(arguments, plan, folder);
    return {};
  }
  std::vector<sweep::Point> points = plan.points;
  bool complete = computer.compute(points);
  if (complete && plan.study.find) complete = sweep::search(plan, computer, points);
  const sweep::Results results = sweep::collect(plan, computer, points);
  sweep::write_tables(results, folder);
  if (arguments.json) fmt::print("{}", sweep::as_json(results));
  if (!complete) return {ended_by(pool.stopped_by())};
  if (!arguments.json) fmt::print("{}", sweep::summary(results));
  log::info("wrote {}: {} points, {} of them computed now", (folder / "points.csv").string(), points.size(),
            computer.computed());
  return {tell_missing(points, computer), true};
}

/// Draws the figures, after the pool has given the signals back: they end the drawing.
/// @returns the exit code if one has ended it, else 0
int draw(const fs::path& folder) {
  try {
    sweep::draw_figures(folder);
  } catch (const InputError& error) {  // the tables are complete
    const int signal = process::last_signal();
    if (signal == SIGINT || signal == SIGTERM) return ended_by(signal);
    log::warning("no figures: {}", error.what());
  }
  return 0;
}

int run_study(const SweepArguments& arguments) {
  const fs::path folder = folder_of(arguments);
  const Outcome outcome = compute_study(arguments, folder);
  if (!outcome.has_tables || arguments.no_figures) return outcome.exit_code;
  const int drawn = draw(folder);
  return drawn == 0 ? outcome.exit_code : drawn;
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command =
      app.add_subcommand("sweep", "Run a case many times with changed keys; one table of the results");
  command->add_option("study", arguments->study, "The study (STUDY.toml)")->required();
  command->add_option("-o,--output", arguments->output, "Folder of the study (default: run/NAME)");
  command->add_flag("--dry-run", arguments->dry_run, "Check all points and list them, compute nothing");
  command->add_flag("--retry", arguments->retry, "Compute failed points once more");
  command->add_flag("--json", arguments->json, "The tables for programs, to standard output");
  command->add_flag("--no-figures", arguments->no_figures, "Tables only");
  CLI::Option* const slurm =
      command
          ->add_option("--slurm", arguments->slurm,
                       "Write the script of a Slurm job array with these options, e.g. '--time=1:00:00', and "
                       "compute nothing")
          ->type_name("OPTIONS")
          ->check([](const std::string& options) {
            return options.find('\n') == std::string::npos ? "" : "options are one line";
          });
  command->add_option("--point", arguments->point, "Compute this point alone: a task of the job array")
      ->type_name("NUMBER")
      ->excludes(slurm)
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command->footer(
      "Example:\n  whipple sweep study.toml -o run/study\n"
      "Interrupted, the same command goes on: finished points are found by the digest of their input.\n"
      "whipple describe study lists the keys. Exit codes: 0 all points are finished (failed ones are "
      "listed),\n"
      "  2 wrong input, 3 a point was ended from outside or is computed elsewhere, 128 + signal when "
      "stopped");
  command->callback([arguments] {
    const int code = run_study(*arguments);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app
