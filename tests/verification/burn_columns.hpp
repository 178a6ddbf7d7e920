// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

/// Columns of explosive between mirror planes, for tests of burn and reaction.
namespace whipple::verification {

/// A column of explosive at the wall x = 0, of one cell across.
inline std::string column(const std::string& material, double length, double cell,
                          const std::string& more = {}) {
  return fmt::format(
      "[domain]\ndimension = \"plane_strain\"\nlower = [0, 0]\nupper = [{}, {}]\ncell_size = {}\n"
      "boundary = {{ x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = \"symmetry\" }}\n"
      "[[body]]\nname = \"charge\"\nmaterial = \"{}\"\nshape = {{ box = {{ lower = [0, 0], upper = [{}, {}] "
      "}} }}\n{}",
      1.1 * length, cell, cell, material, length, cell, more);
}
inline const std::string lit_at_wall =
    "[[detonation]]\nshape = \"plane\"\nposition = [0, 0]\nnormal = [1, 0]\n";

}  // namespace whipple::verification
