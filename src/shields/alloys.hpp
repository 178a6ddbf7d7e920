// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace whipple::shields {

/// Holds the handbook values of an aluminium alloy that ballistic limit equations use, and the material of the library
/// that stands for it in a run. Values: data/material_data.csv of the repository shannonjryan/pyBLOSSUM (MIT licence,
/// commit fe0a7df862041a9ea8816197b32eb9009beac35b).
struct Alloy {
  std::string_view name;      ///< designation and temper, "6061-T6"
  double density = 0.0;       ///< kg/m^3
  double yield = 0.0;         ///< Pa
  double hardness = 0.0;      ///< Brinell
  std::string_view material;  ///< file of the library; empty: the library has none
  std::string_view remark;    ///< how the material differs from the alloy; empty: it is that of the alloy
};

/// Lists the known alloys.
std::span<const Alloy> alloys();

/// Returns the alloy of a designation; a leading "AA" is ignored: "AA6061-T6" is "6061-T6".
/// @throws InputError with the accepted designations
const Alloy& alloy_named(std::string_view name);

/// Returns the library material of an alloy.
/// @throws InputError with the alloys that have one, and which
std::string_view material_of(std::string_view name);

}  // namespace whipple::shields
