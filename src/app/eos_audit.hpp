// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/audit.hpp"
#include "src/material/material.hpp"

namespace whipple::app {

/// Prints the findings of an audit of the equation of state, its range of validity and the verdict.
/// @throws InputError with the findings if it is not usable
void print_audit(const Material& material, eos::AuditDepth depth);

}  // namespace whipple::app
