// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/table/sesame_data.hpp"

namespace whipple::eos {

/// Implements table 301 of a SESAME material as a model (docs/theory/equations_of_state.md, section "SESAME tables"): e
/// and p are piecewise cubic in the density and linear in the temperature, so that p is linear in e on an isochore. The
/// energy increases with temperature at every density, including those between the densities of the table. Pressure and
/// energy are interpolated separately: they are as consistent as the table and its resolution.
///
/// Range: densities and temperatures of the table. Where c^2 < `least_sound_speed_ratio`^2 of the reference state
/// (van der Waals loop, tension), c is limited to that value; energies below that of the lowest temperature are
/// evaluated there, counted, and kept; energies above the table and densities outside are errors. The entropy is
/// derived from the Helmholtz energies if the table has them, and otherwise unknown. No phases.
class Sesame final : public EquationOfState {
 public:
  static constexpr std::string_view name = "sesame";
  static constexpr double least_sound_speed_ratio = 0.01;

  /// Constructs the model. Energies of a few steps that do not increase with temperature are raised, with a warning
  /// that states their number.
  /// @param reference_temperature K; defines the reference state, with the reference density of table 201
  /// @param origin name of the table in messages, usually its file
  /// @throws InputError naming origin, density and temperatures if more than a hundredth of the steps do not
  /// increase, or one must be raised by more than the heat of 2 % of its temperature, or if the reference state is
  /// outside the table
  Sesame(const SesameMaterial& material, double reference_temperature, std::string origin);

  [[nodiscard]] double minimum_density() const { return density_.front(); }
  /// Returns the maximum specific internal energy at a density (J/kg).
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
  /// Returns comments only: a table has no constants.
  [[nodiscard]] std::string constants() const override;

 private:
  /// Holds a quantity at a grid point and its slope along the density.
  struct Node {
    double value = 0, slope = 0;
  };
  /// Locates a density: its two isochores and the weights of their nodes.
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
  /// Returns the row of temperatures that contains an energy; the first or last if it is outside.
  [[nodiscard]] std::size_t row(const Cell& cell, double energy) const;
  /// Evaluates at the fraction `share` of the interval from one row to the next.
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
