// SPDX-License-Identifier: BSD-3-Clause
// Sod, Noh and Sedov with the default scheme: errors in L1, orders, wall heating, shock radius. Bounds say
// how good the scheme is today, not how good it should be; docs/exact_suite.md has all figures.
#include "tests/verification/exact/expect.hpp"
#include "tests/verification/exact/gas_problems.hpp"

namespace whipple::verification::exact {
namespace {

// clang-format off
constexpr Bound gas_bounds[] = {
    {"Sod", "L1 density", 0, {0.012, 0.0072, 0.0076}},
    {"Sod", "L1 velocity", 0, {0.024, 0.014, 0.0088}},
    {"Sod", "L1 pressure", 0, {0.035, 0.021, 0.018}},
    {"Sod", "L1 energy", 0, {0.03, 0.016, 0.0091}},
    {"Sod", "L1 entropy", 0, {0.0054, 0.0046, 0.0055}},
    {"Sod", "e of two cells left of the contact over exact", 1, {0.01, 0.01, 0.01}},
    {"Sod", "e of two cells right of the contact over exact", 1, {0.12, 0.12, 0.12}},
    {"Sod", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Noh, planar", "L1 density", 0, {0.054, 0.041, 0.034}},
    {"Noh, planar", "L1 velocity", 0, {0.033, 0.017, 0.0084}},
    {"Noh, planar", "L1 pressure", 0, {0.13, 0.11, 0.11}},
    {"Noh, planar", "L1 energy", 0, {0.11, 0.091, 0.08}},
    {"Noh, planar", "first cell: rho over exact", 1, {0.36, 0.36, 0.36}},
    {"Noh, planar", "first cell: e over exact", 1, {1.8, 1.8, 1.8}},
    {"Noh, planar", "excess of e in the first ten cells, cells", 0, {1.5, 1.5, 1.5}},
    {"Noh, planar", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Noh, spherical", "L1 density", 0, {0.16, 0.16, 0.2}},
    {"Noh, spherical", "L1 velocity", 0, {1.2, 1.2, 0.99}},
    {"Noh, spherical", "L1 pressure", 0, {0.26, 0.3, 0.35}},
    {"Noh, spherical", "L1 energy", 0, {1.9, 1.6, 1.3}},
    {"Noh, spherical", "rho over exact, 0.08 to 0.15 m", 1, {1.1, 1.1, 0.99}},
    {"Noh, spherical", "p over exact, 0.08 to 0.15 m", 1, {0.94, 0.88, 0.78}},
    {"Noh, spherical", "rho over exact, within 0.05 m", 1, {1.2, 1.1, 1.1}},
    {"Noh, spherical", "e over exact, within 0.05 m", 1, {5.8, 5.8, 4.9}},
    {"Noh, spherical", "energy error", 0, {1e-12, 1e-12, 1e-12}},
    {"Sedov", "L1 density", 0, {0.14, 0.14, 0.13}},
    {"Sedov", "L1 velocity", 0, {0.31, 0.26, 0.19}},
    {"Sedov", "L1 pressure", 0, {0.25, 0.21, 0.19}},
    {"Sedov", "radius of the shock over exact", 1, {0.062, 0.052, 0.038}},
    {"Sedov", "largest density of a shell over that behind the shock", 1, {0.59, 0.54, 0.43}},
    {"Sedov", "kinetic share of the energy", 0.2187, {0.17, 0.13, 0.11}},
    {"Sedov", "energy error", 0, {1e-12, 1e-12, 1e-12}},
};
constexpr Order gas_orders[] = {
    {"Sod", "L1 density", {0.5, -0.2}},
    {"Sod", "L1 velocity", {0.6, 0.5}},
    {"Sod", "L1 pressure", {0.6, 0.1}},
    {"Sod", "L1 energy", {0.7, 0.7}},
    {"Sod", "L1 entropy", {0.1, -0.4}},
    {"Noh, planar", "L1 density", {0.3, 0.1}},
    {"Noh, planar", "L1 velocity", {0.8, 0.8}},
    {"Noh, planar", "L1 pressure", {0.1, 0}},
    {"Noh, planar", "L1 energy", {0.1, 0}},
    {"Noh, spherical", "L1 density", {-0.1, -0.8}},
    {"Noh, spherical", "L1 velocity", {0, 0.2}},
    {"Noh, spherical", "L1 pressure", {-0.7, -0.5}},
    {"Noh, spherical", "L1 energy", {0.4, 0.5}},
    {"Sedov", "L1 density", {0.1, -0.1}},
    {"Sedov", "L1 velocity", {0.5, 0.6}},
    {"Sedov", "L1 pressure", {0.3, 0.1}},
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
