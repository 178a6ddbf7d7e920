// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace whipple::monitor {

/// Follows a table of numbers to which a run appends rows (history.csv, gauges.csv): each call of `look` reads the new
/// rows. A continued run may have shortened or replaced the table; it is then read from the beginning.
class GrowingTable {
 public:
  explicit GrowingTable(std::filesystem::path file) : file_(std::move(file)) {}

  /// Reads the complete lines that were added. A missing file is an empty table.
  void look();

  /// Returns the column headers as in the file: `name [unit]`.
  [[nodiscard]] const std::vector<std::string>& heads() const { return heads_; }
  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_.front().size(); }
  [[nodiscard]] const std::vector<double>& column(std::size_t number) const { return columns_[number]; }

  /// Returns the rows for plotting a column with about the given number of points: all rows, or the first, minimum,
  /// maximum and last of each of equal parts of the rows, so that no peak is lost. In increasing order.
  [[nodiscard]] std::vector<std::size_t> rows_to_draw(std::size_t column, std::size_t points) const;

 private:
  void clear();
  void add(const std::string& line);

  std::filesystem::path file_;
  std::uintmax_t read_ = 0;             // bytes
  std::string first_line_, last_line_;  // complete lines as read, to detect another table
  std::uintmax_t last_begins_ = 0;      // bytes before the last line
  std::string unfinished_;              // incomplete line
  std::vector<std::string> heads_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace whipple::monitor
