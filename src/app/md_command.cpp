// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/md_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "md_fitting/plan/plan.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/process/mpirun.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/process.hpp"

namespace whipple::app {
namespace {

struct MdOptions {
  std::string plan;
  std::string store;
  int ranks = 0;
  bool retry_failed = false;
  bool adaptive = false;
};

/// Defines the exit code of a process terminated by a signal, as returned by a shell and mpirun, less the signal
/// number.
constexpr int killed_code = 128;

/// Returns the number of physical cores, rounded down to a multiple of the ranks per point (at least one team).
int usual_ranks(const std::string& plan) {
  const int team = static_cast<int>(md::read_plan(plan).ranks_per_point);
  return std::max(1, process::physical_cores() / team) * team;
}

/// Computes the missing points of a plan.
int compute(const MdOptions& options, const std::string& plan, int ranks) {
  const log::Level level = log::level();
  std::vector<std::string> program = {"whipple-md", plan};
  if (!options.store.empty()) program.insert(program.end(), {"-o", options.store});
  if (options.retry_failed) program.emplace_back("--retry-failed");
  if (level == log::Level::quiet) program.emplace_back("--quiet");
  if (level == log::Level::verbose) program.emplace_back("--verbose");
  // Ranks share no state except the queue of points; each runs one thread. If a rank is killed (by the system, for
  // memory), all ranks end. Finished points are in the store, and another call computes the rest.
  constexpr int most_calls = 3;
  for (int call = 1;; ++call) {
    const int code = process::mpirun(ranks, program, {{"OMP_NUM_THREADS", "1"}});
    if (code != killed_code + SIGKILL) return code;
    log::warning("a worker was killed (SIGKILL): {}",
                 call < most_calls ? "going on with the points that are missing" : "the plan is incomplete");
    if (call == most_calls) return static_cast<int>(ExitCode::state);
  }
}

/// Alternates between proposal (whipple-fit) and computation (whipple-md) until no further points are proposed.
int run_adaptive(MdOptions options, int ranks) {
  const std::filesystem::path plan = options.plan;
  if (options.store.empty()) options.store = plan.stem().string() + ".md.h5";
  const std::filesystem::path store = options.store;
  const std::filesystem::path round =
      store.parent_path() / fmt::format(".{}.round.toml", store.filename().string());
  const int team = static_cast<int>(md::read_plan(plan).ranks_per_point);
  const std::string at_once = std::to_string(std::max(1, ranks / team));
  std::string former;
  for (;;) {
    std::filesystem::remove(round);
    const int code =
        process::run_process({process::find_executable("whipple-fit").string(), options.store, "--propose",
                              options.plan, "--proposal", round.string(), "--points", at_once});
    if (code != 0 || !std::filesystem::exists(round)) return code;
    const std::string text = read_text(round);
    if (text == former) {
      log::warning("the points proposed last could not be computed");
      std::filesystem::remove(round);
      return static_cast<int>(ExitCode::state);
    }
    former = text;
    const int computed = compute(options, round.string(), ranks);
    std::filesystem::remove(round);
    // A failed point is in the store, and the next proposal omits it.
    if (computed != 0 && computed != static_cast<int>(ExitCode::state)) return computed;
  }
}

int run_md(const MdOptions& options) {
  if (!std::filesystem::exists(options.plan)) {
    throw InputError(fmt::format("{}: error: cannot open the file", options.plan));
  }
  const int ranks = options.ranks > 0 ? options.ranks : usual_ranks(options.plan);
  return options.adaptive ? run_adaptive(options, ranks) : compute(options, options.plan, ranks);
}

}  // namespace

void add_md_command(CLI::App& app) {
  auto options = std::make_shared<MdOptions>();
  CLI::App* command =
      app.add_subcommand("md", "Run what is missing of a plan of molecular-dynamics state points");
  command->add_option("plan", options->plan, "The plan (PLAN.toml)")->required();
  command->add_option("-o,--output", options->store, "The store of results (default: that of the plan)");
  command
      ->add_option("--ranks", options->ranks, "MPI ranks, one state point each (default: the physical cores)")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--retry-failed", options->retry_failed, "Also run points that failed before");
  command->add_flag(
      "--adaptive", options->adaptive,
      "Choose the points from the ranges of the plan by what its section [adaptive] is to learn");
  command->footer("Example:\n  whipple md cases/md/copper_mishin_short.toml -o copper.md.h5 --ranks 2");
  command->callback([options] {
    const int code = run_md(*options);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app
