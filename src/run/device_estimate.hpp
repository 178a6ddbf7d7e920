// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "src/device/cost.hpp"
#include "src/run/forecast.hpp"

namespace whipple::run {

/// Bandwidth (bytes/s) that estimates assume without a card: what copies reach on one with HBM3e, of nominally 4.8 TB/s.
constexpr double assumed_bandwidth = 4.3e12;

/// What a case needs of a graphics processor (docs/manual/devices.md).
struct DeviceEstimate {
  device::StepSize size;                 ///< at the start
  device::MemoryNeed need;               ///< at the start
  device::MemoryNeed dispersed;          ///< if every particle were alone in its cells
  double most_particles = 0.0;           ///< after all divisions (forecast_splitting); 0: none is divided
  double least_bytes = 0.0;              ///< per particle and step, at the start
  std::optional<device::Card> card;      ///< none: this machine has none
  double bandwidth = assumed_bandwidth;  ///< of copies, bytes/s
  bool is_measured = false;              ///< on the card
  /// Lower bound of the time of the run (s): the fewest steps, in each of which every number moves once between memory
  /// and core; 0: the number of steps is not known.
  double least_time = 0.0;
};

/// Checks that a device computes a case.
/// @throws InputError naming what the case asks for that a device does not compute, as a run
void require_device_case(const cases::Case& setup);

/// Estimates memory and time on a graphics processor.
/// @param simulation  in its initial state, on the host
/// @param bandwidth   to assume, bytes/s; 0: that of the card, or assumed_bandwidth
DeviceEstimate estimate_device(const solver::Simulation& simulation, double bandwidth);
/// Sets the bound of the time.
void set_time(DeviceEstimate& estimate, const Forecast& forecast);

std::string device_text(const DeviceEstimate& estimate);
nlohmann::json device_json(const DeviceEstimate& estimate);

}  // namespace whipple::run
