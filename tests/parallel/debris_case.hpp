// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::debris_case {

/// A copper disk through an aluminium plate with the three-phase equation of state, quarter model.
inline constexpr const char* bodies = R"(
[[body]]
name = "disk"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "5.55 km/s"]
shape = { cylinder = { center = ["0 mm", "0 mm", "-1.725 mm"], radius = "5.59 mm", height = "3.45 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { box = { lower = ["-10 mm", "-10 mm", "0 mm"], upper = ["10 mm", "10 mm", "2.87 mm"] } }
)";

}  // namespace whipple::debris_case
