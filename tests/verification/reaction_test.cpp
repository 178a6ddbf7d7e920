// SPDX-License-Identifier: BSD-3-Clause
// Explosives that burn by a rate law: the law against its own integral, a detonation that finds its velocity,
// initiation by a shock, and what a material must say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/material/material_file.hpp"
#include "src/material/reaction/catalogue.hpp"
#include "src/material/reaction/ignition_and_growth.hpp"
#include "src/material/reaction/jwl_plus_plus.hpp"
#include "tests/verification/burn_columns.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification {
namespace {

using exact::default_case;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The explosive of the rate sticks of cases/rate_stick, with a rate and other tables.
std::string non_ideal(const std::string& name, const std::string& reaction) {
  return write_material(name, R"toml(
name = "non-ideal explosive"
source = "test"
[eos]
model = "jwl"
source = "test"
reference_density = "1160 kg/m^3"
pressure_1 = "298.67 GPa"
pressure_2 = "4.117 GPa"
exponent_1 = 4.95
exponent_2 = 1.15
gruneisen = 0.35
detonation_energy = "4 GJ/m^3"
heat_capacity = "1000 J/(kg K)"
)toml" + reaction);
}
const std::string reactant = R"toml(
[eos.unreacted]
model = "murnaghan"
source = "test"
reference_density = "1160 kg/m^3"
bulk_modulus = "25.64 GPa"
bulk_modulus_slope = 7.4
gruneisen = 0.7
heat_capacity = "1000 J/(kg K)"
)toml";
const std::string law = R"toml(
[reaction]
model = "jwl_plus_plus"
source = "test"
rate = "3.5083e6 1/s"
pressure_exponent = 1.3
)toml";

TEST(JwlPlusPlus, IsTheIntegralOfItsRateAtConstantPressure) {
  const reaction::ReactionModel<reaction::JwlPlusPlus> model(
      {.rate = 3e6, .rate_pressure = 1e10, .pressure_exponent = 1.3});
  const std::vector<double> compression = {1.0, 1.1, 1.2, 1.0}, pressure = {1e10, 4e9, 1.7e10, -1e8};
  const auto after = [&](double time, int steps) {
    std::vector<double> burnt = {0.0, 0.3, 0.9, 0.5};
    for (int i = 0; i < steps; ++i) model.advance({time / steps, compression, pressure}, burnt);
    return burnt;
  };
  const std::vector<double> once = after(2e-7, 1), often = after(2e-7, 7), at_first = after(1e-12, 1);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(once[i], often[i], 1e-14);
  EXPECT_NEAR(once[0], 1.0 - std::exp(-0.6), 1e-14);
  // The rate itself: r (p/p_r)^b (1 - F).
  EXPECT_NEAR((at_first[1] - 0.3) / 1e-12, 3e6 * std::pow(0.4, 1.3) * 0.7, 100.0);
  EXPECT_EQ(once[3], 0.5);  // no tension burns
}

/// The least-squares slope of place over time of arrival of half the burn, over particles that begin in a
/// range.
double front_velocity(const std::string& text, double end, double from, double to) {
  solver::Simulation simulation(default_case(end, text), parallel::world());
  const std::vector<Vector3> start = exact::positions_by_id(simulation.particles());
  std::vector<double> arrival(start.size(), -1.0), before(start.size(), 0.0);
  double earlier = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    const Particles& q = s.particles();
    const std::vector<double>& burnt = q.history.scalar("burn_fraction");
    for (std::size_t p = 0; p < q.size(); ++p) {
      const std::size_t id = q.id[p];
      if (arrival[id] < 0.0 && burnt[p] >= 0.5) {
        arrival[id] = earlier + (s.state().time - earlier) * (0.5 - before[id]) / (burnt[p] - before[id]);
      }
      before[id] = burnt[p];
    }
    earlier = s.state().time;
  });
  double n = 0.0, x = 0.0, t = 0.0, xt = 0.0, tt = 0.0;
  for (std::size_t id = 0; id < start.size(); ++id) {
    if (start[id][0] < from || start[id][0] > to || arrival[id] < 0.0) continue;
    n += 1.0, x += start[id][0], t += arrival[id];
    xt += start[id][0] * arrival[id], tt += arrival[id] * arrival[id];
  }
  EXPECT_GT(n, 50.0);
  return (n * xt - x * t) / (n * tt - t * t);
}

/// Velocity of a steady planar front: for each burn fraction the least for which the Rayleigh line meets the
/// Hugoniot of the mixture, of which the largest decides (an eigenvalue of the problem: W. Fickett, W. C.
/// Davis, Detonation (1979), chapter 5). At F = 1 it is that of Chapman and Jouguet.
double steady_velocity(const BurningExplosive& mixture) {
  const double rho0 = mixture.explosive().density, Q = mixture.explosive().stored_energy;
  const auto pressure_on_hugoniot = [&](double v, double F) {
    double lower = 1e7, upper = 1e11;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (lower + upper), rho = rho0 / v, e = Q + 0.5 * middle * (1.0 - v) / rho0;
      double p = 0.0, T = 0.0, c = 0.0;
      mixture.evaluate({{&rho, 1}, {&e, 1}, {&p, 1}, {&T, 1}, {&c, 1}, {}, {}}, {&F, 1});
      (p > middle ? lower : upper) = middle;
    }
    return lower;
  };
  double greatest = 0.0;
  for (double F = 0.0; F <= 1.0; F += 0.05) {
    double least = 1e99;
    for (double v = 0.7; v < 0.99; v += 0.004)
      least = std::min(least, pressure_on_hugoniot(v, F) / (1.0 - v));
    greatest = std::max(greatest, std::sqrt(least / rho0));
  }
  return greatest;
}

// Nothing tells the front how fast to run. The stiff reactant makes the mixture stiffer than either end: the
// front is faster than that of Chapman and Jouguet, by the fraction that the theory of the steady wave gives.
TEST(JwlPlusPlus, APlanarDetonationFindsItsVelocity) {
  const std::string material = non_ideal("rate_law", reactant + law);
  const std::shared_ptr<const Explosive> read = read_material(material).explosive;
  const Explosive& explosive = *read;
  EXPECT_NEAR(explosive.detonation_velocity, 5899.0, 2.0);
  const double D = steady_velocity(BurningExplosive(read));
  EXPECT_NEAR(D, 6513.0, 15.0);  // of an independent computation
  const std::string text = column(material, 0.06, 2.5e-4, lit_at_wall);
  EXPECT_NEAR(front_velocity(text, 0.055 / D, 0.03, 0.045) / D, 1.0, 0.02);
}

// With both at one pressure and temperature the front is slower, 6.44 km/s, not yet that of Chapman and
// Jouguet: this reactant is stiffer than its products up to the pressure of the detonation.
TEST(JwlPlusPlus, InEquilibriumAPlanarDetonationFindsItsVelocity) {
  const std::string material =
      non_ideal("rate_law_equilibrium", reactant + law + "closure = \"equilibrium\"\n");
  const double D = steady_velocity(BurningExplosive(read_material(material).explosive));
  EXPECT_NEAR(D, 6444.0, 15.0);  // of an independent computation
  const std::string text = column(material, 0.045, 2.5e-4, lit_at_wall);
  EXPECT_NEAR(front_velocity(text, 0.041 / D, 0.022, 0.034) / D, 1.0, 0.02);
}

// A flyer lights it where the shock lasts: no detonator is needed, and a tenth of the rate leaves it nearly
// unburnt.
TEST(JwlPlusPlus, AShockLightsItWithoutADetonator) {
  const auto burnt = [&](const std::string& name, const std::string& of_rate) {
    const std::string flyer =
        "[[body]]\nname = \"flyer\"\nmaterial = \"copper_ofhc_mie_gruneisen\"\nvelocity = [-1200, 0]\nshape "
        "= { box = { lower = [0.02, 0], upper = [0.03, 5e-4] } }\n";
    std::string text = column(non_ideal(name, reactant + of_rate), 0.02, 5e-4, flyer);
    text.replace(text.find("0.022"), 5, "0.035");
    solver::Simulation simulation(default_case(3e-6, text), parallel::world());
    run_to(simulation, 3e-6);
    const Particles& q = simulation.particles();
    double mean = 0.0, count = 0.0;
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] == 0) mean += q.history.scalar("burn_fraction")[p], count += 1.0;
    }
    return mean / count;
  };
  std::string slow = law;
  slow.replace(slow.find("3.5083e6"), 8, "3.5083e5");
  const double fast = burnt("rate_law_shocked", law), little = burnt("rate_law_slow", slow);
  EXPECT_GT(fast, 0.5);
  EXPECT_LT(little, 0.5 * fast);
  EXPECT_GT(little, 0.01);
}

/// The set of Composition B, in the units of its table: Mbar and us.
reaction::IgnitionAndGrowth composition_b_rates() {
  return {.ignition_rate = 4e12,
          .ignition_depletion = 0.667,
          .ignition_threshold = 0.0,
          .ignition_exponent = 7.0,
          .ignition_end = 0.022,
          .growth_rate = 850e6,
          .growth_depletion = 0.222,
          .growth_order = 0.667,
          .growth_exponent = 2.0,
          .growth_end = 0.6,
          .completion_rate = 660e6,
          .completion_depletion = 0.333,
          .completion_order = 1.0,
          .completion_exponent = 3.0,
          .completion_start = 0.0};
}

TEST(IgnitionAndGrowth, IsTheIntegralOfItsRateAtConstantPressure) {
  const reaction::IgnitionAndGrowth rates = composition_b_rates();
  const reaction::ReactionModel<reaction::IgnitionAndGrowth> model(rates);
  const std::vector<double> compression = {1.2, 1.25, 1.35, 1.2, 0.9},
                            pressure = {5e9, 1e10, 3e10, 5e9, -1e8};
  const std::vector<double> start = {0.0, 0.0, 0.3, 0.61, 0.5};
  const auto after = [&](double time, int steps) {
    std::vector<double> burnt = start;
    for (int i = 0; i < steps; ++i) model.advance({time / steps, compression, pressure}, burnt);
    return burnt;
  };
  for (const double time : {1e-9, 2e-8, 2e-7}) {
    const std::vector<double> once = after(time, 1), often = after(time, 200);
    for (std::size_t i = 0; i < start.size(); ++i) {
      // By many explicit steps, of which the first to pass the end of ignition stops there.
      double F = start[i];
      for (int k = 0; k < 40000; ++k) {
        const double next = std::min(1.0, F + time / 40000 * rates.rate(F, compression[i], pressure[i]));
        F = F < rates.ignition_end ? std::min(next, rates.ignition_end) : next;
      }
      EXPECT_NEAR(often[i], F, 1e-3) << i << " " << time;
      EXPECT_NEAR(once[i], F, 5e-3) << i << " " << time;
      EXPECT_GE(once[i], start[i]);
    }
    EXPECT_EQ(once[4], 0.5);  // no tension burns
  }
  // The terms one by one.
  EXPECT_NEAR(rates.rate(0.0, 1.2, 5e9), 4e12 * std::pow(0.2, 7), 1.0);
  EXPECT_NEAR(
      rates.rate(0.3, 1.2, 2e10) / 1e6,
      850 * std::pow(0.7, 0.222) * std::pow(0.3, 0.667) * 0.04 + 660 * std::pow(0.7, 0.333) * 0.3 * 0.008,
      1e-9);
  EXPECT_NEAR(rates.rate(0.7, 1.2, 2e10) / 1e6, 660 * std::pow(0.3, 0.333) * 0.7 * 0.008, 1e-9);
  EXPECT_EQ(rates.rate(0.0, 1.0, 1e9), 0.0);
  EXPECT_EQ(rates.rate(1.0, 1.2, 1e10), 0.0);
  // Hot spots burn to their end and no further.
  reaction::IgnitionAndGrowth no_growth = rates;
  no_growth.growth_rate = no_growth.completion_rate = 0.0;
  std::vector<double> burnt = {0.0};
  const std::vector<double> one = {1.3}, at = {1e10};
  reaction::ReactionModel<reaction::IgnitionAndGrowth>(no_growth).advance({1e-6, one, at}, burnt);
  EXPECT_EQ(burnt[0], 0.022);
}

// The set of the library: a planar detonation at the velocity of Chapman and Jouguet of its products, whose
// reaction zone of some tenths of a millimetre the cells resolve.
TEST(IgnitionAndGrowth, APlanarDetonationRunsAtTheVelocityOfChapmanAndJouguet) {
  const std::string booster = "[[detonation]]\nshape = \"sphere\"\nposition = [0, 0]\nradius = 0.003\n";
  const Material material = read_material("composition_b_ignition_and_growth");
  const double D = material.explosive->detonation_velocity;
  EXPECT_NEAR(D, 7980.0, 2.0);
  const std::string text = column("composition_b_ignition_and_growth", 0.02, 1e-4, booster);
  EXPECT_NEAR(front_velocity(text, 0.0185 / D, 0.011, 0.016) / D, 1.0, 0.02);
}

TEST(IgnitionAndGrowth, SaysWhatAMaterialLacks) {
  reaction::IgnitionAndGrowth nothing = composition_b_rates();
  nothing.ignition_end = 0.0;
  EXPECT_THAT([&] { reaction::ReactionModel<reaction::IgnitionAndGrowth>{nothing}; },
              ThrowsMessage<InputError>(HasSubstr("'ignition_rate' and 'ignition_end' must be positive")));
}

TEST(JwlPlusPlus, SaysWhatAMaterialLacks) {
  const auto refused = [](const std::string& tables, const std::string& text) {
    const std::string file = non_ideal("rate_law_wrong", tables);
    EXPECT_THAT([&] { static_cast<void>(read_material(file)); }, ThrowsMessage<InputError>(HasSubstr(text)))
        << tables;
  };
  refused(law, "a rate law takes the equation of state of the unreacted explosive: [eos.unreacted]");
  refused(reactant + "[reaction]\nmodel = \"jwl\"\nsource = \"test\"\n", "jwl_plus_plus");
  refused(reactant + "[reaction]\nmodel = \"jwl_plus_plus\"\nsource = \"test\"\npressure_exponent = 1.3\n",
          "'rate'");
  const Material material = read_material(non_ideal("rate_law_whole", reactant + law));
  EXPECT_THAT(burning(material).constants(), HasSubstr("[reaction]\nmodel = \"jwl_plus_plus\"\nrate = "));
  EXPECT_THAT(unreacted(material).constants(), testing::Not(HasSubstr("[reaction]")));
}

}  // namespace
}  // namespace whipple::verification
