// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/device/contact/constants.hpp"
#include "src/device/contact/nodes.hpp"
#include "src/device/contact/walls.hpp"
#include "src/device/reduction.hpp"

namespace whipple::device {

/// Flags the first node of each pair.
struct FlagFirstOfPair {
  const ContactRole* role;
  std::uint32_t* flags;
  WHIPPLE_POINT void operator()(std::size_t i) const { flags[i] = role[i] == ContactRole::first ? 1 : 0; }
};

/// Sums the balances of all pairs; the maximum is one more than the last pair that more than two fields reach.
struct SumBalances {
  using Result = Reduction<5, 1>;
  const ContactBalance* balances;
  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const ContactBalance& of_pair = balances[i];
    result.sum[0] += of_pair.contact_heat;
    result.sum[1] += of_pair.friction_heat;
    result.sum[2] += of_pair.impulse;
    result.sum[3] += of_pair.friction_impulse;
    result.sum[4] += of_pair.crowded;
    if (of_pair.crowded > 0.0) result.raise(0, static_cast<double>(i + 1));
  }
};

/// Returns the place of a pair.
template <class Lattice>
struct PlaceOfPair {
  struct Result : Reduction<3, 0> {
    [[nodiscard]] Triple<double> place() const { return {sum[0], sum[1], sum[2]}; }
  };
  Lattice lattice;
  const ContactPair* pair;

  WHIPPLE_POINT void operator()(std::size_t, Result& result) const {
    const Place at = lattice.place_of(pair->first);
    result.sum = {lattice.lower.x + at.x * lattice.cell_size, lattice.lower.y + at.y * lattice.cell_size,
                  lattice.lower.z + at.z * lattice.cell_size};
  }
};

/// Sums the heat (J) of contact with images over the particles that nodes move.
template <class Lattice>
struct SumHeatAtWalls {
  using Result = Reduction<1, 0>;
  Lattice lattice;
  const Node* brought;  ///< sums of the particles before folding
  const std::int32_t* number;
  const WallNode* at;

  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const double m = brought[i].mass();
    if (!(m > 0.0)) return;
    const auto node = static_cast<std::uint32_t>(i);
    const std::uint32_t field = lattice.field_of(node);
    Place place = lattice.place_of(node);
    for (int face = 0; face < 6; ++face) {  // beyond a plane of a bonded field: that of the image
      if (lattice.mirrors[static_cast<std::size_t>(face)].bonds(field) && lattice.inside_of(face, place) < 0)
        place = lattice.mirrored(face, place);
    }
    const std::int32_t real = lattice.node_at(field, place);
    if (real != nowhere && number[real] != nowhere) result.sum[0] += m * at[number[real]].heat;
  }
};

}  // namespace whipple::device
