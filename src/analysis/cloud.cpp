// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

constexpr std::array<const char*, 4> phases = {"solid", "melting", "liquid", "vapour"};

/// Sums over particles; momentum along the axis.
struct Sums {
  double mass = 0, momentum = 0, kinetic = 0, internal = 0, heat = 0, melted = 0, vaporised = 0, failed = 0;
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
    for (std::size_t k = 0; k < phase.size(); ++k) phase[k] += other.phase[k];
    return *this;
  }
};

/// The fields that the sums are made of; nullptr if not written.
struct Fields {
  const Snapshot& snapshot;
  const std::vector<double>* energy = snapshot.scalar("internal_energy");
  const std::vector<double>* temperature = snapshot.scalar("temperature");
  const std::vector<double>* phase = snapshot.scalar("phase");
  const std::vector<double>* melted = snapshot.scalar("melted_fraction");
  const std::vector<double>* vaporised = snapshot.scalar("vaporised_fraction");
  const std::vector<double>* failed = snapshot.scalar("failed");
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
    if (fields.temperature != nullptr) one.heat = m * (*fields.temperature)[i];
    if (fields.melted != nullptr) one.melted = m * (*fields.melted)[i];
    if (fields.vaporised != nullptr) one.vaporised = m * (*fields.vaporised)[i];
    if (fields.failed != nullptr && (*fields.failed)[i] > 0.0) one.failed = m;
    if (fields.phase != nullptr) one.phase[static_cast<std::size_t>((*fields.phase)[i]) & 3U] = m;
    return one;
  });
}

Quantities as_row(const Sums& sums, const Fields& fields, double copies) {
  const double per_mass = sums.mass > 0.0 ? 1.0 / sums.mass : nan;
  Quantities row = {{"mass", "kg", "mass of the full problem", copies * sums.mass},
                    {"axial_momentum", "kg m/s", "momentum along the axis", copies * sums.momentum},
                    {"kinetic_energy", "J", "kinetic energy", copies * sums.kinetic},
                    {"mean_axial_velocity", "m/s", "momentum over mass", sums.momentum * per_mass}};
  if (fields.energy != nullptr)
    row.push_back({"internal_energy", "J", "internal energy", copies * sums.internal});
  if (fields.temperature != nullptr)
    row.push_back({"mean_temperature", "K", "mean temperature by mass", sums.heat * per_mass});
  if (fields.melted != nullptr)
    row.push_back({"melted_fraction", "1", "mass fraction of liquid and vapour", sums.melted * per_mass});
  if (fields.vaporised != nullptr)
    row.push_back({"vaporised_fraction", "1", "mass fraction of vapour", sums.vaporised * per_mass});
  if (fields.failed != nullptr)
    row.push_back({"failed_fraction", "1", "share of the mass that has failed", sums.failed * per_mass});
  for (std::size_t k = 0; fields.phase != nullptr && k < phases.size(); ++k) {
    row.push_back({fmt::format("{}_fraction", phases[k]), "1",
                   fmt::format("share of the mass in particles of the phase {}", phases[k]),
                   sums.phase[k] * per_mass});
  }
  return row;
}

/// Percentiles of the mass beyond an axial coordinate, of position and distance from the axis.
void append_percentiles(Quantities& row, const Snapshot& snapshot, const Frame& frame, double from) {
  std::vector<std::pair<double, double>> axial, distance;
  double mass = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const double z = frame.axial(snapshot.position[i] - frame.centre);
    if (z <= from) continue;
    axial.emplace_back(z, snapshot.mass[i]);
    distance.emplace_back(frame.radius(snapshot.position[i]), snapshot.mass[i]);
    mass += snapshot.mass[i];
  }
  const char* what = "of the mass beyond the rear face by a quarter of the target's thickness";
  row.push_back({"mass_behind", "kg", "mass beyond the rear face by a quarter of the target's thickness",
                 frame.copies() * mass});
  for (const int percent : {50, 90, 99}) {
    const double share = 0.01 * percent;
    row.push_back({fmt::format("axial_{}", percent), "m", fmt::format("percentile {}", what),
                   weighted_quantile(axial, share)});
    row.push_back({fmt::format("radius_{}", percent), "m", fmt::format("percentile {}", what),
                   weighted_quantile(distance, share)});
  }
}

}  // namespace

std::vector<std::uint32_t> debris(const Snapshot& snapshot, const Frame& frame) {
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < snapshot.size(); ++i) {
    if (frame.axial(snapshot.velocity[i]) > moving * frame.impact_speed) chosen.push_back(i);
  }
  return chosen;
}

Quantities cloud_measures(const Snapshot& snapshot, const Frame& frame, const Extent& target) {
  const double rear_face = target.upper;
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
  const double speed = moving * frame.impact_speed;
  const Fields fields{snapshot};
  const Sums all = sum(fields, frame, [](std::size_t) { return true; });
  const Sums flying =
      sum(fields, frame, [&](std::size_t i) { return frame.axial(snapshot.velocity[i]) > speed; });
  Quantities row = {
      {"front", "m", "axial coordinate beyond which 0.1 % of the debris lies", front},
      {"foremost", "m", "axial coordinate of the foremost particle of the debris",
       chosen.empty() ? nan : foremost},
      {"rear", "m", "axial coordinate below which 0.1 % of the debris lies", rear},
      {"radius", "m", "distance from the axis beyond which 0.1 % of the debris lies", radius},
      {"outermost", "m", "distance of the outermost particle of the debris from the axis",
       chosen.empty() ? nan : outermost},
      {"radial_speed", "m/s", "speed away from the axis that 0.1 % of the debris exceeds",
       weighted_quantile(radial, 1.0 - beyond)},
      {"mean_velocity", "m/s", "mean axial velocity of the debris",
       flying.mass > 0.0 ? flying.momentum / flying.mass : nan},
      {"half_angle", "rad", "of the cone of directions that holds 95 % of the kinetic energy of the debris",
       weighted_quantile(angle, 0.95)},
      {"cloud_length", "m", "from the rear face of the first target to the front", front - rear_face},
      {"cloud_length_over_width", "1", "cloud length over twice the radius",
       (front - rear_face) / (2.0 * radius)},
      {"debris_mass", "kg", "mass of the debris", frame.copies() * flying.mass}};
  append_percentiles(row, snapshot, frame, rear_face + 0.25 * target.length());
  const double copies = frame.copies();
  if (fields.melted != nullptr) {
    row.push_back({"melted_mass", "kg", "mass of liquid and vapour", copies * all.melted});
    row.push_back({"melted_fraction", "1", "mass fraction of liquid and vapour", all.melted / all.mass});
    row.push_back({"debris_melted_fraction", "1", "mass fraction of liquid and vapour in the debris",
                   flying.mass > 0.0 ? flying.melted / flying.mass : nan});
  }
  if (fields.vaporised != nullptr) {
    row.push_back({"vaporised_mass", "kg", "mass of vapour", copies * all.vaporised});
    row.push_back({"vaporised_fraction", "1", "mass fraction of vapour", all.vaporised / all.mass});
    row.push_back({"debris_vaporised_fraction", "1", "mass fraction of vapour in the debris",
                   flying.mass > 0.0 ? flying.vaporised / flying.mass : nan});
  }
  return row;
}

Table body_table(const Snapshot& snapshot, const Frame& frame, const std::vector<BodyInput>& bodies) {
  Table table{.name = "bodies",
              .meaning = "what the bodies carry at the last snapshot, of the full problem",
              .label = "body part",
              .labels = {},
              .columns = {}};
  const Fields fields{snapshot};
  const double speed = moving * frame.impact_speed;
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
  const Quantity left = {fmt::format("outflow_mass.{}", input.name), "kg",
                         "has left the domain: counts in mean_velocity, in nothing else",
                         frame.copies() * outflow.mass};
  const Quantity mean = {fmt::format("mean_velocity.{}", input.name), "m/s",
                         "momentum over mass, along the axis, with what has left the domain",
                         (sums.momentum + frame.axial(outflow.momentum)) / (sums.mass + outflow.mass)};
  if (!(sums.mass > 0.0)) return outflow.mass > 0.0 ? Quantities{mean, left} : Quantities{};
  const Extent extent = axial_extent(snapshot, frame, body, input.spacing);
  // Particles whose centre lies within one spacing of the foremost one: its outermost layer.
  const Sums surface = sum(fields, frame, [&](std::size_t i) {
    return snapshot.body[i] == body && frame.axial(snapshot.position[i]) > extent.upper - input.spacing;
  });
  const auto name = [&](const char* measure) { return fmt::format("{}.{}", measure, input.name); };
  Quantities row = {
      mean,
      left,
      {name("axial_length"), "m", "extent along the axis", extent.length()},
      {name("front_velocity"), "m/s", "mean axial velocity of the outermost layer of particles ahead",
       surface.momentum / surface.mass}};
  for (std::size_t k = 0; fields.phase != nullptr && k < phases.size(); ++k) {
    row.push_back({fmt::format("{}_fraction.{}", phases[k], input.name), "1", "share of the mass",
                   sums.phase[k] / sums.mass});
  }
  if (fields.melted != nullptr) {
    std::vector<std::pair<double, double>> all;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      if (snapshot.body[i] != body) continue;
      all.emplace_back((*fields.melted)[i], snapshot.mass[i]);
    }
    row.push_back(
        {name("melted_fraction"), "1", "mass fraction of liquid and vapour", sums.melted / sums.mass});
    row.push_back({name("median_melted_fraction"), "1", "median over the mass: surface layers have no weight",
                   weighted_quantile(all, 0.5)});
  }
  return row;
}

void add_speeds(Table& series) {
  const std::vector<double> time = series["time"];
  const std::array<std::array<const char*, 3>, 3> names = {
      {{"front", "front_speed", "change of the front in time"},
       {"rear", "rear_speed", "change of the rear in time"},
       {"radius", "expansion_speed", "change of the radius in time"}}};
  for (const auto& [of, name, meaning] : names) {
    const std::vector<double> x = series[of];
    Column column{name, "m/s", meaning, std::vector<double>(x.size(), nan)};
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
