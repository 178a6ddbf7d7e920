// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whipple::analysis {

double Frame::radius(const Vector3& position) const {
  Vector3 offset = position - centre;
  offset[axis] = 0.0;
  return offset.norm();
}

double Frame::radial_speed(const Vector3& position, const Vector3& velocity) const {
  Vector3 offset = position - centre, across = velocity;
  offset[axis] = 0.0;
  across[axis] = 0.0;
  const double distance = offset.norm();
  return distance > 0.0 ? across.dot(offset) / distance : across.norm();
}

bool Frame::mirrored(int direction) const {
  return std::ranges::any_of(planes, [&](const Plane& plane) { return plane.axis == direction; });
}

Frame find_frame(const Run& run, const Snapshot& first) {
  Frame frame;
  std::size_t slowest = 0;
  Vector3 least = run.bodies[0].velocity, greatest = least;
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    const Vector3& v = run.bodies[b].velocity;
    if (v.norm() > run.bodies[frame.projectile].velocity.norm()) frame.projectile = b;
    if (v.norm() < run.bodies[slowest].velocity.norm()) slowest = b;
    least = least.cwiseMin(v);
    greatest = greatest.cwiseMax(v);
  }
  const Vector3& fastest = run.bodies[frame.projectile].velocity;
  const Vector3 spread = run.bodies.size() > 1 ? Vector3(greatest - least) : Vector3(fastest.cwiseAbs());
  spread.maxCoeff(&frame.axis);
  frame.sign = fastest[frame.axis] >= 0.0 ? 1.0 : -1.0;
  frame.impact_speed = run.bodies.size() > 1
                           ? std::abs(fastest[frame.axis] - run.bodies[slowest].velocity[frame.axis])
                           : std::abs(fastest[frame.axis]);

  double mass = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != frame.projectile) continue;
    frame.centre += first.mass[i] * first.position[i];
    mass += first.mass[i];
  }
  if (mass > 0.0) frame.centre /= mass;
  frame.centre[frame.axis] = 0.0;
  std::vector<int> mirrored, other;
  for (int a = 0; a < 3; ++a) {
    const std::optional<double>& plane = run.mirror_planes[static_cast<std::size_t>(a)];
    if (a == frame.axis) {
      // A body flies against it: the face of a wall, not of a model cut in halves.
      if (plane) frame.wall = frame.sign * *plane;
      continue;
    }
    (plane ? mirrored : other).push_back(a);
    if (!plane) continue;
    frame.planes.push_back({a, *plane});
    frame.centre[a] = *plane;
  }
  // A half model is seen across its mirror plane, which may hold an oblique flight.
  other.insert(other.end(), mirrored.begin(), mirrored.end());
  frame.transverse = {other[0], other[1]};
  return frame;
}

Extent axial_extent(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != body) continue;
    const double z = frame.axial(snapshot.position[i]);
    lower = std::min(lower, z);
    upper = std::max(upper, z);
  }
  return {lower - 0.5 * spacing, upper + 0.5 * spacing};
}

double weighted_quantile(std::vector<std::pair<double, double>>& value_and_weight, double share) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0.0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  if (!(total > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double below = 0.0;
  for (const auto& [value, weight] : value_and_weight) {
    below += weight;
    if (below >= share * total) return value;
  }
  return value_and_weight.back().first;
}

}  // namespace whipple::analysis
