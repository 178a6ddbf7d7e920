// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "eos/loci.hpp"
#include "tests/folders.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {

/// Relative deviations of a model's shock velocities from measured ones.
struct ShockDeviation {
  double rms, mean;
  int count;
};

/// Copper: LASL Shock Hugoniot Data (1980), shock points to 366 GPa; the rows of sound speeds at rest are no
/// shocks.
inline ShockDeviation deviation_from_marsh(const EquationOfState& eos) {
  double sum = 0, mean = 0;
  int count = 0;
  for (const auto& row : read_csv(whipple::tests::source_folder() + "/eos/data/cu_hugoniot_marsh1980.csv")) {
    const double up = std::stod(row[2]) * 1e3, us = std::stod(row[1]) * 1e3;
    if (up == 0) continue;
    const double deviation = Hugoniot(eos).at_particle_velocity(up).shock_velocity / us - 1;
    sum += deviation * deviation;
    mean += deviation;
    ++count;
  }
  return {std::sqrt(sum / count), mean / count, count};
}

}  // namespace whipple::eos::test
