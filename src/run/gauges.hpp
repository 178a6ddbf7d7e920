// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/case/gauges.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/history.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Measures the state at the gauges of a run. An element counts as the eight particles that it may become
/// (src/afemp/conversion.hpp), with their numbers. A moving gauge follows the particle that was nearest to its
/// initial position; a fixed gauge averages over the particles around it, weighted with the quadratic B-spline of
/// the grid's cell size and with mass (velocity, energy, temperature, strain, fractions) or volume (density,
/// pressure, stress). Without material the values are NaN.
class GaugeRecorder {
 public:
  /// Finds the particles of the moving gauges. Collective.
  GaugeRecorder(const std::vector<cases::Gauge>& gauges, const solver::Simulation& simulation);
  /// Continues with the particles of a checkpoint.
  /// @throws InputError if the checkpoint does not hold these gauges
  GaugeRecorder(const std::vector<cases::Gauge>& gauges, const io::CheckpointValues& values);

  [[nodiscard]] bool empty() const { return gauges_.empty(); }
  /// Adds the particles of the moving gauges to a checkpoint.
  void to_checkpoint(io::CheckpointValues& values) const;
  /// Computes the row of gauges.csv: the state at all gauges now. Collective.
  [[nodiscard]] std::vector<io::HistoryValue> row(const solver::Simulation& simulation) const;

 private:
  std::vector<cases::Gauge> gauges_;
  std::vector<std::uint64_t> particle_;  // of each moving gauge; fixed: not used
};

}  // namespace whipple::run
