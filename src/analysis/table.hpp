// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "src/core/hdf5/hdf5.hpp"

namespace whipple::analysis {

/// Marks a quantity that could not be measured.
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Holds one measured number.
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

/// Holds numbers in columns, with or without row labels.
struct Table {
  std::string name;     ///< of the CSV file and of the HDF5 group
  std::string meaning;  ///< one sentence
  std::string label;    ///< meaning of the labels; empty: no labels
  std::vector<std::string> labels;
  std::vector<Column> columns;

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// Adds a row; columns missing from the row are filled with NaN.
  void append(const Quantities& row, const std::string& row_label = {});
  /// Returns the values of a column. @throws InternalError if there is none
  [[nodiscard]] const std::vector<double>& operator[](const std::string& column) const;
};

/// Writes FOLDER/NAME.csv: a header "name [unit]", numbers with the shortest text that converts back to the same
/// double.
/// @throws InputError if the file cannot be written
void write_csv(const Table& table, const std::filesystem::path& folder);

/// Writes a group NAME with one dataset per column; the labels are stored as attribute `labels`, one per line.
void write_hdf5(const Table& table, const hdf5::Group& parent);

}  // namespace whipple::analysis
