// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "eos/catalogue.hpp"

namespace whipple::eos {

/// The catalogue of equations of state together with the models that live in files.
/// @param folder that relative names of files refer to
/// @param used   receives the relative names of the files that a declared model reads; null: not asked for
std::vector<ModelEntry> all_models(const std::filesystem::path& folder = {},
                                   std::vector<std::filesystem::path>* used = nullptr);

}  // namespace whipple::eos
