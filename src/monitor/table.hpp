// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace whipple::monitor {

/// Follows a table of numbers that a run appends to (history.csv, gauges.csv): each look reads what is new. The table
/// may be shorter or another than before, when a run is continued; it is then read again.
class GrowingTable {
 public:
  explicit GrowingTable(std::filesystem::path file) : file_(std::move(file)) {}

  /// Reads the complete lines that were added. A missing file is an empty table.
  void look();

  /// Returns the heads of the columns as they are in the file: `name [unit]`.
  [[nodiscard]] const std::vector<std::string>& heads() const { return heads_; }
  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : columns_.front().size(); }
  [[nodiscard]] const std::vector<double>& column(std::size_t number) const { return columns_[number]; }

  /// Returns the rows that draw a column with about so many points: all of them, or of each of equal parts of the rows
  /// the first, the smallest, the largest and the last, so that no peak is lost. Increasing.
  [[nodiscard]] std::vector<std::size_t> rows_to_draw(std::size_t column, std::size_t points) const;

 private:
  void clear();
  void add(const std::string& line);

  std::filesystem::path file_;
  std::uintmax_t read_ = 0;             // bytes
  std::string first_line_, last_line_;  // complete ones as read, to notice another table
  std::uintmax_t last_begins_ = 0;      // bytes before the last line
  std::string unfinished_;              // line
  std::vector<std::string> heads_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace whipple::monitor
