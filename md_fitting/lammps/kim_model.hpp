// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "md_fitting/lammps/measured_model.hpp"

namespace whipple::md {

/// Returns whether a name is an extended KIM identifier: NAME__MO_123456789012_000, or SM for simulator models. The
/// last number is the version; the content behind an identifier never changes.
bool is_kim_identifier(const std::string& name);

/// Returns the commands of a model of the OpenKIM repository (Tadmor et al., JOM 63 (2011) 17) for one
/// element.
/// @throws InputError if LAMMPS has no KIM package, or if the model is not installed (naming those for the
/// element).
Interactions kim_interactions(const std::string& identifier, const std::string& element);

}  // namespace whipple::md
