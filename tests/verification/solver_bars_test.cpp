// SPDX-License-Identifier: BSD-3-Clause
// Reinforcement bars in a body of particles (hybrid finite element material point method; docs/theory/afemp.md, 5):
// stiffness and wave speed of the composite, conservation, yield and rupture, restart, invalid input.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "tests/verification/contact_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification::bars_in_particles {
namespace {

constexpr double dx = 1e-3, length = 0.02, width = 2 * dx, speed = 2.0;

/// Soft matrix, stiff bars; both without Poisson's effect, so that bars and matrix share the axial strain and
/// nothing else: the composite is a bar of E = (E_m A_m + E_b A_b)/(A_m + A_b) and of the mean density.
std::string elastic(const std::string& name, double density, double young, const std::string& strength) {
  return write_material(
      name, "name = \"" + name + "\"\nsource = \"test\"\n[eos]\nmodel = \"mie_gruneisen\"\n" +
                "source = \"test\"\nreference_density = \"" + number(density) + " kg/m^3\"" +
                "\nhugoniot_intercept = \"" + number(std::sqrt(young / 3 / density)) + " m/s\"" +
                "\nhugoniot_slope = 1e-3\ngruneisen = 1e-3\nheat_capacity = \"1000 J/(kg K)\"\n[strength]\n" +
                "source = \"test\"\nshear_modulus = \"" + number(0.5 * young) + " Pa\"\n" + strength);
}
std::string matrix() { return elastic("matrix", 2000.0, 10e9, "model = \"elastic\"\n"); }
std::string steel(const std::string& strength = "model = \"elastic\"\n") {
  return elastic("bars", 8000.0, 200e9, strength);
}
constexpr double diameter = 0.6e-3;
const double bar_area = 0.25 * std::numbers::pi * diameter * diameter;

/// Returns a case of a column of 2 x 2 cells with or without a bar in its axis.
Problem column(bool reinforced, double end, const std::string& strength = "model = \"elastic\"\n",
               const std::string& options = "") {
  Problem problem;
  problem.method.linear_viscosity = problem.method.quadratic_viscosity = 0.0;
  problem.end = end;
  problem.domain =
      "[domain]\nlower = [0, -0.004, -0.004]\nupper = [0.03, 0.004, 0.004]\ncell_size = 0.001\n"
      "boundary = { x_lower = \"symmetry\" }\n";
  problem.bodies = {{"matrix", matrix(), box({0, -dx, -dx}, {length, dx, dx}), {-speed, 0, 0}}};
  if (!reinforced) return problem;
  problem.more = "[[body]]\nname = \"steel\"\nmaterial = \"" + steel(strength) + "\"\nvelocity = [" +
                 number(-speed) +
                 ", 0, 0]\ndiscretization = { method = \"bars\", bar_diameter = " + number(diameter) +
                 options + " }\n[[body.bar]]\nfrom = [0, 0, 0]\nto = " + vector3({length, 0, 0}) + "\n";
  return problem;
}

struct Watch {
  double energy = 0.0, momentum = 0.0;
  void operator()(const solver::Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  }
};

/// A column that flies at 2 m/s against a rigid wall: a wave stops it gradually, and its momentum vanishes at L/c.
struct Stop {
  double speed;      ///< m/s, of the wave
  double bar_share;  ///< fraction of the bars in the internal energy when everything is at rest
};
Stop stop(bool reinforced) {
  const double young = 10e9, density = 2000.0, slow = std::sqrt(young / density);
  solver::Simulation simulation(column(reinforced, 1.3 * length / slow).read(), parallel::world());
  Watch watch;
  Stop result{};
  double before = simulation.totals().momentum[0], time_before = 0;
  EXPECT_LT(before, 0.0);
  run_to(simulation, simulation.setup().time.end, [&](const solver::Simulation& s) {
    watch(s);
    const double now = s.totals().momentum[0];
    if (result.speed == 0 && now >= 0) {
      result.speed = length / (time_before + (s.state().time - time_before) * before / (before - now));
      const double gained = s.totals().internal_energy - s.state().ledger.initial.internal_energy;
      for (const fem::Bars& bars : s.bars()) result.bar_share += fem::internal_energy(bars) / gained;
    }
    before = now;
    time_before = s.state().time;
  });
  EXPECT_LT(watch.energy, 1e-12);
  EXPECT_LT(watch.momentum, 1e-12);
  return result;
}

TEST(Bars, WaveInAReinforcedColumnIsThatOfTheComposite) {
  const double whole = width * width;
  const double young = (10e9 * whole + 200e9 * bar_area) / whole,
               density = (2000 * whole + 8000 * bar_area) / whole;
  const double exact = std::sqrt(young / density), plain = std::sqrt(10e9 / 2000.0);
  const Stop with = stop(true), without = stop(false);
  const double share = 200e9 * bar_area / (young * whole);
  std::printf(
      "wave: matrix %.1f m/s (exact %.1f), reinforced %.1f (exact %.1f); share of the bars %.4f (exact "
      "%.4f)\n",
      without.speed, plain, with.speed, exact, with.bar_share, share);
  EXPECT_NEAR(without.speed, plain, 0.015 * plain);  // the free end is rounded over a cell
  EXPECT_NEAR(with.speed / without.speed, exact / plain, 0.007 * exact / plain);
  EXPECT_NEAR(with.bar_share, share, 0.05 * share);
}

TEST(Bars, YieldBreakAndKeepEnergy) {
  const std::string von_mises =
      "model = \"von_mises\"\nyield_stress = \"20 MPa\"\nhardening_modulus = \"1 GPa\"\n";
  const Problem problem = column(true, 12e-6, von_mises, ", bar_failure_strain = 1e-3");
  solver::Simulation simulation(problem.read(), parallel::world());
  Watch watch;
  std::size_t broken = 0;
  run_to(simulation, 12e-6, [&](const solver::Simulation& s) {
    watch(s);
    const fem::BarElements& bars = s.bars().front().elements;
    for (std::size_t b = 0; b < bars.size(); ++b) {
      EXPECT_LE(std::abs(bars.stress[b]), 20e6 + 1e9 * bars.plastic_strain[b] + 1.0);
      EXPECT_TRUE(bars.broken[b] == 0 || bars.stress[b] == 0.0);
    }
  });
  for (const std::uint8_t b : simulation.bars().front().elements.broken) broken += b;
  EXPECT_GT(broken, 0U);
  EXPECT_LT(watch.energy, 1e-12);
  EXPECT_LT(watch.momentum, 1e-12);
}

/// Returns a case of a ball of aluminium on a block with two rows of bars, contact between ball and block, quarter
/// model; part of the block leaves the domain.
std::string impact() {
  static const std::string aluminium_file = aluminium("bars_aluminium", "0.3 GPa");
  return Method{}.time_toml(6e-6) + "[output]\nmaximum_energy_error = 1.0\n" +
         "[domain]\nlower = [0, 0, -0.006]\nupper = [0.006, 0.006, 0.006]\ncell_size = 0.001\n"
         "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }\n" +
         ContactOptions{.friction = 0.1}.toml() + "[[body]]\nname = \"ball\"\nmaterial = \"" +
         aluminium_file +
         "\"\nvelocity = [0, 0, 3000]\nshape = { sphere = { center = [0, 0, -2.6e-3], radius = 2.5e-3 } }\n" +
         "[[body]]\nname = \"block\"\ncontact_group = \"target\"\nmaterial = \"" + aluminium_file +
         "\"\nshape = { box = { lower = [0, 0, 0], upper = [5e-3, 5e-3, 3e-3] } }\n" +
         "[[body]]\nname = \"steel\"\ncontact_group = \"target\"\nmaterial = \"" +
         steel("model = \"von_mises\"\nyield_stress = \"0.5 GPa\"\n") +
         "\"\ndiscretization = { method = \"bars\", bar_diameter = 4e-4, bar_failure_strain = 0.5 }\n"
         "[[body.bar]]\nfrom = [0, 0.5e-3, 1e-3]\nto = [5e-3, 0.5e-3, 1e-3]\ncount = 3\nstep = [0, 1.5e-3, "
         "0]\n"
         "[[body.bar]]\nfrom = [0.5e-3, 0, 2e-3]\nto = [0.5e-3, 5e-3, 2e-3]\ncount = 3\nstep = [1.5e-3, 0, "
         "0]\n";
}

TEST(Bars, ImpactKeepsEnergyAndMomentumAndRestartsBitwise) {
  const cases::Case setup = cases::read_case_text(impact(), "bars.toml");
  solver::Simulation whole(setup, parallel::world());
  const double mass = whole.totals().mass;
  const std::size_t bars = whole.bars().front().elements.size();
  Watch watch;
  for (int step = 0; step < 40; ++step) {
    whole.advance(6e-6);
    watch(whole);
  }
  const TemporaryFolder folder;
  solver::Simulation restarted = restored(setup, save(whole, folder.path()), parallel::world());
  for (int step = 0; step < 10; ++step) {
    whole.advance(6e-6);
    restarted.advance(6e-6);
  }
  expect_same(whole, restarted);
  run_to(whole, 6e-6, std::ref(watch));
  EXPECT_LT(watch.energy, 1e-12);
  EXPECT_LT(watch.momentum, 1e-12);
  EXPECT_NEAR(whole.totals().mass + whole.state().ledger.outflow.mass, mass, 1e-13 * mass);
  EXPECT_GT(fem::internal_energy(whole.bars().front()), 0.0);
  EXPECT_LT(whole.bars().front().elements.size(), bars);  // some have left the domain
}

TEST(Bars, FaultsAreNamed) {
  const auto error_of = [](const std::string& text) {
    try {
      static_cast<void>(solver::Simulation(cases::read_case_text(text, "bars.toml"), parallel::world()));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto replaced = [](std::string text, const std::string& old, const std::string& by) {
    text.replace(text.rfind(old), old.size(), by);
    return text;
  };
  const auto expect_error = [&](const std::string& old, const std::string& by, const char* message) {
    EXPECT_NE(error_of(replaced(impact(), old, by)).find(message), std::string::npos)
        << error_of(replaced(impact(), old, by));
  };
  EXPECT_EQ(error_of(impact()), "");
  const std::string alone = replaced(impact(), "contact_group = \"target\"", "");
  EXPECT_NE(
      error_of(replaced(alone, "\"auto\"", "\"multi_field\"")).find("bars have no surface of their own"),
      std::string::npos);
  EXPECT_EQ(cases::read_case_text(alone, "bars.toml").contact_fields.of_body,
            (std::vector<std::uint8_t>{0, 1, 1}));  // with the body around them
  expect_error("bar_diameter = 4e-4, ", "", "bars need a 'bar_diameter'");
  expect_error("from = [0.5e-3, 0, 2e-3]", "from = [0.5e-3, -1e-3, 2e-3]", "reach out of the domain along y");
  expect_error("name = \"block\"\n", "name = \"block\"\ndiscretization = { method = \"finite_elements\" }\n",
               "bars reinforce bodies of particles");
  expect_error("to = [0.5e-3, 5e-3, 2e-3]", "to = [0.5e-3, 0, 2e-3]", "has no length");
}

}  // namespace
}  // namespace whipple::verification::bars_in_particles
