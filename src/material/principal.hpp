// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/tensor.hpp"

namespace whipple::material {

/// Returns cos(3 theta) of a deviator with the Lode angle theta: 1 in uniaxial tension, -1 in uniaxial compression.
inline double lode_cosine(const SymmetricTensor& s) {
  const double j2 = 0.5 * s.squared_norm();
  if (!(j2 > 0.0)) return 1.0;
  const double j3 = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) +
                    s.zx * (s.xy * s.yz - s.yy * s.zx);
  const double radius = std::sqrt(j2 / 3.0);  // J2^(3/2) / (3 sqrt(3)) = radius^3
  return std::clamp(0.5 * (j3 / radius / radius / radius), -1.0, 1.0);
}

/// Returns the largest principal value of a deviator from its Lode angle,
///   s_1 = 2 sqrt(J2/3) cos(theta),  cos(3 theta) = (3 sqrt(3)/2) J3 / J2^(3/2),  theta in [0, pi/3];
/// R. Hill, The Mathematical Theory of Plasticity (Oxford 1950), ch. II; A. Nayak and O. C. Zienkiewicz, J. Struct.
/// Div. ASCE 98 (1972) 949.
inline double greatest_principal_value(const SymmetricTensor& s) {
  return 2.0 * std::sqrt(s.squared_norm() / 6.0) * std::cos(std::acos(lode_cosine(s)) / 3.0);
}

/// Returns an upper bound of the largest principal value without cosines: that of uniaxial tension, 2/3 of the
/// equivalent value.
inline double greatest_principal_bound(const SymmetricTensor& s) {
  return std::sqrt(2.0 / 3.0 * s.squared_norm());
}

}  // namespace whipple::material
