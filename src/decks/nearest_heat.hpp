// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::decks {

/// A heat capacity that the deck does not give, from the material library.
struct LibraryHeat {
  double value = 0.0;    ///< c_v, J/(kg K)
  std::string material;  ///< file name of the library, without its ending
};

/// Returns the heat capacity of the material of the library that has this equation of state and the nearest density.
/// @param density  kg/m^3
/// @param model    of the equation of state: "mie_gruneisen" or "jwl"
/// @throws InputError if the library has no such material
LibraryHeat nearest_heat(double density, std::string_view model);

}  // namespace whipple::decks
