// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/case.hpp"

namespace whipple::run {

/// Returns a case of some steps: a copper ball on an aluminium plate, cells of 1 mm.
inline cases::Case ball_on_plate() {
  return cases::read_case_text(R"(
[domain]
lower = ["-3 mm", "-3 mm", "-4 mm"]
upper = ["3 mm", "3 mm", "2 mm"]
cell_size = "1 mm"
[time]
end = "0.4 us"
[[body]]
name = "ball"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "2 km/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "-1.6 mm"], radius = "1.5 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { box = { lower = ["-2 mm", "-2 mm", "0 mm"], upper = ["2 mm", "2 mm", "1 mm"] } }
)",
                               "case.toml");
}

}  // namespace whipple::run
