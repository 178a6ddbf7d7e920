// SPDX-License-Identifier: BSD-3-Clause
// The foam of Deshpande and Fleck: returns, hydrostatic and uniaxial compression, closing of the pores
// (docs/theory/foam.md).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/polynomial.hpp"
#include "src/core/base/error.hpp"
#include "src/material/failure/viscous_void_growth.hpp"
#include "src/material/strength/deshpande_fleck.hpp"
#include "tests/unit/foam_support.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;
using strength::DeshpandeFleck;
using strength::DeshpandeFleckModel;

constexpr double solid_density = 2700.0, bulk = 70e9;

/// Aluminium foam of 510 kg/m^3 (docs/theory/foam.md, section 2).
DeshpandeFleck aluminium() {
  DeshpandeFleck law;
  law.youngs_modulus = 5.562e9;
  law.poisson_ratio = 0.3;
  law.relative_density = 510.0 / solid_density;
  law.plateau_stress = 14.83e6;
  law.densification_stress = 1e6;
  law.densification_exponent = 12.0;
  law.solid_yield_stress = 200e6;
  return law;
}

std::shared_ptr<const eos::EquationOfState> solid() {
  eos::PolynomialConstants constants;
  constants.reference_density = solid_density;
  constants.C1 = bulk;
  constants.heat_capacity = 900;
  return std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants);
}
Material foam_of(const DeshpandeFleck& law) {
  return make_material("foam", solid(), std::make_shared<const DeshpandeFleckModel>(law));
}

constexpr UpdateSettings settings{
    .time_step = 1e-7, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

/// Holds one point for `crush`.
struct Point {
  double q, p, distension, strain, modulus = 2.14e9, stiffness = 15e9;
  double increment = 0.0, work = 0.0;

  void crush(const DeshpandeFleck& law) { crush_point(DeshpandeFleckModel(law), *this); }
};

// Without hardening the return is the closest point of the ellipse in the norm of the elastic energy.
TEST(DeshpandeFleck, RandomReturnsMinimiseTheEnergyNorm) {
  DeshpandeFleck law = aluminium();
  law.densification_stress = 0.0;
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    law.plastic_poisson_ratio = 0.4 * unit(generator);
    const double square = law.shape(), a = 1.0 + square / 9.0, y = law.plateau_stress;
    Point point{.q = 5.0 * y * unit(generator),
                .p = 6.0 * y * (unit(generator) - 0.4),
                .distension = 5.0,
                .strain = 0.1};
    const double q = point.q, p = point.p, d = point.distension;
    if (std::sqrt((q * q + square * p * p) / a) < y) continue;
    point.crush(law);
    // pressure after the return, from the change of the distension at constant density
    const double after = p + point.stiffness * std::log(point.distension / d);
    EXPECT_NEAR(std::sqrt((point.q * point.q + square * after * after) / a), y, 1e-9 * y);
    const auto norm = [&](double q1, double p1) {
      return (q1 - q) * (q1 - q) / (6.0 * point.modulus) + (p1 - p) * (p1 - p) / (2.0 * point.stiffness);
    };
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 100000; ++i) {
      const double angle = std::numbers::pi * (i / 100000.0 - 0.5);
      least = std::min(least,
                       norm(y * std::sqrt(a) * std::cos(angle), y * std::sqrt(a / square) * std::sin(angle)));
    }
    EXPECT_LT(norm(point.q, after), least * (1.0 + 1e-6)) << n;
    EXPECT_GE(point.work, 0.0);
    EXPECT_NEAR(point.work, y * point.increment, 1e-9 * point.work);
  }
}

// Uniaxial stress without lateral plastic flow (nu_p = 0): q = 3 p = Y.
TEST(DeshpandeFleck, WithoutLateralFlowTheStressOfABarIsTheFlowStress) {
  const DeshpandeFleck law = aluminium();
  EXPECT_DOUBLE_EQ(law.shape(), 4.5);
  EXPECT_NEAR(law.densification_strain(), std::log(solid_density / 510.0), 1e-12);
  const double y = law.strength_at(0.2);
  Point below{.q = y * (1.0 - 1e-9), .p = y / 3.0 * (1.0 - 1e-9), .distension = 4.0, .strain = 0.2};
  below.crush(law);
  EXPECT_EQ(below.increment, 0.0);
  Point above{.q = y * (1.0 + 1e-6), .p = y / 3.0 * (1.0 + 1e-6), .distension = 4.0, .strain = 0.2};
  above.crush(law);
  EXPECT_GT(above.increment, 0.0);
}

// p = Y(e) sqrt(A)/a with e = sqrt(A)/a ln(alpha_0/alpha), until the pores are closed; then the solid.
TEST(DeshpandeFleck, HydrostaticCompressionFollowsTheHardeningCurveToTheSolid) {
  const DeshpandeFleck law = aluminium();
  const Material material = foam_of(law);
  MaterialPoints points = points_of(material, 1);
  EXPECT_NEAR(points.mass[0] / points.volume[0], 510.0, 1e-9);
  EXPECT_NEAR(points.pressure[0], 0.0, 1e-3);
  const double ratio = std::sqrt((1.0 + law.shape() / 9.0) / law.shape());
  Matrix3 before = Matrix3::Zero();
  const Matrix3 gradient = -1e3 * Matrix3::Identity();  // 3e-4 in volume per step
  int yielding = 0;
  double lowest = 1e9;
  for (int n = 0; n < 6000; ++n) {
    const MaterialReport report = step_with_work(material, points, gradient, settings, before);
    ASSERT_TRUE(report.valid());
    before = gradient;
    const double distension = points.history.scalar("distension")[0];
    EXPECT_GE(report.plastic_work, 0.0);
    lowest = std::min(lowest, distension);
    if (distension > 1.001 && points.plastic_strain[0] > 0.01) {
      const double strain = ratio * std::log(solid_density / 510.0 / distension);
      EXPECT_NEAR(points.plastic_strain[0], strain, 1e-3 * strain);
      EXPECT_NEAR(points.pressure[0], ratio * law.strength_at(strain), 1e-3 * points.pressure[0]) << n;
      ++yielding;
    } else if (distension == 1.0) {
      const double density = points.mass[0] / points.volume[0];
      EXPECT_NEAR(points.pressure[0], bulk * (density / solid_density - 1.0), 1e-6 * bulk);
    }
    EXPECT_NEAR(points.deviatoric_stress[0].matrix().norm(), 0.0, 1.0);
  }
  EXPECT_GT(yielding, 1000);
  EXPECT_EQ(lowest, 1.0);
}

// In uniaxial strain the stress stays on the surface, flow is normal to it, and what is dissipated is Y de.
TEST(DeshpandeFleck, UniaxialStrainStaysOnTheSurfaceWithNormalFlow) {
  const DeshpandeFleck law = aluminium();
  const Material material = foam_of(law);
  MaterialPoints points = points_of(material, 1);
  const double square = law.shape(), a = 1.0 + square / 9.0;
  Matrix3 before = Matrix3::Zero(), gradient = Matrix3::Zero();
  gradient(0, 0) = -4e3;
  double plastic = 0.0, expected = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double strain = points.plastic_strain[0], distension = points.history.scalar("distension")[0];
    const MaterialReport report = step_with_work(material, points, gradient, settings, before);
    before = gradient;
    const double alpha = points.history.scalar("distension")[0];
    if (alpha < 1.01) break;
    if (strain < 0.01) continue;
    const double q = std::sqrt(1.5) * points.deviatoric_stress[0].matrix().norm(), p = points.pressure[0];
    const double y = law.strength_at(points.plastic_strain[0]), grown = points.plastic_strain[0] - strain;
    EXPECT_NEAR(std::sqrt((q * q + square * p * p) / a), y, 2e-3 * y) << n;
    EXPECT_NEAR(std::log(distension / alpha), grown * square * p / (a * y), 5e-3 * grown);
    plastic += report.plastic_work;
    expected += y * grown * points.volume[0];
  }
  EXPECT_GT(plastic, 0.0);
  EXPECT_NEAR(plastic, expected, 1e-3 * expected);
  // What was dissipated is heat; the rest of the energy is elastic, a thousandth of it.
  const double heat = (points.temperature[0] - 300.0) * 900.0 * points.mass[0];
  EXPECT_NEAR(heat, plastic, 0.02 * plastic);
}

/// Returns the work (J) that a point took on a path F(t) by either scheme.
template <class Path>
double work_on(const Material& material, int steps, bool from_grid, Path path) {
  MaterialPoints points = points_of(material, 1);
  const double start = points.specific_internal_energy[0];
  Matrix3 before = Matrix3::Zero();
  for (int n = 0; n < steps; ++n) {
    const Matrix3 gradient =
        gradient_between(path(double(n) / steps), path(double(n + 1) / steps), settings.time_step);
    if (from_grid) {
      step_with_work(material, points, gradient, settings, before);
    } else {
      update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), settings);
    }
    before = gradient;
  }
  return (points.specific_internal_energy[0] - start) * points.mass[0];
}

// A closed path never gives more than it took; by both schemes of the energy it takes the same.
TEST(DeshpandeFleck, ClosedPathsTakeWork) {
  const Material material = foam_of(aluminium());
  std::mt19937_64 generator(3);
  for (int n = 0; n < 8; ++n) {
    const Matrix3 way = 0.15 * random_matrix(generator, 1.0);
    const auto path = [&](double t) {
      const double s = std::sin(std::numbers::pi * t);
      return Matrix3(Matrix3::Identity() + s * s * way);
    };
    const double work = work_on(material, 4000, true, path);
    EXPECT_GT(work, 0.0) << n;
    EXPECT_NEAR(work_on(material, 4000, false, path), work, 0.01 * work) << n;
  }
}

TEST(DeshpandeFleck, PartsThatOpenOrKeepTheEnergyOtherwiseAreRefused) {
  Material material = foam_of(aluminium());
  EXPECT_THROW(set_taylor_quinney(material, 0.5), InputError);
  failure::ViscousVoidGrowth voids;
  EXPECT_THROW(
      make_material("foam", solid(), std::make_shared<const DeshpandeFleckModel>(aluminium()),
                    {std::make_shared<const failure::CriterionModel<failure::ViscousVoidGrowth>>(voids)}),
      InputError);
}

TEST(DeshpandeFleck, SmallStrainsAreElastic) {
  const Material material = foam_of(aluminium());
  MaterialPoints points = points_of(material, 1);
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = -1e3;
  for (int n = 0; n < 5; ++n) step_with_work(material, points, gradient, settings);
  EXPECT_EQ(points.plastic_strain[0], 0.0);
  gradient(0, 0) = 1e3 / (1.0 - 5e-4);
  for (int n = 0; n < 5; ++n) step_with_work(material, points, gradient, settings);
  EXPECT_NEAR(points.pressure[0], 0.0, 1e-3 * 14.83e6);
}

TEST(DeshpandeFleck, TakesTheEquationOfStateOfASolid) {
  EXPECT_THROW(make_material("wrong", std::make_shared<LinearInEnergy>(),
                             std::make_shared<const DeshpandeFleckModel>(aluminium())),
               InputError);
}

}  // namespace
}  // namespace whipple
