// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::decks {

/// Holds a heat capacity from the material library, for decks that do not give one.
struct LibraryHeat {
  double value = 0.0;    ///< c_v, J/(kg K)
  std::string material;  ///< file name in the library, without extension
};

/// Returns the heat capacity of the library material with the nearest density among those with this equation of state.
/// @param density  kg/m^3
/// @param model    of the equation of state: "mie_gruneisen" or "jwl"
/// @throws InputError if the library has no such material
LibraryHeat nearest_heat(double density, std::string_view model);

}  // namespace whipple::decks
