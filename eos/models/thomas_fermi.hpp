// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "eos/models/free_energy_spline.hpp"

namespace whipple::eos {

/// Holds the free energy of the electrons of the Thomas-Fermi atom with Z = 1 above that at T = 0, atomic units:
///   F = -exp(sum_ik c_ik T_i(x) T_k(y)),
/// T Chebyshev's polynomials, x and y the logarithms of volume and temperature mapped to [-1, 1].
struct ThomasFermiSeries {
  static constexpr std::size_t volume_terms = 24, temperature_terms = 32;
  std::array<double, 2> volumes;       ///< limits, bohr^3
  std::array<double, 2> temperatures;  ///< limits, hartree
  std::array<double, volume_terms * temperature_terms>
      coefficients;  ///< the index of the volume runs fastest
};

/// Returns the series that scripts/thomas_fermi.py computes: to 3e-4 in entropy, 7e-3 of the pressure.
const ThomasFermiSeries& thomas_fermi_series();

/// Evaluates the thermal free energy of the electrons of an element by the Thomas-Fermi atom, F(V, T) - F(V, 0)
/// (Feynman, Metropolis and Teller, Phys. Rev. 75, 1561 (1949); docs/theory/gray.md, section 12). Volumes, temperatures
/// and energies per atom scale with Z^-1, Z^(4/3), Z^(7/3). No exchange, no shells. SI per unit mass.
class ThomasFermiElectrons {
 public:
  /// @param atomic_number  Z
  /// @param molar_mass     kg/mol
  ThomasFermiElectrons(double atomic_number, double molar_mass);

  /// Returns the free energy and its derivatives: least_volume() <= V, least_temperature() <= T <=
  /// greatest_temperature(). Beyond the largest volume of the series F is continued linearly in ln V, as that of a gas.
  [[nodiscard]] FreeEnergyTerms operator()(double V, double T) const;
  [[nodiscard]] double least_volume() const;          ///< m^3/kg
  [[nodiscard]] double least_temperature() const;     ///< K
  [[nodiscard]] double greatest_temperature() const;  ///< K

 private:
  double volume_unit_, temperature_unit_, energy_unit_;  ///< SI values of the units of the series
};

}  // namespace whipple::eos
