// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "src/device/check/arrangements.hpp"
#include "src/device/check/compare.hpp"
#include "src/device/check/json.hpp"
#include "src/device/check/markdown.hpp"
#include "src/device/check/options.hpp"
#include "src/device/check/timing.hpp"

/// Compares a device with stored results of the host, and measures its times (docs/manual/devices.md).
namespace whipple::device::check {
namespace {

MakeEngine engine_of(On device) {
  if (device == On::emulated) return emulated_engine;
  if (!has_gpu_engine())
    throw WrongInput(
        "this program was built without the compiler of a graphics processor (nvcc 12 or later)");
  return gpu_engine;
}

/// Names the equations of state and strengths of a state, which select its kernels.
std::string model_of(const StoredState& state) {
  std::string text;
  for (const MaterialConstants& material : state.problem.materials) {
    std::string of = material.eos == EosKind::table ? "table" : "Mie-Grueneisen";
    switch (material.strength) {
      case StrengthKind::none:
        break;
      case StrengthKind::von_mises:
        of += ", von Mises";
        break;
      case StrengthKind::johnson_cook:
        of += ", Johnson-Cook";
        break;
      case StrengthKind::steinberg_guinan:
        of += ", Steinberg-Guinan";
        break;
    }
    if (text.find(of) == std::string::npos) text += (text.empty() ? "" : "; ") + of;
  }
  return text;
}

void print_largest(const std::string& what, const std::vector<Difference>& list) {
  if (list.empty()) {
    std::printf("  %-24s all equal\n", what.c_str());
    return;
  }
  const Difference& worst = list.front();
  std::printf("  %-24s %9.2e of %.0e: %s%s\n", what.c_str(), worst.largest, worst.bound,
              worst.component.c_str(), worst.of_bound() <= 1.0 ? "" : "  BEYOND ITS BOUND");
}

void print(const StoredState& state, const Comparison& found) {
  std::printf("\n%s: %s\n  %zu particles, %u fields, %s; written by %s; %zu steps in %.2f s\n",
              state.name.c_str(), state.what.c_str(), state.start.size(), state.problem.fields,
              model_of(state).c_str(), state.revision.c_str(), found.steps, found.seconds);
  print_largest("particles after 1 step", found.first);
  print_largest("sums after 1 step", found.first_sums);
  if (found.steps < state.steps.size()) {
    std::printf("  later steps are not compared: the file holds the results of %zu\n", state.steps.size());
  } else {
    print_largest("particles after " + std::to_string(found.steps), found.last);
    print_largest("sums after " + std::to_string(found.steps), found.last_sums);
  }
  if (!found.repeats) std::printf("  a second time: OTHER BITS\n");
}

Json json_of(const std::vector<Difference>& list) {
  Json object = Json::object();
  for (const Difference& of : list) object.set(of.component, of.largest);
  return object;
}

Json json_of(const StoredState& state, const Comparison& found) {
  Json json = Json::object();
  json.set("state", state.name)
      .set("what", state.what)
      .set("model", model_of(state))
      .set("particles", static_cast<double>(state.start.size()))
      .set("steps", static_cast<double>(found.steps))
      .set("written_by", state.revision)
      .set("seconds", found.seconds)
      .set("differences_after_first", json_of(found.first))
      .set("sums_after_first", json_of(found.first_sums))
      .set("differences_after_last", json_of(found.last))
      .set("sums_after_last", json_of(found.last_sums))
      .set("passes", Json::flag(found.passes()));
  if (found.twice) json.set("same_bits_twice", Json::flag(found.repeats));
  return json;
}

std::vector<Timing> measure_all(const StoredState& state, const Options& options, const MakeEngine& make,
                                const Rates& rates) {
  std::vector<Timing> timings;
  const auto add = [&](const std::string& name, auto&& arrange) {
    Timing timing;
    try {
      timing = measure(name, arrange(), make);
    } catch (const WrongInput& error) {  // it has too many cells
      timing.arrangement = name;
      timing.fault = error.what();
    }
    print(timing, rates);
    timings.push_back(timing);
  };
  for (const std::size_t size : options.sizes) {
    add(state.name + ", repeated along x", [&] { return repeated(state, size); });
    for (const double per_cell : options.per_cell) {
      std::string text(16, '\0');
      text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%g", per_cell)));
      add((per_cell >= 8.0 ? "block, " : "cloud, ") + text + " particles per cell",
          [&] { return scattered(state, size, per_cell); });
    }
  }
  return timings;
}

void write(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  std::ofstream out(file);
  if (!(out << text)) throw WrongInput(file + ": error: cannot be written");
}

int run(const Options& options) {
  const MakeEngine make = engine_of(options.device);
  std::vector<StoredState> states;
  for (const std::string& file : options.files) states.push_back(read_state(file));
  Json comparisons = Json::list(), times = Json::list();
  bool passes = true;
  std::string card, tables = comparison_head();
  for (const StoredState& state : states) {
    if (card.empty()) {
      card = make(state.problem, state.start)->device();
      std::printf("device: %s\n", card.c_str());
    }
    const Comparison found = compare(state, make, options.steps, options.twice);
    print(state, found);
    comparisons.add(json_of(state, found));
    tables += comparison_row(state, found);
    passes = passes && found.passes();
  }
  Json json = Json::object();
  json.set("card", card)
      .set("precision", "double")
      .set("kernels", options.device == On::gpu ? "src/device on the graphics processor"
                                                : "src/device on the host's threads")
      .set("bound_after_first", bounds_of_first.all)
      .set("bound_of_flow_after_first", bounds_of_first.flow)
      .set("bound_after_last", bounds_of_last.all)
      .set("passes", Json::flag(passes))
      .set("states", comparisons);
  Rates rates = {INFINITY, INFINITY};  // rooflines of 0
  if (options.rates) {
    rates = make(states.front().problem, states.front().start)->rates();
    std::printf("\ncopy %.1f GB/s, multiply-adds in double precision %.1f Gflop/s\n", 1e-9 * rates.bandwidth,
                1e-9 * rates.arithmetic);
    json.set("bandwidth_bytes_per_s", rates.bandwidth).set("arithmetic_flops_per_s", rates.arithmetic);
  }
  const std::vector<Timing> timings = measure_all(states.front(), options, make, rates);
  for (const Timing& timing : timings) times.add(to_json(timing, rates));
  if (!timings.empty()) {
    tables += "\n" + timing_table(timings, rates);
    json.set("model", model_of(states.front())).set("times", times);
  }
  std::printf("\n%s\n", passes ? "all within the bounds" : "BEYOND THE BOUNDS");
  write(options.json, json.str() + '\n');
  write(options.markdown, tables);
  return passes ? 0 : 1;
}

int guarded(int argc, char** argv) {
  constexpr int wrong_input = 2, no_device = 3;
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // what is done is seen, also by a log
  try {
    const Options options = read_options(argc, argv);
    if (options.help) {
      std::printf("%s", usage);
      return 0;
    }
    return run(options);
  } catch (const WrongInput& error) {
    std::fprintf(stderr, "whipple-device-check: error: %s\n", error.what());
    return wrong_input;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "whipple-device-check: error: %s\n", error.what());
    return no_device;
  }
}

}  // namespace
}  // namespace whipple::device::check

int main(int argc, char** argv) { return whipple::device::check::guarded(argc, argv); }
