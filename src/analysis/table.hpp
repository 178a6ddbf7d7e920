// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "src/core/hdf5/hdf5.hpp"

namespace whipple::analysis {

/// Marks a quantity that is not there to be measured.
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One measured number.
struct Quantity {
  std::string name;
  std::string unit;
  std::string meaning;
  double value = 0.0;
  std::string reason = {};  ///< why the value is NaN
};
using Quantities = std::vector<Quantity>;

struct Column {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<double> values;
};

/// Numbers in columns, with labels of the rows or without.
struct Table {
  std::string name;     ///< of the CSV file and of the HDF5 group
  std::string meaning;  ///< one sentence
  std::string label;    ///< what the labels are; empty: the rows have none
  std::vector<std::string> labels;
  std::vector<Column> columns;

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// Adds a row; columns that a row lacks hold NaN there.
  void append(const Quantities& row, const std::string& row_label = {});
  /// Values of a column. @throws InternalError if there is none
  [[nodiscard]] const std::vector<double>& operator[](const std::string& column) const;
};

/// FOLDER/NAME.csv: a header "name [unit]", numbers with the shortest text that reads back to the same
/// double.
/// @throws InputError if the file cannot be written
void write_csv(const Table& table, const std::filesystem::path& folder);

/// A group NAME with one data set per column; labels as attribute `labels`, one a line.
void write_hdf5(const Table& table, const hdf5::Group& parent);

}  // namespace whipple::analysis
