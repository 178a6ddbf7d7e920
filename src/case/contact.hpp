// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"

namespace whipple::cases {

struct Case;

/// Contact of bodies (docs/theory/contact.md).
struct ContactControl {
  std::string method = "auto";
  std::string normal = "separating";
  double friction = 0.3;
  bool gap_test = true;
  double gap = 0.0;  ///< in cells
  bool everywhere = false;
  static ParameterTable<ContactControl> parameters();
};

/// Which bodies share a velocity field, and why.
struct ContactFields {
  std::vector<std::uint8_t> of_body;  ///< numbers from 0
  std::vector<std::string> remarks;   ///< what `auto` decided
  std::vector<std::string> warnings;  ///< bodies that meet, but have no fields of their own
  /// Is there more than one?
  [[nodiscard]] bool several() const;
};

/// Velocity fields of the bodies of a case by its method of contact.
ContactFields find_contact_fields(const Case& setup);

/// Lets the particles of curved bodies take the part of their volume that lies in the body, unless the case
/// file says otherwise: mass and surfaces follow from them.
void choose_volumes(Case& setup);

/// What contact needs of scheme and bodies, reported at its table.
void check_contact(const Case& setup, input::Table& contact);

}  // namespace whipple::cases
