// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Reads measured compression curves and compares them with equations of state (docs/theory/fit.md, section 6).
namespace whipple::eos::experiments {

/// Names the quantity in a column of measurements; SI in memory.
enum class Quantity {
  shock_velocity,      ///< Us, m/s
  particle_velocity,   ///< up, m/s
  pressure,            ///< P, Pa
  specific_volume,     ///< V, m^3/kg
  atomic_volume,       ///< m^3 per atom
  density,             ///< rho, kg/m^3
  volume_ratio,        ///< V/V0
  temperature,         ///< T, K
  initial_density,     ///< rho0, kg/m^3
  porosity,            ///< density of the solid over the initial one
  hugoniot_intercept,  ///< C of a fit Us = C + S up + S2 up^2/Us + S3 up^3/Us^2, m/s
  hugoniot_slope,      ///< S
  hugoniot_quadratic,  ///< S2
  hugoniot_cubic,      ///< S3
  bulk_sound_speed,    ///< [(dP/drho)_S]^(1/2), m/s
  heat_capacity,       ///< at constant pressure, J/(kg K)
  linear_expansion,    ///< coefficient of linear thermal expansion, 1/K
};

/// Holds a text table of measurements in the formats commonly written by people and programs
/// (docs/manual/equations_of_state.md, "Measured data"). Cells are separated by semicolons, tabs, commas or blanks,
/// whichever occurs first in this order in the heading line; blanks around cells, quotes, a byte order mark, CRLF,
/// empty lines and comments (#, %) are removed. A heading names a quantity and its unit: "up [km/s]", "up (km/s)",
/// "up_km_s"; or the line below the headings contains the units.
class MeasuredTable {
 public:
  /// Reads a table. @throws InputError with file and line: no rows, a row of different length, a unit of the wrong kind
  static MeasuredTable read(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] int line(std::size_t row) const { return lines_[row]; }
  /// Returns the headings verbatim, separated by ", ".
  [[nodiscard]] std::string headings() const;

  /// Returns the column of a quantity; if there are several, that of the best spelling, e.g. a revised pressure scale.
  [[nodiscard]] std::optional<std::size_t> find(Quantity quantity) const;
  /// Returns the quantity named by a heading, such as "us_km_s" or "P [GPa]"; none if it is not a `Quantity`.
  static std::optional<Quantity> quantity_of(const std::string& heading);
  /// Returns the column with exactly this heading.
  [[nodiscard]] std::optional<std::size_t> find_heading(std::string_view heading) const;

  /// Returns the numbers of a column in SI; NaN where the cell is empty or "nan".
  /// @throws InputError if the heading gives no unit to a quantity that has one, or a cell is not a number
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
  /// Returns the numbers of a quantity; empty without such a column.
  [[nodiscard]] std::vector<double> numbers(Quantity quantity) const;
  /// Returns one standard deviation of a quantity in every row, SI, from a column "us_err", "sigma_us", "dus" or
  /// "us_unc" in a unit of the quantity or in "%" of it; empty without such a column. If there are several, the one
  /// with the same word as the quantity is used.
  [[nodiscard]] std::vector<double> errors(Quantity quantity) const;
  /// Returns the error headings not used by `errors`: unknown ones, or those of a column that is missing, is not a
  /// quantity, or is not the one returned by `find`.
  [[nodiscard]] std::vector<std::string> unused_errors() const;
  [[nodiscard]] std::vector<std::string> texts(std::size_t column) const;

 private:
  struct Column {
    std::string heading;
    std::optional<Quantity> quantity;
    std::size_t spelling = 0;  ///< index among its spellings, the best first
    bool is_error = false;     ///< the standard deviation of the quantity
    std::optional<std::string> unit;
    std::string word{};                ///< word naming the quantity, known or unknown: "us" of "us_err_km_s"
    std::vector<Quantity> could_be{};  ///< quantities compatible with this word and unit, the best first
  };
  [[nodiscard]] Column understand(const std::string& heading, int line) const;
  /// Merges a row that contains only units into the headings.
  bool take_units(const std::vector<std::string>& cells);
  /// Assigns errors with an ambiguous word to the quantity present in the table, e.g. V may be an atomic volume.
  /// Those of a column that is not a quantity, such as a diameter D, stay with that column.
  void assign_errors();
  /// Returns the column of the errors of a quantity.
  [[nodiscard]] std::optional<std::size_t> find_errors(Quantity quantity) const;

  std::filesystem::path file_;
  std::vector<std::string> comments_;
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;
};

}  // namespace whipple::eos::experiments
