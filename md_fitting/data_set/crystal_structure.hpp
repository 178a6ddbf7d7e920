// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "src/core/base/words.hpp"

namespace whipple::md {

/// Lists the crystal structures of metals; the words are those of plans, databases and the LAMMPS command `lattice`.
enum class CrystalStructure : std::uint8_t { fcc, bcc, hcp };
constexpr std::array<Word<CrystalStructure>, 3> words(CrystalStructure) {
  return {{{CrystalStructure::fcc, "fcc"}, {CrystalStructure::bcc, "bcc"}, {CrystalStructure::hcp, "hcp"}}};
}

/// Returns the number of atoms in the cubic cell, or in the orthogonal cell for hcp.
constexpr int atoms_per_cell(CrystalStructure structure) {
  return structure == CrystalStructure::bcc ? 2 : 4;
}

/// Returns the nearest-neighbour distance of a cubic crystal, in the unit of the lattice constant.
inline double nearest_neighbour(CrystalStructure structure, double lattice_constant) {
  return structure == CrystalStructure::fcc ? lattice_constant * std::sqrt(0.5)
                                            : lattice_constant * std::sqrt(0.75);
}

}  // namespace whipple::md
