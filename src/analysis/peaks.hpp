// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Peak pressure of the material below the point of impact, from a series of snapshots
/// (docs/theory/analysis.md, section 6): from the field `maximum_pressure`, or where they lack it from
/// `pressure`. Add the snapshots in order, the first of the run first.
class PeakDecay {
 public:
  /// Follows particles of `body` that begin within `radius` of the axis.
  PeakDecay(const Snapshot& first, const Frame& frame, std::size_t body, double radius, double face);

  void add(const Snapshot& snapshot);

  /// Peak pressure over the whole series against the initial depth below the face, mean of layers of
  /// thickness `layer`.
  [[nodiscard]] Table profile(double layer) const;

  /// Mean peak over depths of 0 to 0.6 and 0 to 1.2 radii, peak at 4 diameters, exponent n of P ~ depth^-n
  /// over 2 to 5 diameters of the projectile (least squares of the logarithms over the particles).
  [[nodiscard]] Quantities measures(double diameter) const;

 private:
  /// Mean of the peaks of what began no deeper than `depth`.
  [[nodiscard]] double mean_to(double depth) const;

  std::vector<std::uint64_t> id_;
  std::vector<double> depth_, peak_;
};

}  // namespace whipple::analysis
