// SPDX-License-Identifier: BSD-3-Clause
// Elastic-plastic piston (two waves of uniaxial strain) and angular momentum in oblique impacts, with the
// default scheme. Bounds say how good the scheme is today, not how good it should be; docs/generated/exact_suite.md has
// all figures.
#include "tests/verification/exact/expect.hpp"
#include "tests/verification/exact/oblique_impact.hpp"
#include "tests/verification/exact/piston.hpp"

namespace whipple::verification::exact {
namespace {

// Piston: 50, 100 and 200 cells; oblique impacts: 1, 0.75 and 0.5 mm.
// clang-format off
constexpr Bound solid_bounds[] = {
    {"piston", "L1 density", 0, {0.0038, 0.0025, 0.0016}},
    {"piston", "L1 velocity", 0, {0.053, 0.034, 0.021}},
    {"piston", "L1 pressure", 0, {0.059, 0.039, 0.025}},
    {"piston", "L1 s_xx", 0, {0.093, 0.056, 0.036}},
    {"piston", "L1 energy", 0, {0.094, 0.061, 0.038}},
    {"piston", "speed of the elastic front, m/s", 6586, {480, 240, 120}},
    {"piston", "speed of the plastic front, m/s", 6005, {200, 150, 78}},
    {"piston", "stress behind the elastic front over exact", 1, {0.19, 0.12, 0.034}},
    {"piston", "stress behind the plastic front over exact", 1, {0.01, 0.01, 0.01}},
    {"piston", "e behind the plastic front over exact", 1, {0.046, 0.029, 0.015}},
    {"piston", "e of the first cell over exact", 1, {0.099, 0.11, 0.11}},
    {"piston", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"cubes of aluminium, 1 km/s", "change of the angular momentum over that at the start", 0, {0.0003, 0.00037, 0.00021}},
    {"cubes of aluminium, 1 km/s", "largest change on the way", 0, {0.0011, 0.00067, 0.0003}},
    {"cubes of aluminium, 1 km/s", "particles lost", 0, {0.5, 0.5, 0.5}},
    {"cubes of aluminium, 1 km/s", "largest momentum error", 0, {1e-12, 1e-12, 1e-12}},
    {"cubes of aluminium, 1 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"cubes of aluminium, 1 km/s, turned", "change of the angular momentum over that at the start", 0, {0.0017, 0.00084, 0.00037}},
    {"cubes of aluminium, 1 km/s, turned", "largest change on the way", 0, {0.0017, 0.00084, 0.00037}},
    {"cubes of aluminium, 1 km/s, turned", "particles lost", 0, {0.5, 0.5, 0.5}},
    {"cubes of aluminium, 1 km/s, turned", "largest momentum error", 0, {1e-12, 1e-12, 1e-12}},
    {"cubes of aluminium, 1 km/s, turned", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"spheres of aluminium, 3 km/s", "change of the angular momentum over that at the start", 0, {0.032, 0.017, 0.0063}},
    {"spheres of aluminium, 3 km/s", "largest change on the way", 0, {0.032, 0.017, 0.0063}},
    {"spheres of aluminium, 3 km/s", "particles lost", 0, {0.5, 0.5, 0.5}},
    {"spheres of aluminium, 3 km/s", "largest momentum error", 0, {1e-12, 1e-12, 1e-12}},
    {"spheres of aluminium, 3 km/s", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"spheres of aluminium, 3 km/s, turned", "change of the angular momentum over that at the start", 0, {0.015, 0.0078, 0.0027}},
    {"spheres of aluminium, 3 km/s, turned", "largest change on the way", 0, {0.017, 0.0086, 0.003}},
    {"spheres of aluminium, 3 km/s, turned", "particles lost", 0, {0.5, 0.5, 0.5}},
    {"spheres of aluminium, 3 km/s, turned", "largest momentum error", 0, {1e-12, 1e-12, 1e-12}},
    {"spheres of aluminium, 3 km/s, turned", "largest energy error", 0, {1e-12, 1e-12, 1e-12}},
};
constexpr Order solid_orders[] = {
    {"piston", "L1 density", {0.4, 0.4}},
    {"piston", "L1 velocity", {0.6, 0.6}},
    {"piston", "L1 pressure", {0.4, 0.4}},
    {"piston", "L1 s_xx", {0.7, 0.5}},
    {"piston", "L1 energy", {0.4, 0.4}},
};
// clang-format on

constexpr std::array<int, 3> piston_cells{50, 100, 200};
constexpr std::array<double, 3> oblique_cells{1e-3, 0.75e-3, 0.5e-3};

TEST(ExactSolid, ElasticPlasticPiston) {
  expect_convergence("piston", elastic_plastic_piston, piston_cells, false, solid_bounds, solid_orders);
}
TEST(ExactSolidFine, ElasticPlasticPiston) {
  expect_convergence("piston", elastic_plastic_piston, piston_cells, true, solid_bounds, solid_orders);
}

void expect_angular_momentum(const ObliqueImpact& impact, bool fine) {
  for (const std::string field : {"", "turned"}) {
    expect_convergence(impact.name + (field.empty() ? "" : ", " + field),
                       [&](double cell) { return run(impact, cell, field); }, oblique_cells, fine,
                       solid_bounds, {});
  }
}

TEST(ExactSolid, ObliqueCubesKeepTheirAngularMomentum) { expect_angular_momentum(oblique_cubes(), false); }
TEST(ExactSolid, ObliqueSpheresKeepTheirAngularMomentum) {
  expect_angular_momentum(oblique_spheres(), false);
}
TEST(ExactSolidFine, ObliqueCubesKeepTheirAngularMomentum) { expect_angular_momentum(oblique_cubes(), true); }
TEST(ExactSolidFine, ObliqueSpheresKeepTheirAngularMomentum) {
  expect_angular_momentum(oblique_spheres(), true);
}

}  // namespace
}  // namespace whipple::verification::exact
