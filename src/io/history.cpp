// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/io/run_directory.hpp"
#include "src/io/sealed_file.hpp"

namespace whipple::io {

namespace {

std::string header_of(std::span<const HistoryValue> row) {
  std::string header;
  for (const HistoryValue& value : row) {
    if (!header.empty()) header += ',';
    header += csv_cell(value.unit.empty() ? value.name : fmt::format("{} [{}]", value.name, value.unit));
  }
  return header;
}

bool read_number(std::string_view cell, double& value) {
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

History::History(std::filesystem::path path) : path_(std::move(path)) {}

History History::restart(std::filesystem::path path, std::int64_t last_step,
                         std::span<const HistoryValue> row) {
  History history(std::move(path));
  if (!std::filesystem::exists(history.path_)) return history;
  const std::string text = read_text(history.path_);
  const std::string_view all = text;

  const std::size_t header_end = all.find('\n');
  if (header_end == std::string_view::npos) return history;  // killed while writing the header: start over
  history.header_ = all.substr(0, header_end);
  const std::vector<std::string> names = csv_cells(history.header_);
  const auto step = std::find(names.begin(), names.end(), "step");
  if (step == names.end()) {
    throw InputError(
        fmt::format("{}:1: has no column \"step\"; is it the history of a run?", history.path_.string()));
  }
  if (const std::string columns = header_of(row); columns != history.header_) {
    throw InputError(fmt::format("{}: the run to resume has other columns:\n{}\nthis program writes\n{}",
                                 history.path_.string(), history.header_, columns));
  }
  const auto step_column = static_cast<std::size_t>(step - names.begin());

  std::size_t kept = header_end + 1;  // bytes
  std::size_t line_number = 1;
  while (kept < all.size()) {
    const std::size_t end = all.find('\n', kept);
    if (end == std::string_view::npos) break;  // incomplete last line
    ++line_number;
    const std::vector<std::string> cells = csv_cells(all.substr(kept, end - kept));
    double value = 0.0;
    if (cells.size() != names.size() || !read_number(cells[step_column], value)) {
      throw InputError(fmt::format("{}:{}: damaged row: {} cells for {} columns, step \"{}\"",
                                   history.path_.string(), line_number, cells.size(), names.size(),
                                   step_column < cells.size() ? cells[step_column] : ""));
    }
    if (value > static_cast<double>(last_step)) break;  // steps ascend: the remaining rows are later
    kept = end + 1;
    ++history.rows_;
  }
  if (kept != all.size()) write_text_atomically(history.path_, all.substr(0, kept));
  return history;
}

void History::append(std::span<const HistoryValue> row) {
  std::string text = header_of(row);
  const bool is_first = header_.empty();
  if (!is_first && text != header_)
    throw InternalError(fmt::format("{}: columns changed between rows", path_.string()));
  if (is_first) {
    header_ = text;
    text += '\n';
  } else {
    text.clear();
  }
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) text += ',';
    text += fmt::format("{}", row[i].value);  // shortest text that restores the same double
  }
  text += '\n';
  if (is_first) {
    write_text_atomically(path_, text);  // replaces a file of that name
  } else {
    append_text(path_, text);
  }
  ++rows_;
}

void History::force_to_disk() const {
  if (rows_ > 0) io::force_to_disk(path_);
}

}  // namespace whipple::io
