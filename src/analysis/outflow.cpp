// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/outflow.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/files.hpp"

namespace whipple::analysis {
namespace {

double number(const std::vector<std::string>& cells, std::size_t column) {
  double value = 0.0;
  if (column < cells.size()) {
    std::from_chars(cells[column].data(), cells[column].data() + cells[column].size(), value);
  }
  return value;
}

}  // namespace

OutflowHistory::OutflowHistory(const Run& run) {
  const std::filesystem::path path = run.folder / "history.csv";
  std::istringstream file(std::filesystem::exists(path) ? read_text(path) : std::string());
  std::string line;
  if (!std::getline(file, line)) return;
  std::map<std::string, std::size_t, std::less<>> columns;
  for (std::size_t c = 0; const std::string& head : csv_cells(line)) {
    columns.emplace(head.substr(0, head.find(" [")), c++);
  }
  std::vector<std::array<std::size_t, 4>> of_body;
  for (const BodyInput& body : run.bodies) {
    std::array<std::size_t, 4> found{};
    for (std::size_t k = 0; const char* name : {"mass", "momentum_x", "momentum_y", "momentum_z"}) {
      const auto column = columns.find("outflow_" + std::string(name) + "." + body.name);
      if (column == columns.end()) return;
      found[k++] = column->second;
    }
    of_body.push_back(found);
  }
  const auto time = columns.find("time");
  if (time == columns.end()) return;
  double lost = 0.0;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    Row row{.time = number(cells, time->second), .bodies = {}};
    double all = 0.0;
    for (const auto& [m, x, y, z] : of_body) {
      row.bodies.push_back({number(cells, m), {number(cells, x), number(cells, y), number(cells, z)}});
      row.bodies.back().momentum -= row.bodies.back().mass * run.frame_velocity;
      all += row.bodies.back().mass;
    }
    if (all > lost) rows_.push_back(std::move(row));
    lost = all;
  }
}

Outflow OutflowHistory::at(std::size_t body, double time) const {
  const auto after = std::ranges::upper_bound(rows_, time, {}, &Row::time);
  return after == rows_.begin() ? Outflow{} : std::prev(after)->bodies[body];
}

}  // namespace whipple::analysis
