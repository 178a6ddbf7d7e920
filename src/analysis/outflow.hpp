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
  /// A run without a history, or one that does not tell the bodies apart, has lost nothing that is known.
  explicit OutflowHistory(const Run& run);
  /// Returns the outflow of a body until a time (s).
  [[nodiscard]] Outflow at(std::size_t body, double time) const;

 private:
  struct Row {
    double time = 0.0;
    std::vector<Outflow> bodies;
  };
  std::vector<Row> rows_;  // those in which it grew
};

}  // namespace whipple::analysis
