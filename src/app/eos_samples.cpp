// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_samples.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "src/core/base/error.hpp"
#include "src/material/material_samples.hpp"

namespace whipple::app {
namespace {

using eos::EquationOfState;

/// Mean and standard deviation.
class Scatter {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    ++count_;
    const double change = value - mean_;
    mean_ += change / count_;
    squares_ += change * (value - mean_);
  }
  void add(const std::optional<double>& value) {
    if (value) add(*value);
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double mean() const { return count_ > 0 ? mean_ : std::nan(""); }
  [[nodiscard]] double deviation() const {
    return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : std::nan("");
  }

 private:
  int count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// One quantity of the table: its column, and what it is of a shock.
struct Quantity {
  Column column;
  double (*value)(const eos::ShockState& shock, const eos::State* released);
};

const std::vector<Quantity>& quantities() {
  using eos::ShockState;
  using eos::State;
  static const std::vector<Quantity> all = {
      {{"us_km_s", "km/s", 1e3, "shock velocity"},
       [](const ShockState& s, const State*) { return s.shock_velocity; }},
      {{"P_GPa", "GPa", 1e9, "pressure"}, [](const ShockState& s, const State*) { return s.state.pressure; }},
      {{"rho_kg_m3", "kg/m^3", 1, "density"},
       [](const ShockState& s, const State*) { return s.state.density; }},
      {{"T_K", "K", 1, "temperature"}, [](const ShockState& s, const State*) { return s.state.temperature; }},
      {{"melted", "", 1, "melted fraction"},
       [](const ShockState& s, const State*) { return s.state.melted_fraction; }},
      {{"released_melted", "", 1, "melted fraction after release"},
       [](const ShockState&, const State* r) { return r == nullptr ? std::nan("") : r->melted_fraction; }},
      {{"released_vapour", "", 1, "vaporised fraction after release"},
       [](const ShockState&, const State* r) { return r == nullptr ? std::nan("") : r->vaporised_fraction; }},
  };
  return all;
}

Column deviation_of(const Column& column) {
  return {"sd-" + column.name, column.unit, column.size, "standard deviation of the " + column.meaning};
}

/// Thresholds that the remarks name, in Pa.
struct Threshold {
  const char* text;
  Scatter scatter{};
};

void add_thresholds(const EquationOfState& eos, double pressure, std::vector<Threshold>& all) {
  const auto of = [](const std::optional<eos::ShockState>& shock) {
    return shock ? std::optional(shock->state.pressure) : std::nullopt;
  };
  const auto melting = eos::shock_melting(eos);
  if (melting) {
    all[0].scatter.add(melting->onset.state.pressure);
    all[1].scatter.add(melting->completion.state.pressure);
  }
  const eos::ReleaseThresholds release = eos::release_thresholds(eos, pressure);
  all[2].scatter.add(of(release.incipient_melting));
  all[3].scatter.add(of(release.complete_melting));
  all[4].scatter.add(of(release.incipient_vaporisation));
}

}  // namespace

SampledHugoniot sampled_hugoniot(const EosOptions& options, const SampleOptions& samples,
                                 const std::filesystem::path& material) {
  if (samples.count < 2) throw InputError("--samples: a scatter needs two samples or more");
  const double last = quantity("--to", options.to, "m/s").value_or(4000.0);
  const double first = quantity("--from", options.from, "m/s").value_or(last / options.points);
  const double release_pressure =
      quantity("--release-pressure", samples.release_pressure, "Pa").value_or(0.0);
  const MaterialSamples drawn = sample_material(material, samples.count, samples.seed);
  const std::vector<double> velocities = spaced(first, last, options.points);

  std::vector<std::vector<Scatter>> rows(velocities.size(), std::vector<Scatter>(quantities().size()));
  std::vector<Threshold> thresholds = {{"melting behind the shock begins at"},
                                       {"melting behind the shock is complete at"},
                                       {"melting on release begins at"},
                                       {"melting on release is complete at"},
                                       {"vaporisation on release begins at"}};
  for (const Material& sample : drawn.materials) {
    const EquationOfState& eos = *sample.eos;
    const eos::Hugoniot hugoniot(eos);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      try {
        const eos::ShockState shock = hugoniot.at_particle_velocity(velocities[i]);
        std::optional<eos::State> released;
        try {
          released = eos::release(eos, shock.state, release_pressure).end.state;
        } catch (const StateError&) {
          // The model ends on the way: the fractions after release of this sample do not count.
        }
        for (std::size_t k = 0; k < quantities().size(); ++k) {
          rows[i][k].add(quantities()[k].value(shock, released ? &*released : nullptr));
        }
      } catch (const StateError&) {
        break;  // beyond the sample's range: its higher velocities do not count
      }
    }
    add_thresholds(eos, release_pressure, thresholds);
  }

  SampledHugoniot result;
  result.table.title =
      fmt::format("Hugoniots of {} samples: {}", samples.count, drawn.materials.front().name);
  result.table.columns = {{"up_km_s", "km/s", 1e3, "particle velocity"}};
  for (const Quantity& quantity : quantities()) {
    result.table.columns.push_back(quantity.column);
    result.table.columns.push_back(deviation_of(quantity.column));
  }
  result.table.columns.push_back({"samples", "", 1, "samples with a state there"});
  result.table.series.push_back({drawn.materials.front().name, {}});
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
  for (const Threshold& threshold : thresholds) {
    if (threshold.scatter.count() == 0) continue;
    result.remarks.push_back(fmt::format(
        "{} {:.1f} +- {:.1f} GPa ({} of {} samples)", threshold.text, 1e-9 * threshold.scatter.mean(),
        1e-9 * threshold.scatter.deviation(), threshold.scatter.count(), samples.count));
  }
  if (drawn.refused > 0) {
    result.remarks.push_back(
        fmt::format("{} draws of which the model makes no material were replaced by others", drawn.refused));
  }
  return result;
}

}  // namespace whipple::app
