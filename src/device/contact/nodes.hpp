// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/device/contact/constants.hpp"
#include "src/device/lattice.hpp"

/// Nodes that two fields reach, from the sums over particles.
namespace whipple::device {

/// States the part of a node in contact.
enum class ContactRole : std::uint8_t {
  none,    ///< no other field reaches its place
  first,   ///< the node of the lowest field at the place
  second,  ///< any other node there: its mass is kept for contact like that of the first
};

/// Returns whether particles of a field contribute to its node at a place, which is no image.
template <class Lattice>
[[nodiscard]] WHIPPLE_POINT inline bool reaches(const Lattice& lattice, std::uint32_t field,
                                                const Place& at) {
  const std::int32_t node = lattice.node_at(field, at);
  return node != nowhere && lattice.nodes[node].mass() > 0.0 && !lattice.is_image(at, field);
}

/// Finds the role of each node. Call it with the sums of the particles, before or after those beyond mirror planes have
/// been folded.
template <class Lattice>
struct FindContactRoles {
  Lattice lattice;
  ContactRole* role;  ///< of each node

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    role[i] = ContactRole::none;
    if (lattice.fields < 2 || !(lattice.nodes[node].mass() > 0.0)) return;
    const std::uint32_t own = lattice.field_of(node);
    const Place at = lattice.place_of(node);
    if (lattice.is_image(at, own)) return;
    bool lower = false, higher = false;
    for (std::uint32_t field = 0; field < lattice.fields; ++field) {
      if (field == own || !reaches(lattice, field, at)) continue;
      lower = lower || field < own;
      higher = higher || field > own;
    }
    if (lower) {
      role[i] = ContactRole::second;
    } else if (higher) {
      role[i] = ContactRole::first;
    }
  }
};

/// Clears the heat of the nodes that are not in contact, in whose place the momentum equation has stored their mass.
template <class Lattice>
struct ClearOutsideContact {
  Lattice lattice;
  const ContactRole* role;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    if (role[i] == ContactRole::none) lattice.nodes[i].set_heat(0.0);
  }
};

/// Lists the pairs, while the nodes hold the sums.
template <class Lattice>
struct ListContactPairs {
  Lattice lattice;
  const ContactRole* role;
  const std::uint32_t* before;  ///< of each node: number of nodes before it whose role is `first`
  ContactPair* pairs;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    if (role[i] != ContactRole::first) return;
    const auto node = static_cast<std::uint32_t>(i);
    const Place at = lattice.place_of(node);
    std::uint32_t partner = crowded;
    int partners = 0;
    for (std::uint32_t field = lattice.field_of(node) + 1; field < lattice.fields; ++field) {
      if (!reaches(lattice, field, at)) continue;
      partner = static_cast<std::uint32_t>(lattice.node_at(field, at));
      ++partners;
    }
    pairs[before[i]] = {node, partners == 1 ? partner : crowded};
  }
};

}  // namespace whipple::device
