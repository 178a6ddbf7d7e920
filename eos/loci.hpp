// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Includes all curves of an equation of state (docs/theory/equations_of_state.md, section 4). They use only the
/// public interface of a model and assume neither a solid, a dome nor a temperature. SI. All functions throw
/// StateError, with the violated bound, if the requested state is outside the model.

#include "eos/loci/cold_curve.hpp"  // IWYU pragma: export
#include "eos/loci/hugoniot.hpp"    // IWYU pragma: export
#include "eos/loci/impedance.hpp"   // IWYU pragma: export
#include "eos/loci/isentrope.hpp"   // IWYU pragma: export
#include "eos/loci/melting.hpp"     // IWYU pragma: export
#include "eos/loci/thresholds.hpp"  // IWYU pragma: export
