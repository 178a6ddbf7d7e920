// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/verification/contact_problems.hpp"

/// Problems of load steps without inertia.
namespace whipple::verification {

/// Linear elastic material with Poisson's ratio 0 and E = 1 MPa.
inline std::string soft_column() {
  return write_material("quasi_static_column", R"toml(
name = "column"
source = "test"
[eos]
model = "mie_gruneisen"
source = "K = E/3"
reference_density = "80 kg/m^3"
hugoniot_intercept = "64.549722436790287 m/s"
hugoniot_slope = 1.0
gruneisen = 1e-6
heat_capacity = "1000 J/(kg K)"
[strength]
model = "elastic"
source = "G = E/2"
shear_modulus = "500 kPa"
)toml");
}

}  // namespace whipple::verification
