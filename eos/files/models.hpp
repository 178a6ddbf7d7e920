// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "eos/catalogue.hpp"

namespace whipple::eos {

/// Returns the catalogue of equations of state together with the models that live in files, and that of simulated
/// crystals. The companions of a declared model are the relative names of its files.
/// @param folder  that relative names of files refer to
Catalogue<ModelEntry> all_models(const std::filesystem::path& folder = {});

}  // namespace whipple::eos
