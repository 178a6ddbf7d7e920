// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/audit.hpp"
#include "src/material/material.hpp"

namespace whipple::app {

/// Prints what an audit of the equation of state found, the range in which it is valid and the verdict.
/// @throws InputError with the findings if it is not usable
void print_audit(const Material& material, eos::AuditDepth depth);

}  // namespace whipple::app
