// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/bench_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/app/build_info.hpp"
#include "src/base/files.hpp"
#include "src/io/run_directory.hpp"
#include "src/parallel/mpi.hpp"
#include "src/parallel/threads.hpp"
#include "src/process/paths.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A case of the project as a problem to time. The steps before the timed ones bring it into the state of
/// interest.
struct Problem {
  std::string name;
  std::string what;
  std::string case_file;
  std::vector<std::pair<std::string, std::string>> overrides;
  int steps_before;
  int steps;
};

std::vector<Problem> problems() {
  return {{"taylor_bar", "elastic-plastic solid, Mie-Grueneisen", "cases/taylor_bar/case.toml", {}, 20, 200},
          {"taylor_bar_musl",
           "the same with linear MUSL",
           "cases/taylor_bar/case.toml",
           {{"time.scheme", "musl"},
            {"transfer.particle_update", "flip"},
            {"transfer.shape_function", "linear"},
            {"output.maximum_energy_error", "1"}},
           20,
           200},
          {"lead_impact",
           "lead sphere on plate during penetration, Mie-Grueneisen",
           "cases/lead_sphere_on_plate/case.toml",
           {},
           50,
           50},
          {"debris_cloud",
           "copper disk on aluminium, three-phase GRAY, cloud formed",
           "cases/copper_disk_on_aluminium/case.toml",
           {{"domain.cell_size", "0.5 mm"}},
           200,
           50}};
}

/// STREAM-like triad, best of five (GB/s): what memory can deliver to this many threads.
double triad_bandwidth() {
  constexpr std::size_t n = std::size_t{1} << 24;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 0.0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Clock::time_point begin = Clock::now();
    parallel::for_each(n, [&](std::size_t i) { a[i] = b[i] + 3.0 * c[i]; });
    best = std::max(best, 24.0 * static_cast<double>(n) / seconds_since(begin) * 1e-9);
  }
  return a[n / 2] == 7.0 ? best : 0.0;  // the result is used, so the loop stays
}

nlohmann::json time_problem(const Problem& problem, bool quick) {
  const setup::Case setup = setup::read_case(process::find_data(problem.case_file), problem.overrides);
  solver::Simulation simulation(setup, parallel::world());
  const int before = quick ? problem.steps_before / 5 : problem.steps_before;
  const int steps = quick ? std::max(10, problem.steps / 5) : problem.steps;
  for (int i = 0; i < before; ++i) simulation.advance(setup.time.end);
  simulation.profile().clear();
  const Clock::time_point begin = Clock::now();
  for (int i = 0; i < steps; ++i) simulation.advance(setup.time.end);
  const double particle_steps = static_cast<double>(simulation.particles().size()) * steps;
  const double total = seconds_since(begin) / particle_steps * 1e9;

  fmt::print("\n{}: {}\n{} particles, {} steps, {} active blocks, {:.0f} bytes per particle\n", problem.name,
             problem.what, simulation.particles().size(), steps, simulation.grid().slots(),
             static_cast<double>(simulation.bytes()) / static_cast<double>(simulation.particles().size()));
  fmt::print("  {:<20} {:>12} {:>8}\n", "stage", "ns/particle", "share");
  nlohmann::json stages = nlohmann::json::object();
  for (const solver::Profile::Stage& stage : simulation.profile().stages()) {
    const double ns = stage.seconds / particle_steps * 1e9;
    fmt::print("  {:<20} {:>12.1f} {:>7.1f}%\n", stage.name, ns, 100.0 * ns / total);
    stages[stage.name] = ns;
  }
  fmt::print("  {:<20} {:>12.1f}\n", "whole step", total);
  return {{"problem", problem.name},
          {"particles", simulation.particles().size()},
          {"steps", steps},
          {"ns_per_particle_step", total},
          {"stages", stages}};
}

struct Options {
  bool quick = false;
  bool force = false;
  int threads = 1;
  std::string json;
};

void run_bench(const Options& options) {
  require_new_file(options.json, options.force);
  parallel::world();
  parallel::set_threads(options.threads);
  const double bandwidth = triad_bandwidth();
  fmt::print("whipple {} ({}), {} threads, memory bandwidth (triad) {:.1f} GB/s\n", build_info().version,
             build_info().revision, options.threads, bandwidth);
  nlohmann::json results = {{"version", build_info().version},
                            {"revision", build_info().revision},
                            {"threads", options.threads},
                            {"triad_GB_per_s", bandwidth},
                            {"problems", nlohmann::json::array()}};
  for (const Problem& problem : problems())
    results["problems"].push_back(time_problem(problem, options.quick));
  if (!options.json.empty()) {
    io::write_text_atomically(options.json, results.dump(2) + "\n");
    fmt::print("\nwrote {}\n", options.json);
  }
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("bench", "Time standard problems: nanoseconds per particle and step, by stage");
  command->add_flag("--quick", options->quick, "A fifth of the steps");
  command->add_option("--threads", options->threads, "Threads (default 1)")->check(CLI::Range(1, 4096));
  command->add_option("--json", options->json, "Also write the figures to a file")->type_name("FILE.json");
  command->add_flag("--force", options->force, "Replace the file");
  command->footer(
      "Example:\n  whipple bench --quick --threads 2 --json bench.json\n"
      "Compare ratios of one machine in one state, never absolute times of two.");
  command->callback([options] { run_bench(*options); });
}

}  // namespace whipple::app
