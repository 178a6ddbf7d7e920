// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/material.hpp"

namespace whipple::app {

/// `whipple eos audit MATERIAL`: prints what the full audit of the equation of state found, the range in
/// which it is valid and the verdict.
/// @throws InputError with the findings if it is not usable
void print_audit(const Material& material);

}  // namespace whipple::app
