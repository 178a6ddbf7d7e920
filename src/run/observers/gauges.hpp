// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "src/run/gauges.hpp"
#include "src/run/observers/table.hpp"

namespace whipple::run {

/// Writes gauges.csv: the state at the gauges and tracers of a case.
class GaugeTable : public Table {
 public:
  using Table::Table;

  void begin(const Moment& moment) override {
    const solver::Simulation& simulation = moment.simulation;
    recorder_.emplace(simulation.setup().all_gauges(), simulation);
    Table::begin(moment);
  }
  void resume(const Moment& moment, const io::CheckpointValues& values) override {
    recorder_.emplace(moment.simulation.setup().all_gauges(), values);
    Table::resume(moment, values);
  }
  void remember(io::CheckpointValues& values) override {
    Table::remember(values);
    recorder_->to_checkpoint(values);
  }

 protected:
  [[nodiscard]] std::vector<io::HistoryValue> row(const solver::Simulation& simulation) override {
    return recorder_->empty() ? std::vector<io::HistoryValue>() : recorder_->row(simulation);
  }

 private:
  std::optional<GaugeRecorder> recorder_;
};

}  // namespace whipple::run
