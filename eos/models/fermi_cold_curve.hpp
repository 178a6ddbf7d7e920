// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "eos/hermite_table.hpp"

namespace whipple::eos {

/// Holds a point of a cold curve. SI per unit mass.
struct ColdPoint {
  double energy = 0, pressure = 0;
  double pressure_by_volume = 0;  ///< dP/dV
};

/// Continues a cold curve to the pressure of the degenerate electron gas (docs/theory/gray.md, section 12):
///   P = P_FG0 X^-5 (1 - X) exp(-(c1 X + c2 X^2 + c3 X^3)),  X = (V/V0)^(1/3),
/// P_FG0 the pressure of the free electrons at V0; c1 is that of their energy in the field of the nuclei and of their
/// exchange, exact for X -> 0; c2 and c3 make the pressure and its slope continuous at the join. The form is that of
/// Holzapfel, Rep. Prog. Phys. 59, 29 (1996), with one constant more.
class FermiColdCurve {
 public:
  /// Holds the state at the join.
  struct Join {
    double volume = 0;  ///< m^3/kg
    double energy = 0, pressure = 0;
    double pressure_by_volume = 0;  ///< dP/dV
  };
  /// @param atomic_number     Z
  /// @param molar_mass        kg/mol
  /// @param reference_volume  V0, m^3/kg
  /// @param least_volume      where the table of the energy ends, m^3/kg
  /// @throws InputError if the pressure is not positive at the join or does not rise up to the least volume
  FermiColdCurve(double atomic_number, double molar_mass, double reference_volume, double least_volume,
                 const Join& join);

  [[nodiscard]] double join_volume() const { return join_volume_; }
  /// @param V  from the least volume to the join
  [[nodiscard]] ColdPoint operator()(double V) const;

 private:
  [[nodiscard]] ColdPoint without_energy(double V) const;

  double reference_volume_, join_volume_, electron_pressure_ = 0;
  std::array<double, 3> c_{};  ///< c1 to c3
  HermiteTable energy_;        ///< over ln V
};

}  // namespace whipple::eos
