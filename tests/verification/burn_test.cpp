// SPDX-License-Identifier: BSD-3-Clause
// Programmed burn: planar detonations against the self-similar wave behind them, what burns when, and what a case must
// say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "eos/detonation.hpp"
#include "src/material/material_file.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "tests/verification/burn_columns.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification {
namespace {

using exact::default_case;
using exact::L1;
using testing::HasSubstr;
using testing::ThrowsMessage;

// --- Planar detonation ---------------------------------------------------------------------------------------

/// The wave behind a planar detonation that runs from a wall at x = 0: the isentrope of the Chapman-Jouguet state by
/// steps in the specific volume, with u + c = x/t, at rest where u = 0.
class TaylorWave {
 public:
  explicit TaylorWave(const eos::EquationOfState& products) {
    const eos::ChapmanJouguet wave = eos::chapman_jouguet(products);
    D_ = wave.detonation_velocity;
    eos::State s = wave.state;
    double u = wave.particle_velocity;
    constexpr double step = 1e-4;  // of the volume
    while (u > 0.0) {
      xi_.push_back((u + s.sound_speed) / D_);
      pressure_.push_back(s.pressure);
      // The midpoint rule for du = -c dv/v and de = -p dv.
      const double v = 1.0 / s.density, dv = step * v;
      const eos::State half =
          products.state(1.0 / (v + 0.5 * dv), s.specific_internal_energy - 0.5 * s.pressure * dv);
      u -= half.sound_speed * dv * half.density;
      s = products.state(1.0 / (v + dv), s.specific_internal_energy - half.pressure * dv);
    }
  }
  [[nodiscard]] double velocity() const { return D_; }
  [[nodiscard]] double wall_pressure() const { return pressure_.back(); }
  [[nodiscard]] double pressure(double xi) const {
    const auto place = std::ranges::upper_bound(xi_, xi, std::greater<>());
    return place == xi_.end() ? pressure_.back() : pressure_[static_cast<std::size_t>(place - xi_.begin())];
  }

 private:
  double D_ = 0.0;
  std::vector<double> xi_, pressure_;
};

struct Slab {
  double error = 0.0;          // L1 of the pressure over 0.05 < x/(D t) < 0.95
  double wall_pressure = 0.0;  // Pa, mean over 0.1 < x/(D t) < 0.4
  double velocity = 0.0;       // m/s, of the front
  double energy_error = 0.0;
};

Slab run_slab(const std::string& material, const TaylorWave& exact, double length, std::size_t cells,
              const std::string& more = {}) {
  const double h = length / static_cast<double>(cells), D = exact.velocity();
  const double end = 0.9 * length / D;
  solver::Simulation simulation(default_case(end, column(material, length, h, lit_at_wall), more),
                                parallel::world());
  Slab slab;
  // When the pressure of each particle passes that of the wall.
  const std::vector<Vector3> start = exact::positions_by_id(simulation.particles());
  std::vector<double> arrival(start.size(), 0.0), pressure(start.size(), 0.0);
  double before = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    slab.energy_error = std::max(slab.energy_error, std::abs(s.state().ledger.energy_error(s.totals())));
    const Particles& q = s.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      const std::size_t id = q.id[p];
      const double now = q.pressure[p], level = exact.wall_pressure();
      if (arrival[id] == 0.0 && now > level) {
        arrival[id] = before + (s.state().time - before) * (level - pressure[id]) / (now - pressure[id]);
      }
      pressure[id] = now;
    }
    before = s.state().time;
  });
  // The slope of their places over the time of arrival, by least squares.
  double n = 0.0, x = 0.0, t = 0.0, xt = 0.0, tt = 0.0;
  for (std::size_t id = 0; id < start.size(); ++id) {
    if (start[id][0] < 0.3 * length || start[id][0] > 0.85 * length) continue;
    n += 1.0, x += start[id][0], t += arrival[id];
    xt += start[id][0] * arrival[id], tt += arrival[id] * arrival[id];
  }
  slab.velocity = (n * xt - x * t) / (n * tt - t * t);
  const Particles& q = simulation.particles();
  L1 error;
  exact::Mean wall;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double xi = q.position[p][0] / (D * end);
    if (xi > 0.05 && xi < 0.95) error.add(q.pressure[p], exact.pressure(xi), q.volume[p], exact.pressure(xi));
    if (xi > 0.1 && xi < 0.4) wall.add(q.pressure[p], q.mass[p]);
  }
  slab.error = error.value();
  slab.wall_pressure = wall.value();
  return slab;
}

TEST(PlanarDetonation, FollowsTheTaylorWaveOfTnt) {
  const TaylorWave exact(*read_material("tnt").eos);
  EXPECT_NEAR(exact.wall_pressure(), 5.640e9, 0.01e9);  // of an independent integration
  // A test of its own, labelled `long`: with cubic functions, since the noise of the quadratic ones behind the front
  // lowers the pressure of the wall by 1 % there, in proportion to the number of steps.
  const bool fine = std::getenv("WHIPPLE_FINE_BURN") != nullptr;
  const Slab slab = run_slab("tnt", exact, 0.1, fine ? 400 : 200,
                             fine ? "[transfer]\nshape_function = \"cubic_bspline\"\n" : "");
  EXPECT_LT(slab.error, fine ? 0.015 : 0.025);
  EXPECT_NEAR(slab.wall_pressure / exact.wall_pressure(), 1.0, fine ? 0.003 : 0.005);
  EXPECT_NEAR(slab.velocity / exact.velocity(), 1.0, fine ? 0.001 : 0.002);
  EXPECT_LT(slab.energy_error, 1e-12);
}

/// Products of a constant adiabatic exponent of 3, rho0 = 1875 kg/m^3, D = 8 km/s: q = D^2/16 (Mader's problem).
std::string gamma_law() {
  return write_material("gamma_law", R"toml(
name = "gamma law"
source = "Fickett and Rivard, LA-8859 (1974)"
[eos]
model = "ideal_gas"
source = "the same"
reference_density = "1875 kg/m^3"
heat_capacity_ratio = 3.0
heat_capacity = "1000 J/(kg K)"
reference_temperature = "4000 K"
[eos.unreacted]
model = "mie_gruneisen"
source = "chosen"
reference_density = "1875 kg/m^3"
hugoniot_intercept = "2800 m/s"
hugoniot_slope = 1.8
gruneisen = 0.7
heat_capacity = "1000 J/(kg K)"
[strength]
model = "none"
)toml");
}

TEST(PlanarDetonation, FollowsTheTaylorWaveOfAGammaLaw) {
  const std::string file = gamma_law();
  const TaylorWave exact(*read_material(file).eos);
  EXPECT_NEAR(exact.velocity(), 8e3, 1e-3);
  EXPECT_NEAR(exact.pressure(0.7), 15.360e9, 0.01e9);  // Mader's table
  EXPECT_NEAR(exact.wall_pressure(), 8.0 / 27.0 * 30e9, 0.01e9);
  const Slab slab = run_slab(file, exact, 0.05, 200);
  EXPECT_LT(slab.error, 0.025);
  EXPECT_NEAR(slab.wall_pressure / exact.wall_pressure(), 1.0, 0.005);
  EXPECT_LT(slab.energy_error, 1e-12);
}

// The same charge runs into vacuum (Fickett and Rivard; ExactPack): its products move ahead with D, and a rarefaction
// goes back into the Taylor wave.
TEST(PlanarDetonation, ProductsEscapeIntoVacuum) {
  constexpr double X = 0.05, D = 8e3, T = X / D, t = 1.4 * T, rho0 = 1875.0;
  constexpr std::size_t cells = 200;
  std::string text = column(gamma_law(), X, X / cells, lit_at_wall);
  text.replace(text.find("0.055"), 5, "0.08");
  solver::Simulation simulation(default_case(t, text), parallel::world());
  run_to(simulation, t);
  const Particles& q = simulation.particles();
  // Of the mass: the outermost cell, where the exact density falls to 0, is too thin to fill its nodes.
  L1 density, velocity;
  double front = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double x = q.position[p][0];
    double c = 0.5 * (x / t + 0.5 * D), u = 0.5 * (x / t - 0.5 * D);
    if (x < 0.5 * D * t) c = 0.5 * D, u = 0.0;
    if (x > X - 0.5 * D * (t - T))
      c = 0.5 * (x / t - (x - X) / (t - T)), u = 0.5 * (x / t + (x - X) / (t - T));
    const double exact = 16.0 / 9.0 * rho0 * std::max(c, 0.0) / D;
    // Ahead of the front, where there should be nothing, and just behind it: wrong by all of it.
    density.add(exact > 0.0 ? std::min(q.mass[p] / q.volume[p] / exact, 2.0) : 2.0, 1.0, q.mass[p]);
    velocity.add(q.velocity[p][0] / D, u / D, q.mass[p]);
    front = std::max(front, x);
  }
  EXPECT_LT(density.value(), 0.035);
  EXPECT_LT(velocity.value(), 0.01);
  std::printf("products into vacuum: density %.4f, velocity %.4f, front %.4f\n", density.value(),
              velocity.value(), front / (D * t));
  EXPECT_GT(front, 0.95 * D * t);
  EXPECT_LT(front, 1.02 * D * t);
}

// --- What burns when -----------------------------------------------------------------------------------------

std::string plate_beside(double length, double h) {
  return fmt::format(
      "[[body]]\nname = \"plate\"\nmaterial = \"copper_ofhc_mie_gruneisen\"\nshape = {{ box = {{ lower = "
      "[{}, "
      "0], upper = [{}, {}] }} }}\n",
      length, length + 2 * h, h);
}

const std::vector<double>& burnt(const solver::Simulation& simulation) {
  return simulation.particles().history.scalar("burn_fraction");
}

TEST(Burn, StartsFromTheUnreactedExplosiveAndReleasesItsStore) {
  const cases::Case setup = default_case(2e-6, column("tnt", 0.01, 5e-4, lit_at_wall));
  const Material& material = *setup.materials[0];
  const double Q = 7.0e9 / 1630.0;
  EXPECT_NEAR(material.reference.pressure, 0.0, 1e-3);
  EXPECT_DOUBLE_EQ(material.reference.density, 1630.0);
  EXPECT_NEAR(material.reference.sound_speed, 2390.0, 1.0);
  EXPECT_NEAR(material.reference.temperature, 300.0, 2.0);
  EXPECT_NEAR(material.reference.specific_internal_energy, Q, 1e-6 * Q);
  EXPECT_THAT(material.constants(), HasSubstr("[eos.unreacted]"));
  solver::Simulation simulation(setup, parallel::world());
  const auto chemical = [&] {
    solver::Figures figures;
    simulation.carriers()[0]->add_figures(figures);
    return figures.chemical_energy;
  };
  const double mass = simulation.bodies()[0].mass;
  EXPECT_NEAR(chemical(), mass * Q, 1e-9 * mass * Q);
  run_to(simulation, setup.time.end);
  EXPECT_EQ(chemical(), 0.0);
  for (const double fraction : burnt(simulation)) EXPECT_EQ(fraction, 1.0);
  EXPECT_GT(simulation.particles().vaporised_fraction[0], 0.99);
}

// A second detonator fires in material at rest; between the fronts nothing has burnt.
TEST(Burn, WakesMaterialAtRest) {
  const double length = 0.06, h = 5e-4, delay = 2e-6;
  const std::string second = fmt::format(
      "[[detonation]]\nshape = \"plane\"\nposition = [{}, 0]\nnormal = [1, 0]\ndelay = {}\n", length, delay);
  const cases::Case setup =
      default_case(delay + 8 * h / 6929, column("tnt", length, h, lit_at_wall + second));
  solver::Simulation simulation(setup, parallel::world());
  bool rested = false;
  run_to(simulation, setup.time.end,
         [&](const solver::Simulation& s) { rested = rested || s.state().particles_at_rest > 0; });
  EXPECT_TRUE(rested);
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double x = q.position[p][0], D = 6929.0, time = simulation.state().time;
    const double lit = std::min(x, length - x + D * delay) / D;
    if (time > lit + 2.1 * h / D) {
      EXPECT_EQ(burnt(simulation)[p], 1.0) << x;
    }
    if (time < lit - 4 * h / D) {
      EXPECT_EQ(burnt(simulation)[p], 0.0) << x;
    }
  }
  // Lighting and burn go on from where they were: to the last bit.
  const double later = setup.time.end + 1e-6;
  solver::Simulation resumed(setup, Particles(*simulation.contents().particles), simulation.state(),
                             parallel::world());
  run_to(simulation, later);
  run_to(resumed, later);
  EXPECT_EQ(resumed.totals().kinetic_energy, simulation.totals().kinetic_energy);
}

TEST(Burn, WithoutDetonationAnExplosiveStaysWhatItIs) {
  const cases::Case setup = default_case(1e-6, column("tnt", 0.005, 5e-4) + "detonation = \"none\"\n");
  EXPECT_FALSE(setup.materials[0]->burns());
  EXPECT_NEAR(setup.materials[0]->reference.specific_internal_energy, 0.0, 5e3);
  const cases::Case burnt_at_once =
      default_case(1e-6, column("tnt", 0.005, 5e-4) + "detonation = \"instantaneous\"\n");
  EXPECT_NEAR(burnt_at_once.materials[0]->reference.pressure, 8.38e9, 0.01e9);
}

// Products that have expanded below a pressure leave with all that they hold; what they still drive does not notice.
TEST(Burn, ProductsRetireBelowAPressureAndAreCounted) {
  const double length = 0.01, h = 5e-4, end = 8e-6;
  const auto run = [&](const std::string& burn) {
    std::string text = column("tnt", length, h, lit_at_wall + burn + plate_beside(length, h));
    text.replace(text.find("0.011"), 5, "0.06");
    text.replace(text.find("x_lower = \"symmetry\", "), 22, "");
    text.replace(text.find("lower = [0, 0]"), 14, "lower = [-0.06, 0]");
    auto simulation = std::make_unique<solver::Simulation>(default_case(end, text), parallel::world());
    run_to(*simulation, end);
    return simulation;
  };
  const auto whole = run(""), retired = run("[burn]\nretire_below = \"50 MPa\"\n");
  const solver::Ledger& ledger = retired->state().ledger;
  EXPECT_EQ(whole->state().ledger.retired.mass, 0.0);
  EXPECT_GT(ledger.retired.mass, 0.05 * ledger.initial.mass);
  EXPECT_LT(retired->particle_count(), whole->particle_count());
  EXPECT_NEAR(retired->totals().mass + ledger.outflow.mass, ledger.initial.mass, 1e-14 * ledger.initial.mass);
  EXPECT_GE(ledger.outflow.mass, ledger.retired.mass);
  EXPECT_LT(std::abs(ledger.energy_error(retired->totals())), 1e-12);
  EXPECT_LT(ledger.momentum_error(retired->totals()), 1e-12);
  EXPECT_LT(ledger.retired.momentum[0], 0.0);  // what escapes from the free side
  EXPECT_GT(ledger.retired.energy, 0.0);
  const auto plate_velocity = [](const solver::Simulation& s) {
    exact::Mean mean;
    const Particles& q = s.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] == 1) mean.add(q.velocity[p][0], q.mass[p]);
    }
    return mean.value();
  };
  EXPECT_NEAR(plate_velocity(*retired) / plate_velocity(*whole), 1.0, 0.01);
}

// What a wall stops is denser than unreacted explosive of this material can be, rho0 S/(S - 1) = 1.68 rho0.
TEST(Burn, ReflectedProductsAreDenserThanTheirReactantCanBe) {
  std::string text = column("pbx_9404", 0.02, 2e-4, lit_at_wall);
  text.replace(text.find("[0.022"), 6, "[0.020");  // the wall, at the end of the charge
  text.insert(text.find("x_lower = "), "x_upper = \"symmetry\", ");
  solver::Simulation simulation(default_case(3e-6, text), parallel::world());
  double least = 1.0;
  run_to(simulation, 3e-6, [&](const solver::Simulation& s) {
    least = std::min(least, *std::ranges::min_element(s.particles().volume));
  });
  const double densest = simulation.particles().mass.front() / least;  // all have one mass
  EXPECT_GT(densest / read_material("pbx_9404").eos->reference_density(), 1.68);
  EXPECT_EQ(simulation.state().ledger.limited_compressions, 0.0);
}

TEST(Burn, SchemesWithoutAWorkIdentityBurn) {
  const TaylorWave exact(*read_material("tnt").eos);
  const Slab slab =
      run_slab("tnt", exact, 0.05, 50, "scheme = \"usl\"\n[output]\nmaximum_energy_error = 1\n");
  EXPECT_LT(slab.error, 0.12);
}

// --- Cases ---------------------------------------------------------------------------------------------------

TEST(ExplosiveCases, ProductsAreNotBondedToWhatTheyDrive) {
  const double length = 0.01, h = 5e-4;
  const auto fields = [&](const std::string& more) {
    return default_case(1e-6, column("tnt", length, h, more + plate_beside(length, h)))
        .contact_fields.of_body;
  };
  EXPECT_NE(fields(lit_at_wall)[0], fields(lit_at_wall)[1]);
}

TEST(ExplosiveCases, SayWhatExplosivesAndDetonatorsLack) {
  const auto refused = [](const std::string& material, const std::string& more, const std::string& text) {
    EXPECT_THAT([&] { static_cast<void>(default_case(1e-6, column(material, 0.01, 5e-4, more))); },
                ThrowsMessage<InputError>(HasSubstr(text)))
        << more;
  };
  refused("tnt", "", "nothing lights it: expected a [[detonation]]");
  refused("copper_ofhc_mie_gruneisen", lit_at_wall, "there is no explosive to light");
  refused("copper_ofhc_mie_gruneisen", "detonation = \"none\"\n", "is no explosive");
  refused("tnt", "detonation = \"later\"\n", "instantaneous");
  refused("tnt", "[[detonation]]\nshape = \"plane\"\nposition = [0, 0]\n", "a plane takes 'normal'");
  refused("tnt", "[[detonation]]\nposition = [0, 0]\nradius = 1e-3\n", "'radius' belongs to a sphere");
  refused("tnt", "[[detonation]]\nshape = \"cord\"\nposition = [0, 0]\nend = [1, 0]\n",
          "a cord takes 'velocity'");
  refused("tnt", "equation_of_state = \"table\"\n" + lit_at_wall, "takes no table");
  refused("tnt", "detonation = \"instantaneous\"\n[burn]\nretire_below = \"1 MPa\"\n",
          "no body burns in the run");
}

}  // namespace
}  // namespace whipple::verification
