// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/md_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/log.hpp"
#include "src/process/paths.hpp"
#include "src/process/process.hpp"

namespace whipple::app {
namespace {

struct Options {
  std::string plan;
  std::string store;
  int ranks = 0;
  bool retry_failed = false;
};

/// Ranks share no state but the queue of points: each runs one thread, a waiting one leaves its core to
/// others.
process::Environment mpi_environment() {
  process::Environment environment = {{"OMP_NUM_THREADS", "1"},
                                      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                                      {"OMPI_MCA_mpi_yield_when_idle", "1"},
                                      {"OMPI_MCA_hwloc_base_binding_policy", "none"}};
  if (geteuid() == 0) {  // Open MPI refuses root, as in containers, unless both are set
    environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return environment;
}

int run_md(const Options& options) {
  if (!std::filesystem::exists(options.plan)) {
    throw InputError(fmt::format("{}: error: cannot open the file", options.plan));
  }
  const int ranks = options.ranks > 0 ? options.ranks : process::physical_cores();
  std::vector<std::string> arguments = {"mpirun", "-np", std::to_string(ranks)};
  const log::Level level = log::level();
  // The worker says itself what went wrong; mpirun would add a page on the exit code.
  if (level != log::Level::verbose) arguments.emplace_back("--quiet");
  arguments.push_back(process::find_executable("whipple-md").string());
  arguments.push_back(options.plan);
  if (!options.store.empty()) arguments.insert(arguments.end(), {"-o", options.store});
  if (options.retry_failed) arguments.emplace_back("--retry-failed");
  if (level == log::Level::quiet) arguments.emplace_back("--quiet");
  if (level == log::Level::verbose) arguments.emplace_back("--verbose");
  log::detail("{}", fmt::join(arguments, " "));
  return process::run_process(arguments, mpi_environment());
}

}  // namespace

void add_md_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("md", "Run what is missing of a plan of molecular-dynamics state points");
  command->add_option("plan", options->plan, "The plan (PLAN.toml)")->required();
  command->add_option("-o,--output", options->store, "The store of results (default: that of the plan)");
  command
      ->add_option("--ranks", options->ranks, "MPI ranks, one state point each (default: the physical cores)")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--retry-failed", options->retry_failed, "Also run points that failed before");
  command->footer("Example:\n  whipple md cases/md/copper_mishin_short.toml -o copper.md.h5 --ranks 2");
  command->callback([options] {
    const int code = run_md(*options);
    if (code != 0) throw CLI::RuntimeError(code);
  });
}

}  // namespace whipple::app
