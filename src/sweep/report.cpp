// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/core/base/csv.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/core/process/scripts.hpp"

namespace whipple::sweep {
namespace {

using Json = nlohmann::ordered_json;

std::vector<const Table*> tables_of(const Results& results) {
  std::vector<const Table*> all;
  for (const Table* table : {&results.points, &results.bands, &results.sensitivities, &results.limits})
    if (!table->columns.empty()) all.push_back(table);
  return all;
}

std::string csv_of(const Table& table) {
  std::vector<std::string> cells;
  for (const Column& column : table.columns)
    cells.push_back(
        csv_cell(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit)));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    cells.clear();
    for (const Column& column : table.columns)
      cells.push_back(column.words.empty() ? fmt::format("{}", column.numbers[row])
                                           : csv_cell(column.words[row]));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

/// Writes a group with a data set per column of numbers; a column of words is an attribute, one word per line.
void write_hdf5(const Table& table, const hdf5::Group& parent) {
  const hdf5::Group group = parent.create_group(table.name, hdf5::Order::creation);
  group.set_attribute("meaning", std::string_view(table.meaning));
  for (const Column& column : table.columns) {
    if (!column.words.empty()) {
      std::string lines;
      for (std::string word : column.words) {
        std::ranges::replace(word, '\n', ' ');
        lines += (lines.empty() ? "" : "\n") + word;
      }
      group.set_attribute(column.name, std::string_view(lines));
      continue;
    }
    const hdf5::Dataset data =
        group.write<double>(column.name, column.numbers, hdf5::Slab::whole(column.numbers.size()));
    data.set_attribute("unit", std::string_view(column.unit));
    data.set_attribute("meaning", std::string_view(column.meaning));
  }
}

Json json_of(const Table& table) {
  Json units = Json::object(), rows = Json::array();
  for (const Column& column : table.columns)
    if (column.words.empty()) units[column.name] = column.unit;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Json cells = Json::object();
    for (const Column& column : table.columns) {
      if (!column.words.empty()) {
        cells[column.name] = column.words[row];
      } else {
        cells[column.name] = std::isfinite(column.numbers[row]) ? Json(column.numbers[row]) : Json(nullptr);
      }
    }
    rows.push_back(std::move(cells));
  }
  return {{"units", units}, {"rows", rows}};
}

}  // namespace

std::string as_json(const Results& results) {
  Json json = Json::object();
  Json variables = Json::array();
  for (const Variable& variable : results.variables)
    variables.push_back({{"name", variable.name},
                         {"unit", variable.unit},
                         {"is_number", variable.is_number},
                         {"is_sampled", variable.is_sampled}});
  json["variables"] = variables;
  json["quantities"] = results.quantities;
  for (const Table* table : tables_of(results)) json[table->name] = json_of(*table);
  return json_text(json, 1) + "\n";
}

void write_tables(const Results& results, const std::filesystem::path& folder) {
  for (const Table* table : tables_of(results))
    write_text_atomically(folder / (table->name + ".csv"), csv_of(*table));
  PartialFile partial(folder / "study.h5");
  hdf5::File file = hdf5::File::create(partial.path(), hdf5::File::Compatibility::compact);
  file.root.set_attribute("format", std::string_view("whipple-study"));
  file.root.set_attribute("version", std::int64_t{1});
  for (const Table* table : tables_of(results)) write_hdf5(*table, file.root);
  file.close();
  partial.publish();
  write_text_atomically(folder / "study.json", as_json(results));
}

void draw_figures(const std::filesystem::path& folder) {
  make_folder(folder / "figures");
  process::draw_with("scripts/plot_sweep.py",
                     {(folder / "study.json").string(), (folder / "figures").string()});
}

std::string summary(const Results& results) {
  const auto words_of = [](const Table& table, const std::string& name) -> const std::vector<std::string>& {
    return std::ranges::find(table.columns, name, &Column::name)->words;
  };
  std::string text;
  const std::vector<std::string>& states = words_of(results.points, "state");
  for (std::size_t row = 0; row < states.size(); ++row) {
    if (states[row] == word_of(State::done)) continue;
    const std::string& message = words_of(results.points, "message")[row];
    text += fmt::format("{} {}{}\n", words_of(results.points, "point")[row], states[row],
                        message.empty() ? "" : ": " + message.substr(0, message.find('\n')));
  }
  const Table& limits = results.limits;
  for (std::size_t row = 0; row < limits.rows(); ++row) {
    const std::size_t others = limits.columns.size() - 3;
    std::string group;
    for (std::size_t c = 0; c < others; ++c) {
      const Column& column = limits.columns[c];
      group += fmt::format(
          "{} = {}, ", column.name,
          column.words.empty() ? fmt::format("{} {}", column.numbers[row], column.unit) : column.words[row]);
    }
    const Column& lower = limits.columns[others];
    const Column& upper = limits.columns[others + 1];
    text += std::isfinite(lower.numbers[row])
                ? fmt::format("{}limit between {} and {} {}\n", group, lower.numbers[row], upper.numbers[row],
                              lower.unit)
                : fmt::format("{}no limit: {}\n", group, limits.columns[others + 2].words[row]);
  }
  return text;
}

}  // namespace whipple::sweep
