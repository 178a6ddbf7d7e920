// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/base/random_bits.hpp"
#include "src/solids/bins.hpp"

namespace whipple::solids {
namespace {

double volume_of(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

/// Draws radii until the spheres have the wanted volume, and scales them to it.
std::vector<double> radii_of(const PackingOrder& order) {
  constexpr double most = 2e5, cut = 2.5;
  const double wanted = order.fraction * (order.upper - order.lower).prod();
  if (wanted / volume_of(order.radius) > most) {
    throw InputError(
        fmt::format("{:.2g} spheres have this fraction of the volume; at most {:.0e}: enlarge 'radius'",
                    wanted / volume_of(order.radius), most));
  }
  std::vector<double> radii;
  double volume = 0.0;
  for (std::uint64_t number = 0; volume < wanted; number += 2) {
    // Normal deviate by Box and Muller.
    const double normal = std::sqrt(-2.0 * std::log(uniform(order.seed, number))) *
                          std::cos(2.0 * std::numbers::pi * uniform(order.seed, number + 1));
    radii.push_back(order.radius * std::exp(order.spread * std::clamp(normal, -cut, cut)));
    volume += volume_of(radii.back());
  }
  // Half a sphere too much on average: the last one stays where that meets the volume more closely.
  if (radii.size() > 1 && volume - wanted > 0.5 * volume_of(radii.back())) {
    volume -= volume_of(radii.back());
    radii.pop_back();
  }
  const double scale = std::cbrt(wanted / volume);
  constexpr double most_scaled = 0.05;
  if (std::abs(scale - 1.0) > most_scaled) {
    throw InputError(
        fmt::format("{} sphere{} of radius {:.3g} m do not fit this fraction of the box: enlarge the box",
                    radii.size(), radii.size() == 1 ? "" : "s", order.radius));
  }
  for (double& radius : radii) radius *= scale;
  return radii;
}

/// Pushes overlapping spheres apart. Returns the largest overlap before that, in parts of the sum of the two radii.
double push_apart(std::vector<Ball>& balls, Bins& bins, const PackingOrder& order) {
  constexpr double apart = 1.0 + 5e-4;  // a little farther than contact, so that pushing comes to an end
  bins.clear();
  for (std::uint32_t i = 0; i < balls.size(); ++i) bins.add(balls[i].centre, i);
  std::vector<Vector3> moved(balls.size());
  std::vector<double> overlaps(balls.size(), 0.0);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    Vector3 shift = Vector3::Zero();
    int pushes = 0;
    static_cast<void>(bins.none_near(balls[i].centre, [&](std::uint32_t j) {
      if (j == i) return false;
      const Vector3 away = balls[i].centre - balls[j].centre;
      const double sum = balls[i].radius + balls[j].radius, distance = away.norm();
      if (distance >= apart * sum) return false;
      overlaps[i] = std::max(overlaps[i], 1.0 - distance / sum);
      const Vector3 direction =
          distance > 0.0 ? Vector3(away / distance) : Vector3(i < j ? 1.0 : -1.0, 0.0, 0.0);
      shift += 0.5 * (apart * sum - distance) * direction;
      ++pushes;
      return false;
    }));
    const Vector3 wall = Vector3::Constant(balls[i].radius);
    // Several neighbours push at once: their mean would be slow, and their sum would overshoot.
    moved[i] = (balls[i].centre + (pushes > 1 ? 1.2 / std::sqrt(pushes) : 1.0) * shift)
                   .cwiseMax(order.lower + wall)
                   .cwiseMin(order.upper - wall);
  }
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i].centre = moved[i];
  return *std::ranges::max_element(overlaps);
}

}  // namespace

std::vector<Ball> pack(const PackingOrder& order) {
  const std::vector<double> radii = radii_of(order);
  const double largest = *std::ranges::max_element(radii);
  if (!(2.0 * largest < (order.upper - order.lower).minCoeff())) {
    throw InputError(fmt::format("a sphere of radius {:.3g} m does not fit into the box", largest));
  }
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Vector3 part(uniform(order.seed + 1, 3 * i), uniform(order.seed + 1, 3 * i + 1),
                       uniform(order.seed + 1, 3 * i + 2));
    const Vector3 wall = Vector3::Constant(radii[i]);
    balls.push_back(
        {order.lower + wall + part.cwiseProduct(order.upper - order.lower - 2.0 * wall), radii[i]});
  }
  constexpr int most_rounds = 5000, patience = 300;
  constexpr double progress = 0.98;  // of the overlap within the rounds of patience
  const double apart = std::cbrt((order.upper - order.lower).prod() / static_cast<double>(balls.size()));
  Bins bins(order.lower, order.upper, std::max(2.01 * largest, 0.5 * apart));
  double least = std::numeric_limits<double>::infinity();
  int least_round = 0, round = 0;
  for (; round < most_rounds && round - least_round < patience; ++round) {
    std::vector<Ball> before = balls;
    const double overlap = push_apart(balls, bins, order);
    if (overlap <= 0.0) return before;  // those of which it was measured
    if (overlap > progress * least) continue;
    least = overlap;
    least_round = round;
  }
  throw InputError(
      fmt::format("a fraction of {} is not reached: {} spheres still overlap by {:.2g} of their distance "
                  "after {} rounds; equal spheres reach about 0.55",
                  order.fraction, balls.size(), least, round));
}

}  // namespace whipple::solids
