// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/case/shapes/shape.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Returns which half of a body about `center` is within the clip along an axis: -1, +1, or 0 for all of it.
inline int half_within(const Shape::Bounds& clip, Eigen::Index axis, double center, double radius) {
  const auto at_center = [&](double face) { return std::abs(face - center) < 1e-9 * radius; };
  return at_center(clip.lower[axis]) ? 1 : at_center(clip.upper[axis]) ? -1 : 0;
}

/// Creates a mesh by `make` about the z axis, starting at z = 0, or halves of it, and moves it to its position: z
/// becomes the direction `axis`.
template <class Make>
fem::Hexahedra mesh_about_axis(const Vector3& base, Eigen::Index axis, double radius,
                               const Shape::Bounds& clip, Make&& make) {
  const Eigen::Index first = (axis + 1) % 3, second = (axis + 2) % 3;
  const int x = half_within(clip, first, base[first], radius);
  const int y = half_within(clip, second, base[second], radius);
  Matrix3 turn = Matrix3::Zero();
  turn(first, 0) = x < 0 ? -1.0 : 1.0;
  turn(second, 1) = y < 0 ? -1.0 : 1.0;
  turn(axis, 2) = 1.0;
  fem::Hexahedra mesh = make(fem::Halved{x != 0, y != 0, false});
  fem::transform(mesh, turn, base);
  return mesh;
}

/// Creates a mesh of the part of a body of revolution within the clip, [from, to] along its axis, by `make(length,
/// halved)`.
template <class Make>
fem::Hexahedra mesh_of_revolution(Vector3 base, Eigen::Index axis, double height, double radius,
                                  const Shape::Bounds& clip, Make&& make) {
  const double from = std::max(base[axis], clip.lower[axis]);
  const double to = std::min(base[axis] + height, clip.upper[axis]);
  base[axis] = from;
  return mesh_about_axis(base, axis, radius, clip,
                         [&](const fem::Halved& halved) { return make(to - from, halved); });
}

}  // namespace whipple::cases
