// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/table.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"

namespace whipple::run {

void Table::begin(const Moment& moment) {
  if (ranks_.is_root()) table_.emplace(options_.file);
  append(moment);
}

void Table::resume(const Moment& moment, const io::CheckpointValues& values) {
  const std::vector<io::HistoryValue> columns = row(moment.simulation);
  ranks_.on_root([&] {
    table_.emplace(columns.empty() ? io::History(options_.file)
                                   : io::History::restart(options_.file, moment.step(), columns));
    const std::int64_t expected = values.integer(options_.rows_name);
    if (table_->rows() == expected || options_.accept_missing_rows) return;
    throw InputError(fmt::format(
        "{}: has {} rows up to step {} of the checkpoint, but {} were written; restore the file, or resume "
        "without them: whipple run --restart {} --force",
        options_.file.string(), table_->rows(), moment.step(), expected,
        options_.file.parent_path().string()));
  });
}

void Table::after_step(const Moment& moment) {
  if (moment.is_last() || moment.is_due(moment.schedule.*options_.every)) append(moment);
}

void Table::append(const Moment& moment) {
  if (moment.step() == last_step_) return;
  const std::vector<io::HistoryValue> numbers = row(moment.simulation);
  if (!numbers.empty()) ranks_.on_root([&] { table_->append(numbers); });
  row_written(moment.simulation);
  last_step_ = moment.step();
}

void Table::remember(io::CheckpointValues& values) {
  values.integers[options_.rows_name] =
      std::stoll(ranks_.broadcast(table_ ? fmt::format("{}", table_->rows()) : ""));
  // Rows counted by the checkpoint must not be lost.
  ranks_.on_root([&] { table_->force_to_disk(); });
}

}  // namespace whipple::run
