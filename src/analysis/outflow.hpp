// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "src/analysis/run.hpp"

namespace whipple::analysis {

/// Holds the mass and momentum of a body that have left the domain (SI, of the model).
struct Outflow {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero();
};

/// Holds the outflow of the bodies over time, from history.csv.
class OutflowHistory {
 public:
  /// Reads the history of a run; without a history, or without columns per body, the outflow is zero.
  explicit OutflowHistory(const Run& run);
  /// Returns the accumulated outflow of a body up to a time (s).
  [[nodiscard]] Outflow at(std::size_t body, double time) const;

 private:
  struct Row {
    double time = 0.0;
    std::vector<Outflow> bodies;
  };
  std::vector<Row> rows_;  // rows in which the outflow grew
};

}  // namespace whipple::analysis
