// SPDX-License-Identifier: BSD-3-Clause
// Properties that every model on the core of constant heat capacity has, at random states of its range:
// thermodynamic identities, a batch equal to its single points, policies at the edges, inversion by
// temperature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "eos/identities.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

MieGruneisenConstants lead_steinberg() {
  // Steinberg, UCRL-MA-106439 (1996): S1, S2, S3 and the linear law of the Grueneisen parameter.
  MieGruneisenConstants c;
  c.reference_density = 11340;
  c.hugoniot_intercept = 2006;
  c.hugoniot_slope = 1.429;
  c.hugoniot_quadratic = 0.8506;
  c.hugoniot_cubic = -1.64;
  c.gruneisen = 2.74;
  c.gruneisen_law = CompressedGruneisenLaw::linear;
  c.gruneisen_slope = 0.54;
  c.heat_capacity = 124;
  return c;
}
PolynomialConstants polynomial_with_all_terms() {
  PolynomialConstants c = aluminium_polynomial();
  c.C0 = 1e9;
  c.C5 = 0.5;
  c.C6 = -0.1;
  c.reference_energy = 1e5;
  return c;
}
PolynomialConstants polynomial_without_heat() {
  PolynomialConstants c = aluminium_polynomial();
  c.C4 = 0;
  return c;
}

template <class M>
std::function<std::unique_ptr<EquationOfState>()> with(const typename M::Constants& constants) {
  return [constants] { return std::make_unique<ModelEquationOfState<M>>(constants); };
}

struct Case {
  const char* name;
  std::function<std::unique_ptr<EquationOfState>()> make;
  double thinnest, densest;  ///< rho/rho0
  double hottest;            ///< K
  bool entropy = true;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class ConstantHeat : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<EquationOfState> eos_ = GetParam().make();
  std::mt19937 random_{7};

  /// Density and energy between 50 K and the hottest temperature.
  std::pair<double, double> random_state() {
    std::uniform_real_distribution<double> uniform(0, 1);
    const Case& c = GetParam();
    const double ratio = c.thinnest * std::pow(c.densest / c.thinnest, uniform(random_));
    const double rho = ratio * eos_->reference_density();
    const double from = eos_->state_at_temperature(rho, 50).specific_internal_energy;
    const double to = eos_->state_at_temperature(rho, c.hottest).specific_internal_energy;
    return {rho, from + std::pow(uniform(random_), 2) * (to - from)};
  }
};

TEST_P(ConstantHeat, IdentitiesHoldByFiniteDifferences) {
  int checked = 0;
  for (int i = 0; i < 600; ++i) {
    const auto [rho, e] = random_state();
    if (std::abs(rho / eos_->reference_density() - 1) < 0.01) continue;  // the law changes at rho0
    const IdentityDefects d = check_identities(*eos_, rho, e);
    EXPECT_LT(d.largest(), 1e-6) << rho << " " << e << ": P " << d.pressure << " c " << d.sound_speed
                                 << " Cv " << d.heat_capacity << " Gamma " << d.gruneisen << " K_T "
                                 << d.bulk_modulus << " S,E " << d.entropy_energy << " S,V "
                                 << d.entropy_volume << " round trip " << d.round_trip;
    checked += std::isnan(d.sound_speed) || std::isnan(d.bulk_modulus) ? 0 : 1;
    EXPECT_EQ(std::isnan(d.entropy_energy), !GetParam().entropy);
  }
  EXPECT_GT(checked, 200);
}

TEST_P(ConstantHeat, ABatchEqualsItsSinglePointsBitForBit) {
  // 4 k + 3 points in an order that mixes both sides of the reference density within a group of four.
  constexpr std::size_t n = 203;
  std::vector<double> rho(n), e(n), p(n), T(n), c(n), melted(n), vapour(n);
  for (std::size_t i = 0; i < n; ++i) std::tie(rho[i], e[i]) = random_state();
  EXPECT_EQ(eos_->evaluate({rho, e, p, T, c, melted, vapour}).out_of_range, 0u);
  for (std::size_t i = 0; i < n; ++i) {
    const State s = eos_->state(rho[i], e[i]);
    EXPECT_EQ(s.pressure, p[i]);
    EXPECT_EQ(s.temperature, T[i]);
    EXPECT_EQ(s.sound_speed, c[i]);
    EXPECT_EQ(s.melted_fraction, melted[i]);
    EXPECT_EQ(s.vaporised_fraction, vapour[i]);
  }
}

TEST_P(ConstantHeat, ReferenceStateAndInversionByTemperature) {
  const State reference = eos_->state(eos_->reference_density(), eos_->reference_energy());
  EXPECT_NEAR(reference.temperature, eos_->reference_temperature(), 1e-9 * reference.temperature);
  if (GetParam().entropy) {
    EXPECT_NEAR(reference.specific_entropy, 0.0, 1e-9 * reference.heat_capacity);
  }
  for (int i = 0; i < 200; ++i) {
    const auto [rho, e] = random_state();
    const State s = eos_->state(rho, e);
    EXPECT_NEAR(eos_->state_at_temperature(rho, s.temperature).specific_internal_energy, e,
                1e-12 * (std::abs(e) + s.heat_capacity * s.temperature));
    EXPECT_GT(s.temperature, 49.9);
  }
}

TEST_P(ConstantHeat, EdgesOfTheRangeAreCountedAndSaid) {
  const double rho0 = eos_->reference_density(), e0 = eos_->reference_energy();
  const double coldest = eos_->minimum_energy(rho0), beyond = 1.01 * eos_->maximum_density();
  EXPECT_LT(coldest, e0);
  const std::vector<double> rho = {rho0, beyond, rho0, -1.0, rho0, std::nan(""), rho0, 0.0, rho0};
  const std::vector<double> e = {e0, e0, std::nan(""), e0, coldest - 1e4, e0, INFINITY, e0, e0};
  std::vector<double> p(9), T(9), c(9), melted(9), vapour(9);
  const RangeReport report = eos_->evaluate({rho, e, p, T, c, melted, vapour});
  EXPECT_EQ(report.out_of_range, 6u);
  EXPECT_EQ(report.first, 1u);
  EXPECT_EQ(report.bound, "density above the compression limit");
  EXPECT_EQ(report.below_cold_curve, 1u);
  for (std::size_t i : {1, 2, 3, 5, 6, 7}) {
    EXPECT_TRUE(std::isnan(p[i]) && std::isnan(T[i]) && std::isnan(c[i]) && std::isnan(melted[i])) << i;
    EXPECT_THROW(static_cast<void>(eos_->state(rho[i], e[i])), StateError) << i;
  }
  for (std::size_t i : {0, 8}) EXPECT_EQ(p[i], eos_->state(rho0, e0).pressure) << "neighbour of a bad point";
  // Too cold: the state of the least temperature, with the energy kept.
  EXPECT_EQ(T[4], eos_->least_temperature());
  const State least = eos_->state(rho0, coldest), held = eos_->state(rho0, coldest - 1e4);
  EXPECT_EQ(held.specific_internal_energy, coldest - 1e4);
  EXPECT_NEAR(held.pressure, least.pressure, 1e-9 * rho0 * least.sound_speed * least.sound_speed);
  EXPECT_THROW(static_cast<void>(eos_->state_at_temperature(rho0, 0.5)), StateError);
  EXPECT_THROW(static_cast<void>(eos_->state_at_temperature(beyond, 300)), StateError);
}

TEST_P(ConstantHeat, WorkOfTheNewPressureSolvesItsEquation) {
  // e = e_0 - h p(e), and that the general way, two evaluations and a secant, finds the same where it meets
  // no cold curve. Among the steps are ones that compress to half the volume and ones that end colder than
  // the coldest state.
  constexpr std::size_t n = 203;
  std::vector<double> rho(n), without(n), before(n), h(n);
  std::vector<bool> cold(n), steep(n);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    double e = 0.0;
    std::tie(rho[i], e) = random_state();
    const double coldest = eos_->minimum_energy(rho[i]);
    if (i % 7 == 0) e = coldest;
    const State state = eos_->state(rho[i], e);
    before[i] = state.pressure;
    h[i] = (i % 5 == 0 ? -0.5 : 0.01 * (uniform(random_) - 0.5)) / rho[i];
    without[i] = e + 1.2 * h[i] * before[i];
    const double first = without[i] - h[i] * before[i];
    const double second = without[i] - h[i] * eos_->state(rho[i], std::max(first, coldest)).pressure;
    cold[i] = std::min(first, second) < coldest;
    steep[i] = h[i] * state.gruneisen * rho[i] < least_work_slope;
  }
  struct Result {
    std::vector<double> e, p;
  };
  const auto integrated = [&](auto&& integrate) {
    Result result{without, before};
    std::vector<double> T(n), c(n), melted(n), vapour(n);
    EXPECT_EQ(integrate(Batch{rho, result.e, result.p, T, c, melted, vapour}, result.e).out_of_range, 0u);
    return result;
  };
  const auto [e, p] =
      integrated([&](const Batch& batch, auto& energy) { return eos_->integrate(batch, energy, h); });
  const Result general = integrated(
      [&](const Batch& batch, auto& energy) { return eos_->EquationOfState::integrate(batch, energy, h); });
  const bool linear = std::string_view(GetParam().name) != "tillotson";
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = std::abs(without[i]) + std::abs(h[i] * p[i]);
    if (!cold[i]) {
      EXPECT_NEAR(e[i], general.e[i], 1e-9 * scale) << i;
    }
    if (!linear) continue;
    const State state = eos_->state(rho[i], std::max(e[i], eos_->minimum_energy(rho[i])));
    EXPECT_NEAR(p[i], state.pressure, 1e-9 * rho[i] * scale) << i;
    if (!steep[i]) {
      EXPECT_NEAR(e[i], without[i] - h[i] * p[i], 1e-12 * scale) << i;
    }
  }
  EXPECT_GT(std::ranges::count(cold, false), 100);
}

class ConstantHeatWithEntropy : public ConstantHeat {};

TEST_P(ConstantHeatWithEntropy, AnIsentropeKeepsItsEntropy) {
  // An integration of de = -p dV that does not know the entropy, from a hot state across the reference
  // density.
  const double rho0 = eos_->reference_density();
  const State start = eos_->state_at_temperature(std::min(1.2, 0.5 * (1 + GetParam().densest)) * rho0,
                                                 2 * eos_->reference_temperature());
  for (const IsentropeState& s : isentrope(*eos_, start, {1.1 * rho0, 1.0 * rho0, 0.97 * rho0})) {
    EXPECT_NEAR(s.state.specific_entropy, start.specific_entropy, 1e-7 * start.heat_capacity);
  }
}

const Case tillotson_case{"tillotson", with<Tillotson>(aluminium_tillotson()), 0.02, 2.5, 3e4, false};
const auto cases_with_entropy = testing::Values(
    Case{"mie_gruneisen", with<MieGruneisen>(aluminium_2024()), 0.3, 2.2, 2e4},
    Case{"mie_gruneisen_constant_gamma", with<MieGruneisen>(aluminium_2024(CompressedGruneisenLaw::constant)),
         0.3, 1.6, 2e4},
    Case{"mie_gruneisen_steinberg_lead", with<MieGruneisen>(lead_steinberg()), 0.3, 1.9, 2e4},
    Case{"polynomial", with<Polynomial>(aluminium_polynomial()), 0.3, 2.0, 2e4},
    Case{"polynomial_all_terms", with<Polynomial>(polynomial_with_all_terms()), 0.3, 2.0, 2e4},
    Case{"polynomial_without_heat", with<Polynomial>(polynomial_without_heat()), 0.3, 2.0, 2e4},
    Case{"polynomial_air", with<Polynomial>(air_polynomial()), 1e-3, 9.0, 2e4},
    Case{"murnaghan", with<Murnaghan>(copper_murnaghan()), 0.3, 2.5, 2e4},
    Case{"tait", with<Tait>(water_tait()), 0.1, 2.0, 1e4},
    Case{"stiffened_gas", with<StiffenedGas>(water_stiffened()), 0.1, 2.0, 1e4},
    Case{"ideal_gas", with<IdealGas>(air()), 1e-6, 900, 2e4},
    Case{"jwl_tnt", with<Jwl>(tnt()), 1e-3, 2.5, 8e3}, Case{"jwl_petn", with<Jwl>(petn()), 1e-3, 2.5, 8e3},
    Case{"jwl_reactant", with<JwlReactant>(comp_b_reactant()), 0.3, 2.5, 8e3});
std::string name_of(const testing::TestParamInfo<Case>& each) { return each.param.name; }

INSTANTIATE_TEST_SUITE_P(Eos, ConstantHeat, cases_with_entropy, name_of);
INSTANTIATE_TEST_SUITE_P(EosTillotson, ConstantHeat, testing::Values(tillotson_case), name_of);
INSTANTIATE_TEST_SUITE_P(Eos, ConstantHeatWithEntropy, cases_with_entropy, name_of);

}  // namespace
}  // namespace whipple::eos::test
