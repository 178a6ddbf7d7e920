// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// Cost of the laws of strength and failure of metals, beside one another on one equation of state.
namespace whipple::bench {

/// Time of the constitutive update of yielding metal with a law.
struct LawMeasurement {
  std::string name;          ///< of the law
  std::string kind;          ///< "strength", or "failure" beside Johnson-Cook strength
  double nanoseconds = 0.0;  ///< of a point and step, median of the rounds
  /// Over that of Johnson-Cook strength without failure in the same round: median, and the quarter of the rounds below
  /// and above.
  double multiple = 0.0, low = 0.0, high = 0.0;
};

/// Times the laws of metals on one thread, in processor time, one after the other in each of some rounds, so that all see the same machine.
/// Random deviatoric flow of 32768 points of copper (Mie-Grueneisen) that alternates in sign: all yield in most steps.
std::vector<LawMeasurement> measure_laws(int rounds);

}  // namespace whipple::bench
