// SPDX-License-Identifier: BSD-3-Clause
// The neo-Hookean solid compared with closed forms (docs/theory/material.md, section 12).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "src/core/base/linear_algebra.hpp"
#include "src/material/neo_hookean.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

constexpr double shear = 2e6;

/// Test equation of state without phases.
struct WithoutPhases final : LinearInEnergy {
  [[nodiscard]] bool has_phases() const override { return false; }
  eos::RangeReport evaluate(const eos::Batch& batch) const override {
    std::array<double, material::chunk_size> melted, vaporised;
    eos::Batch with_phases = batch;
    with_phases.melted_fraction = std::span(melted).first(batch.density.size());
    with_phases.vaporised_fraction = std::span(vaporised).first(batch.density.size());
    return LinearInEnergy::evaluate(with_phases);
  }
};

/// Returns a solid; with gamma = 0 its pressure depends on the density alone.
Material rubber(double gamma = 0.0) {
  WithoutPhases eos;
  eos.rho0 = 1000.0;
  eos.c0 = 300.0;
  eos.gamma = gamma;
  return make_material("rubber", std::make_shared<WithoutPhases>(eos),
                       std::make_shared<const material::NeoHookeanModel>(material::NeoHookean{shear}));
}

constexpr UpdateSettings settings{
    .time_step = 1e-6, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

/// Returns the point after the deformations f(1/steps), ..., f(1), from f(0) = 1.
template <class Deformation>
MaterialPoints deformed(const Material& material, int steps, Deformation f) {
  MaterialPoints points = points_of(material, 1);
  Matrix3 before = Matrix3::Zero();
  for (int n = 0; n < steps; ++n) {
    const Matrix3 gradient =
        gradient_between(f(double(n) / steps), f(double(n + 1) / steps), settings.time_step);
    const MaterialReport report = step_with_work(material, points, gradient, settings, before);
    EXPECT_TRUE(report.valid());
    before = gradient;
  }
  return points;
}

Matrix3 stretched(double ratio) { return Vector3(ratio, 1.0, 1.0).asDiagonal(); }
Matrix3 sheared(double gamma) {
  Matrix3 f = Matrix3::Identity();
  f(0, 1) = gamma;
  return f;
}
Matrix3 turned(double angle) {
  return Eigen::AngleAxisd(angle, Vector3(0.3, 1.0, 0.2).normalized()).toRotationMatrix();
}

TEST(NeoHookean, UniaxialStrainHasTheStressOfTheClosedForm) {
  const Material material = rubber();
  for (const double ratio : {0.7, 0.9, 1.5, 3.0}) {
    const MaterialPoints points =
        deformed(material, 40, [&](double t) { return stretched(1.0 + t * (ratio - 1.0)); });
    // s_xx = 2/3 G J^(-5/3) (ratio^2 - 1), J = ratio
    const double expected = 2.0 / 3.0 * shear * std::pow(ratio, -5.0 / 3.0) * (ratio * ratio - 1.0);
    const SymmetricTensor& s = points.deviatoric_stress[0];
    EXPECT_NEAR(s.xx, expected, 1e-12 * shear) << ratio;
    EXPECT_NEAR(s.yy, -0.5 * expected, 1e-12 * shear) << ratio;
    EXPECT_NEAR(points.volume[0], 1e-9 * ratio, 1e-21) << ratio;
    EXPECT_NEAR(points.pressure[0], material.eos->state(1000.0 / ratio, 0.0).pressure, 1e-9 * 9e7) << ratio;
  }
}

TEST(NeoHookean, SimpleShearHasTheStressOfTheClosedFormAndNormalStresses) {
  const Material material = rubber();
  for (const double gamma : {0.1, 1.0, 2.5}) {
    const MaterialPoints points = deformed(material, 30, [&](double t) { return sheared(t * gamma); });
    const SymmetricTensor& s = points.deviatoric_stress[0];
    EXPECT_NEAR(s.xy, shear * gamma, 1e-11 * shear);
    EXPECT_NEAR(s.xx - s.yy, shear * gamma * gamma, 1e-11 * shear);  // Rivlin's universal relation
    EXPECT_NEAR(s.zz, s.yy, 1e-11 * shear);
    EXPECT_NEAR(points.pressure[0], 0.0, 1e-6);
  }
}

TEST(NeoHookean, RotationTurnsTheStressAndChangesNothingElse) {
  const Material material = rubber(1.0);
  const auto path = [](double t) { return Matrix3(sheared(0.8 * t) * stretched(1.0 + 0.3 * t)); };
  const MaterialPoints plain = deformed(material, 50, path);
  const MaterialPoints spun =
      deformed(material, 50, [&](double t) { return Matrix3(turned(2.0 * t) * path(t)); });
  const Matrix3 q = turned(2.0), s = plain.deviatoric_stress[0].matrix();
  EXPECT_LT((spun.deviatoric_stress[0].matrix() - q * s * q.transpose()).norm(), 1e-11 * s.norm());
  EXPECT_LT((spun.history.values<Matrix3>("deformation_gradient")[0] - q * path(1.0)).norm(), 1e-12);
  EXPECT_NEAR(spun.volume[0], plain.volume[0], 1e-21);
}

// Deformation at constant volume does not heat: all work is elastic energy, except for the error of the time
// integration.
TEST(NeoHookean, WorkAtConstantVolumeIsStoredWithoutHeat) {
  const Material material = rubber(1.0);
  const auto error = [&](int steps) {
    const auto ratio = [](double t) { return 1.0 + 0.5 * std::sin(2.5 * t); };
    const MaterialPoints points = deformed(material, steps, [&](double t) {
      return Matrix3(Vector3(ratio(t), 1.0 / ratio(t), 1.0).asDiagonal());
    });
    const double square = ratio(1.0) * ratio(1.0),
                 stored = 0.5 * shear * (square + 1.0 / square - 2.0) / 1000.0;
    EXPECT_NEAR(points.specific_internal_energy[0], stored, 0.02 * shear / 1000.0);  // it lags by half a step
    return std::abs(points.temperature[0] - 300.0) * 383.0 / (shear / 1000.0);
  };
  EXPECT_LT(error(400), 1e-4);
  EXPECT_LT(error(800),
            0.55 * error(400));  // first order, as the gradient refers to the beginning of the step
}

TEST(NeoHookean, SchemesThatIntegrateTheEnergyKeepTheElasticPartOutOfTheHeat) {
  const Material material = rubber(1.0);
  MaterialPoints points = points_of(material, 1);
  constexpr int steps = 500;
  for (int n = 0; n < steps; ++n) {
    const Matrix3 gradient =
        gradient_between(sheared(double(n) / steps), sheared(double(n + 1) / steps), settings.time_step);
    update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), settings);
  }
  EXPECT_NEAR(points.specific_internal_energy[0], 0.5 * shear / 1000.0, 1e-5 * shear / 1000.0);
  EXPECT_NEAR(points.temperature[0], 300.0, 1e-5 * shear / 1000.0 / 383.0);
}

// Small waves: the sound speed is an upper bound of those of the tangent stiffness, obtained by numerical
// differentiation.
TEST(NeoHookean, SoundSpeedIsNotBelowThatOfAnyWave) {
  const Material material = rubber();
  std::mt19937_64 generator(5);
  for (int i = 0; i < 50; ++i) {
    const Matrix3 f = Matrix3::Identity() + random_matrix(generator, 0.25);
    if (f.determinant() < 0.6 || f.determinant() > 1.6) continue;
    const MaterialPoints points = deformed(
        material, 20, [&](double t) { return Matrix3(Matrix3::Identity() + t * (f - Matrix3::Identity())); });
    const Vector3 n = random_matrix(generator, 1.0).col(0).normalized();
    const double step = 1e-6;
    // D(stress n)/d(amplitude), of displacements a along n: the area of the wave is constant
    Matrix3 stiffness;
    const auto traction = [&](const MaterialPoints& p) {
      return Vector3(p.deviatoric_stress[0].matrix() * n - p.pressure[0] * n);
    };
    for (int a = 0; a < 3; ++a) {
      MaterialPoints moved = points;
      const Matrix3 gradient = step / settings.time_step * Vector3::Unit(a) * n.transpose();
      update_material(material, moved, 0, 1, std::span(&gradient, 1), settings);
      stiffness.col(a) = (traction(moved) - traction(points)) / step;
    }
    const double density = points.mass[0] / points.volume[0];
    const double fastest =
        std::sqrt(symmetric_eigen(0.5 * (stiffness + stiffness.transpose())).values[2] / density);
    EXPECT_GE(points.sound_speed[0], 0.999 * fastest) << i;
    EXPECT_LT(points.sound_speed[0], 1.5 * fastest) << i;
  }
}

TEST(NeoHookean, TakesAnEquationOfStateWithoutPhases) {
  EXPECT_THROW(make_material("wrong", std::make_shared<LinearInEnergy>(),
                             std::make_shared<const material::NeoHookeanModel>(material::NeoHookean{shear})),
               InputError);
}

}  // namespace
}  // namespace whipple
