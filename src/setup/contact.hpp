// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/base/parameter_table.hpp"
#include "src/input/document.hpp"

namespace whipple::setup {

struct Case;

/// Contact of bodies (docs/theory/contact.md).
struct ContactControl {
  std::string method = "none";
  std::string normal = "separating";
  double friction = 0.0;
  bool gap_test = true;
  double gap = 0.0;  ///< in cells
  bool everywhere = false;
  static ParameterTable<ContactControl> parameters();
};

/// What contact needs of scheme and bodies, reported at its table.
void check_contact(const Case& setup, input::Table& contact);

}  // namespace whipple::setup
