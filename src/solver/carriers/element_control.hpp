// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/case/case.hpp"
#include "src/fem/step.hpp"

/// Conversion of the options of a case for elements to arguments of the element functions.
namespace whipple::solver {

/// Returns the control of hourglass modes.
inline fem::HourglassControl hourglass(const cases::Discretization& control) {
  return {control.hourglass, control.hourglass_coefficient};
}

/// Returns the coefficients of the artificial viscosity.
inline fem::ViscosityCoefficients viscosity(const cases::ArtificialViscosity& control) {
  return {.linear = std::max(control.linear, control.expansion), .quadratic = control.quadratic};
}

}  // namespace whipple::solver
