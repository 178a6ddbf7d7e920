// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/decks/dyna_deck.hpp"

namespace whipple::decks::dyna {

enum class ContactKind : std::uint8_t {
  pressing,  ///< bodies press upon one another and part again
  tied,      ///< surfaces stick to one another, for ever or until a stress is reached
  output,    ///< forces are printed
  other,
};

/// What a keyword *CONTACT_... is, by its whole name.
struct ContactType {
  ContactKind kind = ContactKind::other;
  std::size_t first_card = 0;  ///< behind those of the options ID and MPP
};

ContactType contact_type(const Block& block);

}  // namespace whipple::decks::dyna
