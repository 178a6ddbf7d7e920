// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/case/gauges.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/history.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Describes a column of gauges.csv, NAME.QUANTITY.
struct GaugeColumn {
  std::string name;
  std::string unit;
};

/// Lists the columns of a gauge in the order of the file.
std::vector<GaugeColumn> gauge_columns(const cases::Gauge& gauge);
/// Lists the columns of a force gauge in the order of the file.
std::vector<GaugeColumn> gauge_columns(const cases::ForceGauge& gauge);

/// Measures the state at the gauges of a run. An element counts as the eight particles into which it may be converted
/// (src/afemp/conversion.hpp), with their numbers. A moving gauge follows the particle that was nearest to its initial
/// position. A fixed gauge averages over the particles around it, weighted with the quadratic B-spline of the grid's
/// cell size and with mass (velocity, energy, temperature, strain, fractions) or volume (density, pressure, stress).
/// Without material the values are NaN. A force gauge holds the impulse since the last row over the time since then, so
/// that the sum of force times interval is the impulse.
class GaugeRecorder {
 public:
  /// Finds the particles of the moving gauges; forces count from now. Collective.
  GaugeRecorder(const std::vector<cases::Gauge>& gauges, const std::vector<cases::ForceGauge>& forces,
                const solver::Simulation& simulation);
  /// Restores the particles and the impulses of the last row from a checkpoint.
  /// @throws InputError if the checkpoint does not contain these gauges
  GaugeRecorder(const std::vector<cases::Gauge>& gauges, const std::vector<cases::ForceGauge>& forces,
                const io::CheckpointValues& values);

  [[nodiscard]] bool empty() const { return gauges_.empty() && forces_.empty(); }
  /// Adds the particles of the moving gauges and the impulses of the last row to a checkpoint.
  void to_checkpoint(io::CheckpointValues& values) const;
  /// Computes the row of gauges.csv: the current state at all gauges, the forces since the last row. Collective.
  [[nodiscard]] std::vector<io::HistoryValue> row(const solver::Simulation& simulation) const;
  /// Begins the next interval of the forces: the current row was written.
  void row_written(const solver::Simulation& simulation);

 private:
  void add_states(const solver::Simulation& simulation, std::vector<io::HistoryValue>& row) const;
  void add_forces(const solver::Simulation& simulation, std::vector<io::HistoryValue>& row) const;

  std::vector<cases::Gauge> gauges_;
  std::vector<std::uint64_t> particle_;  // of each moving gauge; fixed: not used
  std::vector<cases::ForceGauge> forces_;
  double last_time_ = 0.0;                           // of the last row, s
  std::vector<solver::GaugedImpulse> last_impulse_;  // until then, of each force gauge
};

}  // namespace whipple::run
