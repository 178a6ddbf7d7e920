// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/decks/dyna_deck.hpp"

namespace whipple::decks::dyna {

enum class ContactKind : std::uint8_t {
  pressing,  ///< bodies press against each other and can separate
  tied,      ///< surfaces are bonded, permanently or up to a limit stress
  output,    ///< forces are printed
  other,
};

/// Describes the type of a keyword *CONTACT_..., by its full name.
struct ContactType {
  ContactKind kind = ContactKind::other;
  std::size_t first_card = 0;  ///< after those of the options ID and MPP
};

ContactType contact_type(const Block& block);

}  // namespace whipple::decks::dyna
