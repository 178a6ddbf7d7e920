// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace whipple::io {

/// One entry of a row: "name [unit]" is the column; no unit, no brackets.
struct HistoryValue {
  std::string name;
  std::string unit;
  double value = 0.0;
};

/// A table in time (history.csv, gauges.csv): the header holds names and SI units, numbers are the shortest
/// text that reads back to the same double, and every row is handed to the system at once. One process writes
/// it.
class History {
 public:
  /// Begins a new table, replacing a file of that name at the first row.
  explicit History(std::filesystem::path path);

  /// Goes on with a table: keeps the rows whose column `step` is at most `last_step` and drops the others
  /// together with an incomplete last line, so that the file becomes bitwise that of an undisturbed run. A
  /// missing file is an empty table.
  /// @throws InputError if the file has no column "step" or a damaged row
  static History restart(std::filesystem::path path, std::int64_t last_step);

  /// Rows of the file.
  [[nodiscard]] std::int64_t rows() const { return rows_; }

  /// A power failure after this leaves all rows so far. @throws InputError naming the file
  void force_to_disk() const;

  /// Appends a row. The first row of the object decides, or after a restart must match, the columns.
  /// @throws InputError   if the file cannot be written or a restarted table has other columns
  /// @throws InternalError if the columns changed between two rows
  void append(std::span<const HistoryValue> row);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::int64_t rows_ = 0;
  std::string header_;      ///< of the file; empty before the first row
  bool continued_ = false;  ///< the header was read, not written
};

}  // namespace whipple::io
