// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/bench_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/app/build_info.hpp"
#include "src/base/error.hpp"
#include "src/base/files.hpp"
#include "src/base/log.hpp"
#include "src/base/text_table.hpp"
#include "src/bench/machine.hpp"
#include "src/bench/measurement.hpp"
#include "src/bench/reference_kernel.hpp"
#include "src/io/run_directory.hpp"
#include "src/parallel/mpi.hpp"
#include "src/process/mpirun.hpp"
#include "src/process/paths.hpp"

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
  bool force = false;
  std::string json;
  std::string compare;
  std::string worker;  // the file that one measurement goes to
};

bench::Length length(const BenchOptions& options) {
  return options.whole ? bench::Length::whole : options.quick ? bench::Length::quick : bench::Length::normal;
}

/// The ranks that measure: each problem has processes of its own, so that its peak memory is its own.
void run_worker(const BenchOptions& options) {
  const Measurement measurement =
      bench::measure(bench::find_problem(options.problems.front()), options.threads.front(), length(options));
  if (parallel::rank(parallel::world()) == 0) {
    io::write_text_atomically(options.worker, bench::to_json(measurement).dump() + "\n");
  }
}

Measurement measure_in_own_processes(const BenchOptions& options, const std::string& problem, int ranks,
                                     int threads) {
  const fs::path file = fs::temp_directory_path() / fmt::format("whipple_bench_{}.json", getpid());
  // This executable itself, whatever its name: copies of it are compared with one another.
  std::vector<std::string> program = {process::own_executable().filename().string(),
                                      "bench",
                                      problem,
                                      "--threads",
                                      std::to_string(threads),
                                      "--worker",
                                      file.string()};
  if (options.quick) program.emplace_back("--quick");
  if (options.whole) program.emplace_back("--whole");
  const int code = process::mpirun(ranks, program);
  if (code != 0) throw CLI::RuntimeError(code);
  const Measurement measurement = bench::from_json(nlohmann::json::parse(io::read_text(file)));
  fs::remove(file);
  return measurement;
}

std::string percent(double part, double whole) { return fmt::format("{:.0f} %", 100.0 * part / whole); }

/// Stages beside what memory and arithmetic units of these cores would need at least.
void print(const Measurement& m, const bench::MachineRates& rates, double reference_kernel) {
  fmt::print("\n{}: {}\n{} particles, of which {:.0f} % rest, {} steps, {} ranks x {} threads; ", m.problem,
             bench::find_problem(m.problem).what, m.particles, 100.0 * m.share_at_rest, m.steps, m.ranks,
             m.threads);
  fmt::print("{:.1f} particles per block of 64 cells; {:.0f} bytes per particle, peak {:.0f} MB\n",
             m.particles_per_block, m.bytes_per_particle, 1e-6 * m.peak_memory);
  std::vector<std::vector<std::string>> rows = {
      {"  stage", "ns/particle", "share", "bytes", "of bandwidth", "flops", "of arithmetic"}};
  const auto row = [&](const std::string& name, double ns, double bytes, double flops) {
    const double memory_ns = 1e9 * bytes / rates.bandwidth, flops_ns = 1e9 * flops / rates.arithmetic;
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
  fmt::print("  {:.2f} times the reference kernel on as many cores\n",
             1e-9 * m.nanoseconds * m.cores() / reference_kernel);
}

/// How a problem gains by cores: speed over that of its first configuration, per core of it.
void print_scaling(const std::vector<Measurement>& all) {
  std::vector<std::vector<std::string>> rows = {
      {"problem", "ranks", "threads", "ns/particle", "speed-up", "efficiency"}};
  for (const Measurement& m : all) {
    const auto first = std::ranges::find(all, m.problem, &Measurement::problem);
    const double gain = first->nanoseconds / m.nanoseconds;
    rows.push_back({m.problem, std::to_string(m.ranks), std::to_string(m.threads),
                    fmt::format("{:.1f}", m.nanoseconds), fmt::format("{:.2f}", gain),
                    percent(gain * first->cores(), m.cores())});
  }
  fmt::print("\n{}", text_table(rows, "lr"));
}

struct Record {
  bench::MachineRates rates;  // of the first configuration
  double reference_kernel;    // s per particle and step on one core; 0: not in the file
  std::vector<Measurement> measurements;
};

Record read_record(const fs::path& file) {
  try {
    const nlohmann::json json = nlohmann::json::parse(io::read_text(file));
    Record record{{json.at("bandwidth_bytes_per_s"), json.at("arithmetic_flops_per_s")},
                  1e-9 * json.value("reference_kernel_ns_per_particle_step", 0.0),
                  {}};
    for (const nlohmann::json& m : json.at("measurements"))
      record.measurements.push_back(bench::from_json(m));
    return record;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: not written by whipple bench --json: {}", file.string(), error.what()));
  }
}

/// Ratios of times, plain and with each time in units of what the machine could do in its own call, and of
/// the reference kernel there.
void print_comparison(const Record& now, const Record& before, const std::string& file) {
  std::vector<std::vector<std::string>> rows = {{"problem", "ranks", "threads", "before", "now",
                                                 "now / before", "by arithmetic", "by bandwidth",
                                                 "by kernel"}};
  for (const Measurement& m : now.measurements) {
    const auto old = std::ranges::find_if(before.measurements, [&](const Measurement& other) {
      return other.problem == m.problem && other.ranks == m.ranks && other.threads == m.threads;
    });
    if (old == before.measurements.end()) continue;
    const double ratio = m.nanoseconds / old->nanoseconds;
    rows.push_back({m.problem, std::to_string(m.ranks), std::to_string(m.threads),
                    fmt::format("{:.1f} ns", old->nanoseconds), fmt::format("{:.1f} ns", m.nanoseconds),
                    fmt::format("{:.2f}", ratio),
                    fmt::format("{:.2f}", ratio * now.rates.arithmetic / before.rates.arithmetic),
                    fmt::format("{:.2f}", ratio * now.rates.bandwidth / before.rates.bandwidth),
                    before.reference_kernel > 0.0
                        ? fmt::format("{:.2f}", ratio * before.reference_kernel / now.reference_kernel)
                        : "-"});
  }
  if (rows.size() == 1) {
    fmt::print("\n{} holds none of these problems on these ranks and threads\n", file);
    return;
  }
  fmt::print("\nbeside {}:\n{}", file, text_table(rows, "lr"));
}

nlohmann::json to_json(const Record& record, const BenchOptions& options) {
  nlohmann::json measurements = nlohmann::json::array();
  for (const Measurement& m : record.measurements) measurements.push_back(bench::to_json(m));
  return {{"version", build_info().version},
          {"revision", build_info().revision},
          {"length", options.whole   ? "whole"
                     : options.quick ? "quick"
                                     : "normal"},
          {"bandwidth_bytes_per_s", record.rates.bandwidth},
          {"arithmetic_flops_per_s", record.rates.arithmetic},
          {"reference_kernel_ns_per_particle_step", 1e9 * record.reference_kernel},
          {"measurements", measurements}};
}

void run_bench(BenchOptions options) {
  if (!options.worker.empty()) return run_worker(options);
  require_new_file(options.json, options.force);
  std::optional<Record> before;
  if (!options.compare.empty()) before = read_record(options.compare);
  if (options.problems.empty()) {
    for (const bench::Problem& problem : bench::problems()) {
      if (!problem.only_by_name) options.problems.push_back(problem.name);
    }
  }
  for (const std::string& name : options.problems) static_cast<void>(bench::find_problem(name));

  Record record{bench::measure_machine(1), bench::measure_reference_kernel(), {}};
  fmt::print(
      "whipple {} ({}); one core: triad {:.1f} GB/s, multiply-adds {:.1f} Gflop/s, reference kernel {:.1f} "
      "ns\n",
      build_info().version, build_info().revision, 1e-9 * record.rates.bandwidth,
      1e-9 * record.rates.arithmetic, 1e9 * record.reference_kernel);
  for (const std::string& problem : options.problems) {
    for (const int ranks : options.ranks) {
      for (const int threads : options.threads) {
        const Measurement m = measure_in_own_processes(options, problem, ranks, threads);
        print(m, m.cores() == 1 ? record.rates : bench::measure_machine(m.cores()), record.reference_kernel);
        record.measurements.push_back(m);
      }
    }
  }
  if (options.ranks.size() * options.threads.size() > 1) print_scaling(record.measurements);
  if (before) print_comparison(record, *before, options.compare);
  if (options.json.empty()) return;
  io::write_text_atomically(options.json, to_json(record, options).dump(2) + "\n");
  fmt::print("\nwrote {}\n", options.json);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand(
      "bench",
      "Time standard problems: nanoseconds per particle and step, by stage, beside the machine's limits");
  command->add_option("problems", options->problems, "Which ones (default: all but the largest)")
      ->type_name("NAME");
  command->add_option("--threads", options->threads, "Threads of each rank; several: one after the other")
      ->delimiter(',')
      ->check(CLI::Range(1, 4096));
  command->add_option("--ranks", options->ranks, "MPI ranks of this machine; several: one after the other")
      ->delimiter(',')
      ->check(CLI::Range(1, 4096));
  CLI::Option* quick = command->add_flag("--quick", options->quick, "A fifth of the steps");
  command
      ->add_flag("--whole", options->whole, "The cases from beginning to end instead of some steps of them")
      ->excludes(quick);
  command->add_option("--json", options->json, "Also write the figures to a file")->type_name("FILE.json");
  command->add_option("--compare", options->compare, "Print ratios to the figures of an earlier call")
      ->type_name("OLD.json");
  command->add_flag("--force", options->force, "Replace the file of --json");
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
