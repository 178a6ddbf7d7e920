// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/measurement.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "src/bench/stage_cost.hpp"
#include "src/case/build/tables.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/core/process/paths.hpp"
#include "src/io/ranks.hpp"
#include "src/solver/device/device_stage.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t parts = 5;  // of the timed steps; the fastest part is reported

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Moves all material without forces (see Problem::thinning).
solver::Simulation thinned(const cases::Case& setup, const solver::Simulation& formed, double time) {
  Particles particles = formed.particles();
  for (std::size_t p = 0; p < particles.size(); ++p) particles.position[p] += time * particles.velocity[p];
  return {setup, std::move(particles), formed.state(), formed.communicator()};
}

/// Counts the particles and elements of all ranks, by which the time of a step is divided.
double point_count(const solver::Simulation& simulation) {
  return static_cast<double>(simulation.particle_count() + simulation.element_count());
}

/// Counts the grid nodes of all ranks.
double node_count(solver::Simulation& simulation) {
  if (simulation.device() != nullptr) {
    return static_cast<double>(simulation.device()->engine().slots()) * grid::nodes_per_block;
  }
  std::array<double, 1> nodes = {static_cast<double>(simulation.grid().slots()) * grid::nodes_per_block};
  parallel::sum(simulation.communicator(), nodes);
  return nodes[0];
}

struct Part {
  double particle_steps = 0.0;
  double at_rest = 0.0;                                          // inactive particle steps
  double nanoseconds = std::numeric_limits<double>::infinity();  // per particle and step
  std::deque<solver::Profile::Stage> stages;
};

/// Advances `steps` steps (or to the end of the case) and times them.
Part time_steps(solver::Simulation& simulation, std::size_t steps) {
  const double end = simulation.setup().time.end;
  Part part;
  simulation.profile().clear();
  const Clock::time_point begin = Clock::now();
  for (std::size_t i = 0; i < steps && simulation.state().time < end; ++i) {
    part.particle_steps += point_count(simulation);
    simulation.advance(end);
    part.at_rest += static_cast<double>(simulation.state().particles_at_rest);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  part.nanoseconds = 1e9 * seconds / part.particle_steps;
  part.stages = simulation.profile().stages();
  return part;
}

}  // namespace

Measurement measure(const Problem& problem, int threads, Length length, MPI_Comm communicator) {
  parallel::set_threads(threads);
  cases::Case setup = cases::read_case(process::find_data(problem.case_file).string(), problem.overrides);
  if (is_device(solver::default_device())) solver::evaluate_by_tables(setup);
  cases::tabulate_materials(setup, io::Ranks(communicator));
  std::optional<solver::Simulation> simulation(std::in_place, setup, communicator);
  const bool whole = length == Length::whole;
  const int share = length == Length::quick ? 5 : 1;
  if (!whole) {
    for (int i = 0; i < problem.steps_before / share; ++i) simulation->advance(setup.time.end);
    if (problem.thinning > 0.0) {
      simulation.emplace(thinned(setup, *simulation, problem.thinning));
      simulation->advance(setup.time.end);
    }
  }
  if (simulation->device() != nullptr) simulation->device()->engine().measure_stages(true);
  Part best;
  const std::int64_t first_step = simulation->state().step;
  const std::size_t steps = static_cast<std::size_t>(problem.steps / share) / parts;
  for (std::size_t i = 0; i < (whole ? 1 : parts); ++i) {
    Part part = time_steps(*simulation,
                           whole ? std::numeric_limits<std::size_t>::max() : std::max(steps, std::size_t{2}));
    std::array<double, 1> slowest = {part.nanoseconds};
    parallel::maximum(communicator, slowest);
    part.nanoseconds = slowest[0];
    if (part.nanoseconds < best.nanoseconds) best = std::move(part);
  }

  const double nodes = node_count(*simulation), points = point_count(*simulation);
  std::array<double, 1> memory = {static_cast<double>(simulation->bytes())};
  parallel::sum(communicator, memory);
  std::array<double, 1> peak = {peak_memory()};
  parallel::maximum(communicator, peak);
  Measurement result{.problem = problem.name,
                     .ranks = parallel::size(communicator),
                     .threads = threads,
                     .particles = static_cast<std::size_t>(points),
                     .steps = static_cast<std::size_t>(simulation->state().step - first_step),
                     .nanoseconds = best.nanoseconds,
                     .share_at_rest = best.at_rest / best.particle_steps,
                     .particles_per_block = points / nodes * grid::nodes_per_block,
                     .bytes_per_particle = memory[0] / points,
                     .peak_memory = peak[0],
                     .device = {},
                     .stages = {},
                     .machine = {}};
  if (simulation->device() != nullptr) {
    const device::Rates rates = simulation->device()->engine().rates();
    result.machine = {.bandwidth = rates.bandwidth, .arithmetic = rates.arithmetic};
    result.device = simulation->device()->engine().device();
  }
  for (const solver::Profile::Stage& stage : best.stages) {
    const StageCost cost = stage_cost(stage.name, setup, nodes / points);
    result.stages.push_back({stage.name, 1e9 * stage.seconds / best.particle_steps, cost.bytes, cost.flops});
  }
  return result;
}

nlohmann::json to_json(const Measurement& m) {
  nlohmann::json stages = nlohmann::json::array();
  for (const StageMeasurement& stage : m.stages) {
    stages.push_back({{"stage", stage.name},
                      {"ns_per_particle_step", stage.nanoseconds},
                      {"bytes_per_particle_step", stage.bytes},
                      {"flops_per_particle_step", stage.flops}});
  }
  return {{"problem", m.problem},
          {"ranks", m.ranks},
          {"threads", m.threads},
          {"particles", m.particles},
          {"steps", m.steps},
          {"ns_per_particle_step", m.nanoseconds},
          {"share_at_rest", m.share_at_rest},
          {"particles_per_block", m.particles_per_block},
          {"bytes_per_particle", m.bytes_per_particle},
          {"peak_memory_bytes", m.peak_memory},
          {"device", m.device ? nlohmann::json(*m.device) : nlohmann::json()},
          {"stages", stages},
          {"bandwidth_bytes_per_s", m.machine.bandwidth},
          {"arithmetic_flops_per_s", m.machine.arithmetic},
          {"reference_kernel_ns_per_particle_step", 1e9 * m.machine.reference_kernel}};
}

Measurement from_json(const nlohmann::json& json) {
  Measurement m{
      .problem = json.at("problem"),
      .ranks = json.at("ranks"),
      .threads = json.at("threads"),
      .particles = json.at("particles"),
      .steps = json.at("steps"),
      .nanoseconds = json.at("ns_per_particle_step"),
      .share_at_rest = json.value("share_at_rest", 0.0),
      .particles_per_block = json.at("particles_per_block"),
      .bytes_per_particle = json.at("bytes_per_particle"),
      .peak_memory = json.at("peak_memory_bytes"),
      .device = {},
      .stages = {},
      .machine = {.bandwidth = json.at("bandwidth_bytes_per_s"),
                  .arithmetic = json.at("arithmetic_flops_per_s"),
                  .reference_kernel = 1e-9 * json.at("reference_kernel_ns_per_particle_step").get<double>()}};
  for (const nlohmann::json& stage : json.at("stages")) {
    m.stages.push_back({stage.at("stage"), stage.at("ns_per_particle_step"),
                        stage.at("bytes_per_particle_step"), stage.at("flops_per_particle_step")});
  }
  if (const auto device = json.find("device"); device != json.end() && device->is_string())
    m.device = *device;
  return m;
}

}  // namespace whipple::bench
