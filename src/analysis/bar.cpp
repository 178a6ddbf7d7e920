// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/bar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "src/analysis/measures.hpp"
#include "src/analysis/surfaces.hpp"

namespace whipple::analysis {
namespace {

/// Computes the fraction of a layer that is filled with material within a radius.
double core_fraction(const RingField& field, std::size_t layer, double radius) {
  double filled = 0.0, area = 0.0;
  for (std::size_t ring = 0; ring < field.rings(); ++ring) {
    if (ring > 0 && static_cast<double>(ring + 1) * field.size() > radius) break;
    filled += field.fraction(ring, layer) * field.ring_area(ring);
    area += field.ring_area(ring);
  }
  return filled / area;
}

/// Holds the diameters of the circles with the cross-sectional areas of the layers, and the end of the last layer.
struct Profile {
  std::vector<double> diameter;
  double end;
};

/// Computes the diameters in layers of thickness `size` above `lower`.
/// @param may_stand_off  check whether the material ends before the wall, and begin the layers there
Profile diameters(const Snapshot& snapshot, const Frame& frame, std::size_t body, double size, double lower,
                  double upper, bool wall_at_upper, bool may_stand_off) {
  double radius = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] == body) radius = std::max(radius, frame.radius(snapshot.position[i]));
  }
  const auto mine = [&](std::size_t i) { return snapshot.body[i] == body; };
  const RingField field(snapshot, frame, size, lower, upper, radius + 2.0 * size, mine, wall_at_upper);
  std::vector<double> result(field.layers());
  constexpr double least_filled = 0.3;
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = 2.0 * std::sqrt(field.cross_section(k) / std::numbers::pi);
  }
  if (!may_stand_off || result.size() < 3) return {std::move(result), upper};
  // A rebounded bar may leave a few particles at the wall: nearly empty layers are not its end.
  constexpr std::size_t looked_at = 12;  // layers
  const auto near = std::span(result).last(std::min(looked_at, result.size()));
  const double widest = *std::ranges::max_element(near);
  const auto share = [&](std::size_t k) { return result[k] * result[k] / (widest * widest); };
  std::size_t last = result.size() - 1;
  while (last > 2 && share(last) < least_filled) --last;
  if (last + 1 < result.size()) {
    const double gap = (static_cast<double>(result.size() - 1 - last) - share(last + 1)) * size;
    return diameters(snapshot, frame, body, size, lower - gap, upper - gap, true, true);
  }
  // The bar ends a fraction of a cell before the wall: the layer there is not full, even on the axis. The layers then
  // begin at the face of the bar.
  const double core = 0.25 * result[last - 1], full = core_fraction(field, last - 1, core);
  const double filled = full > 0.0 ? core_fraction(field, last, core) / full : 1.0;
  if (filled > least_filled && filled < 1.0) {
    const double gap = (1.0 - filled) * size;
    return diameters(snapshot, frame, body, size, lower - gap, upper - gap, true, false);
  }
  return {std::move(result), upper};
}

/// Returns twice the distance from the axis that 0.1 % of the mass of a body exceeds, plus one particle spacing.
double largest_diameter(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing) {
  std::vector<std::pair<double, double>> places;  // radius, mass
  double left_out = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != body) continue;
    places.emplace_back(frame.radius(snapshot.position[i]), snapshot.mass[i]);
    left_out += 1e-3 * snapshot.mass[i];
  }
  std::ranges::sort(places, std::ranges::greater());
  for (const auto& [radius, mass] : places) {
    if ((left_out -= mass) < 0.0) return 2.0 * radius + spacing;
  }
  return std::numeric_limits<double>::quiet_NaN();
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
        diameters(snapshot, frame, b, run.cell_size, extent.lower, extent.upper, false, false).diameter;
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
  // Axial coordinates increase towards the wall, so the bar is below it. A body that does not fly at the wall is not a
  // bar.
  if (!frame.wall || !(frame.axial(input.velocity) > 0.0)) return {};
  const Extent extent = axial_extent(snapshot, frame, body, input.spacing);
  if (!std::isfinite(extent.length())) return {};  // no material of the body is left
  const double size = cell_size;
  // A bar that has not arrived, or has rebounded, has a free end, even within the last cell before the wall.
  const double face = *frame.wall - extent.upper > 0.5 * size ? extent.upper : *frame.wall;
  const double lower = face - std::ceil((face - extent.lower) / size + 1.0) * size;
  const auto [d, foot] = diameters(snapshot, frame, body, size, lower, face, true, !held);
  const double length = foot - extent.lower;
  const std::size_t n = d.size();
  Quantities row = {
      measured("length", input.name, length),
      measured("foot_diameter", input.name,
               n < 3 ? nan : (15.0 * d[n - 1] - 10.0 * d[n - 2] + 3.0 * d[n - 3]) / 8.0),  // parabola
      measured("contact_diameter", input.name, n < 1 ? nan : d[n - 1]),
      measured("largest_diameter", input.name, largest_diameter(snapshot, frame, body, input.spacing))};
  if (diameter_at > 0.0) {
    const double x = diameter_at / size - 0.5;  // in layers from the impact end
    const double k = std::clamp(std::floor(x), 0.0, static_cast<double>(n) - 2.0);
    const auto at = static_cast<std::size_t>(k);
    row.push_back(
        measured("diameter_at", input.name,
                 diameter_at < length ? d[n - 1 - at] + (x - k) * (d[n - 2 - at] - d[n - 1 - at]) : nan));
  }
  const auto foot_mean = [&](const char* field, const char* measure) {
    const std::vector<double>* values = snapshot.scalar(field);
    if (values == nullptr) return;
    double mass = 0.0, total = 0.0;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      const bool near = foot - frame.axial(snapshot.position[i]) < input.spacing &&
                        frame.radius(snapshot.position[i]) < 2.0 * input.spacing;
      if (snapshot.body[i] != body || !near) continue;
      mass += snapshot.mass[i];
      total += snapshot.mass[i] * (*values)[i];
    }
    row.push_back(measured(measure, input.name, mass > 0.0 ? total / mass : nan));
  };
  foot_mean("temperature", "foot_temperature");
  foot_mean("plastic_strain", "foot_plastic_strain");
  return row;
}

Quantities spall_measures(const Snapshot& first, const Snapshot& last, const Frame& frame, std::size_t body,
                          const BodyInput& input, bool planar) {
  std::vector<std::pair<double, double>> material;  // axial coordinate, mass
  double total = 0.0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    if (last.body[i] != body) continue;
    material.emplace_back(frame.axial(last.position[i]), last.mass[i]);
    total += last.mass[i];
  }
  if (material.size() < 2 || !planar) {
    const char* reason = "not all bodies fill the section of the domain: the impact is not planar";
    return {measured("spall_thickness", input.name, nan, reason),
            measured("largest_gap", input.name, nan, reason)};
  }
  std::sort(material.begin(), material.end());
  const double length = axial_extent(first, frame, body, input.spacing).length();
  // Considers gaps from the foremost one backwards that have at least one layer of particles ahead and behind: a single
  // particle does not make a gap. The width is the distance of the two layers minus the particle spacing; below half a
  // spacing the material is stretched, not separated.
  struct Gap {
    double width, ahead;
  };
  std::vector<Gap> gaps;
  const double layer = 0.99 * total * input.spacing / length;
  double ahead = 0.0, largest = 0.0;
  for (std::size_t i = material.size() - 1; i > 0; --i) {
    ahead += material[i].second;
    const double width = material[i].first - material[i - 1].first - input.spacing;
    if (width < 0.5 * input.spacing || ahead < layer || total - ahead < layer) continue;
    gaps.push_back({width, ahead});
    largest = std::max(largest, width);
  }
  // Metal often separates on several planes at once; the foremost gap bounds the spalled layer.
  constexpr double is_open = 0.5;  // of the largest gap
  const auto foremost =
      std::ranges::find_if(gaps, [&](const Gap& gap) { return gap.width >= is_open * largest; });
  return {measured("spall_thickness", input.name,
                   foremost == gaps.end() ? nan : length * foremost->ahead / total),
          measured("largest_gap", input.name, gaps.empty() ? 0.0 : largest + input.spacing)};
}

Quantities rod_measures(const Snapshot& first, const Snapshot& last, std::size_t body, const BodyInput& input,
                        double cell_size) {
  constexpr double follows = 0.9;  // fraction of the initial speed: material still moving with the rod
  const double speed = input.velocity.norm();
  if (!(speed > 0.0)) return {};
  const Vector3 direction = input.velocity / speed;
  // Holds mass and momentum in layers of one cell along the direction of flight, from the rearmost layer forward.
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
  return {measured("residual_length_ratio", input.name,
                   static_cast<double>(end - begin) / static_cast<double>(whole.mass.size())),
          measured("residual_speed_ratio", input.name, mass > 0.0 ? momentum / mass / speed : nan)};
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
