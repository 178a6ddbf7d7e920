// SPDX-License-Identifier: BSD-3-Clause
// A driven grip that stretches an elastic bar: Hooke's law, the velocity of the grip, work and impulse in the balances.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "src/core/base/error.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double speed = 10.0, radius = 2e-3, end = 8e-6;  // m/s, m, s
// Length of the bar and a third of the grip, m: the grip yields under a uniform body force by s l/(3 E) on average.
constexpr double length = 8e-3 + 2e-3 / 3.0;

std::string bar_and_grip(const std::string& of_grip) {
  return fmt::format(R"toml(
[domain]
dimension = "axisymmetric"
lower = ["0 mm", "0 mm"]
upper = ["12 mm", "3 mm"]
cell_size = "0.5 mm"
boundary = {{ x_lower = "symmetry" }}
[time]
end = "8 us"
[[body]]
name = "bar"
material = "{0}"
contact_group = "one"
velocity = ["5 m/s", "0 m/s"]
expansion_rate = ["1250 1/s", "0 1/s"]
shape = {{ cylinder = {{ center = ["4 mm", "0 mm", "0 mm"], axis = "x", radius = "2 mm", height = "8 mm" }} }}
[[body]]
name = "grip"
material = "{0}"
contact_group = "one"
velocity = ["10 m/s", "0 m/s"]
{1}
shape = {{ cylinder = {{ center = ["9 mm", "0 mm", "0 mm"], axis = "x", radius = "2 mm", height = "2 mm" }} }}
)toml",
                     elastic_aluminium(), of_grip);
}

TEST(Driven, GripStretchesABarByHookesLawAndTheBalancesKnowItsWork) {
  const cases::Case setup = cases::read_case_text(bar_and_grip("driven = true"), "driven.toml");
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, end);
  double mass = 0.0, momentum = 0.0;
  const Particles& p = simulation.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.body[i] != 1) continue;
    mass += p.mass[i];
    momentum += p.mass[i] * p.velocity[i][0];
  }
  EXPECT_NEAR(momentum / mass, speed, 0.02 * speed);  // change of other forces from one step to the next

  constexpr double bulk = 2785.0 * 5328.0 * 5328.0, shear = 27.6e9;
  constexpr double young = 9.0 * bulk * shear / (3.0 * bulk + shear);
  const double force = young * speed * end / length * std::numbers::pi * radius * radius;
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_NEAR(-ledger.wall_impulse[0], 0.5 * force * end, 0.03 * 0.5 * force * end);
  EXPECT_NEAR(ledger.external_impulse[0], 0.5 * force * end, 0.03 * 0.5 * force * end);
  EXPECT_NEAR(ledger.external_work, 0.5 * force * speed * end, 0.03 * 0.5 * force * speed * end);
  EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_LT(std::abs(ledger.momentum_error(simulation.totals())), 1e-12);
}

/// A driven block that is hit beside its centre of mass, in a plane or in space: its mean rotation (rad).
double turned_by_a_hit(bool plane, bool driven) {
  const auto corner = [&](double x, double y) {
    return plane ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, -1e-3);
  };
  const auto opposite = [&](double x, double y) {
    return plane ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, 1e-3);
  };
  const auto body = [&](const char* name, const char* keys, double x0, double y0, double x1, double y1) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\n{}\nshape = {{ box = {{ lower = {}, upper = {} }} }}\n",
        name, elastic_aluminium(), keys, corner(x0, y0), opposite(x1, y1));
  };
  const std::string hit = plane ? "velocity = [-20, 0]" : "velocity = [-20, 0, 0]";
  const cases::Case setup = cases::read_case_text(
      std::string("[domain]\n") +
          (plane ? "dimension = \"plane_strain\"\nlower = [-0.01, -0.01]\nupper = [0.01, 0.01]\n"
                 : "lower = [-0.01, -0.01, -0.005]\nupper = [0.01, 0.01, 0.005]\n") +
          "cell_size = 0.5e-3\n[time]\nend = 10e-6\n" +
          body("block", driven ? "driven = true" : "", -1e-3, -3e-3, 1e-3, 3e-3) +
          body("hammer", hit.c_str(), 1e-3, 1.5e-3, 5e-3, 3e-3),
      "hit.toml");
  solver::Simulation simulation(setup, parallel::world());
  double angle = 0.0, before = 0.0;
  run_to(simulation, setup.time.end, [&](const solver::Simulation& s) {
    const Particles& q = s.particles();
    double mass = 0.0, moment = 0.0, inertia = 0.0;
    Vector3 centre = Vector3::Zero(), velocity = Vector3::Zero();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] != 0) continue;
      mass += q.mass[p];
      centre += q.mass[p] * q.position[p];
      velocity += q.mass[p] * q.velocity[p];
    }
    centre /= mass, velocity /= mass;
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] != 0) continue;
      const Vector3 r = q.position[p] - centre;
      moment += q.mass[p] * r.cross(q.velocity[p] - velocity)[2];
      inertia += q.mass[p] * (r[0] * r[0] + r[1] * r[1]);
    }
    angle += moment / inertia * (s.state().time - before);
    before = s.state().time;
  });
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_LT(std::abs(simulation.state().ledger.momentum_error(simulation.totals())), 1e-12);
  return std::abs(angle);
}

TEST(Driven, ABodyThatIsHitBesideItsCentreDoesNotTurn) {
  for (const bool plane : {true, false}) {
    const double of_free_block = turned_by_a_hit(plane, false);
    EXPECT_GT(of_free_block, 0.005) << plane;
    EXPECT_LT(turned_by_a_hit(plane, true), 0.02 * of_free_block) << plane;
  }
}

TEST(Driven, AgainstAMirrorPlaneThatItTouchesIsRefused) {
  const std::string text = bar_and_grip("");
  const std::size_t at = text.find("velocity = [\"5 m/s\"");  // the bar, on the plane x = 0
  ASSERT_NE(at, std::string::npos);
  try {
    cases::read_case_text(text.substr(0, at) + "driven = true\n" + text.substr(at), "driven.toml");
    ADD_FAILURE() << "passed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("symmetry plane normal to x"), std::string::npos)
        << error.what();
  }
}

TEST(Driven, KeysThatContradictItAreNamed) {
  const auto refused = [](const std::string& keys, const std::string& reason) {
    try {
      cases::read_case_text(bar_and_grip(keys), "driven.toml");
      ADD_FAILURE() << keys << " passed";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  refused("driven = true\nexpansion_rate = [\"1 1/s\", \"0 1/s\"]", "one velocity");
  refused("driven = true\ndiscretization = { method = \"finite_elements\" }", "only bodies of particles");
  refused("driven = true\nangular_velocity = [\"0 rad/s\", \"0 rad/s\", \"1 rad/s\"]", "one velocity");
}

}  // namespace
}  // namespace whipple::verification
