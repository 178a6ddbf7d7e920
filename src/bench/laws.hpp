// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// Measures the cost of the strength and failure laws of metals, compared on one equation of state.
namespace whipple::bench {

/// Holds the time of the constitutive update of yielding metal with one law.
struct LawMeasurement {
  std::string name;          ///< of the law
  std::string kind;          ///< "strength", or "failure" in addition to Johnson-Cook strength
  double nanoseconds = 0.0;  ///< per point and step, median of the rounds
  /// Holds the ratio to the time of Johnson-Cook strength without failure in the same round: median, and the lower and
  /// upper quartiles of the rounds.
  double multiple = 0.0, low = 0.0, high = 0.0;
};

/// Times the laws of metals on one thread, in processor time. Each round times all laws one after the other, so that
/// all are measured under the same conditions. Random deviatoric flow of 32768 points of copper (Mie-Grueneisen)
/// alternates in sign: all points yield in most steps.
std::vector<LawMeasurement> measure_laws(int rounds);

}  // namespace whipple::bench
