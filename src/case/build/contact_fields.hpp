// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace whipple::cases {

struct Body;
struct Case;

/// Number of further fields of a body whose pieces touch each other.
constexpr unsigned fields_of_pieces = 15;

/// Describes which bodies share a velocity field, and why.
struct ContactFields {
  std::vector<std::uint8_t> of_body;  ///< field numbers from 0
  std::vector<std::uint8_t> cracked;  ///< fields that divide at cracks
  /// First of the `fields_of_pieces` further fields of each body for pieces that deletion has parted; 0: it has none
  std::vector<std::uint8_t> pieces = {};
  std::vector<std::string> remarks;   ///< decisions of method `auto`
  std::vector<std::string> warnings;  ///< bodies that meet but share a velocity field
  /// Returns the number of fields, those of pieces included, those of cracks not.
  [[nodiscard]] unsigned count() const;
  /// Returns whether there is more than one field.
  [[nodiscard]] bool several() const { return count() > 1; }
  /// Returns the field of a part of a body. @param part  0: the body itself, otherwise a piece, from 1
  [[nodiscard]] std::uint8_t of_part(std::size_t body, std::uint8_t part) const {
    return part == 0 ? of_body[body] : static_cast<std::uint8_t>(pieces[body] + part - 1);
  }
  /// Returns the number of parts of a body that have fields of their own, the body itself included.
  [[nodiscard]] unsigned parts(std::size_t body) const;
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
