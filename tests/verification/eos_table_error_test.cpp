// SPDX-License-Identifier: BSD-3-Clause
// A table has the requested error in T and p at every one of many random states, in every phase; where the
// model contradicts itself (the closed form of GRAY's melting band), the table differs from it by just that
// contradiction. WHIPPLE_TABLE_STATES: how many states.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "eos/identities.hpp"
#include "eos/table/builder.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos {
namespace {

std::size_t states() {
  const char* const given = std::getenv("WHIPPLE_TABLE_STATES");
  return given != nullptr ? std::strtoul(given, nullptr, 10) : 100000;
}

/// Every phase but those named, which have no request to meet.
void expect_requested_error(const EquationOfState& eos, const TableRequest& request,
                            const std::string& without = "") {
  const Table table(tabulate(eos, request));
  std::size_t found = 0;
  for (const auto& [phase, error] : verify(table, eos, states())) {
    found += error.states;
    testing::Test::RecordProperty(phase + " T", std::to_string(error.temperature));
    testing::Test::RecordProperty(phase + " p", std::to_string(error.pressure));
    if (phase == without) continue;
    EXPECT_LT(error.temperature, request.error) << phase << ", " << error.states << " states";
    EXPECT_LT(error.pressure, request.error) << phase << ", " << error.states << " states";
    EXPECT_LT(error.mean_sound_speed, request.error) << phase;
  }
  EXPECT_EQ(found, states());
}

TEST(EosTableError, CopperWithTheMeltingBand) {
  const test::GrayEos eos(test::copper());
  expect_requested_error(eos, {}, "melting");
}

TEST(EosTableError, CopperWithEquilibriumMeltingInAllPhases) {
  // Six phases on an isochore in strong tension, a kink at the last tie line and jumps across it.
  const test::GrayEos eos(test::copper(MeltingTransition::equilibrium));
  expect_requested_error(eos, {});
}

TEST(EosTableError, CopperWithIsochoricMeltingInAllPhases) {
  const test::GrayEos eos(test::copper(MeltingTransition::isochoric));
  expect_requested_error(eos, {.error = 3e-4});
}

TEST(EosTableError, InTheMeltingBandTheTableIsTheDerivativeOfTheModelsEntropy) {
  const test::GrayEos eos(test::copper());
  const GrayFreeEnergy& f = eos.underlying().free_energy();
  const TableRequest request;
  const Table table(tabulate(eos, request));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double own_defect = 0;
  for (std::size_t i = 0; i < states() / 50; ++i) {
    const double V = test::copper().reference_specific_volume * (0.5 + 0.58 * uniform(random)), rho = 1 / V;
    const GrayBand band = f.band(f.isochore(V));
    const double e = band.E1 + (0.15 + 0.7 * uniform(random)) * (band.E2 - band.E1);
    const State model = eos.state(rho, e), found = table.state(rho, e);
    const IdentityDefects d = check_identities(eos, rho, e, 1e-4);
    ASSERT_FALSE(std::isnan(d.entropy_energy) || std::isnan(d.entropy_volume));
    // 1/T = (dS/dE)_V, p/T = (dS/dV)_E of the model's entropy by differences.
    const double stiffness = rho * model.sound_speed * model.sound_speed;
    const double T = model.temperature / (1 + d.entropy_energy);
    const double p =
        (model.pressure + d.entropy_volume * (std::abs(model.pressure) + stiffness)) / (1 + d.entropy_energy);
    EXPECT_NEAR(found.temperature / T, 1, request.error);
    EXPECT_NEAR(found.pressure, p, request.error * (std::abs(p) + 0.01 * stiffness));
    own_defect = std::max(own_defect, std::abs(T / model.temperature - 1));
  }
  EXPECT_GT(own_defect, request.error);  // else there would be nothing to explain
  RecordProperty("own defect of T", std::to_string(own_defect));
}

}  // namespace
}  // namespace whipple::eos
