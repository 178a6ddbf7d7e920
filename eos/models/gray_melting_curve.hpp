// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/hermite_table.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "eos/models/phase_equilibrium.hpp"

namespace whipple::eos {

/// Provides the states of solid and liquid, stable or not, to the search of their equilibrium. SI per unit mass.
struct SolidLiquidSurfaces {
  PhaseSurfaceFunction solid, liquid;
  double start_volume = 0, start_temperature = 0;  ///< at which both have equal free energies
  double least_volume = 0;                         ///< of the solid: the compression limit
  double join_volume = 0;                          ///< V_J, of the liquid where the search ends
};

/// Tabulates solid and liquid of GRAY in equilibrium: the common tangent of their free energies on a grid of
/// temperatures (G27), docs/theory/gray.md, section 3. It extends from the state where the liquid reaches V_J, far
/// in tension, to that where the solid reaches the compression limit. SI per unit mass.
///
/// The pressure P(T) and the Gibbs energy g(T) of the coexisting phases give the free energy of every mixture,
/// F(V, T) = g - P V, and all its properties by differentiation: the mixture is thermodynamically consistent, whatever
/// the interpolation error.
class GrayMeltingCurve {
 public:
  /// Holds the coexisting phases on the tangent.
  struct Tangent {
    double temperature = 0, pressure = 0;
    double solid_volume = 0, liquid_volume = 0;
  };
  using Mixture = PhaseMixture;

  /// @throws InputError if the tangent does not exist at the start
  explicit GrayMeltingCurve(const SolidLiquidSurfaces& surfaces);
  explicit GrayMeltingCurve(const GrayFreeEnergy& surface);

  [[nodiscard]] const Tangent& coldest() const { return coldest_; }
  [[nodiscard]] const Tangent& hottest() const { return hottest_; }
  /// @param temperature  from coldest() to hottest()
  [[nodiscard]] Tangent at_temperature(double temperature) const;
  /// @throws StateError outside the curve
  [[nodiscard]] Tangent at_pressure(double pressure) const;

  /// Returns the temperature at which the solid of volume V begins to melt: V from the volume of the hottest liquid
  /// to coldest().solid_volume.
  [[nodiscard]] double solidus(double V) const { return solidus_(V); }
  /// Returns the temperature at which the last solid melts on the isochore V, up to coldest().liquid_volume.
  [[nodiscard]] double liquidus(double V) const { return liquidus_(V); }
  [[nodiscard]] Mixture mixture(double V, double T) const;
  /// Returns the mass fraction of liquid (lever rule).
  [[nodiscard]] double liquid_fraction(double V, double T) const;
  /// Returns the temperature of the mixture with energy E.
  /// @param edges  of the isochore: temperatures and energies
  [[nodiscard]] double temperature(double V, double E, const GrayBand& edges) const;

 private:
  HermiteTable pressure_, gibbs_, solid_volume_, liquid_volume_;  ///< over T
  HermiteTable solidus_, liquidus_;                               ///< over V
  Tangent coldest_, hottest_;
};

}  // namespace whipple::eos
