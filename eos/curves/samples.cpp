// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/samples.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos::curves {
namespace {

/// Describes one quantity of the table: its column, and its evaluation for a shock.
struct Quantity {
  Column column;
  double (*value)(const ShockState& shock, const State* released);
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {quantity_column("us_km_s", "km/s", "m/s", "shock velocity"),
       [](const ShockState& s, const State*) { return s.shock_velocity; }},
      {state_column("P_GPa"), [](const ShockState& s, const State*) { return s.state.pressure; }},
      {state_column("rho_kg_m3"), [](const ShockState& s, const State*) { return s.state.density; }},
      {state_column("T_K"), [](const ShockState& s, const State*) { return s.state.temperature; }},
      {plain_column("melted", "melted fraction"),
       [](const ShockState& s, const State*) { return s.state.melted_fraction; }},
      {plain_column("released_melted", "melted fraction after release"),
       [](const ShockState&, const State* r) { return r == nullptr ? std::nan("") : r->melted_fraction; }},
      {plain_column("released_vapour", "vaporised fraction after release"),
       [](const ShockState&, const State* r) { return r == nullptr ? std::nan("") : r->vaporised_fraction; }},
  };
  return all;
}

Column deviation_of(const Column& column) {
  return {"sd-" + column.name, column.unit, column.size, "standard deviation of the " + column.meaning};
}

void add_thresholds(const EquationOfState& eos, double pressure, std::vector<Threshold>& all) {
  const auto of = [](const std::optional<ShockState>& shock) {
    return shock ? std::optional(shock->state.pressure) : std::nullopt;
  };
  const auto melting = shock_melting(eos);
  if (melting) {
    all[0].pressure.add(melting->onset.state.pressure);
    all[1].pressure.add(melting->completion.state.pressure);
  }
  const ReleaseThresholds release = release_thresholds(eos, pressure);
  all[2].pressure.add(of(release.incipient_melting));
  all[3].pressure.add(of(release.complete_melting));
  all[4].pressure.add(of(release.incipient_vaporisation));
}

}  // namespace

void Scatter::add(double value) {
  if (!std::isfinite(value)) return;
  ++count_;
  const double change = value - mean_;
  mean_ += change / count_;
  squares_ += change * (value - mean_);
}

double Scatter::mean() const { return count_ > 0 ? mean_ : std::nan(""); }

double Scatter::deviation() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : std::nan(""); }

SampledHugoniot sampled_hugoniot(const Subjects& samples, const std::vector<double>& velocities,
                                 double release_pressure) {
  if (samples.size() < 2) throw InputError("a scatter needs two samples or more");
  std::vector<std::vector<Scatter>> rows(velocities.size(), std::vector<Scatter>(quantities().size()));
  std::vector<Threshold> thresholds = {{"melting behind the shock begins at", {}},
                                       {"melting behind the shock is complete at", {}},
                                       {"melting on release begins at", {}},
                                       {"melting on release is complete at", {}},
                                       {"vaporisation on release begins at", {}}};
  for (const Subject& sample : samples) {
    const EquationOfState& eos = *sample.eos;
    const Hugoniot hugoniot(eos);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      try {
        const ShockState shock = hugoniot.at_particle_velocity(velocities[i]);
        std::optional<State> released;
        try {
          released = release(eos, shock.state, release_pressure).end.state;
        } catch (const StateError&) {
          // The range of the model is exceeded: the fractions after release of this sample are not counted.
        }
        for (std::size_t k = 0; k < quantities().size(); ++k) {
          rows[i][k].add(quantities()[k].value(shock, released ? &*released : nullptr));
        }
      } catch (const StateError&) {
        break;  // beyond the range of the sample: its higher velocities are not counted
      }
    }
    add_thresholds(eos, release_pressure, thresholds);
  }

  SampledHugoniot result;
  result.table.title = fmt::format("Hugoniots of {} samples: {}", samples.size(), samples.front().name);
  result.table.columns = {quantity_column("up_km_s", "km/s", "m/s", "particle velocity")};
  for (const Quantity& quantity : quantities()) {
    result.table.columns.push_back(quantity.column);
    result.table.columns.push_back(deviation_of(quantity.column));
  }
  result.table.columns.push_back(plain_column("samples", "samples with a state there"));
  result.table.series.push_back({samples.front().name, {}});
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (rows[i].front().count() == 0) break;
    CurveRow row = {velocities[i]};
    for (const Scatter& scatter : rows[i]) {
      row.emplace_back(scatter.mean());
      row.emplace_back(scatter.deviation());
    }
    row.emplace_back(static_cast<double>(rows[i].front().count()));
    result.table.series.front().rows.push_back(std::move(row));
  }
  result.thresholds = std::move(thresholds);
  return result;
}

}  // namespace whipple::eos::curves
