// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "eos/catalogue.hpp"

namespace whipple::eos {

/// Returns the catalogue of equations of state, extended by models stored in files and simulated crystals. The
/// companions of a declared model are the relative names of its files.
/// @param folder  base of relative file names
Catalogue<ModelEntry> all_models(const std::filesystem::path& folder = {});

}  // namespace whipple::eos
