// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// All curves of an equation of state (docs/theory/equations_of_state.md, section 4). They ask nothing of a
/// model but its public face: no solid, no dome, no temperature is taken for granted. SI. Everything throws
/// StateError, with the bound that was met, if the asked state is outside the model.

#include "eos/loci/cold_curve.hpp"  // IWYU pragma: export
#include "eos/loci/hugoniot.hpp"    // IWYU pragma: export
#include "eos/loci/impedance.hpp"   // IWYU pragma: export
#include "eos/loci/isentrope.hpp"   // IWYU pragma: export
#include "eos/loci/melting.hpp"     // IWYU pragma: export
#include "eos/loci/thresholds.hpp"  // IWYU pragma: export
