// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "src/core/base/files.hpp"
#include "src/run/observers/history_columns.hpp"
#include "src/run/observers/table.hpp"

namespace whipple::run {

/// Writes history.csv: energies, momentum, masses of the phases, errors; and columns.json, which describes it.
class HistoryTable : public Table {
 public:
  HistoryTable(const cases::Case& setup, Options options, const io::Ranks& ranks)
      : Table(options, ranks),
        columns_(history_columns(setup)),
        description_(options.file.parent_path() / "columns.json"),
        ranks_(ranks) {}

  void begin(const Moment& moment) override {
    ranks_.on_root([&] { write_text_atomically(description_, columns_as_json(columns_)); });
    Table::begin(moment);
  }
  void resume(const Moment& moment, const io::CheckpointValues& values) override {
    Table::resume(moment, values);  // which may refuse the file
    ranks_.on_root([&] { write_text_atomically(description_, columns_as_json(columns_)); });
  }

 protected:
  [[nodiscard]] std::vector<io::HistoryValue> row(const solver::Simulation& simulation) override {
    return history_row(columns_, simulation);
  }

 private:
  std::vector<HistoryColumn> columns_;
  std::filesystem::path description_;
  io::Ranks ranks_;
};

}  // namespace whipple::run
