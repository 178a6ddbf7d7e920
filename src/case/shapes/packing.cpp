// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/packing.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::cases {
namespace {

std::vector<solids::Ball> balls_of(const PackingKeys& keys) {
  if (!((keys.upper - keys.lower).minCoeff() > 0.0)) {
    throw InputError("is empty: the lower corner is not below the upper one");
  }
  return solids::pack({keys.lower, keys.upper, keys.radius, keys.spread, keys.fraction,
                       static_cast<std::uint64_t>(keys.seed)});
}

/// Returns the edge of the cubes in which spheres are looked up: no smaller than a sphere reaches, nor than their
/// distance requires.
double edge_of(const std::vector<solids::Ball>& balls, const PackingKeys& keys) {
  const double apart = std::cbrt((keys.upper - keys.lower).prod() / static_cast<double>(balls.size()));
  return std::max(std::ranges::max(balls, {}, &solids::Ball::radius).radius, 0.5 * apart);
}

}  // namespace

Packing::Packing(const PackingKeys& keys, const std::filesystem::path& /*folder*/)
    : keys_(keys), balls_(balls_of(keys)), bins_(keys.lower, keys.upper, edge_of(balls_, keys)) {
  for (std::uint32_t i = 0; i < balls_.size(); ++i) bins_.add(balls_[i].centre, i);
}

std::vector<std::string> Packing::account() const {
  const auto [least, most] = std::ranges::minmax(balls_, {}, &solids::Ball::radius);
  return {fmt::format("{} spheres, radii {:.3g} to {:.3g} mm, {:.4g} of the box", balls_.size(),
                      1e3 * least.radius, 1e3 * most.radius, volume() / (keys_.upper - keys_.lower).prod())};
}

}  // namespace whipple::cases
