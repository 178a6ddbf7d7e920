// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/table/sesame_data.hpp"

namespace whipple::eos {

/// Table 301 of a SESAME material as a model (docs/theory/equations_of_state.md, section "SESAME tables"):
/// e and p piecewise cubic in the density, linear in the temperature, so that p is linear in e on an
/// isochore. The energy rises with the temperature at every density, between the densities of the table too.
/// Pressure and energy are interpolated apart: consistent as far as table and resolution are.
///
/// Range: densities and temperatures of the table. Where c^2 < `least_sound_speed_ratio`^2 of the reference
/// state's (van der Waals loop, tension), c is held at that; energies below that of the least temperature are
/// computed there, counted, and kept; energies above the table and densities outside are errors. Entropy from
/// the Helmholtz energies if the table has them, else unknown. No phases.
class Sesame final : public EquationOfState {
 public:
  static constexpr std::string_view name = "sesame";
  static constexpr double least_sound_speed_ratio = 0.01;

  /// @param reference_temperature K; with the reference density of table 201 the reference state
  /// @param origin what messages call the table, usually its file
  /// Energies of a few steps that do not rise with the temperature are raised, with a warning that counts them.
  /// @throws InputError naming origin, density and temperatures if more than a hundredth of the steps do not rise, or
  /// one needs a raise of more than the heat of 2 % of its temperature, or if the reference state lies outside
  Sesame(const SesameMaterial& material, double reference_temperature, std::string origin);

  [[nodiscard]] double minimum_density() const { return density_.front(); }
  /// Greatest specific internal energy at a density (J/kg).
  [[nodiscard]] double maximum_energy(double density) const;

  [[nodiscard]] std::string_view model() const override { return name; }
  [[nodiscard]] double relative_cost() const override { return 2.5; }
  [[nodiscard]] double reference_density() const override { return reference_density_; }
  [[nodiscard]] double reference_temperature() const override { return reference_temperature_; }
  [[nodiscard]] double reference_energy() const override { return reference_energy_; }
  [[nodiscard]] bool condensed() const override { return condensed_; }
  [[nodiscard]] double maximum_density() const override { return density_.back(); }
  [[nodiscard]] double minimum_energy(double density) const override;
  [[nodiscard]] double least_temperature() const override { return temperature_.front(); }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  /// Comments: a table has no constants.
  [[nodiscard]] std::string constants() const override;

 private:
  /// A quantity at a point of the grid and its slope along the density.
  struct Node {
    double value = 0, slope = 0;
  };
  /// Where a density lies: its two isochores and the weights of their nodes.
  struct Cell {
    const Node *e0, *e1, *p0, *p1;
    std::size_t index;
    double value0, slope0, value1, slope1;              ///< weights of the Hermite cubic
    double by_value0, by_slope0, by_value1, by_slope1;  ///< of its derivative
  };
  struct Result {
    double pressure, temperature, squared_sound_speed;
    double heat_capacity, pressure_by_temperature, pressure_by_density;
  };

  [[nodiscard]] bool inside(double density) const {
    return density > 0 && density >= density_.front() && density <= density_.back();
  }
  [[nodiscard]] Cell cell(double density) const;
  [[nodiscard]] Cell checked_cell(double density) const;
  [[nodiscard]] static double value(const Cell& cell, const Node* at0, const Node* at1, std::size_t row) {
    return cell.value0 * at0[row].value + cell.slope0 * at0[row].slope + cell.value1 * at1[row].value +
           cell.slope1 * at1[row].slope;
  }
  [[nodiscard]] static double energy(const Cell& cell, std::size_t row) {
    return value(cell, cell.e0, cell.e1, row);
  }
  /// Row of temperatures that holds an energy; the first or last if it lies outside.
  [[nodiscard]] std::size_t row(const Cell& cell, double energy) const;
  /// At the fraction of the way from one row to the next.
  [[nodiscard]] Result result(const Cell& cell, double density, std::size_t row, double share) const;
  [[nodiscard]] State full(const Cell& cell, double density, double energy, std::size_t row,
                           double share) const;
  [[nodiscard]] double entropy(const Cell& cell, std::size_t row, double temperature) const;

  std::string origin_;
  int number_;
  std::string comment_;
  std::vector<double> density_, temperature_;
  std::vector<Node> energies_, pressures_, entropies_;  ///< isochore by isochore; entropies may be empty
  double reference_density_, reference_temperature_, reference_energy_ = 0;
  double least_squared_sound_speed_ = 0;
  bool condensed_ = true;
};

}  // namespace whipple::eos
