// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "md_fitting/lammps/measured_model.hpp"

namespace whipple::md {

/// Holds a LAMMPS pair style with its coefficients, as given in a plan: "adp" and {"* * Ni.adp Ni"}.
struct PairStyle {
  std::string style;                      ///< with its arguments; empty: the potential is specified otherwise
  std::vector<std::string> coefficients;  ///< arguments of `pair_coeff`, one entry per command
};

/// Holds the interactions of a pair style, and the SHA-256 of the style, its coefficients and the contents of all
/// files in them.
struct PairInteractions {
  Interactions interactions;
  std::string hash;
};

/// Returns the commands of a pair style. A word of the coefficients that names a file in the folder of the plan or
/// of the LAMMPS potentials is replaced by its path.
/// @throws InputError if LAMMPS was built without the style (listing similar names), if it is a style whose tables
/// the program reads itself (eam, eam/alloy, eam/fs: such files are specified by `potential`), or if a word looks
/// like a file name and there is no such file.
PairInteractions pair_interactions(const PairStyle& pair, const std::string& name,
                                   const std::filesystem::path& folder);

}  // namespace whipple::md
