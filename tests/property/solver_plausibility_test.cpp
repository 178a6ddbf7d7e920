// SPDX-License-Identifier: BSD-3-Clause
// A run with impossible energy parts or speeds stops even if the sum of its energies is exact (docs/theory/mpm.md,
// section 4): states in which energy was moved between the parts without an entry in any balance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

/// Returns a case of a block of aluminium, 4 x 2 x 2 mm, in cells of 1 mm.
/// @param of_body   further keys of the body
/// @param sections  further tables of the case
/// @param of_time   further keys of the table `time`
cases::Case flying(const std::string& velocity, const std::string& of_body = {},
                   const std::string& sections = {}, const Method& method = {},
                   const std::string& of_time = {}) {
  return cases::read_case_text(
      method.time_toml(1e-6) + of_time + R"(
[domain]
lower = [-0.02, -0.01, -0.01]
upper = [0.02, 0.01, 0.01]
cell_size = 1e-3
)" + sections +
          R"(
[[body]]
name = "block"
velocity = )" +
          velocity + "\n" + of_body +
          (of_body.find("material") == std::string::npos
               ? "material = \"" + aluminium("plausible_aluminium", "300 MPa") + "\"\n"
               : "") +
          "shape = { box = { lower = [-2e-3, -1e-3, -1e-3], upper = [2e-3, 1e-3, 1e-3] } }\n",
      "flying.toml");
}

/// Advances one step from the state of a case after `change`; returns the error that ends it.
std::string error_of_step(const cases::Case& setup, const std::function<void(Particles&)>& change) {
  solver::Simulation start(setup, parallel::world());
  Particles particles = start.particles();
  change(particles);
  solver::RunState state = start.state();
  state.step = 1;  // that of a resumed run: its initial values are kept
  solver::Simulation changed(setup, particles, state, parallel::world());
  try {
    changed.advance(setup.time.end);
  } catch (const StateError& error) {
    return error.what();
  }
  return {};
}

/// Raises the speeds by a factor and takes the energy from heat.
std::function<void(Particles&)> faster(double factor) {
  return [factor](Particles& q) {
    for (std::size_t p = 0; p < q.size(); ++p) {
      q.specific_internal_energy[p] -= 0.5 * (factor * factor - 1.0) * q.velocity[p].squaredNorm();
      q.velocity[p] *= factor;
    }
  };
}

TEST(Plausibility, MotionThatNothingCanHaveMadeEndsTheRun) {
  const cases::Case setup = flying("[100, 0, 0]", "", "[output]\nmaximum_speed_factor = 1e12\n");
  EXPECT_EQ(error_of_step(setup, faster(1.0)), "");
  EXPECT_EQ(error_of_step(setup, faster(1.01)),
            "");  // 2 % of the energy, and the permitted error of the sum
  EXPECT_THAT(
      error_of_step(setup, faster(1.05)),
      testing::AllOf(testing::HasSubstr("step 2, t = "), testing::HasSubstr("the energy of motion is 0.24"),
                     testing::HasSubstr("more than the 0.22")));
}

TEST(Plausibility, OneParticleThatIsFarTooFastEndsTheRun) {
  const auto one = [](Particles& q) {
    q.specific_internal_energy[7] -= 0.5 * (2000.0 * 2000.0 - q.velocity[7].squaredNorm());
    q.velocity[7] = {2000.0, 0.0, 0.0};
  };
  // Against a wall, and with an energy limit that is not reached
  const std::string sections =
      "boundary = { x_upper = \"separating\" }\n[output]\nmaximum_energy_error = 1e9\n";
  EXPECT_THAT(
      error_of_step(flying("[100, 0, 0]", "", sections), one),
      testing::AllOf(testing::HasSubstr("is impossible"), testing::HasSubstr("of body \"block\" at ("),
                     testing::HasSubstr("output.maximum_speed_factor")));
  EXPECT_EQ(error_of_step(flying("[100, 0, 0]", "", sections + "maximum_speed_factor = 30\n"), one), "");
}

TEST(Plausibility, SpeedsAreThoseInTheFrameOfTheCentreOfMass) {
  EXPECT_EQ(error_of_step(flying("[9000, 0, 0]"), faster(1.0)), "");
  EXPECT_THAT(error_of_step(flying("[9000, 0, 0]"), faster(1.001)), testing::HasSubstr("is impossible"));
}

// What a load accelerates may be much faster than the mean of all material.
TEST(Plausibility, ALoadOnASmallPartIsNoFault) {
  const std::string corner = "box = { lower = [1.5e-3, 0.5e-3, 0.5e-3], upper = [0.02, 0.01, 0.01] }\n";
  for (const std::string load : {"force = [\"0 N\", \"10 N\", \"0 N\"]\n", "acceleration = [0, 1e6, 0]\n"}) {
    const cases::Case setup = flying("[0, 0, 0]", "", "[[load]]\n" + load + corner);
    solver::Simulation simulation(setup, parallel::world());
    for (int step = 0; step < 5; ++step) ASSERT_NO_THROW(simulation.advance(setup.time.end)) << load;
    double fastest = 0.0;
    for (const Vector3& v : simulation.particles().velocity) fastest = std::max(fastest, v.norm());
    const double mean = simulation.state().ledger.external_impulse.norm() / simulation.totals().mass;
    EXPECT_GT(fastest, setup.output.maximum_speed_factor * mean) << load;
  }
}

// A load that has ended allows no more than it gave.
TEST(Plausibility, AFastParticleBesideALoadThatHasEndedEndsTheRun) {
  const std::string load =
      "[[load]]\nacceleration = [0, 1e6, 0]\ntimes = [\"0 s\", \"1 ns\"]\nfactors = [1, 0]\n";
  const auto one = [](Particles& q) {
    q.specific_internal_energy[7] -= 0.5 * (2000.0 * 2000.0 - q.velocity[7].squaredNorm());
    q.velocity[7] = {2000.0, 0.0, 0.0};
  };
  const std::string sections =
      "boundary = { x_upper = \"separating\" }\n" + load + "[output]\nmaximum_energy_error = 1e9\n";
  EXPECT_THAT(error_of_step(flying("[100, 0, 0]", "", sections), one), testing::HasSubstr("is impossible"));
}

TEST(Plausibility, ATimeStepThatCollapsesEndsTheRun) {
  Method slow, tiny;
  slow.courant = 1e-6;
  tiny.first_step = 1e-6;
  const auto message_of = [](const cases::Case& setup) -> std::string {
    solver::Simulation simulation(setup, parallel::world());
    try {
      for (int step = 0; step < 2; ++step) simulation.advance(setup.time.end);
    } catch (const StateError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(flying("[100, 0, 0]", "", "", slow)), "");  // slow steps are not collapsed steps
  EXPECT_EQ(message_of(flying("[100, 0, 0]", "", "", tiny)), "");
  const std::string pressed = "initial = { pressure = 1e9 }\n";
  EXPECT_THAT(message_of(flying("[100, 0, 0]", pressed, "", {}, "acceleration_limit = 1e-300\n")),
              testing::AllOf(testing::HasSubstr("the time step has collapsed to"),
                             testing::HasSubstr("maximum acceleration"),
                             testing::HasSubstr("body \"block\", particle")));
}

TEST(Plausibility, ANegativeStoreEndsTheRun) {
  const auto negative = [](Particles& q) {
    const double energy = 1e-2;  // J
    q.unresolved_energy[0] -= energy / q.mass[0];
    q.specific_internal_energy[0] += energy / q.mass[0];
  };
  EXPECT_THAT(error_of_step(flying("[100, 0, 0]"), negative),
              testing::HasSubstr("the unresolved energy is -0.01 J, less than 0"));
}

TEST(Plausibility, GasIsFreeToExpandAndPressureToRelease) {
  const std::string gas = write_material(
      "plausible_gas",
      "name = \"gas\"\nsource = \"verification\"\n[eos]\nmodel = \"ideal_gas\"\nsource = \"verification\"\n"
      "reference_density = \"10 kg/m^3\"\nheat_capacity_ratio = 1.4\nheat_capacity = \"718 J/(kg K)\"\n");
  for (const std::string& body :
       {"material = \"" + gas + "\"\ninitial = { pressure = 1e6, density = 10 }\n",
        std::string("initial = { pressure = 5e9 }\n"), std::string("initial = { pressure = -1e9 }\n")}) {
    const cases::Case setup = flying("[0, 0, 0]", body);
    solver::Simulation simulation(setup, parallel::world());
    while (simulation.state().time < setup.time.end) simulation.advance(setup.time.end);
    EXPECT_GT(simulation.totals().kinetic_energy, 0.0);
  }
}

}  // namespace
}  // namespace whipple::verification
