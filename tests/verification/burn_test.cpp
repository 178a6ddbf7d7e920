// SPDX-License-Identifier: BSD-3-Clause
// Programmed burn: lighting times against the exact ones of Kenamond's problems (as in ExactPack, Los Alamos), planar
// detonations against the self-similar wave behind them, what burns when, and what a case must say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "eos/detonation.hpp"
#include "src/case/build/lighting.hpp"
#include "src/material/material_file.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification {
namespace {

using cases::Arrival;
using cases::Detonation;
using cases::DetonationField;
using cases::DetonatorShape;
using exact::default_case;
using exact::L1;
using testing::HasSubstr;
using testing::ThrowsMessage;

// --- Lighting times ------------------------------------------------------------------------------------------

Detonation point(double x, double y, double delay = 0.0) {
  return {.position = Vector3(x, y, 0.0), .delay = delay};
}

/// The square of 20 by 20 around the origin.
DetonationField square(double cell, std::function<double(const Vector3&)> velocity) {
  const auto count = static_cast<std::size_t>(std::lround(20.0 / cell));
  return {Vector3(-10.0, -10.0, 0.0), {count, count, 1}, cell, std::move(velocity)};
}

// Kenamond's problem 1: straight lines from several detonators, whose delays count.
TEST(LightingTimes, AreExactInSight) {
  const Arrival arrival(square(0.5, [](const Vector3&) { return 2.0; }), std::vector{point(0, 5), point(0, -5, 1.0)});
  for (const auto& [x, y] : {std::pair(0.0, 9.9), {7.3, -9.1}, {-2.0, -4.0}, {0.01, 0.01}}) {
    const double exact = std::min(std::hypot(x, y - 5) / 2, 1.0 + std::hypot(x, y + 5) / 2);
    EXPECT_NEAR(arrival.at(Vector3(x, y, 0), 2.0), exact, 1e-12) << x << " " << y;
  }
  // A detonator that another front passes before its delay ends is dead.
  const Arrival late(square(0.5, [](const Vector3&) { return 2.0; }), std::vector{point(0, 5), point(0, 4, 3.0)});
  EXPECT_NEAR(late.at(Vector3(0, -5, 0), 2.0), 5.0, 1e-12);
}

TEST(LightingTimes, OfEveryDetonator) {
  const double D = 2.0;
  const auto at = [&](const Detonation& d, double x, double y) { return d.arrival(Vector3(x, y, 0), D); };
  const Detonation line{.shape = DetonatorShape::line, .position = Vector3(0, 0, 0), .end = Vector3(4, 0, 0)};
  EXPECT_DOUBLE_EQ(at(line, 3, 1), 0.5);
  EXPECT_DOUBLE_EQ(at(line, 7, 4), 2.5);
  const Detonation plane{.shape = DetonatorShape::plane, .position = Vector3(0, 1, 0), .normal = Vector3(0, 3, 0)};
  EXPECT_DOUBLE_EQ(at(plane, 9, 3), 1.0);
  EXPECT_DOUBLE_EQ(at(plane, 9, -1), 1.0);
  const Detonation sphere{.shape = DetonatorShape::sphere, .radius = 1.0};
  EXPECT_DOUBLE_EQ(at(sphere, 3, 4), 2.0);
  EXPECT_DOUBLE_EQ(at(sphere, 0.5, 0), 0.0);
  // A cord of 4 m/s: sin 30 deg = D/4, the front leaves it at 60 deg to the cord.
  const Detonation cord{.shape = DetonatorShape::cord, .end = Vector3(10, 0, 0), .velocity = 4.0, .delay = 1.0};
  EXPECT_DOUBLE_EQ(at(cord, 8, 0), 3.0);
  EXPECT_NEAR(at(cord, 8, 1), 1.0 + 2.0 + std::cos(std::numbers::pi / 6) / D, 1e-12);
  EXPECT_DOUBLE_EQ(at(cord, -2, 0), 2.0);
  EXPECT_DOUBLE_EQ(at(cord, 12, 0), 4.5);
}

/// Kenamond's problem 3: around an inert circle of radius 3, lit at (0, 5).
double around_circle(double x, double y, double D) {
  constexpr double R = 3.0, d = 5.0;
  const double r = std::hypot(x, y);
  const double theta = std::numbers::pi - std::acos(-y / r) - std::acos(R / r) - std::acos(R / d);
  if (theta <= 0.0) return std::hypot(x, y - d) / D;
  return (std::sqrt(d * d - R * R) + R * theta + std::sqrt(r * r - R * R)) / D;
}

/// Largest and mean error in the shadow, in seconds.
std::pair<double, double> shadow_error(double cell, double D) {
  const Arrival arrival(square(cell, [&](const Vector3& x) { return x.norm() < 3.0 ? 0.0 : D; }), std::vector{point(0, 5)});
  double largest = 0.0, sum = 0.0, count = 0.0;
  for (double x = -9.9; x < 10; x += 0.37) {
    for (double y = -9.9; y < 10; y += 0.37) {
      if (std::hypot(x, y) < 3.0) continue;
      const double exact = around_circle(x, y, D), error = std::abs(arrival.at(Vector3(x, y, 0), D) - exact);
      const bool in_sight = exact <= std::hypot(x, y - 5) / D + 1e-9;
      if (in_sight && x * x + y * y > 12.0) EXPECT_LT(error, 1e-12) << x << " " << y;
      largest = std::max(largest, error);
      sum += in_sight ? 0.0 : error;
      count += in_sight ? 0.0 : 1.0;
    }
  }
  return {largest, sum / count};
}

TEST(LightingTimes, GoRoundAnInertCircle) {
  constexpr double D = 2.0, h = 0.2;
  const auto [coarse, coarse_mean] = shadow_error(2 * h, D);
  const auto [fine, fine_mean] = shadow_error(h, D);
  EXPECT_LT(coarse, 1.5 * 2 * h / D);
  EXPECT_LT(fine, 1.5 * h / D);
  EXPECT_LT(fine_mean, 0.6 * coarse_mean);
  // The published values, (x, y) and t.
  EXPECT_NEAR(around_circle(4, -4, D), 5.023555, 1e-6);
  EXPECT_NEAR(around_circle(0, -5, D), 5.930503, 1e-6);
}

// Kenamond's problem 2: a fast circle of radius 3 in a slow explosive, five detonators with delays on the axis.
TEST(LightingTimes, OfTwoExplosives) {
  const auto arrivals = [](double cell) {
    const Arrival arrival(square(cell, [](const Vector3& x) { return x.norm() <= 3.0 ? 2.0 : 1.0; }),
                          std::vector{point(0, 10, 2), point(0, 5, 1), point(0, 0), point(0, -5, 1), point(0, -10, 2)});
    double largest = 0.0;
    for (const auto& [x, y, t] : {std::tuple(0.0, 1.0, 0.5), {0.0, 2.9, 1.45}, {6.0, 0.0, 4.5}, {0.0, 4.0, 2.0},
                                  {0.0, 6.0, 2.0}, {0.0, 7.5, 3.5}, {0.0, 9.0, 3.0}, {5.0, 5.0, 5.571068},
                                  {8.0, 8.0, 9.544004}}) {
      largest = std::max(largest, std::abs(arrival.at(Vector3(x, y, 0), std::hypot(x, y) <= 3.0 ? 2.0 : 1.0) - t));
    }
    return largest;
  };
  EXPECT_LT(arrivals(0.4), 0.4);
  EXPECT_LT(arrivals(0.1), 0.1);
}

// A disc of radius 25 in a cylinder, 20 from the detonator, of no thickness but a cell; three dimensions.
TEST(LightingTimes, GoRoundADisc) {
  constexpr double D = 7.98, cell = 1.0, a = 25.0, z1 = 20.0;
  const Arrival arrival({Vector3(0, 0, 0), {41, 41, 61}, cell,
                         [](const Vector3& x) {
                           return std::hypot(x[0], x[1]) < a && x[2] > z1 && x[2] < z1 + 0.99 * cell ? 0.0 : D;
                         }},
                        std::vector{Detonation{}});
  const auto exact = [](double r, double z) {
    return (std::hypot(a, z1) + std::hypot(r - a, z - z1)) / D;
  };
  EXPECT_NEAR(arrival.at(Vector3(0, 0, 60), D), exact(0, 60), 1.5 * cell / D);
  EXPECT_NEAR(arrival.at(Vector3(20 / std::numbers::sqrt2, 20 / std::numbers::sqrt2, 60), D), exact(20, 60), 1.5 * cell / D);
  EXPECT_NEAR(arrival.at(Vector3(40, 0, 30), D), std::hypot(40, 30) / D, 1e-12);
}

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
      const eos::State half = products.state(1.0 / (v + 0.5 * dv), s.specific_internal_energy - 0.5 * s.pressure * dv);
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

/// A column of explosive lit at the wall x = 0.
std::string column(const std::string& material, double length, double cell, const std::string& more = {}) {
  return fmt::format("[domain]\ndimension = \"plane_strain\"\nlower = [0, 0]\nupper = [{}, {}]\ncell_size = {}\n"
                     "boundary = {{ x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = \"symmetry\" }}\n"
                     "[[body]]\nname = \"charge\"\nmaterial = \"{}\"\nshape = {{ box = {{ lower = [0, 0], upper = [{}, {}] "
                     "}} }}\n{}",
                     1.1 * length, cell, cell, material, length, cell, more);
}
const std::string lit_at_wall = "[[detonation]]\nshape = \"plane\"\nposition = [0, 0]\nnormal = [1, 0]\n";

struct Slab {
  double error = 0.0;         // L1 of the pressure over 0.05 < x/(D t) < 0.95
  double wall_pressure = 0.0; // Pa, mean over 0.1 < x/(D t) < 0.4
  double velocity = 0.0;      // m/s, between two places
  double energy_error = 0.0;
};

Slab run_slab(const std::string& material, const TaylorWave& exact, double length, std::size_t cells,
              const std::string& more = {}) {
  const double h = length / static_cast<double>(cells), D = exact.velocity();
  const double end = 0.9 * length / D;
  solver::Simulation simulation(default_case(end, column(material, length, h, lit_at_wall), more), parallel::world());
  Slab slab;
  std::vector<double> times;  // at which the front, half the wall pressure, passes 0.4 and 0.8 of the length
  double last = 0.0, time_of_last = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    slab.energy_error = std::max(slab.energy_error, std::abs(s.state().ledger.energy_error(s.totals())));
    double front = 0.0;
    const Particles& q = s.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.pressure[p] > exact.wall_pressure()) front = std::max(front, q.position[p][0]);
    }
    const double target = times.empty() ? 0.4 * length : 0.8 * length;
    if (times.size() < 2 && front >= target) {
      times.push_back(time_of_last + (s.state().time - time_of_last) * (target - last) / (front - last));
    }
    if (front > last) last = front, time_of_last = s.state().time;
  });
  slab.velocity = times.size() == 2 ? 0.4 * length / (times[1] - times[0]) : 0.0;
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
  const Slab slab = run_slab("tnt", exact, 0.1, 200);
  EXPECT_LT(slab.error, 0.025);
  EXPECT_NEAR(slab.wall_pressure / exact.wall_pressure(), 1.0, 0.005);
  EXPECT_NEAR(slab.velocity / exact.velocity(), 1.0, 0.003);
  EXPECT_LT(slab.energy_error, 1e-12);
  RecordProperty("error", fmt::format("{}", slab.error));
}

}  // namespace
}  // namespace whipple::verification
