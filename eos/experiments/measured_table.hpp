// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Reading of measured compression curves and their comparison with equations of state (docs/theory/fit.md,
/// section 6).
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
};

/// A text table of measurements, as people and programs write them (docs/manual/equations_of_state.md,
/// "Measured data"). Cells are separated by semicolons, tabs, commas or blanks, whichever of them the line of
/// headings holds first in this order; blanks around cells, quotes, a byte order mark, CRLF, empty lines and
/// comments (#, %) are taken off. A heading names a quantity and its unit: "up [km/s]", "up (km/s)",
/// "up_km_s"; or the line below the headings holds the units.
class MeasuredTable {
 public:
  /// @throws InputError with file and line: no rows, a row of another length, a unit of the wrong kind
  static MeasuredTable read(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] int line(std::size_t row) const { return lines_[row]; }
  /// The headings as they are, separated by ", ".
  [[nodiscard]] std::string headings() const;

  /// Column of a quantity. Of several, that of the best spelling: a revised pressure scale before another.
  [[nodiscard]] std::optional<std::size_t> find(Quantity quantity) const;
  /// The quantity that a heading names, such as "us_km_s" or "P [GPa]"; none where it is no `Quantity`.
  static std::optional<Quantity> quantity_of(const std::string& heading);
  /// Column of this very heading.
  [[nodiscard]] std::optional<std::size_t> find_heading(std::string_view heading) const;

  /// Numbers in SI; NaN where the cell is empty or says so.
  /// @throws InputError if the heading gives no unit to a quantity that has one, or a cell is no number
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
  /// The numbers of a quantity; empty without such a column.
  [[nodiscard]] std::vector<double> numbers(Quantity quantity) const;
  /// One standard deviation of a quantity in every row, SI: a column "us_err", "sigma_us", "dus" or "us_unc" in a unit
  /// of the quantity or in "%" of it; empty without such a column. Of several that of the same word as the quantity's.
  [[nodiscard]] std::vector<double> errors(Quantity quantity) const;
  /// Headings of errors that `errors` gives of no quantity: not known here, or of a column that is not there, is no
  /// quantity, or is not the one that `find` takes.
  [[nodiscard]] std::vector<std::string> unused_errors() const;
  [[nodiscard]] std::vector<std::string> texts(std::size_t column) const;

 private:
  struct Column {
    std::string heading;
    std::optional<Quantity> quantity;
    std::size_t spelling = 0;  ///< place among its spellings, the best first
    bool is_error = false;     ///< the standard deviation of the quantity
    std::optional<std::string> unit;
    std::string word{};                ///< that names the quantity, known or not, bare: "us" of "us_err_km_s"
    std::vector<Quantity> could_be{};  ///< quantities of this word and unit, the best first
  };
  [[nodiscard]] Column understand(const std::string& heading, int line) const;
  /// Takes a row that only names units into the headings.
  bool take_units(const std::vector<std::string>& cells);
  /// Gives errors of a word that names several quantities to the one that the table has: V may be of atoms. Those of a
  /// column that is no quantity, such as a diameter D, stay with it.
  void assign_errors();
  /// Column of the errors of a quantity.
  [[nodiscard]] std::optional<std::size_t> find_errors(Quantity quantity) const;

  std::filesystem::path file_;
  std::vector<std::string> comments_;
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;
};

}  // namespace whipple::eos::experiments
