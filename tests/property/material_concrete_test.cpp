// SPDX-License-Identifier: BSD-3-Clause
// Concrete: surfaces, hardening, damage for given paths, strengths of a single element.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/models/holmquist_johnson_cook.hpp"
#include "tests/unit/brittle_support.hpp"

namespace whipple {
namespace {

using namespace brittle_test;

// --- Holmquist-Johnson-Cook ------------------------------------------------------------------------------

TEST(HolmquistJohnsonCook, StrengthIsThePublishedCurve) {
  const Hjc c = concrete_law();
  for (const double p : {-3e6, 0.0, 1e6, 48e6, 300e6}) {
    for (const double rate : {0.1, 1e3}) {
      const double factor = 48e6 * (rate > 1 ? 1 + 0.007 * std::log(rate) : 1.0), r = p / 48e6;
      const auto y = c.surface({.pressure = p, .rate = rate});
      for (const double d : {0.0, 0.25, 1.0}) {
        const double curve = p > 0 ? 0.79 * (1 - d) + 1.6 * std::pow(r, 0.61) : 0.79 * (1 - d + p / 4e6);
        EXPECT_NEAR(y.strength(d), factor * std::max(0.0, curve), 1e-6) << p << " " << d;
      }
      EXPECT_NEAR(y.failure_strain, std::max(0.01, 0.04 * (p + 4e6) / 48e6), 1e-15);
    }
  }
  EXPECT_EQ(c.surface({.pressure = 2e9, .rate = 1}).strength(0), 7.0 * 48e6);      // S_max
  EXPECT_NEAR(c.surface({.pressure = -2e6, .rate = 1}).strength(0.5), 0.0, 1e-6);  // at -T (1 - D)
}

TEST(HolmquistJohnsonCook, CrushedPoresAddToTheDamage) {
  // Hydrostatic compression: D is the integral of dmu_p/eps_f along the line of crushing.
  const Material material = library("concrete_48mpa_hjc");
  const Hjc c = concrete_law();
  const double lock = dynamic_cast<const eos::ModelEquationOfState<eos::HolmquistJohnsonCook>&>(*material.eos)
                          .underlying()
                          .locked_compression();
  double expected = 0, reached = 0;
  const int steps = 100000;
  const double modulus = 0.8e9 / (lock - 0.1);
  const auto rest = [&](double f) {
    return 0.001 + f * (lock - 0.001) - (16e6 + f * (0.8e9 - 16e6)) / (16e9 + f * (modulus - 16e9));
  };
  Body body{material};
  for (const double share : {0.02, 0.05, 0.1}) {
    const double from = reached;
    for (int i = 0; i < steps; ++i) {
      const double f0 = from + (share - from) * i / steps, f1 = from + (share - from) * (i + 1) / steps;
      const double p = 16e6 + 0.5 * (f0 + f1) * (0.8e9 - 16e6);
      expected += (rest(f1) - rest(f0)) / c.surface({.pressure = p, .rate = 0}).failure_strain;
    }
    reached = share;
    const double ratio = std::cbrt(1 / (1 + 0.001 + share * (lock - 0.001)));
    body.strain_to(diagonal(ratio, ratio, ratio), 2000);
    ASSERT_LT(expected, 1.0);
    EXPECT_NEAR(body.damage(), expected, 2e-3 * expected);
    EXPECT_EQ(body.points.plastic_strain[0], 0.0);
  }
}

TEST(HolmquistJohnsonCook, BrokenConcreteKeepsItsFriction) {
  const Material material = library("concrete_48mpa_hjc");
  Body body{material};
  body.strain_to(diagonal(0.99, 0.99, 0.99), 300);
  Matrix3 f = diagonal(0.99, 0.99, 0.99);
  f(0, 1) = 0.3;
  body.strain_to(f, 1500);
  EXPECT_EQ(body.damage(), 1.0);
  f(0, 1) = 0.5;
  const double rate = 0.2 / 0.99 / 1000 / dt / std::sqrt(3.0);
  const Matrix3 from = body.place;
  for (int i = 1; i <= 1000; ++i) body.strain_to((from + (f - from) * i / 1000).eval());
  const double expected = 48e6 * 1.6 * std::pow(body.p() / 48e6, 0.61) * (1 + 0.007 * std::log(rate));
  EXPECT_NEAR(body.q(), expected, 1e-4 * expected);
  body.strain_to(diagonal(1.02, 1.02, 1.02), 300);  // disintegrates
  EXPECT_EQ(body.p(), 0.0);
  EXPECT_EQ(body.q(), 0.0);
}

TEST(HolmquistJohnsonCook, BothSchemesOfTheEnergyAgree) {
  const Material material = library("concrete_48mpa_hjc");
  Body body{material};
  MaterialPoints other = points_of(material, 1);
  Matrix3 place = Matrix3::Identity();
  const int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    Matrix3 next = diagonal(1 - 0.06 * i / steps, 1.0 + 0.01 * i / steps, 1.0);
    next(1, 2) = 0.05 * i / steps;
    const Matrix3 gradient = gradient_between(place, next, dt);
    body.strain_to(next);
    update_material_and_energy(material, other, 0, 1, std::span(&gradient, 1), settings);
    place = next;
  }
  EXPECT_GT(body.damage(), 0.5);
  EXPECT_NEAR(other.pressure[0], body.p(), 1e-6 * body.p());
  EXPECT_NEAR(other.history.scalar("damage")[0], body.damage(), 1e-6);
  EXPECT_NEAR(other.specific_internal_energy[0], body.points.specific_internal_energy[0],
              2e-3 * body.points.specific_internal_energy[0]);
}

// --- Riedel-Hiermaier-Thoma ------------------------------------------------------------------------------

TEST(RiedelHiermaierThoma, FailureSurfacePassesTheFourStrengths) {
  const RiedelHiermaierThoma c = rht();
  const auto strength = [&](double p, double lode, double rate) {
    return c.surface({.pressure = p, .rate = rate, .lode_cosine = lode}).strength(0) / 35e6;
  };
  EXPECT_NEAR(strength(35e6 / 3, -1, 0), 1.0, 1e-12);  // uniaxial compression
  EXPECT_NEAR(strength(0, 0, 0), 0.18, 1e-12);         // shear
  const double q = 0.6805 - 0.0105 * 0.1 / 3;
  EXPECT_NEAR(strength(-3.5e6 / 3, 1, 0), 0.1 * q / 0.6805, 1e-12);  // uniaxial tension
  const double c_factor = std::pow(1e3 / 3e-5, 0.032), t_factor = std::pow(1e3 / 3e-6, 0.036);
  EXPECT_NEAR(strength(c_factor * 35e6 / 3, -1, 1e3), c_factor, 1e-10);
  EXPECT_NEAR(strength(-t_factor * 3.5e6 / 3, -1, 1e3), 0.1 * t_factor / 0.6805, 1e-10);
  // At high pressure A (p* - 1/3 + A^(-1/n))^n; continuous everywhere; zero at the tip.
  EXPECT_NEAR(strength(350e6, -1, 0), 1.6 * std::pow(10 - 1.0 / 3 + std::pow(1.6, -1 / 0.61), 0.61), 1e-12);
  for (const double p : {0.0, 35e6 / 3})
    EXPECT_NEAR(strength(p - 1e-3, -1, 0), strength(p + 1e-3, -1, 0), 1e-8);
  const double tip = c.least_pressure({.pressure = 0, .rate = 0});
  EXPECT_LT(tip, -3.5e6 / 3);
  EXPECT_NEAR(strength(tip, -1, 0), 0.0, 1e-12);
  // Meridians of Willam and Warnke: 1 in compression, Q in tension.
  EXPECT_NEAR(c.meridian(-1, 3), 1.0, 1e-12);
  EXPECT_NEAR(c.meridian(1, 3), 0.6805 + 0.0105 * 3, 1e-12);
  // Damaged: (1 - D) Y + D A_f p*^n_f; in tension (1 - D) times the surface at p/(1 - D)
  const auto y = c.surface({.pressure = 70e6, .rate = 0, .lode_cosine = -1});
  EXPECT_NEAR(y.strength(0.4), 0.6 * y.strength(0) + 0.4 * 35e6 * 1.6 * std::pow(2, 0.61), 1e-4);
  const auto tensile = c.surface({.pressure = -1e6, .rate = 0, .lode_cosine = -1});
  EXPECT_NEAR(tensile.strength(0.4), 0.6 * 35e6 * strength(-1e6 / 0.6, -1, 0), 1e-4);
}

/// Returns the peak of uniaxial stress at a true strain rate: the lateral strain of every step is determined such that
/// the lateral stress vanishes.
double peak_of_uniaxial_stress(const Material& material, double last, int steps) {
  MaterialPoints points = points_of(material, 1);
  const UpdateSettings slow{
      .time_step = 1.0, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};
  double lateral = 0, peak = 0;
  for (int i = 0; i < steps; ++i) {
    const double axial = last / steps;
    const auto residual = [&](double rate, MaterialPoints& trial) {
      const Matrix3 gradient = diagonal(axial, rate, rate);
      update_material(material, trial, 0, 1, std::span(&gradient, 1), slow);
      return trial.deviatoric_stress[0].yy - trial.pressure[0];
    };
    double low = lateral - std::abs(axial), high = lateral + std::abs(axial);
    for (int k = 0; k < 50; ++k) {
      MaterialPoints trial = points;
      const double middle = 0.5 * (low + high);
      (residual(middle, trial) < 0 ? low : high) = middle;
    }
    lateral = 0.5 * (low + high);
    residual(lateral, points);
    peak = std::max(peak, std::abs(points.deviatoric_stress[0].xx - points.pressure[0]));
    if (points.history.scalar("damage")[0] > 0.3) break;
  }
  return peak;
}

TEST(RiedelHiermaierThoma, CylinderStrengthAndTensileStrengthComeOutOfASingleElement) {
  // Strain rates of 1e-6 to 1e-5 1/s: below both reference rates.
  const Material material = library("concrete_35mpa_rht");
  EXPECT_NEAR(peak_of_uniaxial_stress(material, -3e-3, 1500), 35e6, 0.01 * 35e6);
  EXPECT_NEAR(peak_of_uniaxial_stress(material, 3e-4, 600), 3.5e6, 0.01 * 3.5e6);
}

TEST(RiedelHiermaierThoma, HardensFromTheElasticLimitToTheFailureSurface) {
  RiedelHiermaierThoma c = rht();
  const Material material = library("concrete_35mpa_rht");
  Body body{material};
  const double ratio = 0.9998;  // below p_el, far from the cap
  body.strain_to(diagonal(ratio, ratio, ratio), 50);
  const double p = body.p();
  ASSERT_GT(p, 10e6);
  ASSERT_LT(p, 20e6);
  double first = 0, last = 0;
  for (int i = 1; i <= 2000 && body.damage() == 0.0; ++i) {
    Matrix3 f = diagonal(ratio, ratio, ratio);
    f(0, 1) = 4e-6 * i;
    const double before = body.q();
    body.strain_to(f);
    if (first == 0 && body.points.plastic_strain[0] > 0) first = before;
    last = std::max(last, body.q());
  }
  const double rate = 4e-6 / ratio / dt / std::sqrt(3.0);
  const strength::BrittlePoint point{
      .pressure = body.p(), .rate = rate, .lode_cosine = 0.0, .crush_pressure = 23.3e6};
  const double whole = c.surface(point).strength(0);
  EXPECT_NEAR(last, whole, 0.01 * whole);
  EXPECT_NEAR(first, whole * c.hardened_share(0.0, point), 0.02 * whole);
  EXPECT_LT(first, 0.9 * last);
  EXPECT_GT(body.damage(), 0.0);
  strength::BrittlePoint hardened = point;
  hardened.plastic_strain = body.points.plastic_strain[0];
  EXPECT_NEAR(hardened.plastic_strain, c.hardening_strain(whole, hardened), 0.02 * hardened.plastic_strain);
}

}  // namespace
}  // namespace whipple
