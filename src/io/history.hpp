// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace whipple::io {

/// Holds one entry of a row. The column is called "name [unit]"; without a unit there are no brackets.
struct HistoryValue {
  std::string name;
  std::string unit;
  double value = 0.0;
};

/// Writes a table in time (history.csv, gauges.csv). The header contains names and SI units, numbers are the shortest
/// text that restores the same double, and every row is passed to the system immediately. Used by one process.
class History {
 public:
  /// Starts a new table, replacing a file of that name at the first row.
  explicit History(std::filesystem::path path);

  /// Continues a table: keeps the rows whose column `step` is at most `last_step` and removes the others together with
  /// an incomplete last line, so that the file becomes bitwise that of an uninterrupted run. A missing file is an empty
  /// table.
  /// @param row  any row of the run that continues, for its columns
  /// @throws InputError if the file has no column "step", other columns than the row, or a damaged row; it is then as
  /// it was
  static History restart(std::filesystem::path path, std::int64_t last_step,
                         std::span<const HistoryValue> row);

  /// Returns the number of rows in the file.
  [[nodiscard]] std::int64_t rows() const { return rows_; }

  /// Forces all rows so far to disk, so that they survive a power failure.
  /// @throws InputError naming the file
  void force_to_disk() const;

  /// Appends a row. The first row of the object defines the columns, unless the table was continued.
  /// @throws InputError   if the file cannot be written
  /// @throws InternalError if the columns changed between two rows
  void append(std::span<const HistoryValue> row);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::int64_t rows_ = 0;
  std::string header_;  ///< of the file; empty before the first row
};

}  // namespace whipple::io
