// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whipple::cases {

struct Body;
struct Case;

/// Describes which bodies share a velocity field, and why.
struct ContactFields {
  std::vector<std::uint8_t> of_body;  ///< field numbers from 0
  std::vector<std::uint8_t> cracked;  ///< fields that divide at cracks
  std::vector<std::string> remarks;   ///< decisions of method `auto`
  std::vector<std::string> warnings;  ///< bodies that meet but share a velocity field
  /// Returns whether there is more than one field.
  [[nodiscard]] bool several() const;
};

/// Determines the velocity fields of the bodies of a case from its contact method.
ContactFields find_contact_fields(const Case& setup);

/// Returns the fields of bodies: one per contact group, and a separate one for each body without a group.
std::vector<std::uint8_t> fields_of_groups(const std::vector<Body>& bodies);

/// Returns the number of different fields.
unsigned count_of(const std::vector<std::uint8_t>& fields);

/// Returns the fields that divide at cracks, as far as velocity fields are available. `found` contains the fields of
/// the bodies; warnings about bodies without available fields are added to it.
std::vector<std::uint8_t> cracked_fields(const Case& setup, ContactFields& found);

/// Enables partial volumes for bodies with curved surfaces, unless the case file sets them explicitly: mass and
/// surfaces then follow from the part of each particle that is inside the body.
void choose_volumes(Case& setup);

}  // namespace whipple::cases
