// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::analysis {

void Table::append(const Quantities& row, const std::string& row_label) {
  const std::size_t before = rows();
  for (const Quantity& quantity : row) {
    auto column = std::ranges::find(columns, quantity.name, &Column::name);
    if (column == columns.end()) {
      columns.push_back({quantity.name, quantity.unit, quantity.meaning,
                         std::vector<double>(before, std::numeric_limits<double>::quiet_NaN())});
      column = columns.end() - 1;
    }
    column->values.push_back(quantity.value);
  }
  for (Column& column : columns) column.values.resize(before + 1, std::numeric_limits<double>::quiet_NaN());
  if (!label.empty()) labels.push_back(row_label);
}

const std::vector<double>& Table::operator[](const std::string& column) const {
  const auto found = std::ranges::find(columns, column, &Column::name);
  if (found == columns.end()) throw InternalError(fmt::format("table {} has no column {}", name, column));
  return found->values;
}

void write_csv(const Table& table, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / (table.name + ".csv");
  std::string text;
  std::vector<std::string> cells;
  if (!table.label.empty()) cells.push_back(table.label);
  for (const Column& column : table.columns) {
    cells.push_back(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
  }
  text += fmt::format("{}\n", fmt::join(cells, ","));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    cells.clear();
    if (!table.label.empty()) cells.push_back(table.labels[row]);
    for (const Column& column : table.columns) cells.push_back(fmt::format("{}", column.values[row]));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  write_text_atomically(path, text);
}

void write_hdf5(const Table& table, const hdf5::Group& parent) {
  const hdf5::Group group = parent.create_group(table.name, hdf5::Order::creation);
  group.set_attribute("meaning", std::string_view(table.meaning));
  if (!table.label.empty()) {
    group.set_attribute("label", std::string_view(table.label));
    group.set_attribute("labels", std::string_view(fmt::format("{}", fmt::join(table.labels, "\n"))));
  }
  for (const Column& column : table.columns) {
    const hdf5::Dataset data =
        group.write<double>(column.name, column.values, hdf5::Slab::whole(column.values.size()));
    data.set_attribute("unit", std::string_view(column.unit));
    data.set_attribute("meaning", std::string_view(column.meaning));
  }
}

}  // namespace whipple::analysis
