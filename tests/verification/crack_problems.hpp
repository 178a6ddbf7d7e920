// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "src/case/case.hpp"
#include "tests/verification/solver_problems.hpp"

/// Problems with cracks, shared by several tests.
namespace whipple::verification {

/// Returns the largest distance (m) between particles of the same number in two runs.
inline double largest_distance(const Particles& a, const Particles& b) {
  std::unordered_map<std::uint64_t, Vector3> place;
  for (std::size_t p = 0; p < a.size(); ++p) place[a.id[p]] = a.position[p];
  double largest = 0.0;
  for (std::size_t p = 0; p < b.size(); ++p) {
    if (const auto found = place.find(b.id[p]); found != place.end())
      largest = std::max(largest, (found->second - b.position[p]).norm());
  }
  return largest;
}

/// Returns a case of a plate with scattered failure strain that breaks at a mirror plane (y = 0, or the axis) while a
/// hard block strikes it and pushes it against a wall.
/// @param failure_strain  mean
inline cases::Case breaking_plate(const std::string& dimension, const std::string& cracks,
                                  double failure_strain = 0.05) {
  const std::string plate =
      aluminium(fmt::format("breaking_{}", failure_strain), "0.3 GPa",
                fmt::format("[[failure]]\nmodel = \"plastic_strain\"\nsource = \"test\"\n"
                            "failure_strain = {}\n[[failure]]\nmodel = \"fragment_size\"\nsource = \"test\"\n"
                            "energy_per_area = \"10 kJ/m^2\"\n",
                            failure_strain));
  const std::string block = aluminium("block_on_plate", "2 GPa");
  const bool in_space = dimension == "3d";
  return cases::read_case_text(
      fmt::format(R"(
[domain]
dimension = "{0}"
lower = [-0.004, 0{5}]
upper = [0.012, 0.012{6}]
cell_size = 0.001
boundary = {{ x_upper = "separating", y_lower = "symmetry"{1} }}
[time]
end = 4e-6
[[body]]
name = "block"
material = "{2}"
velocity = [2000, 0, 0]
shape = {{ box = {{ lower = [-0.0031, -0.002, -0.1], upper = [0.0009, 0.002, 0.1] }} }}
[[body]]
name = "plate"
material = "{3}"
velocity = [300, 0, 0]
shape = {{ box = {{ lower = [0.001, -0.008, -0.1], upper = [0.003, 0.008, 0.1] }} }}
failure = {{ cracks = "{4}" }}
failure_scatter = {{ weibull_modulus = 8, seed = 3 }}
[[body]]
name = "stop"
material = "{2}"
shape = {{ box = {{ lower = [0.0095, -0.006, -0.1], upper = [0.012, 0.006, 0.1] }} }}
)",
                  dimension, in_space ? ", z_lower = \"symmetry\", z_upper = \"no_slip\"" : "", block, plate,
                  cracks, in_space ? ", 0" : "", in_space ? ", 0.004" : ""),
      "breaking_plate.toml");
}

}  // namespace whipple::verification
