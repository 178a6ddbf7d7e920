// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/run/device_estimate.hpp"
#include "src/run/forecast.hpp"
#include "src/run/run.hpp"

namespace whipple::run {

/// Holds what the run of a case would be, for `whipple check`.
struct CaseCheck {
  struct OfBody {
    std::string parts;  ///< numbers of its particles, elements, bars
    double mass = 0.0;  ///< kg, in the domain
    double shape_mass = 0.0;
    std::string at_faces;  ///< what it has to do with mirror planes and walls, lines
  };
  cases::Case setup;
  std::vector<OfBody> bodies;
  std::vector<std::string> warnings;
  std::size_t particles = 0, blocks = 0;
  double bytes = 0.0, expected_memory = 0.0;  ///< now; of all particles at most
  std::string splitting;                      ///< lines
  /// Holds what is on one of two levels of cells, small ones first; empty with one size.
  struct OfLevel {
    double cell_size = 0.0;  ///< m
    std::size_t particles = 0, mixed = 0,
                cells = 0;  ///< mixed: also with functions of the other size; active cells
  };
  std::vector<OfLevel> levels;
  int threads = 1;
  std::optional<Forecast> cost;
  std::optional<DeviceEstimate> device;
};

/// Asks for the estimate of a graphics processor.
struct DeviceQuestion {
  double bandwidth = 0.0;  ///< to assume, bytes/s; 0: measured, or assumed_bandwidth
};

/// Examines the run of a case without making it: bodies, particles, memory. Collective.
/// @param with_forecast  also steps and wall time, from a few measured steps
/// @param device         also memory and time on a graphics processor
/// @throws InputError if the case is invalid, or if a graphics processor is asked about that does not compute it
CaseCheck examine_case(const RunOptions& options, bool with_forecast, MPI_Comm communicator,
                       const std::optional<DeviceQuestion>& device = {});

/// Returns it as text for people, or for programs (SI).
std::string check_text(const CaseCheck& found);
nlohmann::json check_json(const CaseCheck& found);

}  // namespace whipple::run
