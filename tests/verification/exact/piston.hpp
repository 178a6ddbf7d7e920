// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/material.hpp"
#include "tests/verification/exact/result.hpp"

/// A column of elastic-plastic material that meets a rigid wall: two shocks of uniaxial strain.
namespace whipple::verification::exact {

/// Uniform state between two fronts; the wall is at x = 0 and at rest.
struct PlateauState {
  double density;   ///< kg/m^3
  double pressure;  ///< Pa
  double stress;    ///< Pa, -sigma_xx
  double deviator;  ///< Pa, s_xx
  double energy;    ///< J/kg, elastic energy of shear included
  double velocity;  ///< m/s, along x
};

/// Von Mises material of constant G and Y with an equation of state p(rho, e), where e holds the work of the
/// deviator too. The elastic shock ends at the yield surface, where the logarithmic strain is Y/(2 G); the
/// plastic shock follows with s_xx = -2 Y/3. Both obey the jump conditions of mass, momentum and energy in
/// -sigma_xx (Zel'dovich & Raizer, Physics of Shock Waves, chapter XI; Udaykumar et al., J. Comput. Phys. 186
/// (2003) 136, use such states as a test).
class TwoWaves {
 public:
  /// @param speed  m/s, with which the material meets the wall; beyond that of the elastic limit
  TwoWaves(const Material& material, double shear_modulus, double yield_stress, double speed);
  [[nodiscard]] PlateauState at(double x, double time) const;
  [[nodiscard]] const PlateauState& ahead() const { return ahead_; }
  [[nodiscard]] const PlateauState& elastic() const { return elastic_; }
  [[nodiscard]] const PlateauState& plastic() const { return plastic_; }
  /// Speed of the fronts in the material at rest before them (m/s, material coordinate).
  [[nodiscard]] double elastic_speed() const { return elastic_speed_; }
  [[nodiscard]] double plastic_speed() const { return plastic_speed_; }

 private:
  PlateauState ahead_, elastic_, plastic_;
  double elastic_speed_, plastic_speed_;
};

/// Aluminium (Mie-Grueneisen, G 27.6 GPa, Y 1 GPa) of 10 mm at 400 m/s against a mirror plane, 1.2 us, with
/// the default scheme.
/// @param cells  along the 10 mm
Result elastic_plastic_piston(int cells);

}  // namespace whipple::verification::exact
