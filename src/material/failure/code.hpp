// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace whipple::failure {

/// Lists the values of `MaterialPoints::failed`: the cause of failure.
enum Code : std::uint8_t {
  intact = 0,
  tensile = 1,           ///< tensile pressure
  plastic = 2,           ///< plastic strain
  principal_stress = 3,  ///< largest principal stress
  principal_strain = 4,  ///< largest principal strain
  fractured = 5,         ///< ductile fracture by accumulated damage
  fragmented = 6,        ///< brittle fragmentation
  void_growth = 7,       ///< growth and coalescence of voids
  spalled = 8,           ///< accumulated tension
};
constexpr std::size_t code_count = 16;  ///< available codes: a new law may use the next free one, `Code{9}`

}  // namespace whipple::failure
