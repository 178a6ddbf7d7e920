// SPDX-License-Identifier: BSD-3-Clause
// What the protocols make of positions, velocities and series, on data with a known answer; and plans that
// cannot be measured.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "md_fitting/protocols/liquid_vapour.hpp"
#include "md_fitting/protocols/piston.hpp"
#include "md_fitting/protocols/spall.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

// A front of finite width stands where the velocity is half way; beyond it nothing may be taken for a front.
TEST(Piston, FrontStandsWhereHalfTheVelocityIsLost) {
  std::vector<double> profile(100);
  for (std::size_t k = 0; k < profile.size(); ++k) {
    profile[k] = -500.0 * (1.0 + std::tanh((static_cast<double>(k) - 40.3) / 2.0));
  }
  EXPECT_NEAR(front_position(profile, 1000.0), 40.3, 0.02);
  profile[3] = -900.0;  // a slow layer near the piston is not the front
  EXPECT_NEAR(front_position(profile, 1000.0), 40.3, 0.02);
  EXPECT_LT(front_position(std::vector<double>(50, -1000.0), 1000.0), 0.0);
}

// The first third, where the shock forms, has no say; the stated error covers the noise.
TEST(Piston, SlopeOfTheLastTwoThirds) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, 0.5);
  std::vector<double> x(60), y(60);
  int within = 0;
  for (int trial = 0; trial < 200; ++trial) {
    for (std::size_t i = 0; i < 60; ++i) {
      x[i] = static_cast<double>(i);
      y[i] = (i < 20 ? 20.0 * 3.0 + 9.0 * (x[i] - 20.0) : 3.0 * x[i]) + noise(generator);
    }
    const Estimate slope = late_slope(x, y);
    if (std::abs(slope.value - 3.0) < 2.0 * slope.error) ++within;
    EXPECT_NEAR(slope.value, 3.0, 0.05);
  }
  EXPECT_GT(within, 190);
}

// Compression along the shock moves no atom across; slip by a partial dislocation does, whatever the period.
TEST(Piston, SlipIsSeenAcrossTheShockOnly) {
  const double a = 3.6, period = 10.8;
  std::vector<double> before = {0.1, 0.1, 0.0, 5.0, 5.0, 9.0, 10.7, 2.0, 18.0, 3.0, 10.75, 27.0};
  std::vector<double> after = before;
  for (std::size_t i = 0; i < 4; ++i) after[3 * i + 2] *= 0.8;
  after[6] -= 10.7;  // thermal motion of 0.1 A across the periodic face
  const std::vector<std::size_t> all = {0, 1, 2, 3};
  EXPECT_EQ(slipped_share(before, after, all, period, a), 0.0);
  after[3] += a / std::sqrt(6.0);
  EXPECT_EQ(slipped_share(before, after, all, period, a), 0.25);
}

TEST(Spall, LargestMeanIsThatOfAWindowNotOfASample) {
  std::vector<double> series(100, 1.0);
  series[20] = 50.0;  // one sample of noise
  for (std::size_t i = 60; i < 70; ++i) series[i] = 10.0;
  const Peak peak = largest_mean(series, 10);
  EXPECT_EQ(peak.first, 60U);
  EXPECT_DOUBLE_EQ(peak.value, 10.0);
  EXPECT_THROW(largest_mean(series, 101), InternalError);
}

// A film that lies across the periodic face has its centre there, not in the middle of the vapour.
TEST(LiquidVapour, CentreOfAFilmAcrossThePeriodicFace) {
  std::vector<double> places;
  for (int i = -100; i <= 100; ++i) places.push_back(std::fmod(0.1 * i + 68.0 + 68.0, 68.0));
  const double centre = circular_mean(places, 68.0);
  EXPECT_NEAR(std::min(centre, 68.0 - centre), 0.0, 1e-9);
  for (double& place : places) place = std::fmod(place + 20.0, 68.0);
  EXPECT_NEAR(circular_mean(places, 68.0), 20.0, 1e-9);
}

TEST(LiquidVapour, InterfaceOfAKnownProfile) {
  // tanh profile of half width 2 A: from 90 to 10 % it takes 2 x 1.0986 x 2 A.
  std::vector<double> profile(40);
  for (std::size_t k = 0; k < profile.size(); ++k) {
    profile[k] = 0.035 - 0.03 * std::tanh((static_cast<double>(k) + 0.5 - 17.2) / 2.0);
  }
  const Interface interface = find_interface(profile, 1.0);
  EXPECT_NEAR(interface.place, 17.2, 0.05);
  EXPECT_NEAR(interface.width, 4.0 * std::atanh(0.8), 0.15);
  // Noise of the plateaus beyond 90 and 10 % is no part of the interface.
  std::vector<double> noisy = profile;
  noisy[4] *= 0.85;
  noisy[30] += 0.008;
  EXPECT_NEAR(find_interface(noisy, 1.0).place, 17.2, 0.3);
  EXPECT_NEAR(find_interface(noisy, 1.0).width, 4.0 * std::atanh(0.8), 0.6);
  EXPECT_THROW(find_interface(std::vector<double>(40, 0.03), 1.0), StateError);
  for (std::size_t k = 0; k < 6; ++k) profile[k] = 0.02;  // torn in the middle
  EXPECT_THROW(find_interface(profile, 1.0), StateError);
}

std::string errors_of(const std::string& text) {
  try {
    auto document = input::Document::from_text(
        "element = \"Cu\"\npotential = \"copper_universal_3\"\n" + text, "plan.toml");
    read_plan(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Plan, SectionsThatCannotBeMeasuredAreRefused) {
  EXPECT_NE(errors_of("[piston]\nparticle_velocity = [\"1 km/s\"]\n").find("[piston] needs the section"),
            std::string::npos);
  EXPECT_NE(errors_of("[hugoniostat]\npressure = [\"50 GPa\"]\n").find("[hugoniostat] needs the section"),
            std::string::npos);
  EXPECT_NE(errors_of("[liquid]\ntemperature = []\n").find("at least one temperature"), std::string::npos);
  EXPECT_NE(errors_of("[[fluid]]\nvolume_ratio = [40]\ntemperature = [\"9000 K\"]\n").find("volume_ratio"),
            std::string::npos);
  EXPECT_NE(errors_of("[[fluid]]\nvolume_ratio = [2]\ntemperature = []\n").find("at least one temperature"),
            std::string::npos);
  EXPECT_NE(errors_of("[spall]\nstrain_rate = \"1e14 1/s\"\n").find("strain_rate"), std::string::npos);
  EXPECT_NE(errors_of("[spall]\nreplicas = 1\n").find("replicas"), std::string::npos);
  EXPECT_NE(errors_of("[liquid_vapour]\ntemperature = [\"-5 K\"]\n").find("temperature"), std::string::npos);
  EXPECT_NE(errors_of("[liquid_vapour]\ntemperature = [\"5000 K\"]\nreplicas = 1\n").find("replicas"),
            std::string::npos);
  const std::string melting = "[[coexistence]]\npressure = [\"0 GPa\"]\nfirst_guess = [\"1300 K\"]\n";
  EXPECT_EQ(errors_of(melting), "no InputError");
  EXPECT_NE(errors_of(melting + "replicas = 1\n").find("replicas"), std::string::npos);
  EXPECT_NE(errors_of(melting + "length = 4\n").find("length"), std::string::npos);
  EXPECT_NE(errors_of("[elastic]\nlargest_strain = 0.5\n").find("largest_strain"), std::string::npos);
  EXPECT_NE(errors_of("[cold_curve]\nvolume_ratio = [0.05]\n").find("volume_ratio"), std::string::npos);
  EXPECT_EQ(errors_of("[spall]\n[elastic]\n"), "no InputError");
}

// The guess from the static crystal is good to a tenth: u3 at V/Vs = 0.75 has 1200 K and 78 GPa on its
// Hugoniot (Us = 3.90 + 1.32 up); and the search by pressure returns to the volume that it came from.
TEST(HugoniotGuess, IsNearTheHugoniotAndConsistent) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  ReferenceState rest;
  rest.specific_volume.value = 1.1352e-4;
  rest.specific_internal_energy.value = -5.2587e6;
  const HugoniotGuess guess = guess_hugoniot(potential, rest, 0.75 * potential.static_volume());
  const double strain = 1.0 - guess.specific_volume / rest.specific_volume.value;
  const double particle = 3900.0 * strain / (1.0 - 1.32 * strain);
  const double pressure = particle * (3900.0 + 1.32 * particle) / rest.specific_volume.value;
  EXPECT_NEAR(guess.pressure / pressure, 1.0, 0.05);
  const HugoniotGuess back = guess_hugoniot_at_pressure(potential, rest, guess.pressure);
  EXPECT_NEAR(back.specific_volume / guess.specific_volume, 1.0, 1e-4);
  EXPECT_NEAR(back.temperature / guess.temperature, 1.0, 1e-3);
  EXPECT_THROW(guess_hugoniot_at_pressure(potential, rest, 1e15), StateError);
}

}  // namespace
}  // namespace whipple::md
