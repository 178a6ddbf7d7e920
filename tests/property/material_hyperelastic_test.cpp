// SPDX-License-Identifier: BSD-3-Clause
// Hyperelastic solids compared with closed forms (docs/theory/material.md, section 12).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/murnaghan.hpp"
#include "src/core/base/linear_algebra.hpp"
#include "src/material/hyperelastic/blatz_ko.hpp"
#include "src/material/hyperelastic/model.hpp"
#include "src/material/hyperelastic/mooney_rivlin.hpp"
#include "src/material/hyperelastic/neo_hookean.hpp"
#include "src/material/hyperelastic/ogden.hpp"
#include "src/material/hyperelastic/yeoh.hpp"
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

/// Returns a solid of a law; with gamma = 0 its pressure depends on the density alone.
template <class Law>
Material solid_of(const Law& law, double gamma = 0.0) {
  WithoutPhases eos;
  eos.rho0 = 1000.0;
  eos.c0 = 300.0;
  eos.gamma = gamma;
  return make_material("rubber", std::make_shared<WithoutPhases>(eos),
                       std::make_shared<const material::HyperelasticModel<Law>>(law));
}
Material rubber(double gamma = 0.0) { return solid_of(material::NeoHookean{shear, {}}, gamma); }

const material::MooneyRivlin mooney_rivlin{0.6e6, 0.4e6, {}};  // G = 2 MPa
const material::Yeoh yeoh{1e6, -0.1e6, 0.02e6, {}};
/// Ogden's fit of Treloar's measurements (R. W. Ogden, Proc. R. Soc. A 326 (1972) 565).
const material::Ogden treloar{{0.63e6, 0.0012e6, -0.01e6}, {1.3, 5.0, -2.0}, {}};

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
/// @param loose  ratio of the bound to the fastest wave, at most
void expect_bound_of_waves(const Material& material, double loose = 1.5) {
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
    EXPECT_LT(points.sound_speed[0], loose * fastest) << i;
  }
}

TEST(Hyperelastic, SoundSpeedIsNotBelowThatOfAnyWave) {
  expect_bound_of_waves(rubber());
  expect_bound_of_waves(solid_of(mooney_rivlin));
  expect_bound_of_waves(solid_of(yeoh));
  expect_bound_of_waves(solid_of(treloar));
}

// The same in a solid whose bulk modulus is not far above that of shear, where the bound of shear decides.
TEST(Hyperelastic, SoundSpeedIsABoundInSoftFoamsToo) {
  const auto stiff = [](auto law, double factor) {
    if constexpr (requires { law.mu; }) {
      for (double& mu : law.mu) mu *= factor;
    } else if constexpr (requires { law.c3; }) {
      law.c1 *= factor, law.c2 *= factor, law.c3 *= factor;
    } else {
      law.c1 *= factor, law.c2 *= factor;
    }
    return law;
  };
  expect_bound_of_waves(solid_of(material::NeoHookean{45e6, {}}));
  expect_bound_of_waves(solid_of(stiff(mooney_rivlin, 20.0)));
  expect_bound_of_waves(solid_of(stiff(yeoh, 20.0)));
  expect_bound_of_waves(solid_of(stiff(treloar, 50.0)));
}

// Rivlin: s_xy = G gamma, s_xx - s_zz = 2 c1 gamma^2, s_yy - s_zz = -2 c2 gamma^2.
TEST(MooneyRivlin, NormalStressesOfSimpleShearTellTheConstantsApart) {
  const Material material = solid_of(mooney_rivlin);
  for (const double gamma : {0.1, 1.0, 2.5}) {
    const MaterialPoints points = deformed(material, 30, [&](double t) { return sheared(t * gamma); });
    const SymmetricTensor& s = points.deviatoric_stress[0];
    EXPECT_NEAR(s.xy, mooney_rivlin.shear() * gamma, 1e-11 * shear);
    EXPECT_NEAR(s.xx - s.zz, 2.0 * mooney_rivlin.c1 * gamma * gamma, 1e-11 * shear);
    EXPECT_NEAR(s.yy - s.zz, -2.0 * mooney_rivlin.c2 * gamma * gamma, 1e-11 * shear);
  }
}

TEST(Yeoh, SimpleShearHasTheStressOfTheClosedForm) {
  const Material material = solid_of(yeoh);
  for (const double gamma : {0.1, 1.0, 2.5}) {
    const MaterialPoints points = deformed(material, 30, [&](double t) { return sheared(t * gamma); });
    const double x = gamma * gamma;  // I1 - 3
    const double expected = 2.0 * (yeoh.c1 + 2.0 * yeoh.c2 * x + 3.0 * yeoh.c3 * x * x) * gamma;
    EXPECT_NEAR(points.deviatoric_stress[0].xy, expected, 1e-11 * shear);
  }
}

// Nominal stress sum mu (l^(a-1) - l^(-1-a/2)) of a bar with free sides, from the deviator: s_xx - s_yy over l.
TEST(Ogden, UniaxialTensionHasTheStressOfTheClosedForm) {
  const Material material = solid_of(treloar);
  for (const double stretch : {0.6, 1.5, 3.0, 5.0, 7.0}) {
    const MaterialPoints points = deformed(material, 60, [&](double t) {
      const double l = 1.0 + t * (stretch - 1.0);
      return Matrix3(Vector3(l, 1.0 / std::sqrt(l), 1.0 / std::sqrt(l)).asDiagonal());
    });
    double nominal = 0.0;
    for (std::size_t a = 0; a < treloar.mu.size(); ++a) {
      nominal += treloar.mu[a] * (std::pow(stretch, treloar.alpha[a] - 1.0) -
                                  std::pow(stretch, -1.0 - 0.5 * treloar.alpha[a]));
    }
    const SymmetricTensor& s = points.deviatoric_stress[0];
    EXPECT_NEAR((s.xx - s.yy) / stretch, nominal, 1e-10 * std::abs(nominal)) << stretch;
    EXPECT_NEAR(s.yy, s.zz, 1e-10 * std::abs(s.xx));
  }
}

TEST(Ogden, ExponentsOfTwoAreTheMooneyRivlinSolid) {
  const material::Ogden same{{2.0 * mooney_rivlin.c1, -2.0 * mooney_rivlin.c2}, {2.0, -2.0}, {}};
  const auto path = [](double t) {
    return Matrix3(turned(1.7 * t) * sheared(0.8 * t) * stretched(1.0 + 0.3 * t));
  };
  const MaterialPoints one = deformed(solid_of(same, 1.0), 40, path);
  const MaterialPoints other = deformed(solid_of(mooney_rivlin, 1.0), 40, path);
  const SymmetricTensor &s = one.deviatoric_stress[0], &r = other.deviatoric_stress[0];
  EXPECT_LT((s.matrix() - r.matrix()).norm(), 1e-11 * r.matrix().norm());
  EXPECT_NEAR(one.temperature[0], other.temperature[0], 1e-9);
}

template <class Law>
void expect_closed_path(const Law& law) {
  const MaterialPoints points = deformed(solid_of(law, 1.0), 200, [](double t) {
    const double phase = std::sin(3.14159265358979323846 * t);
    return Matrix3(turned(4.0 * phase) * sheared(1.2 * phase * phase) * stretched(1.0 - 0.3 * phase));
  });
  EXPECT_LT(points.deviatoric_stress[0].matrix().norm(), 1e-10 * law.shear()) << Law::name;
}

TEST(Hyperelastic, ClosedPathsLeaveNoStress) {
  expect_closed_path(material::NeoHookean{shear, {}});
  expect_closed_path(mooney_rivlin);
  expect_closed_path(yeoh);
  expect_closed_path(treloar);
  expect_closed_path(material::BlatzKo{shear, {}});
}

/// Returns a Blatz-Ko solid beside the isentrope that belongs to it, or one with a further pressure by heat.
Material foam_rubber(double gamma = 1e-9) {
  eos::MurnaghanConstants constants;
  constants.reference_density = 500.0;
  constants.bulk_modulus = 5.0 / 3.0 * shear;
  constants.bulk_modulus_slope = 5.0 / 3.0;
  constants.gruneisen = gamma;
  constants.heat_capacity = 1000.0;
  return make_material(
      "foam rubber", std::make_shared<eos::ModelEquationOfState<eos::Murnaghan>>(constants),
      std::make_shared<const material::HyperelasticModel<material::BlatzKo>>(material::BlatzKo{shear, {}}));
}

// sigma = G (1 - b^-1/J) for any deformation.
TEST(BlatzKo, StressIsThatOfTheClosedForm) {
  const Material material = foam_rubber();
  std::mt19937_64 generator(3);
  for (int i = 0; i < 20; ++i) {
    const Matrix3 f = Matrix3::Identity() + random_matrix(generator, 0.3);
    if (f.determinant() < 0.5) continue;
    const MaterialPoints points = deformed(
        material, 40, [&](double t) { return Matrix3(Matrix3::Identity() + t * (f - Matrix3::Identity())); });
    const Matrix3 stress = points.deviatoric_stress[0].matrix() - points.pressure[0] * Matrix3::Identity();
    const Matrix3 b = f * f.transpose();
    const Matrix3 expected = shear * (Matrix3::Identity() - b.inverse() / f.determinant());
    EXPECT_LT((stress - expected).norm(), 1e-6 * shear) << i;
  }
}

// A bar with free sides: lateral stretch l^(-1/4), stress G (1 - l^(-5/2)).
TEST(BlatzKo, AFreeBarContractsByAQuarter) {
  const Material material = foam_rubber();
  for (const double stretch : {0.6, 0.9, 1.5, 3.0}) {
    const MaterialPoints points = deformed(material, 60, [&](double t) {
      const double l = 1.0 + t * (stretch - 1.0), side = std::pow(l, -0.25);
      return Matrix3(Vector3(l, side, side).asDiagonal());
    });
    const SymmetricTensor& s = points.deviatoric_stress[0];
    EXPECT_NEAR(s.yy - points.pressure[0], 0.0, 1e-6 * shear) << stretch;
    EXPECT_NEAR(s.xx - points.pressure[0], shear * (1.0 - std::pow(stretch, -2.5)), 1e-6 * shear) << stretch;
  }
}

TEST(BlatzKo, SoundSpeedIsNotBelowThatOfAnyWave) {
  expect_bound_of_waves(foam_rubber(), 1.8);  // the bound is that of the smallest stretch in all directions
}

// What a closed path takes it returns, in both kinds of schemes: the pressure of the shape works too.
TEST(BlatzKo, AClosedPathReturnsItsWork) {
  const Material material = foam_rubber();
  const auto path = [](double t) {
    const double phase = std::sin(3.14159265358979323846 * t);
    return Matrix3(turned(2.0 * phase) * sheared(0.8 * phase * phase) * stretched(1.0 - 0.3 * phase));
  };
  for (const bool integrated : {false, true}) {
    const auto left = [&](int steps) {
      MaterialPoints points = points_of(material, 1);
      Matrix3 before = Matrix3::Zero();
      double most = 0.0;
      for (int n = 0; n < steps; ++n) {
        const Matrix3 gradient =
            gradient_between(path(double(n) / steps), path(double(n + 1) / steps), settings.time_step);
        if (integrated) {
          update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), settings);
        } else {
          step_with_work(material, points, gradient, settings, before);
        }
        before = gradient;
        most = std::max(most, points.specific_internal_energy[0]);
      }
      return std::abs(points.specific_internal_energy[0]) / most;
    };
    EXPECT_LT(left(800), 0.01) << integrated;
    EXPECT_LT(left(1600), std::max(0.6 * left(800), 1e-12)) << integrated;
  }
}

/// A solid of which six tenths of the sudden stress relax, in two parts.
material::NeoHookean relaxing() { return {shear, {.fractions = {0.4, 0.2}, .times = {20e-6, 100e-6}}}; }

// After a sudden shear: s(t)/s_0 = 1 - sum g (1 - exp(-t/tau)). The shear itself takes one step of ten.
TEST(Relaxation, StressAfterASuddenShearDecaysAsTheSeries) {
  const Material material = solid_of(relaxing());
  MaterialPoints points = points_of(material, 1);
  constexpr double gamma = 0.2;
  UpdateSettings sudden = settings;
  sudden.time_step = 1e-12;
  Matrix3 gradient = gradient_between(sheared(0.0), sheared(gamma), sudden.time_step);
  update_material(material, points, 0, 1, std::span(&gradient, 1), sudden);
  EXPECT_NEAR(points.deviatoric_stress[0].xy, shear * gamma, 1e-6 * shear);
  gradient.setZero();
  for (int n = 1; n <= 200; ++n) {
    update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
    const double t = n * settings.time_step;
    const double expected = 1.0 + 0.4 * std::expm1(-t / 20e-6) + 0.2 * std::expm1(-t / 100e-6);
    ASSERT_NEAR(points.deviatoric_stress[0].xy, expected * shear * gamma, 1e-6 * shear * gamma) << n;
  }
}

// In oscillating shear the heat of a cycle is pi G'' gamma^2, G'' = G sum g omega tau/(1 + (omega tau)^2).
TEST(Relaxation, OscillationHeatsByTheLossModulus) {
  const Material material = solid_of(relaxing());
  MaterialPoints points = points_of(material, 1);
  constexpr double pi = 3.14159265358979323846, amplitude = 0.02;
  constexpr int steps = 400;
  const double omega = 2.0 * pi / (steps * settings.time_step);
  Matrix3 before = Matrix3::Zero();
  const auto cycle = [&] {
    for (int n = 0; n < steps; ++n) {
      const auto at = [&](int m) { return sheared(amplitude * std::sin(2.0 * pi * m / steps)); };
      const Matrix3 gradient = gradient_between(at(n), at(n + 1), settings.time_step);
      step_with_work(material, points, gradient, settings, before);
      before = gradient;
    }
    return points.specific_internal_energy[0] * 1000.0;  // J/m^3
  };
  cycle();
  cycle();
  const double start = cycle(), heat = cycle() - start;
  double loss = 0.0;
  for (const auto& [share, time] : {std::pair(0.4, 20e-6), std::pair(0.2, 100e-6)}) {
    loss += shear * share * omega * time / (1.0 + omega * time * omega * time);
  }
  EXPECT_NEAR(heat, pi * loss * amplitude * amplitude, 0.01 * heat);
}

// All that is dissipated becomes heat, and never less than nothing: the temperature rises on random paths.
TEST(Relaxation, DissipationIsNeverNegative) {
  const Material material = solid_of(relaxing(), 0.0);
  std::mt19937_64 generator(7);
  for (int path = 0; path < 20; ++path) {
    MaterialPoints points = points_of(material, 1);
    Matrix3 before = Matrix3::Zero();
    double hottest = points.temperature[0];
    for (int leg = 0; leg < 6; ++leg) {
      const Matrix3 random = random_matrix(generator, 1.0);
      const Matrix3 rate = random - random.trace() / 3.0 * Matrix3::Identity();  // 1 at constant volume
      for (int n = 0; n < 200; ++n) {
        const Matrix3 gradient = 4e2 * rate;
        const MaterialReport report = step_with_work(material, points, gradient, settings, before);
        ASSERT_TRUE(report.valid());
        before = gradient;
        // Where the path turns, the energy lags by half of the work of a step.
        const double work =
            settings.time_step * gradient.norm() * points.deviatoric_stress[0].matrix().norm() / 1000.0;
        ASSERT_GT(points.temperature[0], hottest - 0.5 * work / 383.0) << path << " " << leg;
        hottest = std::max(hottest, points.temperature[0]);
      }
    }
    EXPECT_GT(points.temperature[0], 300.0);
  }
}

TEST(Relaxation, RotationTurnsThePartsThatRelax) {
  const Material material = solid_of(relaxing());
  const auto path = [](double t) { return sheared(0.3 * t); };
  const MaterialPoints plain = deformed(material, 200, path);
  const MaterialPoints spun =
      deformed(material, 200, [&](double t) { return Matrix3(turned(1.0 * t) * path(t)); });
  const Matrix3 q = turned(1.0), s = plain.deviatoric_stress[0].matrix();
  EXPECT_LT((spun.deviatoric_stress[0].matrix() - q * s * q.transpose()).norm(), 1e-4 * s.norm());
}

TEST(Hyperelastic, InconsistentConstantsAreRefused) {
  EXPECT_THROW(solid_of(material::Yeoh{1e6, -1e6, 0.02e6, {}}), InputError);
  EXPECT_THROW(solid_of(material::Ogden{{1e6}, {2.0, 3.0}, {}}), InputError);
  EXPECT_THROW(solid_of(material::Ogden{{-1e6}, {2.0}, {}}), InputError);
  EXPECT_THROW(solid_of(material::Ogden{}), InputError);
  EXPECT_THROW(solid_of(material::NeoHookean{1e6, {.fractions = {0.5}, .times = {}}}), InputError);
  EXPECT_THROW(solid_of(material::NeoHookean{1e6, {.fractions = {0.5, 0.5}, .times = {1.0, 2.0}}}),
               InputError);
  EXPECT_THROW(solid_of(material::NeoHookean{1e6, {.fractions = {0.6, 0.3, 0.1}, .times = {1.0, 2.0, 3.0}}}),
               InputError);  // 1 but for round-off
  EXPECT_THROW(
      solid_of(material::NeoHookean{1e6, {.fractions = {0.1, 0.1, 0.1, 0.1}, .times = {1.0, 2.0, 3.0, 4.0}}}),
      InputError);
}

TEST(Hyperelastic, TakesAnEquationOfStateWithoutPhases) {
  EXPECT_THROW(make_material("wrong", std::make_shared<LinearInEnergy>(),
                             std::make_shared<const material::HyperelasticModel<material::NeoHookean>>(
                                 material::NeoHookean{shear, {}})),
               InputError);
}

}  // namespace
}  // namespace whipple
