// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whipple::cases {

struct Body;
struct Case;

/// Which bodies share a velocity field, and why.
struct ContactFields {
  std::vector<std::uint8_t> of_body;  ///< numbers from 0
  std::vector<std::uint8_t> cracked;  ///< those that divide at cracks
  std::vector<std::string> remarks;   ///< what `auto` decided
  std::vector<std::string> warnings;  ///< bodies that meet, but have no fields of their own
  /// Returns whether there is more than one.
  [[nodiscard]] bool several() const;
};

/// Returns the velocity fields of the bodies of a case by its method of contact.
ContactFields find_contact_fields(const Case& setup);

/// Returns the fields of bodies that share one within a contact group, and have their own outside of any.
std::vector<std::uint8_t> fields_of_groups(const std::vector<Body>& bodies);

/// Returns the number of different fields.
unsigned count_of(const std::vector<std::uint8_t>& fields);

/// Returns the fields of bodies whose cracks part, as many as there are velocity fields for; `found` has the fields of
/// the bodies, and is told of those that there are none for.
std::vector<std::uint8_t> cracked_fields(const Case& setup, ContactFields& found);

/// Lets the particles of curved bodies have the part of their volume that is inside the body, unless the case
/// file says otherwise: mass and surfaces follow from them.
void choose_volumes(Case& setup);

}  // namespace whipple::cases
