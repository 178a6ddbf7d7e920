// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eos/curves/queries.hpp"
#include "eos/curves/table.hpp"

namespace whipple::eos::curves {

/// Accumulates mean and standard deviation of a number over samples; non-finite values are ignored.
class Scatter {
 public:
  void add(double value);
  void add(const std::optional<double>& value) {
    if (value) add(*value);
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double mean() const;       ///< NaN without values
  [[nodiscard]] double deviation() const;  ///< NaN with fewer than two values

 private:
  int count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// Holds a shock pressure (Pa) at which a transition begins or is complete.
struct Threshold {
  std::string text;  ///< "melting behind the shock begins at"
  Scatter pressure;
};

/// Holds the uncertainty of a Hugoniot that follows from the scatter of the constants of its equation of state.
struct SampledHugoniot {
  /// Mean and standard deviation over the samples at equal particle velocities: shock velocity, pressure, density,
  /// temperature, melted fraction behind the shock, melted and vaporised fraction after release. At each velocity
  /// only samples with a state there are used; the last column holds their number.
  CurveTable table;
  std::vector<Threshold> thresholds;  ///< of melting and vaporisation, behind the shock and after release
};

/// Computes the Hugoniots of samples of one equation of state.
/// @param velocities        particle velocities, m/s, increasing
/// @param release_pressure  Pa: end of the releases
/// @throws InputError for fewer than two samples
SampledHugoniot sampled_hugoniot(const Subjects& samples, const std::vector<double>& velocities,
                                 double release_pressure);

}  // namespace whipple::eos::curves
