// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Computes the peak pressure of the material below the point of impact from a series of snapshots
/// (docs/theory/analysis.md, section 6): from the field `maximum_pressure`, or from `pressure` if it is missing.
/// Snapshots must be added in order, beginning with the first of the run.
class PeakDecay {
 public:
  /// Tracks particles of `body` that start within `radius` of the axis.
  PeakDecay(const Snapshot& first, const Frame& frame, std::size_t body, double radius, double face);

  void add(const Snapshot& snapshot);

  /// Tabulates the peak pressure over the whole series against the initial depth below the face, averaged in layers of
  /// thickness `layer`.
  [[nodiscard]] Table profile(double layer) const;

  /// Computes the mean peak over depths of 0 to 0.6 and 0 to 1.2 projectile radii, the peak at 4 diameters, and the
  /// exponent n of P ~ depth^-n over 2 to 5 projectile diameters (least squares of the logarithms over the particles).
  [[nodiscard]] Quantities measures(double diameter) const;

 private:
  /// Returns the mean peak of the particles that started no deeper than `depth`.
  [[nodiscard]] double mean_to(double depth) const;

  std::vector<std::uint64_t> id_;
  std::vector<double> depth_, peak_;
};

}  // namespace whipple::analysis
