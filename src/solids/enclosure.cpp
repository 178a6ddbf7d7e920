// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/enclosure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "src/core/parallel/threads.hpp"

namespace whipple::solids {
namespace {

/// Returns the winding number in front of a place on a triangle, where its normal points to; one more is behind it.
/// @param number  of the place: they fill the triangle evenly
int winding_before(const WindingTree& tree, const Triangle& triangle, std::size_t number) {
  constexpr double part = 1e-4;  // of the edge: before any surface that is not in contact
  // Additive recurrence in the plane, whose constants are powers of the root of x^3 = x + 1; the first one is the centre.
  constexpr double root = 1.324717957244746, third = 1.0 / 3.0;
  double u = third + static_cast<double>(number) / root,
         v = third + static_cast<double>(number) / (root * root);
  u -= std::floor(u);
  v -= std::floor(v);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Vector3 first = triangle[1] - triangle[0], second = triangle[2] - triangle[0],
                normal = first.cross(second);
  const Vector3 place =
      triangle[0] + u * first + v * second + part * std::sqrt(normal.norm()) * normal.normalized();
  return static_cast<int>(std::lround(tree.winding_number(place)));
}

}  // namespace

std::optional<Enclosure> enclosure_of(const WindingTree& tree, const Audit& audit) {
  if (!audit.are_parts_closed) return std::nullopt;
  constexpr std::size_t most_places = 5000;  // on surfaces of few triangles, at most 64 on each
  const std::size_t places = std::clamp<std::size_t>(most_places / tree.triangles().size(), 1, 64);
  std::vector<int> before(audit.parts.size());
  std::atomic<bool> do_vary = false;
  parallel::for_each_uneven(audit.parts.size(), [&](std::size_t p) {
    const std::vector<Triangle>& samples = audit.parts[p].samples;
    before[p] = winding_before(tree, samples.front(), 0);
    for (const Triangle& triangle : samples) {
      for (std::size_t i = 0; i < places && !do_vary; ++i) {
        if (winding_before(tree, triangle, i) != before[p]) do_vary = true;
      }
    }
  });
  if (do_vary) return std::nullopt;
  Enclosure enclosure;
  enclosure.parts = audit.parts.size();
  for (std::size_t p = 0; p < before.size(); ++p) {
    const double volume = audit.parts[p].volume;
    if (before[p] == 0) {
      enclosure.volume += volume;
    } else if (before[p] == -1) {
      enclosure.volume -= volume;
    } else {
      ++enclosure.covered;
    }
    if (before[p] < 0) ++enclosure.inverted;
  }
  return enclosure;
}

}  // namespace whipple::solids
