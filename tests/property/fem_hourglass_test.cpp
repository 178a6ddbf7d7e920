// SPDX-License-Identifier: BSD-3-Clause
// Hourglass control gives no more than it took (docs/theory/fem.md, 3): random motion, elements that are
// stretched or lose their stiffness while their modes are loaded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace {

double sum(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result += value;
  return result;
}

/// Nodes that are led through given velocities, whatever the forces are.
struct Led {
  explicit Led(fem::Mesh& led) : mesh(led) {
    motion.end = led.nodes.velocity;
    gradients.resize(led.points.size());
  }
  void step(const std::vector<Vector3>& velocity, double dt) {
    motion.mean = motion.end;
    for (std::size_t a = 0; a < velocity.size(); ++a) motion.mean[a] = 0.5 * (motion.mean[a] + velocity[a]);
    motion.end = velocity;
    report += fem::deform(mesh, motion, dt, stiffness, gradients);
    fem::move_nodes(mesh, motion, dt);
    taken += std::abs(report.hourglass_work - last);
    last = report.hourglass_work;
    lowest = std::min(lowest, last);
    least = std::min(least, *std::ranges::min_element(mesh.elements.hourglass_energy));
  }

  fem::Mesh& mesh;
  fem::Motion motion;
  fem::VelocityGradients gradients;
  fem::DeformationReport report;
  double least = 0.0;                            // J, stored energy of any element
  double taken = 0.0, last = 0.0, lowest = 0.0;  // J, work: of both signs, so far, least so far
};

TEST(Hourglass, NeverGivesMoreThanItTookInRandomMotion) {
  for (const double stretch : {0.0, 5e3, -3e3}) {  // 1/s, along x
    Body body = shaken(Quadrature::one_point, stiffness);
    const double dt = 0.5 * body.critical_time_step();
    const double internal = totals(body.mesh).internal_energy;
    Led led(body.mesh);
    std::mt19937_64 generator(5);
    std::normal_distribution<double> kick(0.0, 3.0);
    std::vector<Vector3> velocity = body.mesh.nodes.velocity, random(velocity.size(), Vector3::Zero());
    for (int i = 0; i < 2000; ++i) {
      for (std::size_t a = 0; a < velocity.size(); ++a) {
        random[a] = 0.9 * random[a] + Vector3(kick(generator), kick(generator), kick(generator));
        velocity[a] = random[a] + Vector3(stretch * body.mesh.nodes.position[a].x(), 0.0, 0.0);
      }
      led.step(velocity, dt);
    }
    ASSERT_EQ(led.report.inverted, 0U) << stretch;
    EXPECT_GE(led.least, 0.0) << stretch;
    EXPECT_GT(led.taken, 0.0);
    EXPECT_LT(led.report.hourglass_overdrawn, 1e-3 * led.taken) << stretch;
    // Of the work, what is stored leads by half a step, and the rest is heat.
    const double lead = sum(body.mesh.elements.hourglass_lead);
    EXPECT_GE(led.report.hourglass_work + lead, -led.report.hourglass_overdrawn);
    EXPECT_NEAR(totals(body.mesh).internal_energy + totals(body.mesh).hourglass_energy,
                internal + led.report.work + led.report.hourglass_work, 1e-12 * led.taken + 1e-18);
  }
}

/// A loaded mode of a cube that grows along the direction of its forces to four times its length, or whose
/// sound speed falls to a tenth: what comes back when it is let go is no more than what went in.
TEST(Hourglass, StretchedAndSoftenedElementsReturnWhatWasStored) {
  for (const bool softens : {false, true}) {
    Body body(Solid{}.material(),
              fem::make_box(Vector3::Constant(-0.5e-3), Vector3::Constant(0.5e-3), {1, 1, 1}),
              Quadrature::one_point);
    body.hourglass = stiffness;
    const auto bend = [](const Vector3& x) {
      const Vector3 s = x.cwiseSign();
      return Vector3(10.0 * s[1] * s[2], 0.0, 0.0);
    };
    const double dt = 0.1 * body.critical_time_step();
    body.set_velocity([](const Vector3&) { return Vector3::Zero(); });
    Led led(body.mesh);
    std::vector<Vector3> velocity(body.mesh.nodes.size());
    const auto lead_through = [&](int steps, auto&& field) {
      for (int i = 0; i < steps; ++i) {
        for (std::size_t a = 0; a < velocity.size(); ++a) velocity[a] = field(body.mesh.nodes.position[a]);
        led.step(velocity, dt);
      }
    };
    lead_through(20, bend);
    const double loaded = led.report.hourglass_work;
    EXPECT_GT(loaded, 0.0);
    if (softens) {
      body.mesh.points.sound_speed[0] *= 0.1;
    } else {
      lead_through(1000,
                   [&](const Vector3& x) { return Vector3(std::log(4.0) / (1000.0 * dt) * x[0], 0, 0); });
    }
    lead_through(200, [&](const Vector3& x) { return Vector3(-bend(x)); });
    EXPECT_GE(led.lowest, -1e-3 * loaded) << softens;
    EXPECT_GE(led.least, 0.0);
    EXPECT_EQ(led.report.limited_hourglass > 0.0, softens);  // the stretch takes too little in any one step
  }
}

}  // namespace
}  // namespace whipple::fem_test
