// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace whipple::eos {

/// Holds a free energy and its derivatives by V (m^3/kg) and T (K), or the weights of a linear functional of them.
struct FreeEnergyTerms {
  double F = 0, F_V = 0, F_T = 0, F_VV = 0, F_VT = 0, F_TT = 0;
};

/// Describes the grid of a FreeEnergySpline. SI.
struct FreeEnergyGrid {
  double least_volume = 0;     ///< m^3/kg: about and below it the correction does not depend on V,
  double greatest_volume = 0;  ///< m^3/kg: nor about and above this one
  double temperature = 0;      ///< T* of u = T/(T + T*), K
  std::size_t volumes = 0, temperatures = 0;

  [[nodiscard]] std::size_t size() const { return volumes * temperatures; }
  /// Returns ln V between the centres of neighbouring functions.
  [[nodiscard]] double volume_step() const;
  /// Returns u between the centres of neighbouring functions.
  [[nodiscard]] double temperature_step() const;
  /// Returns the centre of a function along ln V or along u, for indices from 0.
  [[nodiscard]] double volume_centre(std::size_t i) const;
  [[nodiscard]] double temperature_centre(std::size_t k) const;
};

/// Represents a smooth part of a free energy by a tensor product of quintic B-splines on uniform knots of ln V and
/// u = T/(T + T*), four times continuously differentiable (docs/theory/gray.md, section 11):
///   F(V, T) = sum_ik c_ik B(ln V/h - i) B(u/h_u - k).
/// Beyond the first and the last volume the coefficients continue as constants: the pressure has no correction there. For T -> infinity the corrections of entropy and heat capacity vanish with T^-2.
class FreeEnergySpline {
 public:
  static constexpr std::size_t least_temperatures = 6;  ///< one interval of u
  FreeEnergySpline() = default;
  /// @param coefficients  J/kg, the index of the temperature running fastest
  /// @throws InputError if the grid is not valid or the number of coefficients is not that of the grid
  FreeEnergySpline(const FreeEnergyGrid& grid, std::vector<double> coefficients);

  [[nodiscard]] const FreeEnergyGrid& grid() const { return grid_; }
  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }
  /// Evaluates the correction with its derivatives.
  [[nodiscard]] FreeEnergyTerms operator()(double V, double T) const;
  /// Adds to a row of coefficients the functional with the given weights at (V, T).
  static void add_functional(const FreeEnergyGrid& grid, double V, double T, const FreeEnergyTerms& weights,
                             std::span<double> row);

 private:
  FreeEnergyGrid grid_;
  std::vector<double> coefficients_;
};

}  // namespace whipple::eos
