// SPDX-License-Identifier: BSD-3-Clause
// Sod, Noh and Sedov with the default scheme: errors in L1, orders, wall heating, shock radius. Bounds say
// how good the scheme is today, not how good it should be; docs/generated/exact_suite.md has all figures.
#include "tests/verification/exact/expect.hpp"
#include "tests/verification/exact/gas_problems.hpp"

namespace whipple::verification::exact {
namespace {

// clang-format off
constexpr Bound gas_bounds[] = {
    {"Sod", "L1 density", 0, {0.017, 0.011, 0.0082}},
    {"Sod", "L1 velocity", 0, {0.023, 0.014, 0.008}},
    {"Sod", "L1 pressure", 0, {0.044, 0.026, 0.019}},
    {"Sod", "L1 energy", 0, {0.026, 0.015, 0.0084}},
    {"Sod", "L1 entropy", 0, {0.015, 0.0095, 0.0078}},
    {"Sod", "e of two cells left of the contact over exact", 1, {0.02, 0.014, 0.01}},
    {"Sod", "e of two cells right of the contact over exact", 1, {0.078, 0.078, 0.08}},
    {"Sod", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Noh, planar", "L1 density", 0, {0.063, 0.055, 0.054}},
    {"Noh, planar", "L1 velocity", 0, {0.024, 0.013, 0.0092}},
    {"Noh, planar", "L1 pressure", 0, {0.068, 0.059, 0.059}},
    {"Noh, planar", "L1 energy", 0, {0.031, 0.021, 0.019}},
    {"Noh, planar", "first cell: rho over exact", 1, {0.39, 0.39, 0.39}},
    {"Noh, planar", "first cell: e over exact", 1, {0.11, 0.11, 0.11}},
    {"Noh, planar", "excess of e in the first ten cells, cells", 0, {0.74, 0.73, 0.73}},
    {"Noh, planar", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Noh, spherical", "L1 density", 0, {0.17, 0.17, 0.21}},
    {"Noh, spherical", "L1 velocity", 0, {1.1, 1, 0.91}},
    {"Noh, spherical", "L1 pressure", 0, {0.28, 0.31, 0.35}},
    {"Noh, spherical", "L1 energy", 0, {1.5, 1.4, 1.2}},
    {"Noh, spherical", "rho over exact, 0.08 to 0.15 m", 1, {1.1, 1, 0.93}},
    {"Noh, spherical", "p over exact, 0.08 to 0.15 m", 1, {0.93, 0.86, 0.76}},
    {"Noh, spherical", "rho over exact, within 0.05 m", 1, {1.1, 1.1, 0.97}},
    {"Noh, spherical", "e over exact, within 0.05 m", 1, {1.3, 1.3, 1.5}},
    {"Noh, spherical", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Sedov", "L1 density", 0, {0.11, 0.092, 0.087}},
    {"Sedov", "L1 velocity", 0, {0.25, 0.2, 0.15}},
    {"Sedov", "L1 pressure", 0, {0.18, 0.14, 0.13}},
    {"Sedov", "radius of the shock over exact", 1, {0.034, 0.027, 0.03}},
    {"Sedov", "largest density of a shell over that behind the shock", 1, {0.74, 0.67, 0.59}},
    {"Sedov", "kinetic fraction of the energy", 0.2187, {0.022, 0.028, 0.044}},
    {"Sedov", "energy error", 0, {1e-12, 1e-12, 1e-12}},
};
constexpr Order gas_orders[] = {
    {"Sod", "L1 density", {0.5, -0.2}},
    {"Sod", "L1 velocity", {0.6, 0.5}},
    {"Sod", "L1 pressure", {0.6, 0}},
    {"Sod", "L1 energy", {0.6, 0.7}},
    {"Sod", "L1 entropy", {0.4, -0.1}},
    {"Noh, planar", "L1 density", {-0.1, -0.1}},
    {"Noh, planar", "L1 velocity", {0.3, -0.1}},
    {"Noh, planar", "L1 pressure", {-0.1, -0.1}},
    {"Noh, planar", "L1 energy", {0, -0.2}},
    {"Noh, spherical", "L1 density", {-0.1, -0.7}},
    {"Noh, spherical", "L1 velocity", {0, 0.1}},
    {"Noh, spherical", "L1 pressure", {-0.5, -0.4}},
    {"Noh, spherical", "L1 energy", {0.1, 0.3}},
    {"Sedov", "L1 density", {0.3, -0.1}},
    {"Sedov", "L1 velocity", {0.6, 0.6}},
    {"Sedov", "L1 pressure", {0.6, -0.1}},
};
// clang-format on

constexpr std::array<int, 3> sod_cells{100, 200, 400}, noh_cells{100, 200, 400}, octant_cells{12, 16, 24};

TEST(ExactGas, SodsShockTube) { expect_convergence("Sod", sod, sod_cells, false, gas_bounds, gas_orders); }
TEST(ExactGas, NohAtAWall) {
  expect_convergence("Noh, planar", noh_planar, noh_cells, false, gas_bounds, gas_orders);
}
TEST(ExactGas, NohAtACentre) {
  expect_convergence("Noh, spherical", noh_spherical, octant_cells, false, gas_bounds, gas_orders);
}
TEST(ExactGas, SedovsBlast) {
  expect_convergence("Sedov", sedov, octant_cells, false, gas_bounds, gas_orders);
}

TEST(ExactGasFine, SodsShockTube) { expect_convergence("Sod", sod, sod_cells, true, gas_bounds, gas_orders); }
TEST(ExactGasFine, NohAtAWall) {
  expect_convergence("Noh, planar", noh_planar, noh_cells, true, gas_bounds, gas_orders);
}
TEST(ExactGasFine, NohAtACentre) {
  expect_convergence("Noh, spherical", noh_spherical, octant_cells, true, gas_bounds, gas_orders);
}
TEST(ExactGasFine, SedovsBlast) {
  expect_convergence("Sedov", sedov, octant_cells, true, gas_bounds, gas_orders);
}

}  // namespace
}  // namespace whipple::verification::exact
