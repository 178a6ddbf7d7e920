// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/decks/mpm3d_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::mpm3d {

/// Describes a body as written to the case, in the units of the deck.
struct CaseBody {
  const Statement* statement = nullptr;
  std::string name;
  int component = 1, material = 1;
  std::string shape;        ///< TOML: "{ sphere = { ... } }"; empty: not possible in a case
  std::string description;  ///< for the report
  Vector3 lower, upper;     ///< bounding box
  double particles = 0.0, mass = 0.0, spacing = 0.0;
  Vector3 velocity = Vector3::Zero();
  bool is_given = false;  ///< by a file of particles, not filled again
};

struct BodyOptions {
  bool old_mass =
      false;  ///< the number after the material is the mass of a particle, as in decks before 2013-12
};

/// Builds the bodies of a deck with their shapes and velocities, with remarks on every `part` and `velo`.
/// @param density  of each material, by number
/// @throws InputError for impossible numbers, undefined materials and velocities of undefined bodies
std::vector<CaseBody> bodies_of(const Deck& deck, const std::map<int, double>& density,
                                const UnitSystem& units, const BodyOptions& options, Import& import);

}  // namespace whipple::decks::mpm3d
