// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/analysis/surfaces.hpp"

namespace whipple::analysis {
namespace {

/// Fraction of a layer that material fills within a radius.
double core_fraction(const RingField& field, std::size_t layer, double radius) {
  double filled = 0.0, area = 0.0;
  for (std::size_t ring = 0; ring < field.rings(); ++ring) {
    if (ring > 0 && static_cast<double>(ring + 1) * field.size() > radius) break;
    filled += field.fraction(ring, layer) * field.ring_area(ring);
    area += field.ring_area(ring);
  }
  return filled / area;
}

/// Diameters of circles with the cross-sections of the layers of thickness `size` above `lower`.
/// @param may_stand_off  look whether the material ends before the wall, and begin there
std::vector<double> diameters(const Snapshot& snapshot, const Frame& frame, std::size_t body, double size,
                              double lower, double upper, bool wall_at_upper, bool may_stand_off) {
  double radius = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] == body) radius = std::max(radius, frame.radius(snapshot.position[i]));
  }
  const auto mine = [&](std::size_t i) { return snapshot.body[i] == body; };
  const RingField field(snapshot, frame, size, lower, upper, radius + 2.0 * size, mine, wall_at_upper);
  std::vector<double> result(field.layers());
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = 2.0 * std::sqrt(field.cross_section(k) / std::numbers::pi);
  }
  // A bar that meets its wall stands a part of a cell before it: the layer there is not full, at the axis either.
  // The layers begin at the bar's face then.
  if (may_stand_off && result.size() > 2) {
    const std::size_t k = result.size() - 1;
    const double core = 0.25 * result[k - 1], full = core_fraction(field, k - 1, core);
    const double filled = full > 0.0 ? core_fraction(field, k, core) / full : 1.0;
    if (filled > 0.5 && filled < 1.0) {
      const double gap = (1.0 - filled) * size;
      return diameters(snapshot, frame, body, size, lower - gap, upper - gap, true, false);
    }
  }
  return result;
}

}  // namespace

Table diameter_profile(const Snapshot& snapshot, const Frame& frame, const Run& run) {
  Table table{.name = "profile",
              .meaning = "diameter of the circle with the cross-section of the body, along the axis",
              .label = "body",
              .labels = {},
              .columns = {}};
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    const Extent extent = axial_extent(snapshot, frame, b, run.bodies[b].spacing);
    if (!(extent.length() > 0.0) || !std::isfinite(extent.length())) continue;
    const std::vector<double> d =
        diameters(snapshot, frame, b, run.cell_size, extent.lower, extent.upper, false, false);
    for (std::size_t k = 0; k < d.size(); ++k) {
      table.append({{"axial", "m", "axial coordinate of the middle of the layer",
                     extent.lower + (static_cast<double>(k) + 0.5) * run.cell_size},
                    {"diameter", "m", "of the circle of the same cross-section", d[k]}},
                   run.bodies[b].name);
    }
  }
  return table;
}

Quantities bar_measures(const Snapshot& snapshot, const Frame& frame, std::size_t body,
                        const BodyInput& input, double cell_size, double diameter_at, bool held) {
  if (!frame.wall) return {};
  // Axial coordinates grow towards the wall: the bar lies below it.
  const double wall = *frame.wall;
  const Extent extent = axial_extent(snapshot, frame, body, input.spacing);
  if (!std::isfinite(extent.length())) return {};  // nothing of it is left
  const double size = cell_size;
  const double lower = wall - std::ceil((wall - extent.lower) / size + 1.0) * size;
  const std::vector<double> d = diameters(snapshot, frame, body, size, lower, wall, true, !held);
  const auto name = [&](const char* measure) { return fmt::format("{}.{}", measure, input.name); };
  const std::size_t n = d.size();
  Quantities row = {
      {name("length"), "m", "from the wall to the far end", wall - extent.lower},
      {name("foot_diameter"), "m", "at the wall, continued from the three layers of a cell above it",
       n < 3 ? nan : (15.0 * d[n - 1] - 10.0 * d[n - 2] + 3.0 * d[n - 3]) / 8.0}};  // parabola
  if (diameter_at > 0.0) {
    const double x = diameter_at / size - 0.5;  // in layers from the wall
    const double k = std::clamp(std::floor(x), 0.0, static_cast<double>(n) - 2.0);
    const auto at = static_cast<std::size_t>(k);
    row.push_back({name("diameter_at"), "m", "at the distance from the wall that was asked for",
                   d[n - 1 - at] + (x - k) * (d[n - 2 - at] - d[n - 1 - at])});
  }
  const auto foot_mean = [&](const char* field, const char* unit, const char* measure) {
    const std::vector<double>* values = snapshot.scalar(field);
    if (values == nullptr) return;
    double mass = 0.0, total = 0.0;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      const bool foot = wall - frame.axial(snapshot.position[i]) < input.spacing &&
                        frame.radius(snapshot.position[i]) < 2.0 * input.spacing;
      if (snapshot.body[i] != body || !foot) continue;
      mass += snapshot.mass[i];
      total += snapshot.mass[i] * (*values)[i];
    }
    row.push_back({name(measure), unit, "mean within a particle spacing of the wall, two of the axis",
                   mass > 0.0 ? total / mass : nan});
  };
  foot_mean("temperature", "K", "foot_temperature");
  foot_mean("plastic_strain", "1", "foot_plastic_strain");
  return row;
}

Quantities spall_measures(const Snapshot& first, const Snapshot& last, const Frame& frame, std::size_t body,
                          const BodyInput& input) {
  std::vector<std::pair<double, double>> matter;  // axial coordinate, mass
  double total = 0.0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    if (last.body[i] != body) continue;
    matter.emplace_back(frame.axial(last.position[i]), last.mass[i]);
    total += last.mass[i];
  }
  if (matter.size() < 2) return {};
  std::sort(matter.begin(), matter.end());
  // What is left of the distance of two layers beyond the spacing of the particles.
  const auto gap_behind = [&](std::size_t i) {
    return std::max(matter[i + 1].first - matter[i].first - input.spacing, 0.0);
  };
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < matter.size(); ++i) largest = std::max(largest, gap_behind(i));
  // Metal often parts on several planes at once; the layer that flies off ends at the foremost.
  constexpr double is_open = 0.5;  // of the largest gap
  std::size_t foremost = matter.size() - 1;
  double ahead = 0.0;
  do {
    ahead += matter[foremost].second;
  } while (--foremost > 0 && gap_behind(foremost) < is_open * largest);
  const double length = axial_extent(first, frame, body, input.spacing).length();
  return {{fmt::format("spall_thickness.{}", input.name), "m",
           "initial thickness of the matter ahead of the foremost gap at least half as wide as the largest",
           length * ahead / total},
          {fmt::format("largest_gap.{}", input.name), "m", "largest gap between particles along the axis",
           largest > 0.0 ? largest + input.spacing : 0.0}};
}

Quantities rod_measures(const Snapshot& first, const Snapshot& last, std::size_t body, const BodyInput& input,
                        double cell_size) {
  constexpr double follows = 0.9;  // of the initial speed: material that still flies with the rod
  const double speed = input.velocity.norm();
  if (!(speed > 0.0)) return {};
  const Vector3 direction = input.velocity / speed;
  // Mass in layers of a cell along the direction of flight, from the rearmost one on, and its momentum.
  struct Layers {
    double rear;
    std::vector<double> mass, momentum;
  };
  const auto layers = [&](const Snapshot& snapshot) {
    Layers result{std::numeric_limits<double>::infinity(), {}, {}};
    const auto flies = [&](std::size_t i) {
      return snapshot.body[i] == body && snapshot.velocity[i].dot(direction) > follows * speed;
    };
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      if (flies(i)) result.rear = std::min(result.rear, snapshot.position[i].dot(direction));
    }
    result.rear -= 0.5 * input.spacing;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      if (!flies(i)) continue;
      const auto k =
          static_cast<std::size_t>((snapshot.position[i].dot(direction) - result.rear) / cell_size);
      if (k >= result.mass.size()) {
        result.mass.resize(k + 1, 0.0);
        result.momentum.resize(k + 1, 0.0);
      }
      result.mass[k] += snapshot.mass[i];
      result.momentum[k] += snapshot.mass[i] * snapshot.velocity[i].dot(direction);
    }
    return result;
  };
  const Layers whole = layers(first), now = layers(last);
  double total = 0.0;
  for (const double mass : whole.mass) total += mass;
  const double half_section = 0.5 * total / static_cast<double>(whole.mass.size());
  std::size_t begin = 0;
  while (begin < now.mass.size() && now.mass[begin] < half_section) ++begin;
  std::size_t end = begin;
  double mass = 0.0, momentum = 0.0;
  for (; end < now.mass.size() && now.mass[end] >= half_section; ++end) {
    mass += now.mass[end];
    momentum += now.momentum[end];
  }
  const auto name = [&](const char* measure) { return fmt::format("{}.{}", measure, input.name); };
  return {
      {name("residual_length_ratio"), "1",
       "length of what still flies with 0.9 of the initial speed, from the rear end on as far as it has half "
       "of "
       "the initial section, over the initial length",
       static_cast<double>(end - begin) / static_cast<double>(whole.mass.size())},
      {name("residual_speed_ratio"), "1", "its mean speed along the initial direction over the initial one",
       mass > 0.0 ? momentum / mass / speed : nan}};
}

double pullback(const std::vector<double>& velocity) {
  const auto highest = std::ranges::max_element(velocity);
  if (highest == velocity.end()) return nan;
  double least = *highest;
  for (auto v = highest; v != velocity.end(); ++v) {
    least = std::min(least, *v);
    const double fell = 0.9 * *highest, rose = least + 0.01 * *highest;
    if (least < fell && *v > rose) return *highest - least;
  }
  return nan;
}

}  // namespace whipple::analysis
