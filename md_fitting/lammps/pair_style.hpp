// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "md_fitting/lammps/measured_model.hpp"

namespace whipple::md {

/// A pair style of LAMMPS with its coefficients, as a plan gives them: "adp" and {"* * Ni.adp Ni"}.
struct PairStyle {
  std::string style;                      ///< with its arguments; empty: the potential is named otherwise
  std::vector<std::string> coefficients;  ///< what follows `pair_coeff`, one command each
};

/// Interactions of a pair style, and the SHA-256 of the style, its coefficients and the content of all files
/// in them.
struct PairInteractions {
  Interactions interactions;
  std::string hash;
};

/// Returns the commands of a pair style. A word of the coefficients that names a file in the folder of the
/// plan or of LAMMPS' potentials becomes its path.
/// @throws InputError if LAMMPS was built without the style (naming those nearest in name), if its tables are
/// ones that the program reads itself (eam, eam/alloy, eam/fs: such files are named by `potential`), or if a
/// word looks like a file and there is none.
PairInteractions pair_interactions(const PairStyle& pair, const std::string& name,
                                   const std::filesystem::path& folder);

}  // namespace whipple::md
