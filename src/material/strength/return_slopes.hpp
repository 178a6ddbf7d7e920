// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::strength {

/// Describes a point at the end of a step by what the return to its strength depends on (SI units).
struct ReturnedPoint {
  double trial;           ///< q, equivalent stress of the elastic trial, Pa
  double plastic_strain;  ///< before the step
  bool flows;             ///< whether the step made it flow
  double modulus;         ///< G, Pa
  double factor;          ///< of the flow stress of this point (1: no scatter)
  double pressure;        ///< at the end, Pa
  /// Of laws that change the volume: dp/d(ln distension) at constant density, Pa; distension before the step; growth of
  /// its logarithm in the step.
  double stiffness = 0.0, distension = 1.0, growth = 0.0;
};

/// Holds the slopes of a return: of the equivalent stress by the trial q and by the pressure at the end, and of the growth
/// of ln(distension) by the trial and by the pressure without that growth.
struct ReturnSlopes {
  double stress_by_trial = 1.0, stress_by_pressure = 0.0;
  double growth_by_trial = 0.0, growth_by_pressure = 0.0;  ///< 1/Pa
};

}  // namespace whipple::strength
