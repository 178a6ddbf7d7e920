// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/run_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::analysis {

RunTable::RunTable(const std::filesystem::path& file, Row last) : file_(file) {
  if (!std::filesystem::is_regular_file(file)) return;
  std::istringstream lines(read_text(file));
  std::string line;
  std::size_t number = 0;
  while (std::getline(lines, line)) {
    ++number;
    const bool unfinished = lines.eof();  // without the end of its line
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> cells = csv_cells(line);
    if (columns_.empty()) {
      for (const std::string& head : cells) {
        const std::size_t begin = head.find(" [");
        const bool has_unit = begin != std::string::npos && head.ends_with(']');
        columns_.push_back({head.substr(0, begin),
                            has_unit ? head.substr(begin + 2, head.size() - begin - 3) : std::string{},
                            {},
                            {}});
      }
      continue;
    }
    if (unfinished && last == Row::may_be_unfinished) break;
    if (cells.size() != columns_.size()) {
      throw InputError(fmt::format("{}:{}: error: {} cells under {} names", file.string(), number,
                                   cells.size(), columns_.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double value = nan;
      std::string_view cell = cells[i];
      while (cell.starts_with(' ')) cell.remove_prefix(1);
      while (cell.ends_with(' ')) cell.remove_suffix(1);
      if (cell.starts_with('+')) cell.remove_prefix(1);
      const auto [read_to, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (!cell.empty() && (fault != std::errc() || read_to != cell.data() + cell.size())) {
        throw InputError(fmt::format("{}:{}: error: {} is \"{}\", expected a number", file.string(), number,
                                     columns_[i].name, cells[i]));
      }
      columns_[i].values.push_back(value);
    }
  }
}

const Column* RunTable::find(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name, &Column::name);
  return found == columns_.end() ? nullptr : &*found;
}

const std::vector<double>& RunTable::operator[](std::string_view name) const {
  static const std::vector<double> none;
  const Column* const found = find(name);
  return found == nullptr ? none : found->values;
}

double on_polygon(double x, const std::vector<double>& xs, const std::vector<double>& ys) {
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    const double a = xs[i], b = xs[i + 1];
    if (a <= x && x <= b) return b > a ? ys[i] + (ys[i + 1] - ys[i]) * (x - a) / (b - a) : ys[i];
  }
  return nan;
}

double value_at(double x, const std::vector<double>& xs, const std::vector<double>& ys) {
  if (xs.empty()) return nan;
  if (x <= xs.front()) return ys.front();
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(xs, x) - xs.begin());
  if (after == xs.size()) return ys.back();
  const double a = xs[after - 1], b = xs[after];
  return b > a ? ys[after - 1] + (ys[after] - ys[after - 1]) * (x - a) / (b - a) : ys[after];
}

}  // namespace whipple::analysis
