// SPDX-License-Identifier: BSD-3-Clause
// Modified Cam-clay: returns, the line of isotropic compression, the critical state of drained and undrained shear,
// gaps, dissipation, closed cycles (docs/theory/soil.md, section 6).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "src/material/strength/modified_cam_clay.hpp"
#include "tests/unit/brittle_support.hpp"

namespace whipple {
namespace cam_clay_test {

using namespace brittle_test;
using strength::ModifiedCamClay;
using strength::ModifiedCamClayModel;

constexpr double bulk = 20e6, shear = 9e6, density = 1800.0, heat_capacity = 1000.0;

ModifiedCamClay clay(double preconsolidation = 200e3) {
  ModifiedCamClay law;
  law.shear_modulus = shear;
  law.critical_state_slope = 1.1;
  law.preconsolidation_pressure = preconsolidation;
  law.plastic_compressibility = 0.06;
  return law;
}

Material soil(const ModifiedCamClay& law) {
  eos::PolynomialConstants constants;
  constants.reference_density = density;
  constants.C1 = bulk;
  constants.heat_capacity = heat_capacity;
  return make_material("clay", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<ModifiedCamClayModel>(law));
}

double plastic_volume_ratio(const Body& body) { return body.points.history.scalar("distension")[0]; }

/// Returns the pressure of the equation of state at a volume and a plastic volume ratio.
double pressure_at(double volume, double plastic) { return bulk * (plastic / volume - 1.0) / plastic; }

/// Returns the zero of a function that changes its sign between two numbers.
template <class Function>
double zero_between(double a, double b, Function function) {
  const bool positive = function(a) > 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (a + b);
    ((function(middle) > 0.0) == positive ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// Compresses a body isotropically to a pressure at which it is elastic.
void compress(Body& body, double pressure, int steps) {
  const double side = std::cbrt(1.0 / (1.0 + pressure / bulk));
  body.strain_to(diagonal(side, side, side), steps);
}

// With very slow hardening the return is the closest point of the ellipse in the norm of the elastic energy.
TEST(ModifiedCamClay, RandomReturnsMinimiseTheEnergyNorm) {
  ModifiedCamClay law = clay();
  law.plastic_compressibility = 1e9;
  law.maximum_dilation = 0.5;
  const double m = law.critical_state_slope, length = law.preconsolidation_pressure;
  std::mt19937_64 generator(21);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<int, 2> of_kind{};  // compaction, dilation
  for (int n = 0; n < 200; ++n) {
    const double p = 1.5 * length * unit(generator), q = 1.5 * length * unit(generator);
    const double growth =
        law.growth({.pressure = p, .trial = q, .stiffness = bulk, .modulus = shear, .distension = 1.0});
    if (q * q / (m * m) + p * (p - length) <= 0.0) {
      EXPECT_EQ(growth, 0.0);
      continue;
    }
    ++of_kind[growth > 0.0 ? 1 : 0];
    const double after = p + bulk * growth, left = m * std::sqrt(after * (length - after));
    ASSERT_GT(after, 0.0);
    const auto norm = [&](double q1, double p1) {
      return (q1 - q) * (q1 - q) / (6.0 * shear) + (p1 - p) * (p1 - p) / (2.0 * bulk);
    };
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 20000; ++i) {
      const double angle = std::numbers::pi * i / 20000.0;
      least =
          std::min(least, norm(0.5 * m * length * std::sin(angle), 0.5 * length * (1.0 + std::cos(angle))));
    }
    EXPECT_LT(norm(left, after), least * (1.0 + 1e-6) + 1e-9) << n;
  }
  for (const int count : of_kind) EXPECT_GT(count, 20);
}

// ln J_p = -h ln(p/p_c0) on the virgin line; unloading and reloading follow the equation of state.
TEST(ModifiedCamClay, IsotropicCompressionFollowsTheVirginLine) {
  const ModifiedCamClay law = clay();
  const Material material = soil(law);
  Body body{material};
  double greatest = law.preconsolidation_pressure, plastic = 1.0;
  for (const double volume : {0.995, 0.97, 0.985, 0.95, 0.952, 0.9}) {
    const double side = std::cbrt(volume);
    body.strain_to(diagonal(side, side, side), 1000);
    if (pressure_at(volume, plastic) > greatest) {
      greatest = zero_between(greatest, 1e8, [&](double p) {
        return pressure_at(volume, std::pow(p / law.preconsolidation_pressure, -0.06)) - p;
      });
      plastic = std::pow(greatest / law.preconsolidation_pressure, -0.06);
    }
    const double expected = std::max(pressure_at(volume, plastic), 0.0);  // less opens a gap
    std::printf("volume %.3f: p %.6e Pa, relative error %.1e\n", volume, body.p(),
                (body.p() - expected) / greatest);
    EXPECT_NEAR(body.p(), expected, 1e-7 * greatest) << volume;
    EXPECT_NEAR(plastic_volume_ratio(body), plastic, 1e-6) << volume;
    EXPECT_LT(body.q(), 1e-6 * greatest);
  }
  EXPECT_GT(greatest, 2.0 * law.preconsolidation_pressure);
}

// At constant volume flow goes to the critical state, from the wet and from the dry side: q = M p, p = p_c/2.
TEST(ModifiedCamClay, UndrainedShearEndsInTheCriticalState) {
  for (const double before : {180e3, 60e3, 20e3}) {
    const ModifiedCamClay law = clay();
    const Material material = soil(law);
    Body body{material};
    compress(body, before, 200);
    const double volume = body.place.determinant(), side = std::cbrt(volume);
    const double stretch = std::exp(-0.3);
    for (int i = 1; i <= 8000; ++i) {
      const double along = side * std::pow(stretch, i / 8000.0);
      const double across = std::sqrt(volume / along);
      body.strain_to(diagonal(along, across, across));
    }
    const double p = zero_between(1.0, 1e6, [&](double at) {
      return pressure_at(volume, std::pow(2.0 * at / law.preconsolidation_pressure, -0.06)) - at;
    });
    std::printf("from %.0f kPa: p %.4f kPa, exact %.4f, q/(M p) %.6f\n", before / 1e3, body.p() / 1e3,
                p / 1e3, body.q() / (1.1 * body.p()));
    EXPECT_NEAR(body.p(), p, 1e-5 * p) << before;
    EXPECT_NEAR(body.q(), 1.1 * p, 1e-5 * p) << before;
    EXPECT_EQ(std::log(plastic_volume_ratio(body)) > 0.0,
              before < 100e3);  // dilation of overconsolidated clay
  }
}

/// Shortens a body along x to a ratio, at a constant lateral pressure (Pa) that a controller of its width holds.
/// @returns the greatest q/p
double shorten(Body& body, double ratio, double lateral, int steps) {
  double across = body.place(1, 1), rate = 0.0, highest = 0.0;
  const double along = body.place(0, 0);
  for (int i = 1; i <= steps; ++i) {
    const double error = (body.p() - body.points.deviatoric_stress[0].yy - lateral) / (2.0 * bulk);
    rate += 0.02 * error;
    across *= 1.0 + rate + 0.3 * error;
    body.strain_to(diagonal(along * std::pow(ratio, double(i) / steps), across, across));
    highest = std::max(highest, body.q() / body.p());
  }
  return highest;
}

// With a constant lateral pressure s: p = s/(1 - M/3), q = M p, and p_c = 2 p.
TEST(ModifiedCamClay, DrainedTriaxialShearEndsInTheCriticalState) {
  for (const double lateral : {150e3, 30e3}) {
    const ModifiedCamClay law = clay();
    const Material material = soil(law);
    Body body{material};
    compress(body, lateral, 200);
    const double highest = shorten(body, std::exp(-0.6), lateral, 20000);
    const double p = lateral / (1.0 - 1.1 / 3.0);
    std::printf("lateral %.0f kPa: p %.4f kPa, exact %.4f, ln J_p %.5f, greatest q/p %.3f\n", lateral / 1e3,
                body.p() / 1e3, p / 1e3, std::log(plastic_volume_ratio(body)), highest);
    EXPECT_NEAR(body.p(), p, 2e-3 * p) << lateral;
    EXPECT_NEAR(body.q(), 1.1 * p, 2e-3 * p) << lateral;
    EXPECT_NEAR(std::log(plastic_volume_ratio(body)), -0.06 * std::log(2.0 * p / 200e3), 2e-4) << lateral;
    EXPECT_EQ(highest > 1.2 * 1.1, lateral < 100e3);  // overconsolidated clay has a peak
  }
}

TEST(ModifiedCamClay, NeverGivesWorkBack) {
  expect_dissipation(soil(clay(20e3)), 31);
  expect_dissipation(soil(clay(200e3)), 32);
}

// Energy of a closed path: dissipation and what is stored in deviator and compression.
TEST(ModifiedCamClay, EnergyOfAClosedPathIsItsDissipationAndWhatIsStored) {
  const Matrix3 home = diagonal(0.999, 0.999, 0.999);
  Matrix3 sheared = home, other = home;
  sheared(0, 1) = 0.05;
  other(2, 1) = -0.04;
  const auto stored = [](const Body& body) {
    const double mass = body.points.mass[0], volume = body.points.volume[0];
    const double mu = mass / volume * plastic_volume_ratio(body) / density - 1.0;
    return body.points.deviatoric_stress[0].squared_norm() / (4.0 * shear) * volume +
           mass * bulk / density * (std::log1p(mu) - mu / (1.0 + mu));
  };
  double coarse = 0.0;
  for (const int steps : {2000, 20000}) {
    const Material material = soil(clay(70e3));
    Body body{material};
    body.strain_to(home, steps);
    const double start = body.energy() - stored(body);
    double work = 0.0;
    for (const Matrix3& next : {sheared, other, home}) {
      const Matrix3 from = body.place;
      for (int i = 1; i <= steps; ++i)
        work += body.strain_to((from + (next - from) * i / steps).eval()).plastic_work;
    }
    work += body.strain_to(Matrix3(body.place)).plastic_work;
    const double error = std::abs(body.energy() - stored(body) - start - work) / work;
    std::printf("%d steps: dissipation %.6e J, error %.2e\n", steps, work, error);
    EXPECT_GT(work, 1e3 * body.points.volume[0]);
    EXPECT_LT(error, steps > 10000 ? 1e-6 : 1e-5);
    if (coarse > 0.0) {
      EXPECT_LT(error, 0.12 * coarse);  // first order
    }
    coarse = error;
  }
}

TEST(ModifiedCamClay, AClosedElasticPathReturnsAllEnergy) {
  const Material material = soil(clay());
  Body body{material};
  compress(body, 60e3, 4000);
  const double start = body.energy();
  const Matrix3 home = body.place;
  Matrix3 sheared = home;
  sheared(0, 1) = 0.002;
  sheared(1, 1) *= 1.001;
  body.strain_to(sheared, 4000);
  body.strain_to(home, 4000);
  EXPECT_EQ(body.points.plastic_strain[0], 0.0);
  EXPECT_EQ(plastic_volume_ratio(body), 1.0);
  EXPECT_NEAR(body.energy(), start, 1e-6 * start);
}

// What separates is a gap; sheared at a small pressure it dilates up to the bound.
TEST(ModifiedCamClay, SeparationIsAGapAndDilationEnds) {
  const ModifiedCamClay law = clay();
  const Material material = soil(law);
  Body body{material};
  Matrix3 f = diagonal(1.03, 1.02, 1.05);
  f(0, 1) = 0.2;
  body.strain_to(f, 500);
  EXPECT_EQ(plastic_volume_ratio(body), 1.0);
  EXPECT_EQ(body.p(), 0.0);
  EXPECT_EQ(body.q(), 0.0);
  EXPECT_GT(body.points.void_volume[0], 0.09 * body.points.volume[0]);
  // At 500 Pa p_c would fall to 1 kPa, ln J_p = 0.32, were it not for the bound.
  Body other{material};
  compress(other, 500.0, 100);
  shorten(other, std::exp(-1.0), 500.0, 20000);
  EXPECT_NEAR(std::log(plastic_volume_ratio(other)), 0.2, 1e-9);
  EXPECT_LE(std::log(plastic_volume_ratio(other)), 0.2 * (1.0 + 1e-12));
}

}  // namespace cam_clay_test
}  // namespace whipple
