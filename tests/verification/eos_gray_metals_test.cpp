// SPDX-License-Identifier: BSD-3-Clause
// GRAY on Steinberg's metals with a curved Us-up relation: lead and titanium.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/identities.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

/// Steinberg, UCRL-MA-106439 (1996). Electronic heat coefficients: 3.0 and 3.35 mJ/(mol K^2).
GrayConstants lead(double electronic) {
  GrayConstants c;
  c.molar_mass = 207.2e-3;
  c.reference_specific_volume = 1 / 11340.0;
  c.hugoniot_intercept = 2006;
  c.hugoniot_slope = 1.429;
  c.hugoniot_quadratic = 0.8506;
  c.hugoniot_cubic = -1.64;
  c.gruneisen = 2.74;
  c.gruneisen_slope = 2.2;
  c.electronic_heat_coefficient = electronic;
  c.melting_temperature = 760;
  c.vapour_attraction = 100;
  c.join_volume_ratio = 1.2;
  return c;
}
GrayConstants titanium(double electronic) {
  GrayConstants c;
  c.molar_mass = 47.867e-3;
  c.reference_specific_volume = 1 / 4510.0;
  c.hugoniot_intercept = 5020;
  c.hugoniot_slope = 1.536;
  c.hugoniot_quadratic = -5.138;
  c.hugoniot_cubic = 10.82;
  c.gruneisen = 1.23;
  c.gruneisen_slope = 1.0;
  c.electronic_heat_coefficient = electronic;
  c.melting_temperature = 2260;
  c.vapour_attraction = 2000;
  return c;
}

/// Greatest relative deviation of Us from Steinberg's curve on the solid Hugoniot.
double shock_curve_deviation(const GrayConstants& c) {
  const GrayEos eos(c);
  const double onset = shock_melting(eos).value().onset.state.pressure;
  double worst = 0;
  for (int i = 1; i < 60; ++i) {
    const ShockState s = Hugoniot(eos).at_pressure(onset * i / 60);
    EXPECT_EQ(s.state.phase, "solid");
    const double up = s.particle_velocity, x = up / s.shock_velocity;
    const double us =
        c.hugoniot_intercept + up * (c.hugoniot_slope + c.hugoniot_quadratic * x + c.hugoniot_cubic * x * x);
    worst = std::max(worst, std::abs(s.shock_velocity / us - 1));
  }
  return worst;
}

TEST(EosGrayMetals, HugoniotFollowsACurvedShockRelation) {
  // Without electronic terms there is one Grueneisen parameter, and the curve is reproduced exactly.
  EXPECT_LT(shock_curve_deviation(lead(0)), 1e-8);
  EXPECT_LT(shock_curve_deviation(titanium(0)), 1e-8);
  EXPECT_LT(shock_curve_deviation(titanium(3.35e-3)), 2e-3);
  // Lead, hot and soft, feels gamma_e = 2/3 against gamma = 2.7: 1.3 % at the onset of melting (63 GPa).
  const double deviation = shock_curve_deviation(lead(3.0e-3));
  EXPECT_GT(deviation, 0.010);
  EXPECT_LT(deviation, 0.015);
}

TEST(EosGrayMetals, ColdPressureRisesToTheCompressionLimit) {
  for (GrayConstants c : {lead(0), lead(3.0e-3), titanium(0), titanium(3.35e-3)}) {
    c.join_volume_ratio = 1.3;  // also in tension, where S2 and S3 are not used
    const GrayFreeEnergy f(c);
    double before = -INFINITY;
    for (int i = 0; i <= 4000; ++i) {
      const double P = f.cold_pressure(f.join_volume() + (f.least_volume() - f.join_volume()) * i / 4000);
      ASSERT_GT(P, before) << c.molar_mass << " " << i;
      before = P;
    }
  }
  // Maximum of the cold curve of lead, and pole of the shock curve of titanium (1 - S x... = 0.03): both
  // from an independent integration.
  const GrayFreeEnergy pb(lead(0)), ti(titanium(0));
  EXPECT_NEAR(pb.least_volume() * 11340, 0.4742, 2e-4);
  EXPECT_NEAR(pb.cold_pressure(pb.least_volume()) * 1e-9, 113.9, 0.1);
  EXPECT_NEAR(ti.least_volume() * 4510, 0.4723, 1e-4);
  EXPECT_THROW(static_cast<void>(GrayEos(lead(0)).state(1.001 / pb.least_volume(), 5e6)), StateError);
}

}  // namespace
}  // namespace whipple::eos::test
