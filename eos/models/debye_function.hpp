// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::eos {

/// Returns the Debye function D(y) = 3/y^3 integral from 0 to y of t^3/(e^t - 1) dt, y >= 0; relative error below
/// 1e-13. Uses a table of quintic Hermite polynomials below y = 40 and the complete integral (D = pi^4/(5 y^3)) above.
double debye_function(double y);

}  // namespace whipple::eos
