// SPDX-License-Identifier: BSD-3-Clause
// Foam that hardens with its compaction: returns, compression and tension from all sides, uniaxial strain, closing of the
// pores (docs/theory/foam.md, section 4).
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
#include "src/material/strength/crushable_foam.hpp"
#include "tests/unit/foam_support.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple::crushable_foam_test {
namespace {

using namespace material_test;
using strength::CrushableFoam;
using strength::CrushableFoamModel;

constexpr double solid_density = 1050.0, bulk = 3e9, relative = 0.1;

/// Polystyrene foam of 105 kg/m^3 with constants of the right size.
CrushableFoam polystyrene() {
  CrushableFoam law;
  law.youngs_modulus = 30e6;
  law.poisson_ratio = 0.1;
  law.relative_density = relative;
  law.hydrostatic_yield = 0.6e6;
  law.uniaxial_yield = 0.8e6;
  law.tensile_yield = 0.15e6;
  law.linear_hardening = 0.5e6;
  law.densification_stress = 2e6;
  law.densification_exponent = 4.0;
  law.solid_yield_stress = 40e6;
  return law;
}

Material foam_of(const CrushableFoam& law) {
  eos::PolynomialConstants constants;
  constants.reference_density = solid_density;
  constants.C1 = bulk;
  constants.heat_capacity = 1300;
  return make_material("foam", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<const CrushableFoamModel>(law));
}

constexpr UpdateSettings quiet{
    .time_step = 1e-7, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

/// Holds one point for `crush`.
struct Trial {
  double q = 0.0, p = 0.0, distension = 1.0, strain = 0.0, modulus = 14e6, stiffness = 300e6;
  double increment = 0.0, work = 0.0;

  void crush(const CrushableFoam& law) { crush_point(CrushableFoamModel(law), *this); }
};

/// What keeps a state within the ellipse (<= 0), Pa^2.
double excess(const CrushableFoam& law, double q, double p, double crush_pressure) {
  return q * q + law.shape() * (p - crush_pressure) * (p + law.tensile_yield);
}

TEST(CrushableFoam, YieldsAtTheThreeStressesThatItsConstantsName) {
  const CrushableFoam law = polystyrene();
  const double p0 = law.hydrostatic_yield, c = law.uniaxial_yield, scale = p0 * p0;
  EXPECT_NEAR(excess(law, c, c / 3.0, p0), 0.0, 1e-12 * scale);
  EXPECT_NEAR(excess(law, 0.0, p0, p0), 0.0, 1e-12 * scale);
  EXPECT_NEAR(excess(law, 0.0, -law.tensile_yield, p0), 0.0, 1e-12 * scale);
  EXPECT_DOUBLE_EQ(law.strength_at(1.0 / relative), p0);
  for (const double factor : {1.0 - 1e-6, 1.0 + 1e-6}) {
    Trial bar{.q = c * factor, .p = c / 3.0 * factor, .distension = 1.0 / relative};
    bar.crush(law);
    EXPECT_EQ(bar.increment > 0.0, factor > 1.0);
  }
}

// Without hardening the return is the closest point of the ellipse in the norm of the elastic energy.
TEST(CrushableFoam, RandomReturnsMinimiseTheEnergyNorm) {
  CrushableFoam law = polystyrene();
  law.linear_hardening = law.densification_stress = 0.0;
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int returned = 0;
  for (int n = 0; n < 200; ++n) {
    law.uniaxial_yield = law.hydrostatic_yield * (0.5 + 1.5 * unit(generator));
    law.tensile_yield = law.hydrostatic_yield * unit(generator);
    const double y = law.hydrostatic_yield, t = law.tensile_yield, a = std::sqrt(law.shape());
    Trial point{.q = 5.0 * y * unit(generator), .p = 6.0 * y * (unit(generator) - 0.4), .distension = 5.0};
    const double q = point.q, p = point.p, d = point.distension;
    if (excess(law, q, p, y) < 0.0) continue;
    ++returned;
    point.crush(law);
    const double after = p + point.stiffness * std::log(point.distension / d);
    EXPECT_NEAR(excess(law, point.q, after, y), 0.0, 1e-7 * y * y);
    const auto norm = [&](double q1, double p1) {
      return (q1 - q) * (q1 - q) / (6.0 * point.modulus) + (p1 - p) * (p1 - p) / (2.0 * point.stiffness);
    };
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 100000; ++i) {
      const double angle = std::numbers::pi * (i / 100000.0 - 0.5), half = 0.5 * (y + t);
      least = std::min(least, norm(a * half * std::cos(angle), 0.5 * (y - t) + half * std::sin(angle)));
    }
    EXPECT_LT(norm(point.q, after), least * (1.0 + 1e-6)) << n;
    EXPECT_GE(point.work, 0.0);
    const double sheared = (q - point.q) / (3.0 * point.modulus), crushed = (p - after) / point.stiffness;
    EXPECT_NEAR(point.work, point.q * sheared + after * crushed, 1e-6 * point.work) << n;
  }
  EXPECT_GT(returned, 100);
}

// With hardening: on the surface of the new distension, flow along its normal, never negative work.
TEST(CrushableFoam, ReturnsAreConsistentAndNormalWhileTheFoamHardens) {
  const CrushableFoam law = polystyrene();
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int crushed = 0, dilated = 0;
  for (int n = 0; n < 500; ++n) {
    Trial point{.distension = 1.2 + 8.0 * unit(generator)};
    const double limit = law.strength_at(point.distension), d = point.distension;
    const double p = point.p = limit * (3.0 * unit(generator) - 1.0),
                 q = point.q = 3.0 * limit * unit(generator);
    if (excess(law, q, p, limit) < 0.0) continue;
    point.crush(law);
    const double v = -std::log(point.distension / d), after = p - point.stiffness * v;
    const double hardened = v > 0.0 ? law.strength_at(point.distension) : limit;
    EXPECT_NEAR(excess(law, point.q, after, hardened), 0.0, 1e-6 * limit * limit) << n;
    const double sheared = (q - point.q) / (3.0 * point.modulus);
    const double normal = law.shape() * (2.0 * after - hardened + law.tensile_yield);
    EXPECT_NEAR(v * 2.0 * point.q, sheared * normal, 1e-6 * (std::abs(v) + sheared) * limit) << n;
    EXPECT_GE(point.work, 0.0);
    ++(v > 0.0 ? crushed : dilated);
  }
  EXPECT_GT(crushed, 50);
  EXPECT_GT(dilated, 50);
}

// p = p_c(alpha) until the pores are closed; then the solid.
TEST(CrushableFoam, CompressionFromAllSidesFollowsTheHardeningCurveToTheSolid) {
  const CrushableFoam law = polystyrene();
  const Material material = foam_of(law);
  MaterialPoints points = points_of(material, 1);
  EXPECT_NEAR(points.mass[0] / points.volume[0], relative * solid_density, 1e-9);
  Matrix3 before = Matrix3::Zero();
  const Matrix3 gradient = -1e3 * Matrix3::Identity();
  int yielding = 0, closed = 0;
  for (int n = 0; n < 8200; ++n) {
    const MaterialReport report = step_with_work(material, points, gradient, quiet, before);
    ASSERT_TRUE(report.valid());
    before = gradient;
    const double distension = points.history.scalar("distension")[0];
    EXPECT_GE(report.plastic_work, 0.0);
    if (distension > 1.01 && points.plastic_strain[0] > 0.01) {
      EXPECT_NEAR(points.pressure[0], law.strength_at(distension), 2e-3 * points.pressure[0]) << n;
      ++yielding;
    } else if (distension == 1.0) {
      const double density = points.mass[0] / points.volume[0];
      EXPECT_NEAR(points.pressure[0], bulk * (density / solid_density - 1.0), 1e-6 * bulk);
      ++closed;
    }
  }
  EXPECT_GT(yielding, 5000);
  EXPECT_GT(closed, 100);
}

TEST(CrushableFoam, TensionFromAllSidesIsCutOff) {
  const CrushableFoam law = polystyrene();
  const Material material = foam_of(law);
  MaterialPoints points = points_of(material, 1);
  Matrix3 before = Matrix3::Zero();
  const Matrix3 gradient = 100.0 * Matrix3::Identity();
  for (int n = 0; n < 3000; ++n) {
    step_with_work(material, points, gradient, quiet, before);
    before = gradient;
    EXPECT_GT(points.pressure[0], -law.tensile_yield * 1.02);
  }
  EXPECT_NEAR(points.pressure[0], -law.tensile_yield, 0.02 * law.tensile_yield);
  EXPECT_GT(points.history.scalar("distension")[0], 1.05 / relative);
}

// In uniaxial strain the stress stays on the surface, flow is normal to it, and what is dissipated is heat.
TEST(CrushableFoam, UniaxialStrainStaysOnTheSurfaceWithNormalFlow) {
  const CrushableFoam law = polystyrene();
  const Material material = foam_of(law);
  MaterialPoints points = points_of(material, 1);
  Matrix3 before = Matrix3::Zero(), gradient = Matrix3::Zero();
  gradient(0, 0) = -2e3;
  double plastic = 0.0;
  int yielding = 0;
  for (int n = 0; n < 20000; ++n) {
    const MaterialReport report = step_with_work(material, points, gradient, quiet, before);
    before = gradient;
    const double alpha = points.history.scalar("distension")[0];
    plastic += report.plastic_work;
    if (alpha < 1.01) break;
    if (points.plastic_strain[0] < 0.05) continue;
    const double q = std::sqrt(1.5) * points.deviatoric_stress[0].matrix().norm(),
                 limit = law.strength_at(alpha);
    EXPECT_NEAR(excess(law, q, points.pressure[0], limit), 0.0, 0.02 * limit * limit) << n;
    ++yielding;
  }
  EXPECT_GT(yielding, 5000);
  const double heat = (points.temperature[0] - 300.0) * 1300.0 * points.mass[0];
  EXPECT_NEAR(heat, plastic, 0.05 * plastic);
}

// A closed path never gives more than it took; by both schemes of the energy it takes the same.
TEST(CrushableFoam, ClosedPathsTakeWork) {
  const Material material = foam_of(polystyrene());
  std::mt19937_64 generator(3);
  for (int n = 0; n < 6; ++n) {
    const Matrix3 way = 0.15 * random_matrix(generator, 1.0);
    const auto path = [&](double t) {
      const double s = std::sin(std::numbers::pi * t);
      return Matrix3(Matrix3::Identity() + s * s * way);
    };
    std::array<double, 2> work{};
    for (const bool from_grid : {false, true}) {
      MaterialPoints points = points_of(material, 1);
      const double start = points.specific_internal_energy[0];
      Matrix3 before = Matrix3::Zero();
      for (int step = 0; step < 4000; ++step) {
        const Matrix3 gradient = gradient_between(path(step / 4e3), path((step + 1) / 4e3), quiet.time_step);
        const MaterialReport report =
            from_grid ? step_with_work(material, points, gradient, quiet, before)
                      : update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), quiet);
        EXPECT_GE(report.dissipation, 0.0);
        before = gradient;
      }
      work[from_grid ? 1 : 0] = (points.specific_internal_energy[0] - start) * points.mass[0];
    }
    EXPECT_GT(work[1], 0.0) << n;
    EXPECT_NEAR(work[0], work[1], 0.01 * work[1]) << n;
  }
}

TEST(CrushableFoam, ConstantsWithoutAnEllipseAreRefused) {
  CrushableFoam law = polystyrene();
  law.uniaxial_yield = 3.0 * law.hydrostatic_yield;
  EXPECT_THROW(CrushableFoamModel{law}, InputError);
  law = polystyrene();
  law.tensile_yield = 1.1 * law.hydrostatic_yield;
  EXPECT_THROW(CrushableFoamModel{law}, InputError);
}

}  // namespace
}  // namespace whipple::crushable_foam_test
