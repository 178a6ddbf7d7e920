// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"

/// Responses of hyperelastic laws to an isochoric deformation, by which they enter `HyperelasticModel`
/// (docs/theory/material.md, section 12). Tensors are written xx, yy, zz, xy, yz, zx.
namespace whipple::material::hyperelastic {

using Tensor = std::array<double, 6>;

/// Holds what a law gives for b' = J^(-2/3) F F^T and J, per volume of the undeformed solid, Pa.
struct Response {
  Tensor stress;          ///< deviator of J times the Cauchy stress
  double energy;          ///< W
  double pressure = 0.0;  ///< J times that of W, which adds to that of the equation of state
  /// Bounds of the wave stiffness without the bulk modulus (eq. 29): of waves that displace along their direction,
  /// across it, and of the coupling of both.
  double longitudinal, transverse, coupling;
};

/// Holds W and its derivatives by the invariants I1 = tr b' and I2 = (I1^2 - b':b')/2.
struct Potential {
  double energy;       ///< Pa
  double first;        ///< dW/dI1
  double second;       ///< dW/dI2
  double first_twice;  ///< d2W/dI1^2
};

/// Computes b'^2, of which only the symmetric part exists.
inline Tensor squared(const Tensor& b) {
  return {b[0] * b[0] + b[3] * b[3] + b[5] * b[5], b[3] * b[3] + b[1] * b[1] + b[4] * b[4],
          b[5] * b[5] + b[4] * b[4] + b[2] * b[2], b[0] * b[3] + b[3] * b[1] + b[5] * b[4],
          b[3] * b[5] + b[1] * b[4] + b[4] * b[2], b[0] * b[5] + b[3] * b[4] + b[5] * b[2]};
}

/// Computes the response of a potential of both invariants,
///   J s = dev[2 (W_1 + I1 W_2) b' - 2 W_2 b'^2],
/// and the bounds of its stiffness (eq. 29), for which the eigenvalues of b' and of its inverse lie within
/// tr/3 +- 2/3 sqrt(tr^2 - 3 tr') of their traces tr = I1, I2 (tr' = I2, I1).
template <class Law>
Response response_of(const Law& law, const Tensor& b) {
  const double i1 = b[0] + b[1] + b[2];
  const Tensor square = squared(b);
  const double trace = square[0] + square[1] + square[2], i2 = 0.5 * (i1 * i1 - trace);
  const Potential w = law.potential(i1, i2);
  const double linear = 2.0 * (w.first + i1 * w.second), quadratic = 2.0 * w.second;
  Response out;
  for (std::size_t j = 0; j < 6; ++j) out.stress[j] = linear * b[j] - quadratic * square[j];
  const double mean = (out.stress[0] + out.stress[1] + out.stress[2]) / 3.0;
  for (std::size_t j = 0; j < 3; ++j) out.stress[j] -= mean;
  out.energy = w.energy;
  const double spread = std::sqrt(std::max(i1 * i1 - 3.0 * i2, 0.0));
  const double of_inverse = std::sqrt(std::max(i2 * i2 - 3.0 * i1, 0.0));
  const double largest = (i1 + 2.0 * spread) / 3.0, inverse = (i2 + 2.0 * of_inverse) / 3.0;
  const double deviation = 4.0 / 9.0 * spread * spread;  // square of a bound of |dev b'|
  const double stiffening = 4.0 * std::max(w.first_twice, 0.0) * deviation;
  out.longitudinal =
      w.first * 10.0 / 9.0 * i1 + w.second * (10.0 / 3.0 * inverse - 2.0 / 9.0 * i2) + stiffening;
  out.transverse = 2.0 * w.first * largest + 2.0 * w.second * inverse + stiffening;
  // Off-diagonal components are at most half of the difference of two eigenvalues, which is 2/sqrt(3) of the spread.
  out.coupling = (4.0 / 3.0 * w.first * spread + 8.0 / 3.0 * w.second * of_inverse) / std::sqrt(3.0);
  return out;
}

/// Describes the relaxation of the stress by a sum of exponentials, s(t)/s_0 = 1 - sum g_i (1 - exp(-t/tau_i)) after a
/// sudden strain (J. C. Simo, Comput. Meth. Appl. Mech. Engng 60 (1987) 153).
struct Relaxation {
  static constexpr std::size_t most = 3;  ///< terms
  std::vector<double> fractions;          ///< g_i
  std::vector<double> times;              ///< tau_i, s

  static ParameterTable<Relaxation> parameters() {
    return {
        real_list("relaxing_fractions", &Relaxation::fractions, "", range::positive(),
                  "fractions of the sudden stress that relax, at most three; their sum is below 1")
            .optional(),
        real_list("relaxation_times", &Relaxation::times, "s", range::positive(), "times of these fractions")
            .optional()};
  }
  /// Returns the fraction of the stress that stays.
  [[nodiscard]] double lasting() const {
    double left = 1.0;
    for (const double relaxing : fractions) left -= relaxing;
    return left;
  }
  /// @throws InputError if the lists are inconsistent
  void require_consistent() const {
    if (fractions.size() != times.size()) {
      throw InputError("'relaxing_fractions' and 'relaxation_times' must have as many entries");
    }
    if (fractions.size() > most) throw InputError("'relaxing_fractions' has more than three entries");
    constexpr double least = 1e-6;  // the sudden stress is found from what lasts
    if (!(lasting() >= least))
      throw InputError("the sum of 'relaxing_fractions' must be below 1 by 1e-6 at least");
  }
};

}  // namespace whipple::material::hyperelastic
