// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace whipple {

/// Selects the part of the artificial viscosity that heats if losses are kept as unresolved energy
/// (docs/theory/dissipation.md, eq. 6).
enum class HeatingViscosity : std::uint8_t {
  not_distinguished,  ///< losses become heat: points do not store such a part
  whole,              ///< all of it
  of_affine_field,    ///< the part that the affine field of a point represents
};

}  // namespace whipple
