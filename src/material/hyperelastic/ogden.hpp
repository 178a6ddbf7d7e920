// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>

#include "src/core/base/tensor.hpp"
#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Ogden's solid: W = sum_a mu_a/alpha_a (l_1^alpha_a + l_2^alpha_a + l_3^alpha_a - 3) with the principal isochoric
/// stretches l_i. Source: R. W. Ogden, Proc. R. Soc. A 326 (1972) 565.
struct Ogden {
  std::vector<double> mu;     ///< Pa
  std::vector<double> alpha;  ///< 1
  hyperelastic::Relaxation relaxation;

  static ParameterTable<Ogden> parameters() {
    return with_part(
        {real_list("mu", &Ogden::mu, "Pa", range::any(), "coefficients mu_a"),
         real_list("alpha", &Ogden::alpha, "", range::any(), "exponents alpha_a; mu_a alpha_a > 0")},
        &Ogden::relaxation, hyperelastic::Relaxation::parameters());
  }
  static constexpr const char* name = "ogden";
  static constexpr const char* summary = "Ogden's solid (rubber), may relax";
  static constexpr const char* theory =
      "W = sum_a mu_a/alpha_a (l_1^alpha_a + l_2^alpha_a + l_3^alpha_a - 3), l_i^2 the eigenvalues of\n"
      "b' = J^(-2/3) F F^T; G = sum_a mu_a alpha_a/2.\n"
      "Source: R. W. Ogden, Proc. R. Soc. A 326 (1972) 565.";

  /// @throws InputError if the lists are inconsistent
  void require_consistent() const {
    if (mu.size() != alpha.size()) throw InputError("'mu' and 'alpha' must have as many entries");
    if (mu.empty()) throw InputError("'mu' has no entries");
    for (std::size_t a = 0; a < mu.size(); ++a) {
      if (!(mu[a] * alpha[a] > 0.0)) throw InputError("each 'mu' times its 'alpha' must be positive");
    }
  }
  [[nodiscard]] double shear() const {
    double modulus = 0.0;
    for (std::size_t a = 0; a < mu.size(); ++a) modulus += 0.5 * mu[a] * alpha[a];
    return modulus;
  }

  /// Computes the response along the principal axes: J s_i = t_i less the mean, t_i = sum_a mu_a l_i^alpha_a. The
  /// stiffness is bounded by the row sums of its principal components (eq. 33), which hold for every direction.
  [[nodiscard]] hyperelastic::Response respond(const hyperelastic::Tensor& b, double) const {
    Matrix3 tensor;
    tensor << b[0], b[3], b[5], b[3], b[1], b[4], b[5], b[4], b[2];
    const Eigen::SelfAdjointEigenSolver<Matrix3> axes(tensor);
    const Vector3& square = axes.eigenvalues();
    hyperelastic::Response out{};
    Vector3 t = Vector3::Zero(), slope = Vector3::Zero();  // of t_i by the logarithm of l_i
    for (std::size_t a = 0; a < mu.size(); ++a) {
      for (int i = 0; i < 3; ++i) {
        const double part = mu[a] * std::pow(square[i], 0.5 * alpha[a]);
        t[i] += part;
        slope[i] += alpha[a] * part;
        out.energy += (part - mu[a]) / alpha[a];
      }
    }
    t.array() -= t.mean();
    const Matrix3 s = axes.eigenvectors() * t.asDiagonal() * axes.eigenvectors().transpose();
    out.stress = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
    bound(square, t, slope, out);
    return out;
  }

 private:
  static void bound(const Vector3& square, const Vector3& t, const Vector3& slope,
                    hyperelastic::Response& out) {
    const Matrix3 isochoric = Matrix3::Identity() - Matrix3::Constant(1.0 / 3.0);
    Matrix3 normal = isochoric * slope.asDiagonal() * isochoric;
    normal.diagonal() -= t;
    double shear = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        const double apart = square[i] - square[j];
        const double of_pair = std::abs(apart) > 1e-6 * square[i] ? square[j] * (t[i] - t[j]) / apart
                                                                  : 0.5 * std::max(slope[i], slope[j]);
        shear = std::max(shear, of_pair);
        normal(i, j) += of_pair - t[j];
      }
    }
    out.longitudinal = std::max(normal.cwiseAbs().rowwise().sum().maxCoeff(), shear);
    out.transverse = out.longitudinal;
    out.coupling = 0.0;
  }
};

}  // namespace whipple::material
