// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/analysis/cloud.hpp"

namespace whipple::analysis {
namespace {

std::size_t bins(double length, double size) {
  return static_cast<std::size_t>(std::max(std::ceil(length / size - 1e-9), 1.0));
}

/// Holds the index of the lower of the two bins between which a value at `x` (in bins) is divided, and the fraction of
/// the upper one; the index is -1 if the lower bin is outside.
struct Split {
  std::ptrdiff_t lower;
  double upper_share;
};
Split split(double x) {
  const double below = std::floor(x - 0.5);
  return {static_cast<std::ptrdiff_t>(below), x - 0.5 - below};
}

/// Returns the volume-weighted mean over the two innermost rings: a single ring holds few particles.
double on_axis(const RingField& field, std::size_t layer) {
  if (field.rings() < 2) return field.fraction(0, layer);
  const double a = field.ring_area(0), b = field.ring_area(1);
  return (a * field.fraction(0, layer) + b * field.fraction(1, layer)) / (a + b);
}

/// Holds the depths (m) below `face` at which the first material on the axis begins and ends; NaN if it does not.
struct OnAxis {
  double begin = nan, end = nan;
};
OnAxis material_on_axis(const Snapshot& snapshot, const Frame& frame,
                        const std::function<bool(std::size_t)>& mine, double face, double size) {
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (mine(i) && frame.radius(snapshot.position[i]) < 3.0 * size)
      last = std::max(last, frame.axial(snapshot.position[i]));
  }
  if (!(last > face)) return {};
  const RingField field(snapshot, frame, size, face, last + 3.0 * size, 2.0 * size, mine);
  std::vector<double> fractions(field.layers());
  for (std::size_t k = 0; k < field.layers(); ++k) fractions[k] = on_axis(field, k);
  OnAxis found{first_surface(fractions, size), nan};
  if (std::isnan(found.begin)) return found;
  for (auto k = static_cast<std::size_t>(std::ceil(found.begin / size)) + 1; k < fractions.size(); ++k) {
    if (fractions[k] >= 0.5) continue;
    const double before = fractions[k - 1];
    found.end = (static_cast<double>(k) - 0.5 + (before - 0.5) / (before - fractions[k])) * size;
    break;
  }
  return found;
}

}  // namespace

RingField::RingField(const Snapshot& snapshot, const Frame& frame, double size, double lower, double upper,
                     double radius, const std::function<bool(std::size_t)>& chosen, bool wall_at_upper)
    : size_(size),
      lower_(lower),
      rings_(bins(radius, size)),
      layers_(bins(upper - lower, size)),
      volume_(rings_ * layers_, 0.0) {
  for (std::size_t ring = 0; ring < rings_; ++ring) {
    area_.push_back(frame.ring_area(static_cast<double>(ring) * size, static_cast<double>(ring + 1) * size));
  }
  const std::vector<double> volumes = snapshot.volumes();
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (!chosen(i)) continue;
    const Split r = split(frame.radius(snapshot.position[i]) / size);
    const Split z = split((frame.axial(snapshot.position[i]) - lower) / size);
    for (int dr = 0; dr < 2; ++dr) {
      // Within half a bin of the axis everything is assigned to the innermost ring.
      const std::ptrdiff_t ring = std::max<std::ptrdiff_t>(r.lower + dr, 0);
      if (ring >= static_cast<std::ptrdiff_t>(rings_)) continue;
      for (int dz = 0; dz < 2; ++dz) {
        const auto last = static_cast<std::ptrdiff_t>(layers_) - 1;
        const std::ptrdiff_t layer = wall_at_upper ? std::min(z.lower + dz, last) : z.lower + dz;
        if (layer < 0 || layer > last) continue;
        const double share =
            (dr == 1 ? r.upper_share : 1.0 - r.upper_share) * (dz == 1 ? z.upper_share : 1.0 - z.upper_share);
        volume_[static_cast<std::size_t>(layer) * rings_ + static_cast<std::size_t>(ring)] +=
            frame.copies() * share * volumes[i];
      }
    }
  }
}

double RingField::cross_section(std::size_t layer) const {
  double volume = 0.0;
  for (std::size_t ring = 0; ring < rings_; ++ring) volume += volume_[layer * rings_ + ring];
  return volume / size_;
}

double RingField::thickness(std::size_t ring) const {
  double volume = 0.0;
  for (std::size_t layer = 0; layer < layers_; ++layer) volume += volume_[layer * rings_ + ring];
  return volume / ring_area(ring);
}

double first_surface(const std::vector<double>& fractions, double size) {
  for (std::size_t k = 0; k + 1 < fractions.size(); ++k) {
    if (fractions[k] < 0.5 || fractions[k + 1] < 0.5) continue;
    if (k == 0) return 0.0;
    const double before = fractions[k - 1];
    return (static_cast<double>(k) - 0.5 + (0.5 - before) / (fractions[k] - before)) * size;
  }
  return nan;
}

Crater measure_crater(const Snapshot& snapshot, const Frame& frame, std::size_t body, double face,
                      double rear, double cell_size) {
  const auto mine = [&](std::size_t i) { return snapshot.body[i] == body; };
  double outermost = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (mine(i)) outermost = std::max(outermost, frame.radius(snapshot.position[i]));
  }
  // Layer boundaries coincide with the original surface; material protruding beyond it is ignored.
  const RingField field(snapshot, frame, cell_size, face, rear, outermost, mine);
  Crater crater;
  std::vector<double> along_axis(field.layers());
  for (std::size_t layer = 0; layer < field.layers(); ++layer) along_axis[layer] = on_axis(field, layer);
  crater.depth = first_surface(along_axis, cell_size);
  // Radius in the two uppermost layers, extrapolated to the surface.
  std::array<double, 2> radius{};
  for (std::size_t layer = 0; layer < 2 && layer < field.layers(); ++layer) {
    std::vector<double> outward(field.rings());
    for (std::size_t ring = 0; ring < field.rings(); ++ring) outward[ring] = field.fraction(ring, layer);
    radius[layer] = first_surface(outward, cell_size);
  }
  crater.radius = std::isfinite(radius[1]) ? 1.5 * radius[0] - 0.5 * radius[1] : radius[0];
  if (std::isnan(crater.depth)) crater.radius = nan;
  const OnAxis axis = material_on_axis(snapshot, frame, mine, face, cell_size);
  const double thickness = rear - face;
  crater.bulge = axis.end - thickness;
  crater.is_bulge = axis.begin > 0.0 && (axis.begin >= thickness || crater.bulge > 0.5 * axis.begin);
  if (crater.is_bulge) crater.depth = crater.radius = nan;
  return crater;
}

double penetration_depth(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing,
                         double face) {
  std::vector<std::pair<double, double>> axial;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] == body) axial.emplace_back(frame.axial(snapshot.position[i]), snapshot.mass[i]);
  }
  if (axial.empty()) return nan;
  return std::max(weighted_quantile(axial, 1.0 - beyond) + 0.5 * spacing - face, 0.0);
}

Hole measure_hole(const Snapshot& snapshot, const Frame& frame, const std::vector<std::uint8_t>& wall,
                  double thickness, double cell_size) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower, radius = 0.0;
  const auto chosen = [&](std::size_t i) { return wall[i] != 0; };
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (!chosen(i)) continue;
    lower = std::min(lower, frame.axial(snapshot.position[i]));
    upper = std::max(upper, frame.axial(snapshot.position[i]));
    radius = std::max(radius, frame.radius(snapshot.position[i]));
  }
  if (!(upper > lower)) return {.diameter = nan, .left_on_axis = 0.0};
  const RingField field(snapshot, frame, cell_size, lower - cell_size, upper + cell_size, radius, chosen);
  std::vector<double> left(field.rings());
  for (std::size_t ring = 0; ring < field.rings(); ++ring) left[ring] = field.thickness(ring) / thickness;
  Hole hole;
  hole.diameter = 2.0 * first_surface(left, cell_size);
  hole.left_on_axis = field.rings() > 1 ? 0.25 * left[0] + 0.75 * left[1] : left[0];
  return hole;
}

}  // namespace whipple::analysis
