// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "src/core/base/dialect.hpp"
#include "src/material/failure/code.hpp"
#include "src/material/kinematic_formulas.hpp"

/// State of one material point and the results of its update, as kernels of a graphics processor hold them.
namespace whipple::device {

/// Holds the fields of `MaterialPoints` of a point and its history (SI).
struct MaterialState {
  double mass, volume, void_volume;
  double energy;    ///< J/kg, at the end of the step by the work of the grid; not changed
  double pressure;  ///< Pa, that acts
  double artificial_viscosity, heating_viscosity;
  double temperature, sound_speed, plastic_strain;
  double melted, vaporised;
  double failed;  ///< code of the cause, failure::Code
  double maximum_pressure, maximum_temperature, melting_time;
  double threshold_factor;  ///< scatter of the failure threshold; 1: none
  double damage, fragment_size;
  double cold_work;  ///< J/kg
  material::formulas::Symmetric<double> deviator;

  [[nodiscard]] WHIPPLE_POINT bool intact() const { return failed == 0.0; }
  WHIPPLE_POINT void fail(failure::Code cause) { failed = static_cast<double>(cause); }
};

struct MaterialStep {
  double dt;    ///< s
  double time;  ///< at the end of the step, s
};

/// Lists the bits of `MaterialResult::events`, the counters of `MaterialReport`. A run stops at those of `stopping`.
namespace event {
constexpr std::uint32_t eos_not_a_number = 1;  ///< the first four are those of `eos::PointEvent`
constexpr std::uint32_t eos_density = 2;
constexpr std::uint32_t eos_energy = 4;
constexpr std::uint32_t below_cold_curve = 8;
constexpr std::uint32_t undefined = 16;              ///< nonpositive volume, NaN in gradient or energy
constexpr std::uint32_t limited_volume_change = 32;  ///< J outside [1/2, 2]
constexpr std::uint32_t limited_density = 64;
constexpr std::uint32_t squeezed = 128;           ///< held at the maximum density of the equation of state
constexpr std::uint32_t limited_void_step = 256;  ///< of material next to a void
constexpr std::uint32_t newly_failed = 512;       ///< `MaterialState::failed` holds the code
constexpr std::uint32_t eos_out_of_range = eos_not_a_number | eos_density | eos_energy;
constexpr std::uint32_t stopping = eos_out_of_range | undefined;
}  // namespace event

struct MaterialResult {
  double plastic_work, dissipation, plastic_heat;  ///< J, as in `MaterialReport`
  double compression_rate;                         ///< -tr L of a point under pressure, 1/s
  std::uint32_t events;                            ///< bits of `event`
};

}  // namespace whipple::device
