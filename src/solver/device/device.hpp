// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/words.hpp"

namespace whipple::solver {

/// Selects where the steps of a run are computed.
enum class Device : std::uint8_t {
  cpu,        ///< with the kernels for the registers of the processor
  reference,  ///< with plain loops over single numbers
  emulated,   ///< with the kernels of a graphics processor, on the threads of the host
  gpu,        ///< on a graphics processor
};
constexpr std::array<Word<Device>, 4> words(Device) {
  return {{{Device::cpu, "cpu"},
           {Device::reference, "reference"},
           {Device::emulated, "emulated"},
           {Device::gpu, "gpu"}}};
}
/// Returns whether the particles are kept in the memory of a device.
constexpr bool is_device(Device device) { return device == Device::emulated || device == Device::gpu; }

/// Returns the device that new simulations use: cpu, unless the program or a test selects another, as it selects
/// kernel_set().
Device& default_device();

/// Checks that the program and this machine have the device.
/// @throws InputError that says what is missing
void require(Device device);

/// Returns what a case asks for that a device does not compute, each with its key; empty if a device can run it.
std::vector<InputFault> device_faults(const cases::Case& setup);

/// Lets bodies whose equation of state a device has in closed form no evaluate it from a table
/// (`equation_of_state = "table"`).
void evaluate_by_tables(cases::Case& setup);

}  // namespace whipple::solver
