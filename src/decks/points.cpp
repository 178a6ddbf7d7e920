// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/points.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whipple::decks {

std::string shape_of_points(Import& import, const std::string& name, const UnitSystem& units,
                            std::span<const Vector3> places, std::span<const double> masses) {
  if (!std::ranges::all_of(masses, [](double mass) { return mass > 0.0; })) return {};
  std::string text = fmt::format("# {} of {}\nx [{}],y [{}],z [{}],mass [{}]\n", name, import.deck,
                                 units.length, units.length, units.length, units.mass);
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += fmt::format("{},{},{},{}\n", places[i][0], places[i][1], places[i][2], masses[i]);
  }
  const std::string file = fmt::format("points/{}.csv", name);
  import.files.push_back({file, std::move(text)});
  return fmt::format("{{ points = {{ file = \"{}\" }} }}", file);
}

}  // namespace whipple::decks
