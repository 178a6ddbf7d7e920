// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/bench/machine.hpp"
#include "src/bench/problems.hpp"

namespace whipple::bench {

/// Holds time, memory traffic and arithmetic operations of a stage per particle and step.
struct StageMeasurement {
  std::string name;
  double nanoseconds = 0.0;  ///< wall clock
  double bytes = 0.0;        ///< minimum memory traffic; 0: not counted
  double flops = 0.0;        ///< required by the equations; 0: not counted
};

/// Holds the measurement of one problem on a number of ranks and threads.
struct Measurement {
  std::string problem;
  int ranks = 1;
  int threads = 1;            ///< of each rank
  std::size_t particles = 0;  ///< and elements
  std::size_t steps = 0;
  double nanoseconds = 0.0;    ///< wall clock per particle and step, best of several parts of the run
  double share_at_rest = 0.0;  ///< inactive fraction of the particles, mean over the steps
  double particles_per_block = 0.0;
  double bytes_per_particle = 0.0;    ///< memory of the fields and the grid, all ranks
  double peak_memory = 0.0;           ///< bytes, resident, of the largest rank's process
  std::optional<std::string> device;  ///< that kept the particles
  std::vector<StageMeasurement> stages;
  MachineRates machine;  ///< rates of as many cores, measured immediately afterwards; 0: unknown

  [[nodiscard]] int cores() const { return ranks * threads; }
};

enum class Length {
  quick,  ///< a fifth of the steps
  normal,
  whole,  ///< from the start to the end of the case
};

/// Times a problem on the ranks of a communicator, or on solver::default_device(). Collective.
/// @throws InputError naming what a device does not compute of the problem
Measurement measure(const Problem& problem, int threads, Length length, MPI_Comm communicator);

nlohmann::json to_json(const Measurement& measurement);
/// Reads a measurement.
/// @throws nlohmann::json::exception if keys are missing
Measurement from_json(const nlohmann::json& json);

}  // namespace whipple::bench
