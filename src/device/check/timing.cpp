// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/timing.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

namespace whipple::device::check {
namespace {

constexpr std::size_t timed_steps = 20;

double roofline(const StageCost& cost, const Rates& rates) {
  return std::max(cost.least_bytes / rates.bandwidth, cost.flops / rates.arithmetic);
}

void measure(Timing& timing, const Arrangement& arrangement, const MakeEngine& make) {
  const auto engine = make(arrangement.problem, arrangement.points);
  double end = 0.0;
  Outcome outcome;
  const auto steps = [&](std::size_t n) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < n; ++i) {
      end += arrangement.dt;
      outcome = engine->step({.dt = arrangement.dt,
                              .end = end,
                              .acceleration = {},
                              .least_closing_speed = 0.0,
                              .looks_at_fill = false,
                              .sorts = i == 0});
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  steps(2);
  const auto per_step = [&](double seconds) {
    return seconds / (static_cast<double>(timed_steps) * static_cast<double>(engine->size()));
  };
  timing.step = per_step(steps(timed_steps));
  engine->measure_stages(true);
  steps(timed_steps);
  for (std::size_t s = 0; s < stage_count; ++s) timing.of_stages[s] = per_step(engine->stage_times()[s]);
  timing.steps = timed_steps;
  timing.bytes = static_cast<double>(engine->bytes());
  const Problem& problem = arrangement.problem;
  timing.size = {.particles = static_cast<double>(engine->size()),
                 .slots = static_cast<double>(outcome.slots),
                 .cells = static_cast<double>(outcome.cells),
                 .blocks = count_blocks(problem),
                 .reflects = problem.reflecting_faces() != 0,
                 .fields = problem.fields,
                 .conducts = problem.shock_conduction > 0.0};
}

}  // namespace

double roofline_of_step(const StepSize& size, const Rates& rates) {
  double sum = 0.0;
  for (std::size_t s = 0; s < stage_count; ++s) sum += roofline(cost_of(static_cast<Stage>(s), size), rates);
  return sum;
}

Timing measure(const std::string& name, const Arrangement& arrangement, const MakeEngine& make) {
  Timing timing;
  timing.arrangement = name;
  timing.size.particles = static_cast<double>(arrangement.points.size());
  try {
    measure(timing, arrangement, make);
  } catch (const std::exception& error) {
    timing.fault = error.what();
  }
  return timing;
}

void print(const Timing& timing, const Rates& rates) {
  if (!timing.fault.empty()) {
    std::printf("\n%s, %.0f particles: no times: %s\n", timing.arrangement.c_str(), timing.size.particles,
                timing.fault.c_str());
    return;
  }
  const StepSize& size = timing.size;
  std::printf("\n%s: %.0f particles, %.2f per cell that has any, %.2f nodes each, %.0f bytes each\n",
              timing.arrangement.c_str(), size.particles, size.particles / size.cells,
              block_nodes * size.slots / size.particles, timing.bytes / size.particles);
  std::printf("  %-20s %12s %12s %12s %12s %10s\n", "stage", "ns/particle", "roofline", "least bytes",
              "moved bytes", "flops");
  const auto row = [&](const char* name, double seconds, const StageCost& cost, double least) {
    std::printf("  %-20s %12.3f %12.3f %12.0f %12.0f %10.0f\n", name, 1e9 * seconds, 1e9 * least,
                cost.least_bytes, cost.moved_bytes, cost.flops);
  };
  for (std::size_t s = 0; s < stage_count; ++s) {
    const StageCost cost = cost_of(static_cast<Stage>(s), size);
    row(stage_names[s], timing.of_stages[s], cost, roofline(cost, rates));
  }
  row("whole step", timing.step, cost_of_step(size), roofline_of_step(size, rates));
}

Json to_json(const Timing& timing, const Rates& rates) {
  Json json = Json::object();
  json.set("arrangement", timing.arrangement).set("particles", timing.size.particles);
  if (!timing.fault.empty()) return json.set("fault", timing.fault);
  Json stages = Json::list();
  const auto of = [&](const char* name, double seconds, const StageCost& cost, double least) {
    return Json::object()
        .set("stage", name)
        .set("ns_per_particle_step", 1e9 * seconds)
        .set("roofline_ns", 1e9 * least)
        .set("least_bytes", cost.least_bytes)
        .set("moved_bytes", cost.moved_bytes)
        .set("flops", cost.flops);
  };
  for (std::size_t s = 0; s < stage_count; ++s) {
    const StageCost cost = cost_of(static_cast<Stage>(s), timing.size);
    stages.add(of(stage_names[s], timing.of_stages[s], cost, roofline(cost, rates)));
  }
  return json.set("steps", static_cast<double>(timing.steps))
      .set("cells_with_particles", timing.size.cells)
      .set("blocks_with_nodes", timing.size.slots)
      .set("memory_bytes", timing.bytes)
      .set("estimated_memory_bytes", memory_need(timing.size).all)
      .set("step",
           of("whole step", timing.step, cost_of_step(timing.size), roofline_of_step(timing.size, rates)))
      .set("stages", stages);
}

}  // namespace whipple::device::check
