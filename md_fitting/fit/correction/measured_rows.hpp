// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "md_fitting/fit/correction/correction_data.hpp"
#include "md_fitting/fit/joint/measured_curves.hpp"

namespace whipple::fit {

/// Collects what measured isotherms, Hugoniots, isentropes and melting lines say about the corrections, linear about
/// GRAY: the change of the ordinate of each curve at its abscissa (docs/theory/fit.md, section 10). The scale of each
/// table is a deviation. Points in mixtures of phases, of porous material, and of other kinds of curve are left out.
/// @param constants  of the metal, with electrons
CorrectionData measured_rows(std::span<const MeasuredCurve> curves, const eos::GrayConstants& constants);

}  // namespace whipple::fit
