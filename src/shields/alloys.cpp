// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/alloys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"

namespace whipple::shields {
namespace {

constexpr std::string_view al_1100 = "aluminium_1100_fracture_mie_gruneisen.toml";
constexpr std::string_view al_2017 = "aluminium_2017_t4_fracture_mie_gruneisen.toml";
constexpr std::string_view al_2024 = "aluminium_2024_fracture_mie_gruneisen.toml";
constexpr std::string_view al_2024_t3 = "aluminium_2024_t3_sheet_mie_gruneisen.toml";
constexpr std::string_view al_2219 = "aluminium_2219_t87_mie_gruneisen.toml";
constexpr std::string_view al_5083 = "aluminium_5083_h116_mie_gruneisen.toml";
constexpr std::string_view al_5456 = "aluminium_5456_h116_mie_gruneisen.toml";
constexpr std::string_view al_6061 = "aluminium_6061_fracture_mie_gruneisen.toml";
constexpr std::string_view al_7075 = "aluminium_7075_mie_gruneisen.toml";
constexpr std::string_view none;

// Alloys share a material where their yield stresses differ by less than 11 %; softer tempers have none. Three
// exceptions say so in their remark: 99.9 %, 2024-T351 and 6101-T6.
constexpr auto table = std::to_array<Alloy>({
    {"99.9%", 2700.0, 10e6, 15.0, al_1100,
     "1100-O, yield stress 34 MPa, stands for purer aluminium of 10 MPa"},
    {"1100-O", 2710.0, 34e6, 23.0, al_1100, ""},
    {"2017-T4", 2800.0, 275e6, 105.0, al_2017, ""},
    {"2024-T3", 2770.0, 345e6, 120.0, al_2024_t3, ""},
    {"2024-T351", 2770.0, 395e6, 130.0, al_2024,
     "strength of 2024-T4, yield stress 325 instead of 395 MPa; damage of 2024-T351"},
    {"2024-T4", 2770.0, 325e6, 120.0, al_2024, ""},
    {"2219-T851", 2840.0, 352e6, 130.0, al_2219, "strength of 2219-T87"},
    {"2219-T87", 2840.0, 393e6, 130.0, al_2219, ""},
    {"3003-H12", 2730.0, 125e6, 35.0, none, ""},
    {"3003-H14", 2730.0, 145e6, 40.0, none, ""},
    {"5083-H116", 2660.0, 228e6, 85.0, al_5083, ""},
    {"5083-O", 2660.0, 145e6, 77.0, none, ""},
    {"5154-O", 2660.0, 117e6, 58.0, none, ""},
    {"5456-H116", 2660.0, 255e6, 90.0, al_5456, ""},
    {"6061-CMG", 2700.0, 198e6, 77.0, none, ""},
    {"6061-T6", 2700.0, 276e6, 95.0, al_6061, ""},
    {"6061-T651", 2700.0, 276e6, 95.0, al_6061, ""},
    {"6101-T6", 2700.0, 193e6, 71.0, al_6061, "strength of 6061-T6, yield stress 276 instead of 193 MPa"},
    {"7075-O", 2800.0, 103e6, 60.0, none, ""},
    {"7075-T6", 2800.0, 503e6, 150.0, al_7075, ""},
    {"7075-T651", 2800.0, 503e6, 150.0, al_7075, ""},
    {"Alclad 7075-T6", 2800.0, 462e6, 150.0, al_7075, "without its cladding"},
});

std::string_view without_prefix(std::string_view name) {
  constexpr std::string_view prefix = "AA";
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  return name;
}

}  // namespace

std::span<const Alloy> alloys() { return table; }

const Alloy& alloy_named(std::string_view name) {
  const auto found = std::ranges::find(table, without_prefix(name), &Alloy::name);
  if (found != table.end()) return *found;
  std::string accepted;
  std::vector<std::string> names;
  for (const Alloy& alloy : table) {
    names.emplace_back(alloy.name);
    accepted += fmt::format("{}{}", accepted.empty() ? "" : ", ", alloy.name);
  }
  throw InputError(fmt::format("unknown alloy \"{}\"{} (accepted: {})", name,
                               did_you_mean(without_prefix(name), names), accepted));
}

std::string_view material_of(std::string_view name) {
  const Alloy& alloy = alloy_named(name);
  if (!alloy.material.empty()) return alloy.material;
  std::string accepted;
  for (const Alloy& other : table) {
    if (!other.material.empty()) accepted += fmt::format("\n  {}: {}", other.name, other.material);
  }
  throw InputError(fmt::format("the library has no material for the alloy \"{}\"; alloys with a material:{}",
                               name, accepted));
}

}  // namespace whipple::shields
