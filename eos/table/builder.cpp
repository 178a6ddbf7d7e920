// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/builder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>

#include "eos/table/strip.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int scan_density = 400;
constexpr int scan_energy = 256;
constexpr std::size_t greatest_segments = 64;
constexpr std::size_t greatest_strips = 256;
constexpr std::size_t consistency_states = 4096;
/// Limit of the inconsistency in p on the scale of TableError: GRAY's melting band has 0.1.
constexpr double greatest_contradiction = 0.5;
constexpr double default_thinness = 1e-5;  ///< minimum density over the reference density
/// Maximum density over the compression limit, where the bulk modulus of the cold solid vanishes and the melting
/// band of GRAY, whose width is proportional to 1/K_T, is least consistent.
constexpr double default_density_share = 0.99;

/// Holds a range of densities in which every isochore crosses the same phases; sampled from `first` to `last`.
struct Segment {
  double first, last;
};

class Scan {
 public:
  Scan(const table::Sampler& sampler) : sampler_(sampler) {}

  /// Finds the ends of the segments between two values of ln rho.
  void split(double a, const std::vector<std::string_view>& phases_a, double b,
             const std::vector<std::string_view>& phases_b, std::vector<Segment>& segments) const {
    if (phases_a == phases_b) return;
    const double middle = 0.5 * (a + b);
    if (b - a < 2e-13 * std::abs(a) || middle <= a || middle >= b) {
      segments.back().last = a;
      segments.push_back({b, b});
      if (segments.size() > greatest_segments) {
        throw InputError("table: the order of the phases along isochores changes too often with the density");
      }
      return;
    }
    const auto phases = sampler_.isochore(middle).phases;
    split(a, phases_a, middle, phases, segments);
    split(middle, phases, b, phases_b, segments);
  }

 private:
  const table::Sampler& sampler_;
};

/// Range of densities, as logarithms.
struct Extent {
  double begin, end;
};

/// @throws InputError if a table cannot represent the model, or the request contradicts it
Extent require_feasible(const EquationOfState& eos, const TableRequest& request) {
  const State reference = eos.state(eos.reference_density(), eos.reference_energy());
  if (!std::isfinite(reference.specific_entropy) || !std::isfinite(reference.temperature)) {
    throw InputError(fmt::format("table: model {} carries no {}; a table needs a complete equation of state",
                                 eos.model(),
                                 std::isfinite(reference.temperature) ? "entropy" : "temperature"));
  }
  if (eos.initial_distension() != 1.0) {
    throw InputError(
        "table: the state of porous material depends on its history, which a table of density and energy "
        "cannot represent");
  }
  const double thinnest =
      request.minimum_density > 0 ? request.minimum_density : default_thinness * eos.reference_density();
  const double densest =
      request.maximum_density > 0 ? request.maximum_density : default_density_share * eos.maximum_density();
  if (!(request.error > 1e-9 && request.error < 0.1))
    throw InputError("table: the error must be between 1e-9 and 0.1");
  if (!(thinnest < densest && densest <= eos.maximum_density())) {
    throw InputError(
        fmt::format("table: densities from {:.6g} to {:.6g} kg/m^3; the model holds up to {:.6g}", thinnest,
                    densest, eos.maximum_density()));
  }
  if (!(request.least_temperature >= eos.least_temperature() &&
        request.least_temperature < request.greatest_temperature)) {
    throw InputError(fmt::format("table: temperatures from {:.6g} to {:.6g} K; the model begins at {:.6g} K",
                                 request.least_temperature, request.greatest_temperature,
                                 eos.least_temperature()));
  }
  return {std::log(thinnest), std::log(densest)};
}

/// Returns a table without strips: what it tells of the model and the request.
/// @throws InputError if the coldest state has no heat capacity
TableData described(const EquationOfState& eos, const TableRequest& request) {
  TableData data;
  data.condensed = eos.condensed() ? 1.0 : 0.0;
  data.reference_density = eos.reference_density();
  data.reference_temperature = eos.reference_temperature();
  data.reference_energy = eos.reference_energy();
  data.requested_error = request.error;
  data.origin = std::string(eos.model());
  data.constants = eos.constants();
  data.least_temperature = request.least_temperature;
  data.greatest_temperature = request.greatest_temperature;
  const State coldest = eos.state_at_temperature(eos.reference_density(), request.least_temperature);
  data.thermal_energy = coldest.heat_capacity * request.least_temperature;
  if (!(data.thermal_energy > 0))
    throw InputError("table: the heat capacity of the coldest state is not positive");
  return data;
}

/// Divides the range of densities where the order of the phases along isochores changes, and at the kinks of the model.
/// @param least_sound_speed  lowered to the least of the isochores
std::vector<Segment> segments_of(const EquationOfState& eos, const table::Sampler& sampler,
                                 const Extent& extent, const ForEach& for_each, double& least_sound_speed) {
  std::vector<table::Isochore> isochores(scan_density + 1);
  const auto x_of = [&](std::size_t i) {
    return std::min(extent.end,
                    extent.begin + (extent.end - extent.begin) * static_cast<double>(i) / scan_density);
  };
  for_each(isochores.size(), [&](std::size_t i) { isochores[i] = sampler.isochore(x_of(i)); });
  for (const table::Isochore& isochore : isochores)
    least_sound_speed = std::min(least_sound_speed, isochore.least_sound_speed);

  std::vector<Segment> segments = {{extent.begin, extent.begin}};
  const Scan scan(sampler);
  for (std::size_t i = 0; i < scan_density; ++i) {
    scan.split(x_of(i), isochores[i].phases, x_of(i + 1), isochores[i + 1].phases, segments);
  }
  segments.back().last = extent.end;
  for (const double density : eos.kinks()) {
    const double x = std::log(density);
    const auto at =
        std::ranges::find_if(segments, [&](const Segment& s) { return s.first < x && x < s.last; });
    if (at == segments.end()) continue;
    const Segment rest = {x, at->last};
    at->last = x;
    segments.insert(at + 1, rest);
  }
  return segments;
}

/// Returns the strips to begin with, one for each segment.
std::vector<table::StripTask> tasks_of(std::span<const Segment> segments, double begin) {
  std::vector<table::StripTask> tasks;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& s = segments[i];
    if (s.first >= s.last) continue;
    const double from = i == 0 ? begin : segments[i - 1].last;
    tasks.push_back({.begin = from, .end = s.last, .first_sample = s.first, .last_sample = s.last});
  }
  return tasks;
}

/// Adds what is left of a strip that misses the required error: the strip with one cut more, or its halves.
void add_rest(table::StripTask task, const table::FittedStrip& result, std::vector<table::StripTask>& next) {
  if (result.cut) {
    task.cuts.push_back(*result.cut);
    next.push_back(std::move(task));
    return;
  }
  const double middle = 0.5 * (task.begin + task.end);
  task.miss_of_whole = result.miss;
  table::StripTask lower = task, upper = std::move(task);
  lower.end = lower.last_sample = upper.begin = upper.first_sample = middle;
  next.push_back(std::move(lower));
  next.push_back(std::move(upper));
}

/// Divides strips until each reaches the required error. Returns them in the order of the density.
std::vector<table::FittedStrip> fit(const table::Sampler& sampler, std::vector<table::StripTask> tasks,
                                    const TableData& data, const Extent& extent, const ForEach& for_each,
                                    const Report& report) {
  std::vector<table::FittedStrip> fitted;
  double done = 0;
  std::mutex lock;
  while (!tasks.empty()) {
    std::vector<table::FittedStrip> results(tasks.size());
    for_each(tasks.size(), [&](std::size_t i) {
      results[i] = table::fit_strip(sampler, tasks[i], data, data.requested_error);
      const std::scoped_lock guard(lock);
      if (results[i].converged) done += (tasks[i].end - tasks[i].begin) / (extent.end - extent.begin);
      if (report) report(done);
    });
    std::vector<table::StripTask> next;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (results[i].converged) {
        fitted.push_back(std::move(results[i]));
      } else {
        add_rest(std::move(tasks[i]), results[i], next);
      }
    }
    tasks = std::move(next);
    if (fitted.size() + tasks.size() > greatest_strips) {
      for (table::StripTask& task : tasks) task.last_attempt = true;
    }
  }
  std::ranges::sort(fitted, {}, [](const table::FittedStrip& f) { return f.strip.begin; });
  return fitted;
}

/// Only the entropy was sampled: it must be consistent with the pressure, as far as the model is.
/// @throws InputError if it is not
void require_consistent(const TableData& data, const EquationOfState& eos) {
  for (const auto& [phase, found] : verify(Table(data), eos, consistency_states)) {
    if (found.pressure > greatest_contradiction) {
      throw InputError(
          fmt::format("table: the entropy of model {} does not yield its pressure ({}, {:.2g} of |p| + rho "
                      "c^2/100): a table of it would be another material",
                      eos.model(), phase, found.pressure));
    }
  }
}

}  // namespace

ForEach serial() {
  return [](std::size_t n, const std::function<void(std::size_t)>& body) {
    for (std::size_t i = 0; i < n; ++i) body(i);
  };
}

TableData tabulate(const EquationOfState& eos, const TableRequest& request, const ForEach& for_each,
                   const Report& report) {
  const Extent extent = require_feasible(eos, request);
  TableData data = described(eos, request);
  const table::Sampler sampler(eos, data.thermal_energy, request, scan_energy);
  data.least_sound_speed = eos.state(eos.reference_density(), eos.reference_energy()).sound_speed;
  const std::vector<Segment> segments = segments_of(eos, sampler, extent, for_each, data.least_sound_speed);
  const std::vector<table::FittedStrip> fitted =
      fit(sampler, tasks_of(segments, extent.begin), data, extent, for_each, report);
  for (const table::FittedStrip& f : fitted) table::append(data, f);
  require_consistent(data, eos);
  return data;
}

std::map<std::string, TableError> verify(const Table& table, const EquationOfState& eos, std::size_t states,
                                         const ForEach& for_each, const Report& report) {
  constexpr std::size_t chunk = 4096;
  const std::size_t chunks = (states + chunk - 1) / chunk;
  const double begin = std::log(table.minimum_density()), end = std::log(table.maximum_density());
  const double soft =
      table::soft_square(eos.state(eos.reference_density(), eos.reference_energy()).sound_speed);
  const double bottom = table.data().thermal_energy;
  std::vector<std::map<std::string, TableError>> partial(chunks);
  std::mutex lock;
  std::size_t done = 0;
  for_each(chunks, [&](std::size_t k) {
    const std::size_t n = std::min(chunk, states - k * chunk);
    std::vector<double> rho(n), e(n), p(n), T(n), c(n), melted(n), vaporised(n);
    // splitmix64 (Steele et al., OOPSLA 2014), seeded by the chunk: the same states for any number of threads.
    std::uint64_t seed = 0x9e3779b97f4a7c15ULL * (k * chunk * 2 + 1);
    const auto uniform = [&] {
      std::uint64_t v = seed += 0x9e3779b97f4a7c15ULL;
      v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
      v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
      return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
    };
    for (std::size_t i = 0; i < n; ++i) {
      rho[i] = std::exp(begin + (end - begin) * uniform());
      const double base = table.minimum_energy(rho[i]) - bottom;
      e[i] = base +
             bottom * std::pow((table.maximum_energy(rho[i]) - base) / bottom, 0.999999 * uniform() + 5e-7);
    }
    table.evaluate({rho, e, p, T, c, melted, vaporised});
    for (std::size_t i = 0; i < n; ++i) {
      const State s = eos.state(rho[i], e[i]);
      TableError& error = partial[k][std::string(s.phase)];
      ++error.states;
      const auto raise = [](double& greatest, double value) {
        if (!(value <= greatest)) greatest = value;  // also true for NaN
      };
      const double dT = std::abs(T[i] / s.temperature - 1);
      const double dp = std::abs(p[i] - s.pressure) /
                        table::pressure_scale(s.pressure, rho[i], s.sound_speed * s.sound_speed, soft);
      raise(error.temperature, dT);
      raise(error.pressure, dp);
      error.beyond += dT <= table.data().requested_error && dp <= table.data().requested_error ? 0 : 1;
      const double dc = 0.5 * std::abs(c[i] * c[i] - s.sound_speed * s.sound_speed) /
                        (s.sound_speed * s.sound_speed + soft);
      raise(error.sound_speed, dc);
      error.mean_sound_speed += dc;
      const double df =
          std::max(std::abs(melted[i] - s.melted_fraction), std::abs(vaporised[i] - s.vaporised_fraction));
      raise(error.fraction, df);
      error.mean_fraction += df;
    }
    const std::scoped_lock guard(lock);
    done += n;
    if (report) report(static_cast<double>(done) / static_cast<double>(states));
  });
  std::map<std::string, TableError> total;
  for (const auto& part : partial) {
    for (const auto& [phase, error] : part) {
      TableError& t = total[phase];
      t.states += error.states;
      t.beyond += error.beyond;
      t.temperature = std::max(t.temperature, error.temperature);
      t.pressure = std::max(t.pressure, error.pressure);
      t.sound_speed = std::max(t.sound_speed, error.sound_speed);
      t.mean_sound_speed += error.mean_sound_speed;
      t.fraction = std::max(t.fraction, error.fraction);
      t.mean_fraction += error.mean_fraction;
    }
  }
  for (auto& [phase, t] : total) {
    t.mean_sound_speed /= static_cast<double>(t.states);
    t.mean_fraction /= static_cast<double>(t.states);
  }
  return total;
}

}  // namespace whipple::eos
