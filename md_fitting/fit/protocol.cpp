// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/protocol.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace whipple::fit {

std::optional<Protocol> protocol_of(const md::PointRecord& point) {
  static constexpr std::array<std::pair<std::string_view, Protocol>, 4> words = {
      {{"zero_pressure_volume", Protocol::zero_pressure_volume},
       {"hugoniot", Protocol::hugoniot},
       {"isochore", Protocol::isochore},
       {"coexistence", Protocol::coexistence}}};
  for (const auto& [word, protocol] : words) {
    if (point.protocol == word) return protocol;
  }
  return std::nullopt;
}

}  // namespace whipple::fit
