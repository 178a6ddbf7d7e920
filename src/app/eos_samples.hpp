// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "src/app/eos_queries.hpp"

/// `whipple eos hugoniot MATERIAL --samples N`: what the covariance of a fitted material leaves uncertain.
namespace whipple::app {

struct SampleOptions {
  int count = 0;
  std::uint64_t seed = 1;
  std::string release_pressure = "100 kPa";
};

/// Mean and standard deviation over the samples at equal particle velocities: shock velocity, pressure,
/// density, temperature, melted fraction behind the shock, melted and vaporised fraction after release. At
/// each velocity the samples that have a state there count; the last column says how many.
struct SampledHugoniot {
  CurveTable table;
  std::vector<std::string> remarks;  ///< thresholds of melting and vaporisation, draws refused
};

/// @throws InputError if the material has no covariance, or for fewer than two samples
SampledHugoniot sampled_hugoniot(const EosOptions& options, const SampleOptions& samples,
                                 const std::filesystem::path& material);

}  // namespace whipple::app
