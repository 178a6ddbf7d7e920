// SPDX-License-Identifier: BSD-3-Clause
#include "src/monitor/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <system_error>

#include "src/core/base/csv.hpp"

namespace whipple::monitor {
namespace {

/// Returns the number in a cell; NaN if it contains none.
double number_of(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace

void GrowingTable::clear() {
  read_ = 0;
  first_line_.clear();
  last_line_.clear();
  last_begins_ = 0;
  unfinished_.clear();
  heads_.clear();
  columns_.clear();
}

void GrowingTable::add(const std::string& line) {
  const std::vector<std::string> cells = csv_cells(line);
  if (heads_.empty()) {
    first_line_ = line;
    heads_ = cells;
    columns_.resize(heads_.size());
    return;
  }
  if (cells.size() != heads_.size()) return;  // a line that is being rewritten
  for (std::size_t c = 0; c < cells.size(); ++c) columns_[c].push_back(number_of(cells[c]));
}

void GrowingTable::look() {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(file_, missing);
  if (missing) return clear();
  std::ifstream in(file_, std::ios::binary);
  if (!in) return clear();
  if (!first_line_.empty()) {
    // A run that resumed from an earlier state, or started again, may have replaced the rows that were read.
    std::string first, last;
    std::getline(in, first);
    in.seekg(static_cast<std::streamoff>(last_begins_));
    std::getline(in, last);
    if (size < read_ || first != first_line_ || last != last_line_) clear();
  }
  if (size == read_) return;
  in.clear();
  in.seekg(static_cast<std::streamoff>(read_));
  std::string more(static_cast<std::size_t>(size - read_), '\0');
  in.read(more.data(), static_cast<std::streamsize>(more.size()));
  more.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  const std::uintmax_t unfinished_begins = read_ - unfinished_.size();
  read_ += more.size();
  unfinished_ += more;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = unfinished_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    last_line_ = unfinished_.substr(begin, end - begin);
    last_begins_ = unfinished_begins + begin;
    add(last_line_);
  }
  unfinished_.erase(0, begin);
}

std::vector<std::size_t> GrowingTable::rows_to_draw(std::size_t column, std::size_t points) const {
  const std::vector<double>& values = columns_[column];
  std::vector<std::size_t> drawn;
  constexpr std::size_t of_part = 4;
  const std::size_t parts = std::max<std::size_t>(points / of_part, 1);
  if (values.size() <= of_part * parts) {
    for (std::size_t row = 0; row < values.size(); ++row) drawn.push_back(row);
    return drawn;
  }
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t first = part * values.size() / parts, last = (part + 1) * values.size() / parts - 1;
    std::size_t smallest = first, largest = first;  // ignoring NaN
    for (std::size_t row = first; row <= last; ++row) {
      if (values[row] < values[smallest] || std::isnan(values[smallest])) smallest = row;
      if (values[row] > values[largest] || std::isnan(values[largest])) largest = row;
    }
    std::vector<std::size_t> of_this = {first, smallest, largest, last};
    std::ranges::sort(of_this);
    of_this.erase(std::ranges::unique(of_this).begin(), of_this.end());
    drawn.insert(drawn.end(), of_this.begin(), of_this.end());
  }
  return drawn;
}

}  // namespace whipple::monitor
