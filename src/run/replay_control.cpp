// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/replay_control.hpp"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <string>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/observer.hpp"

namespace whipple::run {
namespace {

std::int64_t step_of(const std::string& cell) {
  std::int64_t step = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), step);
  if (error != std::errc() || end != cell.data() + cell.size() || step < 0) {
    throw InputError(fmt::format("expected the number of a step, found \"{}\"", cell));
  }
  return step;
}

}  // namespace

ReplayControl::ReplayControl(const std::filesystem::path& table) {
  std::istringstream file(read_text(table));
  std::string line;
  if (!std::getline(file, line) || line != DirectoryControl::header) {
    throw InputError(fmt::format("{}: error: is no steering.csv of a run", table.string()));
  }
  for (int number = 2; std::getline(file, line); ++number) {
    try {
      const std::vector<std::string> cells = csv_cells(line);
      if (cells.size() != 7) throw InputError(fmt::format("expected 7 cells, found {}", cells.size()));
      if (value_of<Verdict>(cells[5]) != Verdict::accepted) continue;
      const std::int64_t step = step_of(cells[1]);
      if (!rows_.empty() && step < rows_.back().first) {
        throw InputError(
            fmt::format("step {} after step {}: the run was continued from an earlier checkpoint, and cannot "
                        "be repeated from this table",
                        step, rows_.back().first));
      }
      rows_.emplace_back(step, parse_request(cells[3], cells[4]));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: error: {}", table.string(), number, error.what()));
    }
  }
}

void ReplayControl::ask(const Moment& moment, Requests& requests) {
  if (requests.steering.act != Act::none) return;
  if (rows_.empty()) {
    if (moment.paused) requests.steering = {Act::resume};  // the run ended while paused
    return;
  }
  if (moment.step() < rows_.front().first) return;
  requests.steering = rows_.front().second;
  rows_.pop_front();
}

}  // namespace whipple::run
