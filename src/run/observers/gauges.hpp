// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "src/run/gauges.hpp"
#include "src/run/observers/table.hpp"

namespace whipple::run {

/// Writes gauges.csv: the state at the gauges and tracers of a case, and its forces.
class GaugeTable : public Table {
 public:
  using Table::Table;

  void begin(const Moment& moment) override {
    const solver::Simulation& simulation = moment.simulation;
    recorder_.emplace(simulation.setup().all_gauges(), simulation.setup().force_gauges, simulation);
    Table::begin(moment);
  }
  void resume(const Moment& moment, const io::CheckpointValues& values) override {
    const cases::Case& setup = moment.simulation.setup();
    recorder_.emplace(setup.all_gauges(), setup.force_gauges, values);
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
  void row_written(const solver::Simulation& simulation) override { recorder_->row_written(simulation); }

 private:
  std::optional<GaugeRecorder> recorder_;
};

}  // namespace whipple::run
