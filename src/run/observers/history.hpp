// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/run/observers/history_columns.hpp"
#include "src/run/observers/table.hpp"

namespace whipple::run {

/// Writes history.csv: energies, momentum, masses of the phases, errors.
class HistoryTable : public Table {
 public:
  HistoryTable(const cases::Case& setup, Options options, const io::Ranks& ranks)
      : Table(std::move(options), ranks), columns_(history_columns(setup)) {}

 protected:
  [[nodiscard]] std::vector<io::HistoryValue> row(const solver::Simulation& simulation) override {
    return history_row(columns_, simulation);
  }

 private:
  std::vector<HistoryColumn> columns_;
};

}  // namespace whipple::run
