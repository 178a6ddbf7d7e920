// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/table/layout.hpp"
#include "src/core/base/simd.hpp"

/// A complete equation of state as a table of its entropy (docs/theory/equations_of_state.md, section
/// "Tables"). One piecewise polynomial s(ln rho, z), z = ln(e - e_0(rho)), gives everything else,
///   1/T = (ds/de)_V,  p = T (ds/dV)_e,  c^2 = (dp/drho)_s,
/// so that the thermodynamic identities hold at every resolution. The edges of the phases are coordinate
/// lines: the second derivatives of s jump there, and no polynomial crosses them.
namespace whipple::eos {

/// Everything of a table that is stored; plain data. Each strip of densities holds up to eight regions above
/// one another, parted by the edges of the phases. A region has nx * ny cells, each a polynomial of degree
/// (5, 5) in its local coordinates.
struct TableData {
  static constexpr std::size_t greatest_regions = 8;
  static constexpr std::size_t cell_size = 36;  ///< coefficients; those of one power of x side by side

  struct Region {
    std::uint32_t first_cell = 0, nx = 1, ny = 1;
    std::uint32_t first_fraction = 0, fraction_nx = 1, fraction_ny = 1;  ///< cells of the phase fractions
    std::uint32_t phase = 0;                                             ///< index of its name
  };
  struct Strip {
    double begin = 0, end = 0;      ///< ln rho
    double inverse_length = 1;      ///< 1/(end - begin)
    double top = 0, top_slope = 0;  ///< greatest z, linear over ln rho
    std::uint32_t first_interval = 0, intervals = 1;
    std::uint32_t region_count = 1;
    std::array<Region, greatest_regions> regions;

    /// Groups of four curves: e_0 and the edges between the regions.
    [[nodiscard]] std::uint32_t blocks() const { return region_count > 4 ? 2 : 1; }
  };
  /// Quintic polynomials in the local coordinate of an interval of ln rho, for four curves at once: e_0 and
  /// the edges between the regions as values of z. A strip of more than four regions has two of them for each
  /// interval, one after the other. Edges that a strip does not have lie at infinity.
  using Interval = std::array<Lanes, 6>;

  std::vector<Strip> strips;  ///< in the order of the density, without gaps
  std::vector<Interval> intervals;
  std::vector<double> cells;
  /// Melted and vaporised mass fraction in units of 1/65535 at the corners of their cells, bilinear between.
  std::vector<std::array<std::uint16_t, 2>> fractions;
  std::vector<std::string> phases;

  double thermal_energy = 0;     ///< e - e_0 of the coldest state, J/kg, at every density
  double least_sound_speed = 0;  ///< m/s: what c is held at where c^2 is less (loops of metastable fluids)
  double least_temperature = 0, greatest_temperature = 0;  ///< K
  double reference_density = 0, reference_temperature = 0, reference_energy = 0;
  double requested_error = 0;
  double condensed = 1;   ///< 0: a gas, without a state of zero pressure
  std::string origin;     ///< the model
  std::string constants;  ///< its constants as TOML lines

  /// Bytes that an evaluation may touch.
  [[nodiscard]] std::size_t size() const;
};

/// The run-time face of a table.
///
/// Range: densities of the table; energies below that of the least temperature are computed there, counted,
/// and kept; energies above the top and densities outside are errors.
class Table final : public EquationOfState {
 public:
  static constexpr std::string_view name = "table";

  /// @throws InputError if the data contradict themselves
  explicit Table(TableData data);

  [[nodiscard]] const TableData& data() const { return data_; }
  [[nodiscard]] double minimum_density() const;

  [[nodiscard]] std::string_view model() const override { return name; }
  [[nodiscard]] double reference_density() const override { return data_.reference_density; }
  [[nodiscard]] double reference_temperature() const override { return data_.reference_temperature; }
  [[nodiscard]] double reference_energy() const override { return data_.reference_energy; }
  [[nodiscard]] bool condensed() const override { return data_.condensed != 0; }
  [[nodiscard]] double maximum_density() const override;
  [[nodiscard]] double minimum_energy(double density) const override;
  /// Greatest specific internal energy at a density (J/kg).
  [[nodiscard]] double maximum_energy(double density) const;
  [[nodiscard]] double least_temperature() const override { return data_.least_temperature; }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  /// Comments: a table has no constants but those of its model.
  [[nodiscard]] std::string constants() const override;

 private:
  [[nodiscard]] const TableData::Strip& strip(double x) const;
  /// e_0 at a density.
  /// @throws StateError outside the densities of the table
  [[nodiscard]] double base_energy(double density) const;

  TableData data_;
  table::Layout layout_;
};

}  // namespace whipple::eos
