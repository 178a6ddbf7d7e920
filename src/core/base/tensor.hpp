// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace whipple {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Holds a symmetric second-order tensor; the storage order xx, yy, zz, xy, yz, zx is that of the output files.
struct SymmetricTensor {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  [[nodiscard]] Matrix3 matrix() const {
    Matrix3 m;
    m << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    return m;
  }
  static SymmetricTensor from(const Matrix3& m) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
  }
  /// Returns s:s.
  [[nodiscard]] double squared_norm() const {
    return xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx);
  }
};

}  // namespace whipple
