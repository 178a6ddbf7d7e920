// SPDX-License-Identifier: BSD-3-Clause
// What becomes of a struck wall by the rule of docs/decisions/0023_outcome_of_a_wall.md, on made-up particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "src/analysis/outcome.hpp"
#include "tests/unit/analysis_support.hpp"

namespace whipple::analysis::outcome {
namespace {

using testing::HasSubstr;

constexpr double spacing = 0.5e-3, cell = 1e-3, thickness = 2e-3, diameter = 6e-3;

/// A wall of 30 mm by 20 mm by 2 mm and a ball of 6 mm that flies at its middle at 5 km/s from 8 mm before it.
struct Struck {
  Run run;
  Frame frame;
  Snapshot start;

  Struck() {
    Maker maker(spacing);
    const auto everywhere = [](const Vector3&) { return true; };
    const Vector3 middle(15e-3, 10e-3, -8e-3);
    maker.fill(
        {12e-3, 7e-3, -11e-3}, {18e-3, 13e-3, -5e-3},
        [&](const Vector3& p) { return (p - middle).norm() < 0.5 * diameter; }, {0, 0, 5000}, 0);
    maker.fill({0, 0, 0}, {30e-3, 20e-3, thickness}, everywhere, Vector3::Zero(), 1);
    start = maker.snapshot;
    start.scalars.erase("phase");
    start.scalars["plastic_strain"].assign(start.size(), 0.0);
    run.cell_size = cell;
    run.lower = Vector3(-5e-3, -5e-3, -30e-3);
    run.upper = Vector3(40e-3, 30e-3, 60e-3);
    run.bodies = {{.name = "ball", .velocity = {0, 0, 5000}, .spacing = spacing, .size = diameter},
                  {.name = "wall", .velocity = Vector3::Zero(), .spacing = spacing, .size = thickness}};
    frame.centre = Vector3(15e-3, 10e-3, 0);
    frame.impact_speed = 5000.0;
  }
  [[nodiscard]] double distance(std::size_t i) const {
    return std::hypot(start.position[i].x() - 15e-3, start.position[i].y() - 10e-3);
  }
  /// Returns the wall after `change` of each of its particles at a time, with the ball at rest before it.
  [[nodiscard]] Snapshot wall(double time, const std::function<void(Snapshot&, std::size_t)>& change) const {
    Snapshot now = start;
    now.time = time;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now.body[i] == 0) {
        now.velocity[i].setZero();
      } else {
        change(now, i);
      }
    }
    return now;
  }
  /// Returns the wall as its middle moves at 100 m/s, plastically strained by 1 %.
  [[nodiscard]] Snapshot loaded(double time = 5e-6, double strain = 0.01) const {
    return wall(time, [&](Snapshot& now, std::size_t i) {
      now.scalars["plastic_strain"][i] = strain;
      if (distance(i) < 5e-3) now.velocity[i].z() = 100.0;
    });
  }
};

/// Judges snapshots one after the other.
Verdict verdict_of(const Struck& struck, const std::vector<Snapshot>& snapshots) {
  Wall wall(struck.run, struck.start, struck.frame, 1);
  Judge judge(struck.run, struck.start, struck.frame, wall);
  for (const Snapshot& snapshot : snapshots) judge.add(snapshot, wall.look(snapshot));
  return judge.verdict();
}

/// The window of the rule for a ball of 6 mm is 30 us.
TEST(Outcome, IsUndecidedUntilTheDebrisHasComeAndTheWallHasStopped) {
  const Struck struck;
  Verdict verdict = verdict_of(struck, {struck.start});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_THAT(verdict.reason, HasSubstr("1 of the projectile's momentum is still on its way"));
  verdict = verdict_of(struck, {struck.start, struck.loaded(), struck.loaded(34e-6)});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);  // the window has not passed
  EXPECT_THAT(verdict.reason, HasSubstr("the wall still deforms"));
  verdict = verdict_of(struck, {struck.start, struck.loaded(), struck.loaded(35e-6, 0.0106)});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);  // it has grown by 6 %
  verdict = verdict_of(
      struck, {struck.start, struck.loaded(), struck.loaded(35e-6, 0.0106), struck.loaded(65e-6, 0.011)});
  EXPECT_EQ(verdict.outcome, Outcome::whole);
  EXPECT_EQ(verdict.time, 65e-6);
  EXPECT_FALSE(verdict.is_defeat());
  Snapshot without = struck.loaded();
  without.scalars.erase("plastic_strain");
  EXPECT_THAT(verdict_of(struck, {without}).reason, HasSubstr("lack the field plastic_strain"));
}

TEST(Outcome, HoleIsDecidedAtOnceAndStays) {
  const Struck struck;
  const Snapshot open = struck.wall(3e-6, [&](Snapshot& now, std::size_t i) {
    if (struck.distance(i) < 4e-3) now.scalars["failed"][i] = 1.0;
  });
  const Verdict verdict =
      verdict_of(struck, {struck.start, open, struck.loaded(20e-6), struck.loaded(60e-6)});
  EXPECT_EQ(verdict.outcome, Outcome::perforated);
  EXPECT_EQ(verdict.time, 3e-6);
  EXPECT_TRUE(verdict.is_defeat());
}

/// Returns the wall whose rear half within a radius has moved off, strained by 1 %.
Snapshot spalled(const Struck& struck, double time, double radius, double distance, double speed) {
  return struck.wall(time, [&](Snapshot& now, std::size_t i) {
    now.scalars["plastic_strain"][i] = 0.01;
    if (struck.distance(i) > radius || struck.start.position[i].z() < 0.5 * thickness) return;
    now.position[i].z() += distance;
    now.velocity[i].z() = speed;
  });
}

TEST(Outcome, DetachedSpallNeedsMassSpeedAndDistance) {
  const Struck struck;
  const auto outcome = [&](double radius, double distance, double speed) {
    return verdict_of(struck,
                      {struck.start, struck.loaded(), spalled(struck, 40e-6, radius, distance, speed)});
  };
  // A layer a thickness away is decided at once, also while it flies.
  const Verdict away = outcome(4e-3, 5e-3, 80.0);
  EXPECT_EQ(away.outcome, Outcome::detached_spall);
  EXPECT_TRUE(away.is_defeat());
  EXPECT_THAT(away.reason, HasSubstr("80 m/s"));
  EXPECT_EQ(away.time, 40e-6);
  EXPECT_EQ(verdict_of(struck, {struck.start, spalled(struck, 9e-6, 4e-3, 5e-3, 80.0)}).time, 9e-6);
  // One that keeps pace with the wall, or a few particles, are none.
  EXPECT_NE(outcome(4e-3, 5e-3, 8.0).outcome, Outcome::detached_spall);
  EXPECT_NE(outcome(0.3e-3, 5e-3, 80.0).outcome, Outcome::detached_spall);
}

TEST(Outcome, GapInsideIsAttachedSpallAndDisplacedRearIsABulge) {
  const Struck struck;
  // The rear layer arches away by 3 mm and stays linked at its rim.
  const auto arched = [&](double height, bool rear_alone) {
    return struck.wall(40e-6, [&, height, rear_alone](Snapshot& now, std::size_t i) {
      now.scalars["plastic_strain"][i] = 0.01;
      const double r = struck.distance(i) / 8e-3;
      if (r > 1.0 || (rear_alone && struck.start.position[i].z() < 0.5 * thickness)) return;
      now.position[i].z() += height * std::pow(std::cos(0.5 * std::numbers::pi * r), 2);
    });
  };
  const auto outcome = [&](const Snapshot& last) {
    return verdict_of(struck, {struck.start, struck.loaded(), last});
  };
  const Verdict attached = outcome(arched(3e-3, true));
  EXPECT_EQ(attached.outcome, Outcome::attached_spall) << attached.reason;
  EXPECT_FALSE(attached.is_defeat());
  const Verdict bulge = outcome(arched(3e-3, false));
  EXPECT_EQ(bulge.outcome, Outcome::bulge) << bulge.reason;
  EXPECT_THAT(bulge.reason, HasSubstr("mm"));
  EXPECT_EQ(outcome(arched(0.5e-3, false)).outcome, Outcome::whole);
  // A wall that has drifted as a whole has not bulged.
  const Snapshot drifted = struck.wall(40e-6, [](Snapshot& now, std::size_t i) {
    now.scalars["plastic_strain"][i] = 0.01;
    now.position[i].z() += 3e-3;
    now.velocity[i].z() = 20.0;
  });
  EXPECT_EQ(outcome(drifted).outcome, Outcome::whole);
}

/// A point that fails takes its strain with it: neither that nor the fall of the mean of the rest is a wall at rest.
TEST(Outcome, WallThatStillFailsHasNotStopped) {
  const Struck struck;
  // The front layer within a radius has failed in place.
  const auto failed = [&](double time, double radius, double strain) {
    return struck.wall(time, [&, radius, strain](Snapshot& now, std::size_t i) {
      now.scalars["plastic_strain"][i] = strain;
      if (struck.distance(i) > radius || struck.start.position[i].z() > 0.25 * thickness) return;
      now.scalars["failed"][i] = 1.0;
      now.scalars["plastic_strain"][i] = 3.0;
    });
  };
  Verdict verdict = verdict_of(struck, {struck.start, failed(5e-6, 2e-3, 0.01), failed(40e-6, 3e-3, 0.01)});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_THAT(verdict.reason, HasSubstr("the wall still deforms"));
  // Four points are less than a hundredth of the plug, but the strain at which they failed is growth.
  verdict = verdict_of(struck, {struck.start, struck.loaded(), failed(40e-6, 0.4e-3, 0.01)});
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_THAT(verdict.reason, HasSubstr("the wall still deforms"));
  verdict = verdict_of(struck, {struck.start, failed(5e-6, 0.4e-3, 0.01), failed(40e-6, 0.4e-3, 0.01)});
  EXPECT_EQ(verdict.outcome, Outcome::whole);
  // Failure at the strain that the points had: the failed mass alone tells that the wall has not stopped.
  const auto same = [&](double time, double radius) {
    Snapshot now = failed(time, radius, 0.01);
    for (double& strain : now.scalars["plastic_strain"]) strain = 0.01;
    return now;
  };
  EXPECT_EQ(verdict_of(struck, {struck.start, same(5e-6, 2e-3), same(40e-6, 3e-3)}).outcome,
            Outcome::undecided);
  EXPECT_EQ(verdict_of(struck, {struck.start, same(5e-6, 2e-3), same(40e-6, 2e-3)}).outcome, Outcome::whole);
}

TEST(Outcome, RearLayerOfTheWholeWidthThatFliesOffIsDetachedSpall) {
  const Struck struck;
  const auto outcome = [&](double distance, double speed) {
    return verdict_of(struck, {struck.start, struck.loaded(), spalled(struck, 40e-6, 1.0, distance, speed)});
  };
  const Verdict away = outcome(5e-3, 80.0);
  EXPECT_EQ(away.outcome, Outcome::detached_spall) << away.reason;
  EXPECT_THAT(away.reason, HasSubstr("80 m/s"));
  EXPECT_EQ(outcome(3e-3, 5.0).outcome, Outcome::attached_spall);  // it keeps pace
}

/// What has failed on the rim of a wall that drifts moves with it.
TEST(Outcome, FailedRimOfAWallThatDriftsIsNoSpall) {
  const Struck struck;
  const auto drifted = [&](double rim, double speed) {
    return struck.wall(40e-6, [&, rim, speed](Snapshot& now, std::size_t i) {
      now.scalars["plastic_strain"][i] = 0.01;
      now.position[i].z() += 5e-3;
      now.velocity[i].z() = 30.0;
      const double x = struck.start.position[i].x();
      if (x > rim && x < 30e-3 - rim) return;
      now.scalars["failed"][i] = 1.0;
      now.velocity[i].z() = speed;
    });
  };
  for (const double rim : {1e-3, 2e-3}) {
    const Verdict verdict = verdict_of(struck, {struck.start, drifted(rim, 30.0), [&] {
                                                  Snapshot later = drifted(rim, 30.0);
                                                  later.time = 80e-6;
                                                  return later;
                                                }()});
    EXPECT_EQ(verdict.outcome, Outcome::whole) << rim << ": " << verdict.reason;
  }
}

/// In a section a particle far from the axis is a ring that outweighs a hundredth of the plug.
TEST(Outcome, RingOfOneParticleIsNoSpall) {
  Maker maker(spacing);
  const auto everywhere = [](const Vector3&) { return true; };
  constexpr double thick = 4e-3;  // of the wall; coordinates: axis, radius, and one layer across the section
  maker.fill({-8e-3, 0, 0}, {-2e-3, 3e-3, spacing}, everywhere, {5000, 0, 0}, 0);
  maker.fill({0, 0, 0}, {thick, 30e-3, spacing}, everywhere, Vector3::Zero(), 1);
  Snapshot start = maker.snapshot;
  start.scalars.erase("phase");
  start.scalars["plastic_strain"].assign(start.size(), 0.0);
  for (std::size_t i = 0; i < start.size(); ++i) {
    start.position[i].z() = 0.0;
    start.mass[i] = density * spacing * spacing * 2.0 * pi * start.position[i].y();
  }
  analysis::Run run;
  run.dimension = grid::Dimension::axisymmetric;
  run.cell_size = cell;
  run.lower = Vector3(-30e-3, 0, 0);
  run.upper = Vector3(60e-3, 40e-3, cell);
  run.bodies = {{.name = "ball", .velocity = {5000, 0, 0}, .spacing = spacing, .size = diameter},
                {.name = "wall", .velocity = Vector3::Zero(), .spacing = spacing, .size = thick}};
  const Frame frame = find_frame(run, start);
  ASSERT_TRUE(frame.is_planar());
  // A square block of the rear, `edge` wide, flies off at a radius of 20 mm.
  const auto outcome = [&](double edge) {
    Snapshot off = start;
    off.time = 9e-6;
    for (std::size_t i = 0; i < off.size(); ++i) {
      const double r = start.position[i].y() - 20e-3;
      if (off.body[i] != 1 || r < 0.0 || r > edge || start.position[i].x() < thick - edge) continue;
      off.position[i].x() += 10e-3;
      off.velocity[i].x() = 80.0;
    }
    Wall wall(run, start, frame, 1);
    Judge judge(run, start, frame, wall);
    judge.add(off, wall.look(off));
    return judge.verdict();
  };
  for (const double edge : {spacing, 2.0 * spacing}) {  // one particle, and four: a block one cell wide
    const Verdict verdict = outcome(edge);
    EXPECT_EQ(verdict.outcome, Outcome::undecided) << verdict.reason;
    EXPECT_THAT(verdict.reason, HasSubstr("momentum is still on its way"));
  }
  const Verdict wide = outcome(4.0 * spacing);  // two cells
  EXPECT_EQ(wide.outcome, Outcome::detached_spall) << wide.reason;
}

TEST(Outcome, MeasuresAreNumbersOnceItIsDecided) {
  const Struck struck;
  Wall wall(struck.run, struck.start, struck.frame, 1);
  Judge judge(struck.run, struck.start, struck.frame, wall);
  judge.add(struck.start, wall.look(struck.start));
  EXPECT_TRUE(std::isnan(value(judge.measures(), "defeated.wall")));
  const Snapshot off = spalled(struck, 9e-6, 4e-3, 5e-3, 80.0);
  judge.add(off, wall.look(off));
  EXPECT_EQ(value(judge.measures(), "defeated.wall"), 1.0);
  EXPECT_EQ(value(judge.measures(), "outcome_time.wall"), 9e-6);
}

}  // namespace
}  // namespace whipple::analysis::outcome
