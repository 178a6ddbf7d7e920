// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace whipple {

/// Returns the tables of a material file with their keys, for `whipple describe material`; the constants of models are
/// described with their models.
std::string describe_material();

/// Returns the JSON schema of material files, for editors (src/core/input/schema.hpp): the constants of every
/// model of the catalogues.
std::string material_schema();

/// Returns the keys that the root of a material file may have.
std::vector<std::string> material_keys();

}  // namespace whipple
