// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/kinematics.hpp"

#include "src/core/base/simd.hpp"
#include "src/material/kinematic_formulas.hpp"

namespace whipple::material {
namespace {

using Matrix = formulas::Matrix<double>;
using Symmetric = formulas::Symmetric<double>;
using formulas::motion_of;

template <class NineLanes>
inline Matrix load_matrix(const NineLanes& lanes, std::size_t k) {
  return {lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k], lanes[4][k],
          lanes[5][k], lanes[6][k], lanes[7][k], lanes[8][k]};
}

template <class SixLanes>
inline Symmetric load(const SixLanes& lanes, std::size_t k) {
  return {lanes[0][k], lanes[1][k], lanes[2][k], lanes[3][k], lanes[4][k], lanes[5][k]};
}

template <class SixLanes>
inline void store(const Symmetric& s, SixLanes&& lanes, std::size_t k) {
  lanes[0][k] = s.xx;
  lanes[1][k] = s.yy;
  lanes[2][k] = s.zz;
  lanes[3][k] = s.xy;
  lanes[4][k] = s.yz;
  lanes[5][k] = s.zx;
}

}  // namespace

void volume_change(std::size_t size, double dt, Kinematics& step) {
  for (std::size_t k = 0; k < size; ++k) {
    const Matrix l = load_matrix(step.gradient, k);
    step.ratio[k] = determinant(identity_plus(dt, l));
    step.divergence[k] = l.xx + l.yy + l.zz;
  }
}

namespace {

template <StressRotation rule>
void elastic_trial_by(std::size_t size, double dt, Kinematics& step) {
  for (std::size_t k = 0; k < size; ++k) {
    const formulas::Motion<double> motion = motion_of<rule>(load_matrix(step.gradient, k), dt);
    const formulas::Trial<double> trial =
        formulas::elastic_trial(load(step.deviator, k), motion, step.modulus[k]);
    store(trial.deviator, step.deviator, k);
    store(motion.strain, step.strain, k);
    step.trial[k] = trial.equivalent;
  }
}

template <StressRotation rule>
void turn_by(std::size_t size, double dt, const MatrixLanes& gradient, std::span<Lanes, 6> tensor) {
  for (std::size_t k = 0; k < size; ++k) {
    store(turned(load(tensor, k), motion_of<rule>(load_matrix(gradient, k), dt).rotation), tensor, k);
  }
}

template <StressRotation rule>
void strain_increment_by(std::size_t size, double dt, const MatrixLanes& gradient, SymmetricLanes& strain) {
  for (std::size_t k = 0; k < size; ++k) {
    store(motion_of<rule>(load_matrix(gradient, k), dt).strain, strain, k);
  }
}

using enum StressRotation;

}  // namespace

WHIPPLE_KERNEL void elastic_trial(std::size_t size, double dt, StressRotation rule, Kinematics& step) {
  rule == polar ? elastic_trial_by<polar>(size, dt, step) : elastic_trial_by<hughes_winget>(size, dt, step);
}

WHIPPLE_KERNEL void turn(std::size_t size, double dt, StressRotation rule, const MatrixLanes& gradient,
                         std::span<Lanes, 6> tensor) {
  rule == polar ? turn_by<polar>(size, dt, gradient, tensor)
                : turn_by<hughes_winget>(size, dt, gradient, tensor);
}

WHIPPLE_KERNEL void deform(std::size_t size, double dt, const MatrixLanes& gradient,
                           std::span<Lanes, 9> deformation) {
  for (std::size_t k = 0; k < size; ++k) {
    const Matrix f = multiply(identity_plus(dt, load_matrix(gradient, k)), load_matrix(deformation, k));
    const double parts[9] = {f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz};
    for (std::size_t e = 0; e < 9; ++e) deformation[e][k] = parts[e];
  }
}

WHIPPLE_KERNEL void strain_increment(std::size_t size, double dt, StressRotation rule,
                                     const MatrixLanes& gradient, SymmetricLanes& strain) {
  rule == polar ? strain_increment_by<polar>(size, dt, gradient, strain)
                : strain_increment_by<hughes_winget>(size, dt, gradient, strain);
}

}  // namespace whipple::material
