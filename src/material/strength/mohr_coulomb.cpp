// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/mohr_coulomb.hpp"

#include <Eigen/Eigenvalues>

#include "src/material/principal.hpp"

namespace whipple::strength {
namespace {

/// Returns whether a deviator is below the pyramid at a pressure (Pa), from the invariants alone: s1 - s3 = 2 r sin(theta
/// + pi/3) and s1 + s3 = 2 r cos(theta + pi/3)/sqrt(3) - 2 p with r = q/sqrt(3) and the Lode angle theta.
bool is_below(const Pyramid& pyramid, const SymmetricTensor& s, double pressure) {
  const double radius = std::sqrt(0.5 * s.squared_norm());
  if (radius * 2.0 <= pyramid.intercept + 2.0 * pressure * pyramid.sine - 2.0 * radius * pyramid.sine)
    return true;
  const double angle = std::acos(material::lode_cosine(s)) / 3.0 + std::numbers::pi / 3.0;
  const double scale = 2.0 * radius;
  const double difference = scale * std::sin(angle);
  const double sum = scale / std::numbers::sqrt3 * std::cos(angle) - 2.0 * pressure;
  return difference + sum * pyramid.sine <= pyramid.intercept;
}

/// Describes the return of a deviator at a pressure.
struct Return {
  Matrix3 axes;      // principal, in the order of the values
  Vector3 deviator;  // principal values of the trial, Pa
  Vector3 stress;    // after the return, tension positive, Pa
};

Return return_of(const Pyramid& pyramid, const SymmetricTensor& deviator, double pressure, double bulk,
                 double shear) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(deviator.matrix());  // ascending
  const Vector3& values = solver.eigenvalues();
  const PrincipalStress trial = {values[2] - pressure, values[1] - pressure, values[0] - pressure};
  const PrincipalStress now = return_to(pyramid, bulk, shear, trial);
  return {solver.eigenvectors(), values, Vector3(now[2], now[1], now[0])};
}

}  // namespace

void MohrCoulombModel::dilate(const DilationState& state) const {
  const double least = law_.least_pressure();
  for (std::size_t i = 0; i < state.trial.size(); ++i) {
    state.dilation[i] = may_dilate(state, i, least) ? law_.remaining(state.distension[i]) : 0.0;
    state.growth[i] = 0.0;
    const double pressure = state.pressure[i], bulk = state.stiffness[i];
    if (state.dilation[i] == 0.0 || is_below(pyramid_, state.deviator[i], pressure)) continue;
    const Return to =
        return_of(with_dilation(state.dilation[i]), state.deviator[i], pressure, bulk, state.modulus[i]);
    const double gained = -to.stress.sum() / 3.0 - pressure;
    state.growth[i] = std::clamp(gained / bulk, 0.0, law_.room(state.distension[i]));
  }
}

// The pressure is that of the new distension: the flow has the direction of its dilation, and leaves the mean stress.
void MohrCoulombModel::relax(const BrittleState& state) const {
  const double least = law_.least_pressure();
  for (std::size_t i = 0; i < state.trial.size(); ++i) {
    state.least_pressure[i] = least;
    state.plastic_increment[i] = 0.0;
    const double shear = state.modulus[i], solid = state.solid_fraction[i];
    if (!(shear > 0.0) || !(solid > 0.0)) {
      state.equivalent[i] = solid > 0.0 ? state.trial[i] : 0.0;
      continue;
    }
    const double pressure = std::max(state.pressure[i], least);
    if (is_below(pyramid_, state.deviator[i], pressure)) continue;
    const Pyramid pyramid = with_dilation(state.dilation.empty() ? 0.0 : state.dilation[i]);
    const Return to = return_of(pyramid, state.deviator[i], pressure, 0.0, shear);
    const Vector3 kept = to.stress + Vector3::Constant(pressure);
    const Vector3 flow = (to.deviator - kept) / (2.0 * shear);
    state.deviator[i] = SymmetricTensor::from(to.axes * kept.asDiagonal() * to.axes.transpose());
    state.equivalent[i] = std::sqrt(1.5) * kept.norm();
    state.plastic_increment[i] = std::sqrt(2.0 / 3.0) * flow.norm();
    state.plastic_strain[i] += state.plastic_increment[i];
    state.work[i] = std::max(kept.dot(flow), 0.0);
  }
}

}  // namespace whipple::strength
