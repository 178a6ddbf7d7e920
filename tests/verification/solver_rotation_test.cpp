// SPDX-License-Identifier: BSD-3-Clause
// Rotation over many turns: sensitive to an unbalanced transfer of the affine field.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

/// Holds the relative changes in ten turns.
struct TenTurns {
  double angular_momentum, internal_energy, energy_error;
};

/// Computes an elastic sphere of radius 3 cells with a rim speed of 300 m/s.
TenTurns ten_turns(const std::string& shape, const std::string& affine_field) {
  constexpr double radius = 3e-3, rim = 300.0;
  const double omega = rim / radius, end = 10 * 2 * std::numbers::pi / omega;
  Method method;
  method.shape_function = shape;
  method.options = "affine_field = \"" + affine_field + "\"\n";
  char body[512];
  std::snprintf(body, sizeof body,
                "[domain]\nlower = [-0.01, -0.01, -0.01]\nupper = [0.01, 0.01, 0.01]\ncell_size = "
                "0.001\n[[body]]\nname = \"sphere\"\nmaterial = \"%s\"\nangular_velocity = [0, 0, "
                "%.17g]\nshape = { sphere = { center = [0.00023, 0.000299, 0.000161], radius = 0.003 } }\n",
                elastic_aluminium().c_str(), omega);
  solver::Simulation simulation(cases::read_case_text(method.time_toml(end) + method.toml() +
                                                          "[output]\nmaximum_energy_error = 1e9\n" + body,
                                                      "rotation.toml"),
                                parallel::world());
  const double inertia = transfer::affine_inertia(simulation.setup().transfer.shape_function, 1e-3);
  const auto angular_momentum = [&] {
    const Particles& q = simulation.particles();
    double sum = 0;
    for (std::size_t p = 0; p < q.size(); ++p) {
      const Matrix3& c = q.affine_velocity[p];
      sum += q.mass[p] * (q.position[p].cross(q.velocity[p])[2] + inertia * (c(1, 0) - c(0, 1)));
    }
    return sum;
  };
  const double before = angular_momentum(), energy = simulation.totals().energy();
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));
  const TenTurns change{angular_momentum() / before - 1, simulation.totals().internal_energy / energy,
                        watch.worst};
  std::printf("%s, affine field %s, ten turns: angular momentum %+.2e, internal energy %.2e, %lld steps\n",
              shape.c_str(), affine_field.c_str(), change.angular_momentum, change.internal_energy,
              static_cast<long long>(simulation.state().step));
  return change;
}

TEST(Sphere, KeepsItsAngularMomentumOverTenTurns) {
  for (const char* shape : {"quadratic_bspline", "cubic_bspline"}) {
    for (const char* affine_field : {"deformed", "turned"}) {
      const bool turned = std::string(affine_field) == "turned";
      const TenTurns change = ten_turns(shape, affine_field);
      EXPECT_LT(std::abs(change.angular_momentum), turned ? 2e-4 : 2e-3);
      EXPECT_LT(change.internal_energy, turned ? 2.5e-3 : 1e-2);  // elastic stretch, 1e-3, included
      EXPECT_LT(change.energy_error, 1e-11);
    }
  }
}

}  // namespace
}  // namespace whipple::verification
