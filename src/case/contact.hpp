// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"
#include "src/contact/surfaces.hpp"

namespace whipple::cases {

/// Selects the bodies that have separate velocity fields.
enum class ContactMethod : std::uint8_t {
  automatic,    ///< all except bodies that initially touch and have the same velocity
  none,         ///< one field for all bodies
  multi_field,  ///< each body, or each contact group
};
constexpr std::array<Word<ContactMethod>, 3> words(ContactMethod) {
  return {{{ContactMethod::automatic, "auto"},
           {ContactMethod::none, "none"},
           {ContactMethod::multi_field, "multi_field"}}};
}

/// Controls the contact of bodies (docs/theory/contact.md).
struct ContactControl {
  ContactMethod method = ContactMethod::automatic;
  contact::Normal normal = contact::Normal::separating;
  double friction = 0.3;
  double explosive_friction = 0.0;
  double crack_friction = 0.3;
  bool gap_test = true;
  double gap = 0.0;  ///< in cells
  bool everywhere = false;

  static ParameterTable<ContactControl> parameters();
  /// Adds faults if scheme or bodies are incompatible with contact.
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
