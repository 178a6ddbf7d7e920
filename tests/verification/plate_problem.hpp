// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
/// A plate of elements, clamped at both ends, under a uniform load.
namespace plate_problem {

inline constexpr double span = 1.0, thickness = 0.05, density = 2700.0, gravity = 9.81;  // m, kg/m^3, m/s^2
inline constexpr double young = 67.5e9, poisson = 0.34;                                  // Pa
inline constexpr double shear = 0.5 * young / (1.0 + poisson), bulk = young / (3.0 * (1.0 - 2.0 * poisson));
inline constexpr double water = 1000.0 * gravity * 2.0;  // Pa: 2 m

/// Returns the deflection of the middle under a pressure (Pa) by Timoshenko, m: q L^4/(384 D) + q L^2/(8 k G h), with
/// D = E h^3/(12 (1 - nu^2)), k = 5/6.
inline double timoshenko(double load) {
  const double bending = young * thickness * thickness * thickness / (12.0 * (1.0 - poisson * poisson));
  return load * std::pow(span, 4) / (384.0 * bending) +
         load * span * span / (8.0 * 5.0 / 6.0 * shear * thickness);
}

inline std::string metal() {
  return write_material("plate_metal", R"toml(
name = "aluminium of the plate"
source = "test"
[eos]
model = "polynomial"
source = "test"
reference_density = "2700 kg/m^3"
C1 = ")toml" + number(bulk) + R"toml( Pa"
C4 = 0
C5 = 0
C6 = 0
heat_capacity = "900 J/(kg K)"
[strength]
source = "test"
model = "elastic"
shear_modulus = ")toml" + number(shear) + " Pa\"\n");
}

/// Half of the plate, from its middle at a mirror plane to its clamped end.
inline cases::Case plate(int through, bool with_weight, double end) {
  const double size = thickness / through;
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{.linear_viscosity = 0.0, .quadratic_viscosity = 0.0}.toml() +
          "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = " + vector3({0, -thickness, 0}) +
          "\nupper = " + vector3({0.5 * span + thickness, 2 * thickness, size}) +
          "\ncell_size = " + number(size) +
          "\nboundary = { x_lower = \"symmetry\", z_lower = \"symmetry\", z_upper = \"symmetry\" "
          "}\n[damping]\n"
          "coefficient = 0.8\n" +
          (with_weight ? "[gravity]\nacceleration = [0, -9.81, 0]\n" : "") +
          "[[load]]\nforce = " + vector3({0, -water * 0.5 * span * size, 0}) + "\n" +
          BodyOptions{"plate", metal(), box({0, 0, 0}, {0.5 * span, thickness, size}), Vector3::Zero(),
                      "discretization = { method = \"finite_elements\", element = \"b_bar\" }\n"
                      "[[body.node_condition]]\nlower = " +
                          vector3({0.4999 * span, -1, -1}) + "\nupper = " + vector3({0.5001 * span, 1, 1}) +
                          "\ndirections = [\"x\", \"y\", \"z\"]\n"}
              .toml(),
      "plate.toml");
}

struct Rest {
  double deflection, moving, energy;  // m; kinetic over strain energy at the end; largest error
};

inline Rest settle(int through, bool with_weight) {
  constexpr double end = 18e-3;  // five periods
  solver::Simulation simulation(plate(through, with_weight, end), parallel::world());
  const fem::Nodes start = simulation.meshes()[0].nodes;
  EnergyWatch watch;
  int steps = 0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    watch(s);
    ++steps;
  });
  double sum = 0.0;
  int nodes = 0;
  const fem::Nodes& now = simulation.meshes()[0].nodes;
  for (std::size_t a = 0; a < now.size(); ++a) {
    const Vector3& x = start.position[a];
    if (x[0] > 1e-9 || std::abs(x[1] - 0.5 * thickness) > 1e-9) continue;
    sum += x[1] - now.position[a][1];
    ++nodes;
  }
  const solver::Ledger& ledger = simulation.state().ledger;
  const Rest rest{sum / nodes, simulation.totals().kinetic_energy / ledger.external_work, watch.worst};
  const double exact = timoshenko(water + (with_weight ? density * gravity * thickness : 0.0));
  std::printf(
      "plate, %d elements through it, %s: %.3f um, Timoshenko %.3f um, %+.2f %%; kinetic %.1e of the work, "
      "%d steps\n",
      through, with_weight ? "with its weight" : "water alone", 1e6 * rest.deflection, 1e6 * exact,
      100.0 * (rest.deflection / exact - 1.0), rest.moving, steps);
  return rest;
}

}  // namespace plate_problem
}  // namespace whipple::verification
