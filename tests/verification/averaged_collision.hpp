// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

#include "src/case/case.hpp"
#include "tests/verification/solver_problems.hpp"

/// A collision of bodies whose pressure and volume rate act as means over cells.
namespace whipple::verification {

/// Returns two blocks of aluminium that collide obliquely, in a section or in space.
/// @param volumetric  that of both
/// @param end  s
/// @param drift  of both, along x, m/s
inline cases::Case averaged_collision(const Method& method, const std::string& dimension,
                                      const std::string& volumetric, double end = 0.08e-6,
                                      double drift = 0.0) {
  const bool space = dimension == "3d";
  const auto corner = [&](double x, double y) {
    return space ? fmt::format("[{}, {}, {}]", x, y, y) : fmt::format("[{}, {}]", x, y);
  };
  // The transverse velocity would leave the axis of a section with an axis.
  const double transverse = dimension == "axisymmetric" ? 0.0 : 50.0;
  const auto body = [&](const char* name, double velocity, double lower, double upper) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nvelocity = {}\nvolumetric = \"{}\"\n"
        "shape = {{ box = {{ lower = {}, upper = {} }} }}\n",
        name, aluminium("averaged_aluminium", "290 MPa"),
        corner(velocity + drift, velocity > 0 ? transverse : 0.0), volumetric, corner(lower, 0.0),
        corner(upper, 4.3e-4));
  };
  const std::string text =
      method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = " +
      (space ? corner(-2e-3, -1e-3) : "[-2e-3, 0]") + "\nupper = " + corner(2e-3, 1.5e-3) +
      "\ncell_size = 1e-4\n" + (space ? "" : "dimension = \"" + dimension + "\"\n") +
      body("left", 400.0, -6e-4, 0.0) + body("right", -400.0, 0.0, 6e-4);
  return cases::read_case_text(text, "averages.toml");
}

}  // namespace whipple::verification
