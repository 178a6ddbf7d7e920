// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/hits.hpp"

/// Measurement of the impacts on a witness plate (docs/theory/analysis.md, section 5).
namespace whipple::analysis {

struct WitnessOptions {
  double position = 0.0;  ///< axial coordinate of the plate, m
  double ring = 0.0;      ///< width of the rings, m
  int times = 50;         ///< intervals of the flux over time
};

/// Computes the hits of the debris in free flight from its state in the snapshot: particle i passes the plate at t + (X
/// - z_i) / v_i, which is before the snapshot for particles already beyond it.
Loads witness_plate(const Snapshot& snapshot, const Frame& frame, const WitnessOptions& options);

}  // namespace whipple::analysis
