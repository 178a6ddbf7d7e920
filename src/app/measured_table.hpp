// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whipple::app {

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

  /// Column of a quantity: us, up, P, V, atomic_volume, rho, V_over_V0, T, rho0 (initial density), m
  /// (porosity), C, S, S2, S3. Of several, that of the best spelling: a revised pressure scale before
  /// another.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view quantity) const;
  /// The quantity that a heading names; empty: none of those.
  static std::string quantity_of(const std::string& heading);
  /// Column of this very heading.
  [[nodiscard]] std::optional<std::size_t> find_heading(std::string_view heading) const;

  /// Numbers in SI; NaN where the cell is empty or says so.
  /// @throws InputError if the heading gives no unit to a quantity that has one, or a cell is no number
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
  /// The numbers of a quantity; empty without such a column.
  [[nodiscard]] std::vector<double> numbers(std::string_view quantity) const;
  [[nodiscard]] std::vector<std::string> texts(std::size_t column) const;

 private:
  struct Column {
    std::string heading;
    std::string quantity;      ///< empty: none of those above
    std::size_t spelling = 0;  ///< place among its spellings, the best first
    std::optional<std::string> unit;
  };
  [[nodiscard]] Column understand(const std::string& heading, int line) const;
  /// Takes a row that only names units into the headings.
  bool take_units(const std::vector<std::string>& cells);

  std::filesystem::path file_;
  std::vector<std::string> comments_;
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> lines_;
};

}  // namespace whipple::app
