// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/analysis/measures.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

constexpr std::array<const char*, 4> phases = {"solid", "melting", "liquid", "vapour"};

/// Holds sums over particles; the momentum is axial. `warm`: mass of the particles with a temperature (trusses have
/// none); `phased`: mass of the particles whose equation of state has phases.
struct Sums {
  double mass = 0, momentum = 0, kinetic = 0, internal = 0, heat = 0, melted = 0, vaporised = 0, failed = 0;
  double warm = 0, phased = 0;
  std::array<double, 4> phase{};
  Sums& operator+=(const Sums& other) {
    mass += other.mass;
    momentum += other.momentum;
    kinetic += other.kinetic;
    internal += other.internal;
    heat += other.heat;
    melted += other.melted;
    vaporised += other.vaporised;
    failed += other.failed;
    warm += other.warm;
    phased += other.phased;
    for (std::size_t k = 0; k < phase.size(); ++k) phase[k] += other.phase[k];
    return *this;
  }
};

/// Holds the fields that enter the sums; nullptr if not written.
struct Fields {
  const Snapshot& snapshot;
  std::span<const BodyInput> bodies = {};
  const std::vector<double>* energy = snapshot.scalar("internal_energy");
  const std::vector<double>* temperature = snapshot.scalar("temperature");
  const std::vector<double>* phase = snapshot.scalar("phase");
  const std::vector<double>* melted = snapshot.scalar("melted_fraction");
  const std::vector<double>* vaporised = snapshot.scalar("vaporised_fraction");
  const std::vector<double>* failed = snapshot.scalar("failed");
  /// Returns whether the equation of state of a particle's body has phases.
  [[nodiscard]] bool has_phases(std::size_t i) const {
    return snapshot.body[i] >= bodies.size() || bodies[snapshot.body[i]].phases;
  }
};

template <class Chosen>
Sums sum(const Fields& fields, const Frame& frame, Chosen&& chosen) {
  const Snapshot& s = fields.snapshot;
  return parallel::sum<Sums>(s.size(), [&](std::size_t i) {
    Sums one;
    if (!chosen(i)) return one;
    const double m = s.mass[i];
    one.mass = m;
    one.momentum = m * frame.axial(s.velocity[i]);
    one.kinetic = 0.5 * m * s.velocity[i].squaredNorm();
    if (fields.energy != nullptr) one.internal = m * (*fields.energy)[i];
    if (fields.temperature != nullptr && (*fields.temperature)[i] > 0.0) {
      one.warm = m;
      one.heat = m * (*fields.temperature)[i];
    }
    if (fields.failed != nullptr && (*fields.failed)[i] > 0.0) one.failed = m;
    if (!fields.has_phases(i)) return one;
    one.phased = m;
    if (fields.melted != nullptr) one.melted = m * (*fields.melted)[i];
    if (fields.vaporised != nullptr) one.vaporised = m * (*fields.vaporised)[i];
    if (fields.phase != nullptr) one.phase[static_cast<std::size_t>((*fields.phase)[i]) & 3U] = m;
    return one;
  });
}

Quantities as_row(const Sums& sums, const Fields& fields, double copies) {
  const auto inverse = [](double mass) { return mass > 0.0 ? 1.0 / mass : nan; };
  const double per_mass = inverse(sums.mass), per_phased = inverse(sums.phased);
  Quantities row = {{"mass", "kg", "mass of the full problem", copies * sums.mass},
                    {"axial_momentum", "kg m/s", "momentum along the axis", copies * sums.momentum},
                    {"kinetic_energy", "J", "kinetic energy", copies * sums.kinetic},
                    {"mean_axial_velocity", "m/s", "momentum over mass", sums.momentum * per_mass}};
  if (fields.energy != nullptr)
    row.push_back({"internal_energy", "J", "internal energy", copies * sums.internal});
  if (fields.temperature != nullptr)
    row.push_back({"mean_temperature", "K", "mean temperature by mass", sums.heat * inverse(sums.warm)});
  if (fields.melted != nullptr)
    row.push_back({"melted_fraction", "1", "mass fraction of liquid and vapour", sums.melted * per_phased});
  if (fields.vaporised != nullptr)
    row.push_back({"vaporised_fraction", "1", "mass fraction of vapour", sums.vaporised * per_phased});
  if (fields.failed != nullptr)
    row.push_back({"failed_fraction", "1", "fraction of the mass that has failed", sums.failed * per_mass});
  for (std::size_t k = 0; fields.phase != nullptr && k < phases.size(); ++k) {
    row.push_back({fmt::format("{}_fraction", phases[k]), "1",
                   fmt::format("fraction of the mass in particles of the phase {}", phases[k]),
                   sums.phase[k] * per_phased});
  }
  return row;
}

/// Measures the mass beyond an axial coordinate: percentiles of position and distance from the axis.
void append_percentiles(Quantities& row, const Snapshot& snapshot, const Frame& frame, double from) {
  std::vector<std::pair<double, double>> axial, distance;
  double mass = std::isfinite(from) ? 0.0 : nan;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const double z = frame.axial(snapshot.position[i] - frame.centre);
    if (!(z > from)) continue;
    axial.emplace_back(z, snapshot.mass[i]);
    distance.emplace_back(frame.radius(snapshot.position[i]), snapshot.mass[i]);
    mass += snapshot.mass[i];
  }
  row.push_back(measured("mass_behind", frame.copies() * mass));
  for (const int percent : {50, 90, 99}) {
    const double fraction = 0.01 * percent;
    row.push_back(measured(fmt::format("axial_{}", percent), weighted_quantile(axial, fraction)));
    row.push_back(measured(fmt::format("radius_{}", percent), weighted_quantile(distance, fraction)));
  }
}

}  // namespace

std::vector<std::uint32_t> debris(const Snapshot& snapshot, const Frame& frame) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < snapshot.size(); ++i) {
    if (frame.axial(snapshot.velocity[i]) > frame.debris_speed()) chosen.push_back(i);
  }
  return chosen;
}

Quantities cloud_measures(const Snapshot& snapshot, const Frame& frame, const std::optional<Extent>& target,
                          std::span<const BodyInput> bodies) {
  const double rear_face = target ? target->upper : nan;
  const std::vector<std::uint32_t> chosen = debris(snapshot, frame);
  using Weighted = std::vector<std::pair<double, double>>;
  Weighted axial, distance, radial, angle;
  double foremost = -std::numeric_limits<double>::infinity(), outermost = 0.0;
  for (const std::uint32_t i : chosen) {
    const double m = snapshot.mass[i], z = frame.axial(snapshot.position[i] - frame.centre);
    const double v_r = frame.radial_speed(snapshot.position[i], snapshot.velocity[i]);
    const double v_z = frame.axial(snapshot.velocity[i]);
    const double r = frame.radius(snapshot.position[i]);
    axial.emplace_back(z, m);
    distance.emplace_back(r, m);
    radial.emplace_back(v_r, m);
    angle.emplace_back(std::atan2(std::abs(v_r), v_z), 0.5 * m * snapshot.velocity[i].squaredNorm());
    foremost = std::max(foremost, z);
    outermost = std::max(outermost, r);
  }
  const double rear = weighted_quantile(axial, beyond), front = weighted_quantile(axial, 1.0 - beyond);
  const double radius = weighted_quantile(distance, 1.0 - beyond);
  const double speed = frame.debris_speed();
  const Fields fields{snapshot, bodies};
  const Sums all = sum(fields, frame, [](std::size_t) { return true; });
  const Sums flying =
      sum(fields, frame, [&](std::size_t i) { return frame.axial(snapshot.velocity[i]) > speed; });
  Quantities row = {measured("front", front),
                    measured("foremost", chosen.empty() ? nan : foremost),
                    measured("rear", rear),
                    measured("radius", radius),
                    measured("outermost", chosen.empty() ? nan : outermost),
                    measured("radial_speed", weighted_quantile(radial, 1.0 - beyond)),
                    measured("mean_velocity", flying.mass > 0.0 ? flying.momentum / flying.mass : nan),
                    measured("half_angle", weighted_quantile(angle, 0.95)),
                    measured("cloud_length", front - rear_face),
                    measured("cloud_length_over_width", (front - rear_face) / (2.0 * radius)),
                    measured("debris_mass", frame.copies() * flying.mass)};
  append_percentiles(row, snapshot, frame, target ? rear_face + 0.25 * target->length() : nan);
  const auto append_phase = [&](const std::string& phase, double of_all, double of_debris) {
    row.push_back(measured(phase + "_mass", all.phased > 0.0 ? frame.copies() * of_all : nan));
    row.push_back(measured(phase + "_fraction", all.phased > 0.0 ? of_all / all.phased : nan));
    row.push_back(measured(fmt::format("debris_{}_fraction", phase),
                           flying.phased > 0.0 ? of_debris / flying.phased : nan));
  };
  if (fields.melted != nullptr) append_phase("melted", all.melted, flying.melted);
  if (fields.vaporised != nullptr) append_phase("vaporised", all.vaporised, flying.vaporised);
  return row;
}

Table body_table(const Snapshot& snapshot, const Frame& frame, const std::vector<BodyInput>& bodies) {
  Table table{.name = "bodies",
              .meaning = "what the bodies carry at the last snapshot, of the full problem",
              .label = "body part",
              .labels = {},
              .columns = {}};
  const Fields fields{snapshot, bodies};
  const double speed = frame.debris_speed();
  const auto axial = [&](std::size_t i) { return frame.axial(snapshot.velocity[i]); };
  const auto add_rows = [&](const std::string& name, auto&& mine) {
    const auto add = [&](const char* part, auto&& chosen) {
      const auto both = [&](std::size_t i) { return mine(i) && chosen(i); };
      table.append(as_row(sum(fields, frame, both), fields, frame.copies()),
                   fmt::format("{} {}", name, part));
    };
    add("whole", [](std::size_t) { return true; });
    add("debris", [&](std::size_t i) { return axial(i) > speed; });
    add("ejecta", [&](std::size_t i) { return axial(i) < -speed; });
    for (std::size_t k = 0; fields.phase != nullptr && k < phases.size(); ++k) {
      add(phases[k], [&](std::size_t i) { return (*fields.phase)[i] == static_cast<double>(k); });
    }
  };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    add_rows(bodies[b].name, [&](std::size_t i) { return snapshot.body[i] == b; });
  }
  if (bodies.size() > 1) add_rows("all", [](std::size_t) { return true; });
  return table;
}

Quantities body_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                         const BodyInput& input, const Outflow& outflow) {
  const Fields fields{snapshot};
  const Sums sums = sum(fields, frame, [&](std::size_t i) { return snapshot.body[i] == body; });
  const Quantity left = measured("outflow_mass", input.name, frame.copies() * outflow.mass);
  const Quantity mean =
      measured("mean_velocity", input.name,
               (sums.momentum + frame.axial(outflow.momentum)) / (sums.mass + outflow.mass));
  if (!(sums.mass > 0.0)) return outflow.mass > 0.0 ? Quantities{mean, left} : Quantities{};
  const Extent extent = axial_extent(snapshot, frame, body, input.spacing);
  // Particles whose centre is within one spacing of the foremost one: the outermost layer.
  const Sums surface = sum(fields, frame, [&](std::size_t i) {
    return snapshot.body[i] == body && frame.axial(snapshot.position[i]) > extent.upper - input.spacing;
  });
  Quantities row = {mean, left, measured("axial_length", input.name, extent.length()),
                    measured("front_velocity", input.name, surface.momentum / surface.mass)};
  for (std::size_t k = 0; fields.phase != nullptr && k < phases.size(); ++k) {
    row.push_back(measured(fmt::format("{}_fraction", phases[k]), input.name,
                           input.phases ? sums.phase[k] / sums.mass : nan));
  }
  if (fields.melted != nullptr) {
    std::vector<std::pair<double, double>> all;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      if (snapshot.body[i] == body) all.emplace_back((*fields.melted)[i], snapshot.mass[i]);
    }
    row.push_back(measured("melted_fraction", input.name, input.phases ? sums.melted / sums.mass : nan));
    row.push_back(
        measured("median_melted_fraction", input.name, input.phases ? weighted_quantile(all, 0.5) : nan));
  }
  return row;
}

void add_speeds(Table& series) {
  const std::vector<double> time = series["time"];
  for (const auto& [of, name] : speeds) {
    const std::vector<double> x = series[of];
    const Quantity speed = measured(name, nan);
    Column column{speed.name, speed.unit, speed.meaning, std::vector<double>(x.size(), nan)};
    for (std::size_t k = 0; k < x.size(); ++k) {
      const std::size_t before = k > 0 && std::isfinite(x[k - 1]) ? k - 1 : k;
      const std::size_t after = k + 1 < x.size() && std::isfinite(x[k + 1]) ? k + 1 : k;
      if (after > before) column.values[k] = (x[after] - x[before]) / (time[after] - time[before]);
    }
    series.columns.push_back(std::move(column));
  }
}

double final_slope(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::pair<double, double>> known;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(y[i])) known.emplace_back(x[i], y[i]);
  }
  const std::size_t last = std::min(std::max(known.size() / 3, std::size_t{3}), known.size());
  if (last < 2) return nan;
  known.erase(known.begin(), known.end() - static_cast<std::ptrdiff_t>(last));
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : known) {
    mean_x += a / static_cast<double>(last);
    mean_y += b / static_cast<double>(last);
  }
  for (const auto& [a, b] : known) {
    xx += (a - mean_x) * (a - mean_x);
    xy += (a - mean_x) * (b - mean_y);
  }
  return xy / xx;
}

}  // namespace whipple::analysis
