// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/table/layout.hpp"
#include "eos/table/point.hpp"
#include "src/core/base/registers.hpp"

/// Represents a complete equation of state by a table of its entropy (docs/theory/equations_of_state.md, section
/// "Tables"). One piecewise polynomial s(ln rho, z), z = ln(e - e_0(rho)), gives all other quantities,
///   1/T = (ds/de)_V,  p = T (ds/dV)_e,  c^2 = (dp/drho)_s,
/// so that the thermodynamic identities hold at every resolution. The edges of the phases are coordinate lines,
/// since the second derivatives of s jump there; no polynomial crosses them.
namespace whipple::eos {

/// Holds all stored data of a table. Each strip of densities has up to eight stacked regions, separated by the
/// edges of the phases. A region has nx * ny cells, each a polynomial of degree (5, 5) in its local coordinates.
struct TableData {
  static constexpr std::size_t greatest_regions = 8;
  static constexpr std::size_t cell_size = 36;  ///< coefficients; those of one power of x are contiguous

  struct Region {
    std::uint32_t first_cell = 0, nx = 1, ny = 1;
    std::uint32_t first_fraction = 0, fraction_nx = 1, fraction_ny = 1;  ///< cells of the phase fractions
    std::uint32_t phase = 0;                                             ///< index of the phase name
  };
  struct Strip {
    double begin = 0, end = 0;      ///< ln rho
    double inverse_length = 1;      ///< 1/(end - begin)
    double top = 0, top_slope = 0;  ///< maximum z, linear over ln rho
    std::uint32_t first_interval = 0, intervals = 1;
    std::uint32_t region_count = 1;
    std::array<Region, greatest_regions> regions;

    /// Returns the number of groups of four curves: e_0 and the edges between the regions.
    [[nodiscard]] std::uint32_t blocks() const { return region_count > 4 ? 2 : 1; }
  };
  /// Quintic polynomials in the local coordinate of an interval of ln rho, for four curves at once: e_0 and the
  /// edges between the regions as values of z. A strip of more than four regions has two consecutive entries for
  /// each interval. Edges that a strip does not have are at infinity.
  using Interval = std::array<Lanes, 6>;

  std::vector<Strip> strips;  ///< in the order of the density, without gaps
  std::vector<Interval> intervals;
  std::vector<double> cells;
  /// Melted and vaporised mass fraction in units of 1/65535 at the corners of their cells, with bilinear interpolation.
  std::vector<std::array<std::uint16_t, 2>> fractions;
  std::vector<std::string> phases;

  double thermal_energy = 0;     ///< e - e_0 of the coldest state, J/kg, at every density
  double least_sound_speed = 0;  ///< m/s: lower limit of c (loops of metastable fluids)
  double least_temperature = 0, greatest_temperature = 0;  ///< K
  double reference_density = 0, reference_temperature = 0, reference_energy = 0;
  double requested_error = 0;
  double condensed = 1;   ///< 0: a gas, without a zero-pressure state
  std::string origin;     ///< name of the model
  std::string constants;  ///< constants of the model as TOML lines

  /// Returns the number of bytes that an evaluation may access.
  [[nodiscard]] std::size_t size() const;
};

/// Adapts a table to the run-time interface.
///
/// Range: densities of the table; energies below that of the lowest temperature are evaluated there, counted, and
/// kept; energies above the top and densities outside are errors.
class Table final : public EquationOfState {
 public:
  static constexpr std::string_view name = "table";

  /// @throws InputError if the data contradict themselves
  explicit Table(TableData data);

  [[nodiscard]] const TableData& data() const { return data_; }
  /// Returns the constants of an evaluation point by point, whose numbers are appended to an array.
  [[nodiscard]] table::Point point(std::vector<double>& numbers) const;
  [[nodiscard]] double minimum_density() const;

  [[nodiscard]] std::string_view model() const override { return name; }
  [[nodiscard]] double reference_density() const override { return data_.reference_density; }
  [[nodiscard]] double reference_temperature() const override { return data_.reference_temperature; }
  [[nodiscard]] double reference_energy() const override { return data_.reference_energy; }
  [[nodiscard]] bool condensed() const override { return data_.condensed != 0; }
  [[nodiscard]] double maximum_density() const override;
  [[nodiscard]] double minimum_energy(double density) const override;
  /// Returns the maximum specific internal energy at a density (J/kg).
  [[nodiscard]] double maximum_energy(double density) const;
  [[nodiscard]] double least_temperature() const override { return data_.least_temperature; }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  /// Returns comments only: a table has no constants except those of its model.
  [[nodiscard]] std::string constants() const override;

 private:
  [[nodiscard]] const TableData::Strip& strip(double x) const;
  /// Returns e_0 at a density.
  /// @throws StateError outside the density range of the table
  [[nodiscard]] double base_energy(double density) const;

  TableData data_;
  table::Layout layout_;
};

}  // namespace whipple::eos
