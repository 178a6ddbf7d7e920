// SPDX-License-Identifier: BSD-3-Clause
// Force gauges (docs/theory/mpm.md, equations 3.6a to 3.6c): their integral is the change of momentum, at rest they
// carry the weight and its lever arm, patches of a wall add up to the wall.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "src/core/base/error.hpp"
#include "src/run/gauges.hpp"
#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double dx = 1e-3;

struct Integral {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();  // over time, N s and N m s
};

/// Runs a simulation, writes a row of gauges.csv every few steps and integrates the columns over the intervals.
std::map<std::string, Integral> integrate(solver::Simulation& simulation, double end, int every) {
  const cases::Case& setup = simulation.setup();
  run::GaugeRecorder recorder(setup.all_gauges(), setup.force_gauges, simulation);
  std::map<std::string, Integral> sums;
  double last = simulation.state().time;
  const auto add_row = [&] {
    std::map<std::string, double> row;
    for (const io::HistoryValue& value : recorder.row(simulation)) row[value.name] = value.value;
    recorder.row_written(simulation);
    const double interval = simulation.state().time - last;
    last = simulation.state().time;
    for (const cases::ForceGauge& gauge : setup.force_gauges) {
      Integral& sum = sums[gauge.name];
      for (int a = 0; a < 3; ++a) {
        sum.force[a] += interval * row.at(gauge.name + ".force_" + "xyz"[a]);
        sum.moment[a] += interval * row.at(gauge.name + ".moment_" + "xyz"[a]);
      }
    }
  };
  add_row();
  for (int step = 1; simulation.state().time < end; ++step) {
    simulation.advance(end);
    if (step % every == 0 || simulation.state().time >= end) add_row();
  }
  return sums;
}

std::string force_gauge(const std::string& name, const std::string& on, const std::string& more = {}) {
  return "[[force_gauge]]\nname = \"" + name + "\"\n" + on + "\n" + more;
}

/// A ball flies into a block that lies on a wall, in a corner with a second wall.
std::string collision(const std::string& floor, const std::string& domain, const std::string& ball,
                      const Method& method) {
  return method.time_toml(8e-6) + method.toml() +
         "[output]\nmaximum_energy_error = 10.0\n[contact]\nmethod = \"multi_field\"\nfriction = "
         "0.2\n[domain]\nlower = "
         "[0, 0, 0]\nupper = [0.014, 0.014, 0.020]\ncell_size = 0.001\n" +
         domain + "boundary = { x_lower = \"symmetry\", z_lower = \"" + floor + "\" }\n" +
         BodyOptions{"block", elastic_aluminium(), box({0, 3 * dx, 0}, {6 * dx, 9 * dx, 4 * dx})}.toml() +
         BodyOptions{"ball",
                     elastic_aluminium(),
                     box({1 * dx, 4 * dx, 4.3 * dx}, {5 * dx, 8 * dx, 8.3 * dx}),
                     {40, 30, -200},
                     ball}
             .toml() +
         force_gauge("on_block", "body = \"block\"") + force_gauge("on_ball", "body = \"ball\"") +
         force_gauge("floor", "face = \"z_lower\"", "about = [0.001, 0.002, 0.003]\n") +
         force_gauge("side", "face = \"x_lower\"") +
         force_gauge(
             "left", "face = \"z_lower\"",
             "about = [0.001, 0.002, 0.003]\nbox = { lower = [0, 0, -1], upper = [1, 0.0053, 1] }\n") +
         force_gauge("right", "face = \"z_lower\"",
                     "about = [0.001, 0.002, 0.003]\nbox = { lower = [0, 0.0053, -1], upper = [1, 1, 1] }\n");
}

struct Impact {
  std::string floor, domain = {}, ball = {};
  Method method{};
};

class Impacts : public testing::TestWithParam<Impact> {};

TEST_P(Impacts, GiveTheirImpulseToBodiesAndWalls) {
  const Impact& impact = GetParam();
  solver::Simulation simulation(
      cases::read_case_text(collision(impact.floor, impact.domain, impact.ball, impact.method),
                            "collision.toml"),
      parallel::world());
  const std::array<BodySums, 2> start = {sums_of(simulation, 0), sums_of(simulation, 1)};
  auto of = integrate(simulation, 8e-6, 7);
  const Vector3 block = sums_of(simulation, 0).momentum - start[0].momentum,
                ball = sums_of(simulation, 1).momentum - start[1].momentum;
  const double scale = start[1].momentum.norm();
  ASSERT_LT(ball.norm(), 1.99 * scale);
  ASSERT_GT(ball.norm(), 0.2 * scale) << "they meet";
  EXPECT_LT((of["on_block"].force - block).norm(), 1e-12 * scale);
  EXPECT_LT((of["on_ball"].force - ball).norm(), 1e-12 * scale);
  // The faces take what both bodies lose; each that of its kind.
  EXPECT_LT((of["floor"].force + of["side"].force + block + ball).norm(), 1e-12 * scale);
  EXPECT_LT((of["floor"].force + of["side"].force + simulation.state().ledger.wall_impulse).norm(),
            1e-12 * scale);
  EXPECT_LT(of["floor"].force[2], -0.05 * scale) << "pressed down";
  if (impact.floor == "separating") {  // without friction each face takes what is normal to it
    EXPECT_LT(std::abs(of["floor"].force[0]) + std::abs(of["floor"].force[1]), 1e-12 * scale);
    EXPECT_NEAR(of["side"].force[0], -block[0] - ball[0], 1e-12 * scale);
    EXPECT_GT(std::abs(of["side"].force[0]), 1e-3 * scale);
  }
  // What one body does to the other is opposite, with its moment about the same point.
  const Vector3 both = of["on_block"].moment + of["on_ball"].moment;
  Vector3 of_faces =
      of["side"].moment + of["floor"].moment + Vector3(0.001, 0.002, 0.003).cross(of["floor"].force);
  EXPECT_LT((both + of_faces).norm(), 1e-12 * scale * 20 * dx);
  // Two patches are the wall.
  EXPECT_LT((of["left"].force + of["right"].force - of["floor"].force).norm(), 1e-12 * scale);
  EXPECT_LT((of["left"].moment + of["right"].moment - of["floor"].moment).norm(), 1e-12 * scale * 20 * dx);
  EXPECT_GT(of["left"].force.norm(), 0.01 * scale);
  EXPECT_GT(of["right"].force.norm(), 0.01 * scale);
}

INSTANTIATE_TEST_SUITE_P(
    ForceGauges, Impacts,
    testing::Values(Impact{"separating"}, Impact{"no_slip"}, Impact{"friction", "friction = 0.3\n"},
                    Impact{"separating", "",
                           "discretization = { method = \"finite_elements\", element_size = 0.001 }\n"},
                    Impact{"friction", "friction = 0.3\n", "", {"musl", "linear", "flip", 0.3, 0.06, 1.5}}),
    [](const auto& info) { return "Case" + std::to_string(info.index); });

/// A block of elements falls on each kind of plane: its nodes are stopped there without the grid.
TEST(ForceGauges, TakeTheImpulseOfElementsAtPlanes) {
  for (const std::string kind : {"symmetry", "no_slip"}) {
    for (const std::string held : {"0", "0.0007"}) {  // m, above the plane: bonded to it, or not
      constexpr double end = 8e-6;
      solver::Simulation simulation(
          cases::read_case_text(
              Method{}.time_toml(end) + Method{}.toml() +
                  "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = [0, 0, 0]\nupper = [0.01, 0.01, "
                  "0.01]\n"
                  "cell_size = 0.001\nboundary = { z_lower = \"" +
                  kind + "\" }\n" +
                  BodyOptions{
                      "bar",
                      elastic_aluminium(),
                      "box = { lower = [0.003, 0.003, " + held + "], upper = [0.006, 0.006, 0.0057] }",
                      {30, 0, -200},
                      "discretization = { method = \"finite_elements\", element_size = 0.001 }\n"}
                      .toml() +
                  force_gauge("floor", "face = \"z_lower\"") + force_gauge("bar", "body = \"bar\""),
              "bar.toml"),
          parallel::world());
      const BodySums start = sums_of(simulation, 0);
      auto of = integrate(simulation, end, 3);
      const Vector3 gained = sums_of(simulation, 0).momentum - start.momentum;
      const double scale = start.mass * 200.0;
      EXPECT_GT(gained[2], 0.2 * scale) << kind << held;
      EXPECT_LT((of["floor"].force + gained).norm(), 1e-12 * scale) << kind << held;
      EXPECT_LT((of["bar"].force - gained).norm(), 1e-12 * scale) << kind << held;
    }
  }
}

/// A block rests on a wall under its weight, off the axis about which moments are taken.
class Resting : public testing::TestWithParam<const char*> {};

TEST_P(Resting, ForceIsTheWeightAndItsMomentTheLeverArm) {
  constexpr double gravity = 1e6, end = 20e-6;  // m/s^2, s
  const std::string friction = GetParam() == std::string("friction") ? "friction = 0.3\n" : "";
  solver::Simulation simulation(
      cases::read_case_text(
          Method{}.time_toml(end) + Method{}.toml() +
              "[output]\nmaximum_energy_error = 10.0\n[domain]\ndimension = \"plane_strain\"\nlower = [0, "
              "0]\nupper = "
              "[0.024, 0.010]\ncell_size = 0.001\n" +
              friction + "boundary = { y_lower = \"" + GetParam() +
              "\" }\n[gravity]\nacceleration = [0, -1e6, 0]\n" +
              BodyOptions{"block", elastic_aluminium(), box({6.3 * dx, 0, -1}, {15.3 * dx, 6 * dx, 1}),
                          Vector3::Zero(), "initial = { lithostatic = { surface = 0.006, k0 = 0 } }\n"}
                  .toml() +
              force_gauge("floor", "face = \"y_lower\"") +
              force_gauge("block", "body = \"block\"", "about = [0.0108, 0, 0]\n"),
          "block.toml"),
      parallel::world());
  const BodySums start = sums_of(simulation, 0);
  auto of = integrate(simulation, end, 5);
  const double weight = start.mass * gravity;
  const Vector3 gained = sums_of(simulation, 0).momentum;
  std::printf("%s: mean force / weight %.9f, moved with %.2e of it, lever %.9f\n", GetParam(),
              -of["floor"].force[1] / (weight * end), gained[1] / (weight * end),
              of["floor"].moment[2] / of["floor"].force[1] / start.centre[0]);
  // The force is the weight as nearly as the block is at rest.
  EXPECT_NEAR(-of["floor"].force[1], weight * end + gained[1], 1e-12 * weight * end);
  EXPECT_NEAR(-of["floor"].force[1], weight * end, 2e-3 * weight * end);
  EXPECT_NEAR(of["block"].force[1], -of["floor"].force[1], 1e-12 * weight * end);
  EXPECT_NEAR(of["floor"].force[0], -gained[0], 1e-12 * weight * end);
  // The lever of its weight, as nearly as it does not vibrate: 3e-9 where it slides, 2e-8 where it is held.
  const double moment = weight * end * start.centre[0];
  EXPECT_NEAR(of["floor"].moment[2], start.centre[0] * of["floor"].force[1], 1e-7 * moment);
  EXPECT_NEAR(of["block"].moment[2], 0.0, 1e-7 * moment) << "about a point below the centre of mass";
}

INSTANTIATE_TEST_SUITE_P(ForceGauges, Resting,
                         testing::Values("separating", "symmetry", "no_slip", "friction"));

TEST(ForceGauges, RefuseWhatHasNoForce) {
  const auto message = [](const std::string& gauge, const std::string& more = {}) -> std::string {
    try {
      static_cast<void>(cases::read_case_text(collision("separating", "", more, {}) + gauge, "wrong.toml"));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  const auto expect = [&](const std::string& gauge, const std::string& text) {
    EXPECT_NE(message(gauge).find(text), std::string::npos) << text << "\nfound: " << message(gauge);
  };
  expect(force_gauge("free", "face = \"y_lower\""),
         "'y_lower' is of kind \"outflow\": material passes it without a force");
  expect(
      force_gauge("lost", "face = \"z_lower\"", "box = { lower = [0.02, 0, -1], upper = [0.03, 1, 1] }\n"),
      "the patch touches no part of 'z_lower', which is at x = 0 m to 0.014 m: the box has 0.02 m to 0.03 m");
  expect(force_gauge("above", "face = \"z_lower\"", "box = { lower = [0, 0, 0.01], upper = [1, 1, 1] }\n"),
         "the patch touches no part of 'z_lower'");
  expect(force_gauge("none", "body = \"blok\""), "there is no body \"blok\" (accepted: block, ball)");
  expect(force_gauge("both", "body = \"ball\"\nface = \"z_lower\""),
         "'body' or that on a 'face': both given");
  expect(force_gauge("nothing", ""), "'body' or that on a 'face': none given");
  expect(force_gauge("floor", "body = \"ball\""), "two gauges are called \"floor\"");
  EXPECT_NE(message("", "contact_group = \"all\"\n[[body]]\nname = \"third\"\nmaterial = \"" +
                            elastic_aluminium() + "\"\ncontact_group = \"all\"\nshape = { " +
                            box({0, 0, 0.014}, {0.004, 0.004, 0.018}) + " }\n")
                .find("body \"ball\" shares its velocity field with body \"third\""),
            std::string::npos);
}

}  // namespace
}  // namespace whipple::verification
