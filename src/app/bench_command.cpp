// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/bench_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/app/build_info.hpp"
#include "src/bench/device_states.hpp"
#include "src/bench/laws.hpp"
#include "src/bench/machine.hpp"
#include "src/bench/measurement.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text_table.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/process/mpirun.hpp"
#include "src/core/process/paths.hpp"
#include "src/io/run_directory.hpp"
#include "src/solver/device/device.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;
using bench::Measurement;

struct BenchOptions {
  std::vector<std::string> problems;
  std::vector<int> threads = {1};
  std::vector<int> ranks = {1};
  bool quick = false;
  bool whole = false;
  bool weak = false;
  bool force = false;
  bool laws = false;
  solver::Device device = solver::Device::cpu;
  std::string json;
  std::string compare;
  std::string states;  // folder
  std::string worker;  // file to which one measurement is written
};

bench::Length length(const BenchOptions& options) {
  return options.whole ? bench::Length::whole : options.quick ? bench::Length::quick : bench::Length::normal;
}

/// Measures one problem on the ranks of this process. Each problem runs in separate processes, so that its peak memory
/// is measured separately.
void run_worker(const BenchOptions& options) {
  solver::default_device() = options.device;
  bench::Problem problem = bench::find_problem(options.problems.front());
  const int cores = parallel::size(parallel::world()) * options.threads.front();
  if (options.weak) problem = bench::refined(problem, cores);
  const Measurement measurement =
      bench::measure(problem, options.threads.front(), length(options), parallel::world());
  if (parallel::rank(parallel::world()) == 0) {
    io::write_text_atomically(options.worker, json_text(bench::to_json(measurement), -1) + "\n");
  }
}

Measurement measure_in_own_processes(const BenchOptions& options, const std::string& problem, int ranks,
                                     int threads) {
  const fs::path file = fs::temp_directory_path() / fmt::format("whipple_bench_{}.json", getpid());
  // This executable under its current name: copies of it are compared with one another.
  std::vector<std::string> program = {process::own_executable().filename().string(),
                                      "bench",
                                      problem,
                                      "--threads",
                                      std::to_string(threads),
                                      "--worker",
                                      file.string()};
  if (options.quick) program.emplace_back("--quick");
  if (options.whole) program.emplace_back("--whole");
  if (options.weak) program.emplace_back("--weak");
  if (solver::is_device(options.device)) {
    program.emplace_back("--device");
    program.emplace_back(word_of(options.device));
  }
  const int code = process::mpirun(ranks, program);
  if (code != 0) throw CLI::RuntimeError(code);
  const Measurement measurement = bench::from_json(parse_json(read_text(file)));
  fs::remove(file);
  return measurement;
}

std::string percent(double part, double whole) { return fmt::format("{:.0f} %", 100.0 * part / whole); }

/// Prints the stages compared with the minimum time set by memory bandwidth and arithmetic units of these cores.
void print(const Measurement& m) {
  fmt::print("\n{}: {}\n{} particles, of which {:.0f} % are at rest, {} steps, {} ranks x {} threads; ",
             m.problem, bench::find_problem(m.problem).what, m.particles, 100.0 * m.share_at_rest, m.steps,
             m.ranks, m.threads);
  fmt::print("{:.1f} particles per block of 64 cells; {:.0f} bytes per particle, peak {:.0f} MB\n",
             m.particles_per_block, m.bytes_per_particle, 1e-6 * m.peak_memory);
  std::vector<std::vector<std::string>> rows = {
      {"  stage", "ns/particle", "fraction", "bytes", "of bandwidth", "flops", "of arithmetic"}};
  const auto row = [&](const std::string& name, double ns, double bytes, double flops) {
    const double memory_ns = 1e9 * bytes / m.machine.bandwidth, flops_ns = 1e9 * flops / m.machine.arithmetic;
    rows.push_back(
        {"  " + name, fmt::format("{:.1f}", ns), percent(ns, m.nanoseconds),
         bytes > 0.0 ? fmt::format("{:.0f}", bytes) : "", bytes > 0.0 ? percent(memory_ns, ns) : "",
         flops > 0.0 ? fmt::format("{:.0f}", flops) : "", flops > 0.0 ? percent(flops_ns, ns) : ""});
  };
  double bytes = 0.0, flops = 0.0;
  for (const bench::StageMeasurement& stage : m.stages) {
    row(stage.name, stage.nanoseconds, stage.bytes, stage.flops);
    bytes += stage.bytes;
    flops += stage.flops;
  }
  row("whole step", m.nanoseconds, bytes, flops);
  fmt::print("{}", text_table(rows, "lr"));
  if (m.device) {
    fmt::print("  device: {}; copy {:.0f} GB/s, multiply-adds in double precision {:.0f} Gflop/s\n",
               *m.device, 1e-9 * m.machine.bandwidth, 1e-9 * m.machine.arithmetic);
    return;
  }
  fmt::print(
      "  {:.2f} times the reference kernel on as many cores ({:.1f} ns; triad {:.1f} GB/s, "
      "multiply-adds {:.1f} Gflop/s)\n",
      1e-9 * m.nanoseconds / m.machine.reference_kernel, 1e9 * m.machine.reference_kernel,
      1e-9 * m.machine.bandwidth, 1e-9 * m.machine.arithmetic);
}

/// Prints how each problem scales with cores: the speed-up relative to its first configuration, per core, and relative
/// to the speed-up of the reference kernel, whose threads share no data, on the same cores. Times are per particle:
/// the speed-up of a problem that grows with the cores is that of the work done in a second.
void print_scaling(const std::vector<Measurement>& all) {
  std::vector<std::vector<std::string>> rows = {{"problem", "ranks", "threads", "ns/particle", "speed-up",
                                                 "efficiency", "kernel's speed-up", "of the kernel's"}};
  for (const Measurement& m : all) {
    const auto first = std::ranges::find(all, m.problem, &Measurement::problem);
    const double gain = first->nanoseconds / m.nanoseconds;
    const double of_kernel = first->machine.reference_kernel / m.machine.reference_kernel;
    rows.push_back({m.problem, std::to_string(m.ranks), std::to_string(m.threads),
                    fmt::format("{:.1f}", m.nanoseconds), fmt::format("{:.2f}", gain),
                    percent(gain * first->cores(), m.cores()), fmt::format("{:.2f}", of_kernel),
                    percent(gain, of_kernel)});
  }
  fmt::print("\n{}", text_table(rows, "lr"));
}

std::vector<Measurement> read_measurements(const fs::path& file) {
  try {
    const nlohmann::json json = parse_json(read_text(file));
    std::vector<Measurement> all;
    for (const nlohmann::json& m : json.at("measurements")) all.push_back(bench::from_json(m));
    return all;
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: error: was not written by whipple bench --json", file.string()));
  }
}

/// Prints ratios of times, plain and normalised by the machine performance measured in the same session.
void print_comparison(const std::vector<Measurement>& now, const std::vector<Measurement>& before,
                      const std::string& file) {
  std::vector<std::vector<std::string>> rows = {{"problem", "ranks", "threads", "before", "now",
                                                 "now / before", "by arithmetic", "by bandwidth",
                                                 "by kernel"}};
  for (const Measurement& m : now) {
    const auto old = std::ranges::find_if(before, [&](const Measurement& other) {
      return other.problem == m.problem && other.ranks == m.ranks && other.threads == m.threads;
    });
    if (old == before.end()) continue;
    const double ratio = m.nanoseconds / old->nanoseconds;
    rows.push_back(
        {m.problem, std::to_string(m.ranks), std::to_string(m.threads),
         fmt::format("{:.1f} ns", old->nanoseconds), fmt::format("{:.1f} ns", m.nanoseconds),
         fmt::format("{:.2f}", ratio),
         fmt::format("{:.2f}", ratio * m.machine.arithmetic / old->machine.arithmetic),
         fmt::format("{:.2f}", ratio * m.machine.bandwidth / old->machine.bandwidth),
         fmt::format("{:.2f}", ratio * old->machine.reference_kernel / m.machine.reference_kernel)});
  }
  if (rows.size() == 1) {
    fmt::print("\n{} holds none of these problems on these ranks and threads\n", file);
    return;
  }
  fmt::print("\nbeside {}:\n{}", file, text_table(rows, "lr"));
}

nlohmann::json to_json(const std::vector<Measurement>& all, const BenchOptions& options) {
  nlohmann::json measurements = nlohmann::json::array();
  for (const Measurement& m : all) measurements.push_back(bench::to_json(m));
  return {{"version", build_info().version},
          {"revision", build_info().revision},
          {"scaling", options.weak ? "weak" : "strong"},
          {"length", options.whole   ? "whole"
                     : options.quick ? "quick"
                                     : "normal"},
          {"measurements", measurements}};
}

/// Prints the cost of the strength and failure laws in multiples of Johnson-Cook, as a table of the manual.
void print_laws(bool quick) {
  fmt::print("| law | kind | ns per point and step | multiple of johnson_cook (half of the rounds) |\n");
  fmt::print("| --- | --- | --- | --- |\n");
  for (const bench::LawMeasurement& law : bench::measure_laws(quick ? 5 : 41)) {
    fmt::print("| `{}` | {} | {:.1f} | {:.2f} ({:.2f} to {:.2f}) |\n", law.name, law.kind, law.nanoseconds,
               law.multiple, law.low, law.high);
  }
}

/// Writes states for whipple-device-check.
void write_states(const BenchOptions& options) {
  const std::size_t steps = options.quick ? 20 : 200;
  for (const std::string& line : bench::write_device_states(options.states, options.problems, steps,
                                                            build_info().revision, parallel::world())) {
    fmt::print("{}\n", line);
  }
}

void run_bench(BenchOptions options) {
  if (!options.worker.empty()) return run_worker(options);
  if (options.laws) return print_laws(options.quick);
  if (!options.states.empty()) return write_states(options);
  solver::require(options.device);
  require_new_file(options.json, options.force);
  std::vector<Measurement> before;
  if (!options.compare.empty()) before = read_measurements(options.compare);
  if (options.problems.empty()) {
    for (const bench::Problem& problem : bench::problems()) {
      if (!problem.only_by_name) options.problems.push_back(problem.name);
    }
  }
  for (const std::string& name : options.problems) static_cast<void>(bench::find_problem(name));

  std::vector<Measurement> all;
  fmt::print("whipple {} ({})\n", build_info().version, build_info().revision);
  for (const std::string& problem : options.problems) {
    for (const int ranks : options.ranks) {
      for (const int threads : options.threads) {
        Measurement m = measure_in_own_processes(options, problem, ranks, threads);
        if (!solver::is_device(options.device)) m.machine = bench::measure_machine(m.cores());
        print(m);
        all.push_back(std::move(m));
      }
    }
  }
  if (options.ranks.size() * options.threads.size() > 1) print_scaling(all);
  if (!options.compare.empty()) print_comparison(all, before, options.compare);
  if (options.json.empty()) return;
  io::write_text_atomically(options.json, json_text(to_json(all, options), 2) + "\n");
  fmt::print("\nwrote {}\n", options.json);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench",
                                         "Time standard problems: nanoseconds per particle and step, by "
                                         "stage, compared with the limits of the machine");
  CLI::Option* laws = command->add_flag("--laws", options->laws,
                                        "Instead of problems: the update of the material by law of strength "
                                        "and failure of metals, in multiples "
                                        "of Johnson-Cook");
  command->add_option("problems", options->problems, "Which ones (default: all but the largest)")
      ->type_name("NAME")
      ->excludes(laws);
  command->add_option("--threads", options->threads, "Threads of each rank; several: one after the other")
      ->delimiter(',')
      ->check(CLI::Range(1, 4096))
      ->excludes(laws);
  command->add_option("--ranks", options->ranks, "MPI ranks of this machine; several: one after the other")
      ->delimiter(',')
      ->check(CLI::Range(1, 4096))
      ->excludes(laws);
  add_word_option(*command, "--device", options->device,
                  "cpu | gpu: a graphics processor | emulated: its kernels on the threads of this machine")
      ->default_str("cpu")
      ->excludes(laws);
  CLI::Option* quick = command->add_flag("--quick", options->quick, "A fifth of the steps");
  command
      ->add_flag("--whole", options->whole, "The cases from beginning to end instead of some steps of them")
      ->excludes(quick)
      ->excludes(laws);
  command
      ->add_flag("--weak", options->weak,
                 "As many points for each core: cells finer by the cube root of the number of cores")
      ->excludes(laws);
  command->add_option("--json", options->json, "Also write the figures to a file")
      ->type_name("FILE.json")
      ->excludes(laws);
  command->add_option("--compare", options->compare, "Print ratios to the figures of an earlier call")
      ->type_name("OLD.json")
      ->excludes(laws);
  command->add_flag("--force", options->force, "Replace the file of --json")->excludes(laws);
  command
      ->add_option("--states", options->states,
                   "Instead of timing: run small problems and write states for whipple-device-check; with "
                   "--quick of 20 steps instead of 200; names of problems are those of the states")
      ->type_name("FOLDER")
      ->excludes(laws);
  command->add_option("--worker", options->worker)->group("");  // the ranks that this command starts
  std::string footer = "Problems:\n";
  for (const bench::Problem& problem : bench::problems()) {
    footer += fmt::format("  {:<24} {}\n", problem.name, problem.what);
  }
  command->footer(
      footer +
      "Example:\n  whipple bench taylor_bar lead_impact --threads 1,2 --json new.json --compare old.json\n"
      "Compare ratios of one machine in one state, never absolute times of two.");
  command->callback([options] { run_bench(*options); });
}

}  // namespace whipple::app
