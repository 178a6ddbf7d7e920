// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whipple::analysis {

double Frame::radius(const Vector3& position) const {
  Vector3 offset = position - centre;
  offset[axis] = 0.0;
  return offset.norm();
}

double Frame::ring_area(double inner, double outer) const {
  if (dimension == grid::Dimension::plane_strain) return 2.0 * (outer - inner) * grid::unit_depth;
  return std::numbers::pi * (outer - inner) * (outer + inner);
}

double Frame::radial_speed(const Vector3& position, const Vector3& velocity) const {
  Vector3 offset = position - centre, across = velocity;
  offset[axis] = 0.0;
  across[axis] = 0.0;
  const double distance = offset.norm();
  return distance > 0.0 ? across.dot(offset) / distance : across.norm();
}

Frame Frame::at_face(double coordinate) const {
  Frame moved = *this;
  if (impact_angle == 0.0 || !std::isfinite(coordinate)) return moved;
  for (const int a : transverse) {
    if (!mirrored(a)) moved.centre[a] += direction[a] * (coordinate - start);
  }
  moved.start = coordinate;
  return moved;
}

double Frame::depth(const Vector3& position) const {
  return dimension == grid::Dimension::plane_strain ? grid::unit_depth
                                                    : 2.0 * std::numbers::pi * radius(position);
}

double Frame::edge(double volume, const Vector3& position) const {
  return is_planar() ? std::sqrt(volume / depth(position)) : std::cbrt(volume);
}

Frame Frame::along(int other) const {
  Frame turned = *this;
  if (other == axis) return turned;
  turned.axis = other;
  turned.sign = direction[other] >= 0.0 ? 1.0 : -1.0;
  turned.centre[axis] = sign * start;
  turned.start = turned.sign * turned.centre[other];
  turned.centre[other] = 0.0;
  turned.direction = direction / std::abs(direction[other]);
  turned.impact_angle = std::acos(std::min(1.0, 1.0 / turned.direction.norm()));
  turned.transverse = {axis, transverse[0] == other ? transverse[1] : transverse[0]};
  return turned;
}

bool Frame::mirrored(int direction) const {
  return std::ranges::any_of(planes, [&](const Plane& plane) { return plane.axis == direction; });
}

namespace {

/// Computes the momentum over the mass of every body of a snapshot.
std::vector<Vector3> mean_velocities(const Run& run, const Snapshot& snapshot) {
  std::vector<Vector3> momentum(run.bodies.size(), Vector3::Zero());
  std::vector<double> mass(run.bodies.size(), 0.0);
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    momentum[snapshot.body[i]] += snapshot.mass[i] * snapshot.velocity[i];
    mass[snapshot.body[i]] += snapshot.mass[i];
  }
  for (std::size_t b = 0; b < mass.size(); ++b) {
    if (mass[b] > 0.0) momentum[b] /= mass[b];
  }
  return momentum;
}

}  // namespace

Frame find_frame(const Run& run, const Snapshot& first, std::optional<int> axis, const Snapshot* last) {
  std::vector<Vector3> velocity;
  for (const BodyInput& body : run.bodies) velocity.push_back(body.velocity);
  const bool at_rest = std::ranges::all_of(velocity, [](const Vector3& v) { return v.isZero(0.0); });
  if (at_rest && last != nullptr) velocity = mean_velocities(run, *last);
  Frame frame;
  frame.dimension = run.dimension;
  if (run.dimension == grid::Dimension::axisymmetric) axis = 0;
  std::size_t slowest = 0;
  Vector3 least = velocity[0], greatest = least;
  for (std::size_t b = 0; b < velocity.size(); ++b) {
    const Vector3& v = velocity[b];
    if (v.norm() > velocity[frame.projectile].norm()) frame.projectile = b;
    if (v.norm() < velocity[slowest].norm()) slowest = b;
    least = least.cwiseMin(v);
    greatest = greatest.cwiseMax(v);
  }
  const Vector3& fastest = velocity[frame.projectile];
  const Vector3 spread = run.bodies.size() > 1 ? Vector3(greatest - least) : Vector3(fastest.cwiseAbs());
  if (axis) {
    frame.axis = *axis;
  } else {
    spread.maxCoeff(&frame.axis);
  }
  // If nothing moves initially, there is no direction of flight: the axis is that of the domain.
  frame.sign = at_rest || fastest[frame.axis] >= 0.0 ? 1.0 : -1.0;
  Vector3 approach = run.bodies.size() > 1 ? Vector3(fastest - velocity[slowest]) : fastest;
  if (at_rest && approach[frame.axis] < 0.0) approach = -approach;
  (at_rest ? frame.parting_speed : frame.impact_speed) = approach.norm();
  // Mean velocities of ring sections have a radial component, along which nothing flies.
  if (run.dimension == grid::Dimension::axisymmetric) approach = Vector3(approach[0], 0.0, 0.0);
  if (approach[frame.axis] != 0.0) {
    frame.direction = approach / std::abs(approach[frame.axis]);
    frame.impact_angle = std::acos(std::min(1.0, 1.0 / frame.direction.norm()));
  }

  double mass = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != frame.projectile) continue;
    frame.centre += first.mass[i] * first.position[i];
    mass += first.mass[i];
  }
  if (mass > 0.0) frame.centre /= mass;
  frame.start = frame.axial(frame.centre);
  frame.centre[frame.axis] = 0.0;
  std::vector<int> mirrored, other;
  for (int a = 0; a < 3; ++a) {
    const std::optional<double>& plane = run.mirror_planes[static_cast<std::size_t>(a)];
    const auto& faces = run.walls[static_cast<std::size_t>(a)];
    const bool slice = faces[0] && faces[1] && faces[0]->holds && faces[1]->holds;
    const std::optional<Run::Wall>& ahead_of_flight = faces[frame.sign > 0.0 ? 1 : 0];
    const bool flown_at = a == frame.axis && !at_rest && ahead_of_flight && ahead_of_flight->holds;
    if (plane && !slice && !flown_at) frame.cuts.push_back({a, *plane});
    if (a == frame.axis) {
      // The projectile flies against this face: it is a wall, not the mirror plane of a half model.
      const std::optional<Run::Wall>& ahead =
          run.walls[static_cast<std::size_t>(a)][frame.sign > 0.0 ? 1 : 0];
      if (ahead && !at_rest && frame.sign * ahead->position > frame.start) {
        frame.wall = frame.sign * ahead->position;
        frame.wall_holds = ahead->holds;
      }
      continue;
    }
    (plane ? mirrored : other).push_back(a);
    if (!plane) continue;
    frame.planes.push_back({a, *plane});
    frame.slices += slice ? 1 : 0;
    frame.centre[a] = *plane;
  }
  if (run.dimension == grid::Dimension::axisymmetric)
    frame.centre[1] = 0.0;  // not the centre of the ring sections
  // A half model is viewed across its mirror plane, which may contain an oblique flight.
  other.insert(other.end(), mirrored.begin(), mirrored.end());
  frame.transverse = {other[0], other[1]};
  if (frame.is_planar()) frame.transverse = {frame.axis == 0 ? 1 : 0, 2};
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

double weighted_quantile(std::vector<std::pair<double, double>>& value_and_weight, double fraction) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0.0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  if (!(total > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double below = 0.0;
  for (const auto& [value, weight] : value_and_weight) {
    below += weight;
    if (below >= fraction * total) return value;
  }
  return value_and_weight.back().first;
}

}  // namespace whipple::analysis
