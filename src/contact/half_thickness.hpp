// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/core/base/simd.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/grid/geometry.hpp"
#include "src/particles/particles.hpp"

namespace whipple::contact {

/// Holds the components of up to four normals, one per lane; unused lanes repeat the first normal.
struct Normals {
  Lanes x, y, z;
};
/// Computes the distance h_p from the centre of a particle to its surface along unit vectors (docs/theory/contact.md,
/// equation 3.4): of its initial box, or of its tracked domain, scaled to its present volume.
class HalfThickness {
 public:
  WHIPPLE_INLINE HalfThickness(const grid::Geometry& geometry, const Particles& particles, std::size_t p)
      : extent_(particles.extent[p].matrix()) {
    if (geometry.is_planar()) {
      set_planar(geometry, particles, p);
      return;
    }
    const double box = 8.0 * std::sqrt(std::max(extent_.determinant(), 0.0));
    const double volume = particles.volume[p] + particles.void_volume[p];
    scale_ = std::cbrt(box > 0.0 ? volume / box : volume);
    if (!(box > 0.0)) extent_ = 0.25 * Matrix3::Identity();
    largest_ = scale_ * std::sqrt(std::max(extent_.trace(), 0.0));
  }
  /// Returns an upper bound of the half thickness over all directions, m.
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double along(const Vector3& n) const {
    return scale_ * std::sqrt(std::max(n.dot(extent_ * n), 0.0));
  }
  /// Returns the half thickness along several normals, m.
  [[nodiscard]] WHIPPLE_INLINE Lanes along(const Normals& n) const {
    const Matrix3& e = extent_;
    const Lanes square = n.x * (e(0, 0) * n.x + 2.0 * (e(0, 1) * n.y + e(0, 2) * n.z)) +
                         n.y * (e(1, 1) * n.y + 2.0 * e(1, 2) * n.z) + e(2, 2) * n.z * n.z;
    return scale_ * sqrt(maximum(square, Lanes{}));
  }

 private:
  void set_planar(const grid::Geometry& geometry, const Particles& particles, std::size_t p) {
    extent_.row(2).setZero();
    extent_.col(2).setZero();
    const double box = 4.0 * std::sqrt(std::max(extent_.topLeftCorner<2, 2>().determinant(), 0.0));
    const double area =
        (particles.volume[p] + particles.void_volume[p]) / geometry.depth(particles.position[p]);
    scale_ = std::sqrt(box > 0.0 ? area / box : area);
    if (!(box > 0.0)) extent_ = Vector3(0.25, 0.25, 0.0).asDiagonal();
    largest_ = scale_ * std::sqrt(std::max(extent_.trace(), 0.0));
  }

  Matrix3 extent_;
  double scale_, largest_;
};

}  // namespace whipple::contact
