// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Holds columns of a table that a run writes (history.csv, gauges.csv), or that lies beside a case: a header
/// "name [unit]", lines that begin with # apart. Empty cells are NaN.
class RunTable {
 public:
  /// Whether the last row counts if the end of its line is missing: in a table that a run is writing it does not.
  enum class Row : std::uint8_t { complete, may_be_unfinished };

  /// Reads a table; without columns if the file is missing.
  /// @throws InputError naming the file and the line of what is no number, or of too few or too many cells
  explicit RunTable(const std::filesystem::path& file, Row last = Row::may_be_unfinished);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Returns the values of a column; empty if there is none.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view name) const;
  [[nodiscard]] const Column* find(std::string_view name) const;

 private:
  std::filesystem::path file_;
  std::vector<Column> columns_;
};

/// Returns the value at x of the polygon through points, x ascending, on the first edge that contains it; NaN beyond
/// its ends.
double on_polygon(double x, const std::vector<double>& xs, const std::vector<double>& ys);

/// Returns the value at x, linear between points with ascending x, and that of the first or last point beyond them.
double value_at(double x, const std::vector<double>& xs, const std::vector<double>& ys);

}  // namespace whipple::analysis
