// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "src/device/points.hpp"

namespace whipple::device {

/// Computes the distance h_p from the centre of a particle to its surface along unit vectors (docs/theory/contact.md,
/// equation 3.4): of its initial box, or of its tracked domain, scaled to its present volume; in two dimensions of the
/// section of the box, scaled to its area in the plane.
class HalfThickness {
 public:
  template <class Lattice>
  WHIPPLE_POINT HalfThickness(const Lattice& /*its dimensions*/, const Points& points, std::size_t p)
      : xx_(points.at(extent, p)),
        yy_(points.at(extent + 1, p)),
        zz_(points.at(extent + 2, p)),
        xy_(points.at(extent + 3, p)),
        yz_(points.at(extent + 4, p)),
        zx_(points.at(extent + 5, p)) {
    if constexpr (Lattice::planar) {
      set_section(size_in_section<true>(points, p));
    } else {
      set(points, p);
    }
  }
  /// Returns an upper bound over all directions, m.
  [[nodiscard]] WHIPPLE_POINT double largest() const {
    const double trace = xx_ + yy_ + zz_;
    return scale_ * std::sqrt(trace > 0.0 ? trace : 0.0);
  }
  [[nodiscard]] WHIPPLE_POINT double along(const Triple<double>& n) const {
    const double square = n.x * (xx_ * n.x + 2.0 * (xy_ * n.y + zx_ * n.z)) +
                          n.y * (yy_ * n.y + 2.0 * yz_ * n.z) + zz_ * n.z * n.z;
    return scale_ * std::sqrt(square > 0.0 ? square : 0.0);
  }
  [[nodiscard]] WHIPPLE_POINT double along_axis(int axis) const {
    return scale_ * std::sqrt(axis == 0 ? xx_ : axis == 1 ? yy_ : zz_);
  }

 private:
  WHIPPLE_POINT void set(const Points& points, std::size_t p) {
    const double determinant =
        xx_ * (yy_ * zz_ - yz_ * yz_) - xy_ * (xy_ * zz_ - yz_ * zx_) + zx_ * (xy_ * yz_ - yy_ * zx_);
    const double box = 8.0 * std::sqrt(determinant > 0.0 ? determinant : 0.0);
    const double size = size_in_section<false>(points, p);
    scale_ = std::cbrt(box > 0.0 ? size / box : size);
    if (!(box > 0.0)) {  // a cube
      xx_ = yy_ = zz_ = 0.25;
      xy_ = yz_ = zx_ = 0.0;
    }
  }
  WHIPPLE_POINT void set_section(double area) {
    zz_ = yz_ = zx_ = 0.0;
    const double determinant = xx_ * yy_ - xy_ * xy_;
    const double box = 4.0 * std::sqrt(determinant > 0.0 ? determinant : 0.0);
    scale_ = std::sqrt(box > 0.0 ? area / box : area);
    if (!(box > 0.0)) {  // a square
      xx_ = yy_ = 0.25;
      xy_ = 0.0;
    }
  }

  double xx_, yy_, zz_, xy_, yz_, zx_;
  double scale_;
};

}  // namespace whipple::device
