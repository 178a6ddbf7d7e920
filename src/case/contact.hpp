// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"
#include "src/contact/surfaces.hpp"

namespace whipple::cases {

/// Which bodies have velocity fields of their own.
enum class ContactMethod : std::uint8_t {
  automatic,    ///< all but those that touch at the start and move alike
  none,         ///< one field for all
  multi_field,  ///< all, or each contact group
};
constexpr std::array<Word<ContactMethod>, 3> words(ContactMethod) {
  return {{{ContactMethod::automatic, "auto"},
           {ContactMethod::none, "none"},
           {ContactMethod::multi_field, "multi_field"}}};
}

/// Contact of bodies (docs/theory/contact.md).
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
  /// Adds what contact needs of scheme and bodies.
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
