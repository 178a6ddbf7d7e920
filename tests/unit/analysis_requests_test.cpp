// SPDX-License-Identifier: BSD-3-Clause
// Measures on request, of tables and snapshots made for them. Numbers with many digits are those of an independent
// program (numpy) on the same files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "src/analysis/requests.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::analysis {
namespace {

using testing::HasSubstr;

class Requests : public testing::Test {
 protected:
  double take(const std::string& text) { return take_on_request(folder.path(), text).value; }
  std::string refusal(const std::string& text) {
    try {
      take(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }
  std::ofstream file(const std::string& name) { return std::ofstream(folder.path() / name); }
  std::string path(const std::string& name) { return (folder.path() / name).string(); }

  TemporaryFolder folder;
};

/// A bar whose section shrinks at a known rate, and whose force ends.
class PulledBar : public Requests {
 protected:
  static constexpr double rate = 1000.0, end_of_force = 200e-6, force = 5e3, average = 4e-6;

  PulledBar() { write(261); }
  void write(int rows) {
    std::ofstream history = file("history.csv");
    history << "time [s],wall_impulse_x [N s]\n";
    for (int i = 0; i < rows; ++i) {
      const double t = 1e-6 * i;
      const double held = std::min(t, end_of_force) + 0.2 * std::max(t - end_of_force, 0.0);
      history << fmt::format("{},{}\n", t, -force * held);
    }
    std::ofstream gauges = file("gauges.csv");
    gauges << "time [s],mark.x [m]";
    for (int k = 1; k <= 3; ++k) {
      for (const char* column :
           {"y [m]", "stress_xx [Pa]", "stress_yy [Pa]", "stress_zz [Pa]", "stress_xy [Pa]", "stress_yz [Pa]",
            "stress_zx [Pa]", "plastic_strain [1]", "failed_fraction [1]"}) {
        gauges << fmt::format(",{}_{}.{}", group, k, column);
      }
    }
    for (int i = 0; i <= 260; ++i) {
      const double t = 1e-6 * i, strain = rate * t;
      gauges << fmt::format("\n{},{}", t, 10e-3 * std::exp(strain));
      for (int k = 0; k < 3; ++k) {
        gauges << fmt::format(",{},3e8,1e8,1e8,1e8,2e8,3e8,{},{}", 1e-3 * k * std::exp(-0.5 * strain), strain,
                              k == 0 && t >= end_of_force - 0.5e-6 ? 1 : 0);
      }
    }
    gauges << "\n";
  }
  std::string group = "section";
};

TEST_F(PulledBar, ForceAndSection) {
  EXPECT_NEAR(take("peak_stress.section place=2 mm") / 397887357.729741, 1.0, 1e-12);
  EXPECT_NEAR(take("neck_strain.section"), 0.20200000000000007, 1e-12);
  EXPECT_NEAR(take("neck_strain.section"), rate * end_of_force, rate * average);
  EXPECT_NEAR(take("elongation.section.mark"), 0.22384800811135808, 1e-12);
}

TEST_F(PulledBar, FirstFailure) {
  EXPECT_NEAR(take("failure_strain.section"), rate * end_of_force, 1e-12);
  // A lateral tension of 1 and an axial one of 3, and shear: mean 5/3, equivalent (4 + 3 (1 + 4 + 9))^0.5.
  EXPECT_NEAR(take("failure_triaxiality.section"), 5.0 / 3.0 / std::sqrt(46.0), 1e-9);
  EXPECT_NEAR(take("failure_triaxiality.section"), 0.24573659359149633, 1e-12);
}

TEST_F(PulledBar, APunchOfTheSameForceAndPath) {
  EXPECT_NEAR(take("shear_strength.mark place=3 mm travel=2 mm") / 132629119.24324699, 1.0, 1e-12);
  EXPECT_NEAR(take("shear_stroke.mark travel=2 mm"), 1.1192400405567902, 1e-12);
  EXPECT_NEAR(take("shear_stroke.mark travel=2 mm"), 5.0 * std::expm1(rate * end_of_force),
              10 * rate * average);
}

TEST_F(PulledBar, AWholeBarHasNoStrainAtFracture) {
  write(149);
  for (const char* measure :
       {"neck_strain.section", "elongation.section.mark", "shear_stroke.mark travel=2 mm"}) {
    EXPECT_TRUE(std::isnan(take(measure))) << measure;
    EXPECT_FALSE(take_on_request(folder.path(), measure).reason.empty()) << measure;
  }
  std::filesystem::remove(folder.path() / "gauges.csv");
  EXPECT_TRUE(std::isnan(take("failure_strain.section")));
  EXPECT_TRUE(std::isnan(take("failure_triaxiality.section")));
}

TEST_F(PulledBar, NamesThatAreNotThereAreRefused) {
  EXPECT_THAT(refusal("elongation.section"), HasSubstr("expected elongation.TRACERS.GAUGE"));
  EXPECT_THAT(refusal("elongation.section.end"), HasSubstr("gauges.csv has no end"));
  EXPECT_THAT(refusal("neck_strain.section.mark"), HasSubstr("expected neck_strain.TRACERS"));
  EXPECT_THAT(refusal("neck_strain.waist"), HasSubstr("gauges.csv has no waist_1"));
  EXPECT_THAT(refusal("necking.section"), HasSubstr("unknown kind; there are wall_speed"));
  EXPECT_THAT(refusal("neck_strain.section place=1 mm"), HasSubstr("neck_strain takes no parameters"));
  EXPECT_THAT(refusal("peak_stress.section"), HasSubstr("peak_stress takes place"));
  EXPECT_THAT(refusal("peak_stress.section place=1 s"), HasSubstr("place: "));
  EXPECT_THAT(refusal("peak_stress.section place=1 mm place=2 mm"), HasSubstr("place is given twice"));
  group = "section_a";
  write(261);
  EXPECT_THAT(refusal("neck_strain.section"), HasSubstr("gauges.csv has no section_1"));
}

/// Tables of tracers along x that a front passes.
class Fronts : public Requests {
 protected:
  /// @param pressure  pressure(time, tracer), Pa
  void write(const std::vector<double>& places, int rows, double step,
             const std::function<double(double, std::size_t)>& pressure) {
    std::ofstream gauges = file("gauges.csv");
    gauges << "time [s]";
    for (std::size_t i = 0; i < places.size(); ++i)
      gauges << fmt::format(",front_{0:02}.x [m],front_{0:02}.pressure [Pa]", i);
    for (int row = 0; row < rows; ++row) {
      const double time = step * row;
      gauges << fmt::format("\n{}", time);
      for (std::size_t i = 0; i < places.size(); ++i)
        gauges << fmt::format(",{},{}", places[i], pressure(time, i));
    }
    gauges << "\n";
  }
};

TEST_F(Fronts, TheSpeedIsTheSlopeOverTracers) {
  const std::vector<double> places = {0.01, 0.015, 0.02, 0.025};
  // A front of 5000 m/s whose pressure rises linearly over 2 mm.
  write(places, 60, 1e-7, [&](double time, std::size_t i) {
    return 1e9 * std::clamp((5000.0 * time - places[i]) / 0.002, 0.0, 1.0);
  });
  EXPECT_NEAR(take("arrival_speed.front"), 5000.0, 1e-6);
  EXPECT_TRUE(std::isnan(take("arrival_speed.wall")));
}

TEST_F(Fronts, TheRunDistanceIsWhereAShockBecomesADetonation) {
  std::vector<double> places;
  for (int i = 0; i < 40; ++i) places.push_back(0.01 + 0.0005 * i);
  const auto rise = [](double time, double arrival) {
    return 1e10 * std::clamp((time - 1e-6 * arrival) / 2e-9, 0.0, 1.0);
  };
  // 4000 m/s over the first 8 mm, 8000 m/s from there on.
  write(places, 4000, 1e-9, [&](double time, std::size_t i) {
    const double x = places[i];
    return rise(time, std::min((x - 0.01) / 4e-3, 2.0) + std::max(x - 0.018, 0.0) / 8e-3);
  });
  EXPECT_NEAR(take("run_distance.front place=10 mm"), 0.008, 0.0005);
  EXPECT_NEAR(take("run_distance.front place=10 mm"), 0.008123389694041869, 1e-9);
  places.resize(30);
  write(places, 4000, 1e-9,
        [&](double time, std::size_t i) { return rise(time, (places[i] - 0.01) / 4e-3); });
  EXPECT_TRUE(std::isnan(take("run_distance.front place=10 mm")));
}

TEST_F(Requests, TheMeanForceByImpulses) {
  file("history.csv")
      << "step,time [s],wall_impulse_x [N s]\n0,0,0\n1,1,-2\n2,3,-8\n3";  // a row in the making
  EXPECT_EQ(take("mean_force.wall_impulse_x time=1 s"), -3.0);
  EXPECT_EQ(take("mean_force.wall_impulse_x time=2 s"), -3.0);
  EXPECT_TRUE(std::isnan(take("mean_force.wall_impulse_x time=3 s")));
  EXPECT_TRUE(std::isnan(take("mean_force.wall_impulse_y time=1 s")));
}

TEST_F(Fronts, PeakAndArrivalOfAGauge) {
  file("gauges.csv")
      << "time [s],far.pressure [Pa]\n0,\n1,100\n2,110\n3,200\n4,300\n5,150\n6";  // a row in the making
  EXPECT_EQ(take("peak.far.pressure"), 300.0);
  EXPECT_EQ(take_on_request(folder.path(), "peak.far.pressure").unit, "Pa");
  EXPECT_EQ(take("arrival.far.pressure"), 3.0);
  EXPECT_EQ(take("change.far.pressure"), 50.0);
  EXPECT_EQ(take_on_request(folder.path(), "change.far.pressure").unit, "Pa");
  EXPECT_TRUE(std::isnan(take("peak.near.pressure")));
  file("gauges.csv") << "time [s],far.pressure [Pa]\n0,high\n1,2\n";
  EXPECT_THAT(refusal("peak.far.pressure"), HasSubstr("gauges.csv:2: error: far.pressure is \"high\""));
}

TEST_F(Requests, TheSpeedOfAWallAtAPlace) {
  std::ofstream gauges = file("gauges.csv");
  gauges << "time [s],w_1.x [m],w_1.y [m],w_2.x [m],w_2.y [m],w_3.x [m],w_3.y [m]\n";
  for (int i = 0; i < 40; ++i) {
    const double time = 2.5e-7 * i, r = 0.01 + 1e-3 * std::pow(1e6 * time, 1.3) * 0.9;
    gauges << fmt::format("{},{},{},{},{},0.05,{}\n", time, 0.01 + 100 * time, 1.1 * r, 0.03 + 50 * time, r,
                          0.9 * r);
  }
  gauges.close();
  EXPECT_NEAR(take("wall_speed.w place=35 mm travel=4 mm") / 1619.6615581637623, 1.0, 1e-9);
  EXPECT_TRUE(std::isnan(take("wall_speed.w place=35 mm travel=400 mm")));
  EXPECT_TRUE(std::isnan(take("wall_speed.w place=90 mm travel=4 mm")));
}

TEST_F(Requests, TracersThatHaveLeftDoNotDisturbTheSpeedOfAWall) {
  std::ofstream gauges = file("gauges.csv");
  gauges << "time [s],w_1.x [m],w_1.y [m],w_2.x [m],w_2.y [m],w_3.x [m],w_3.y [m]\n";
  for (int i = 0; i < 8; ++i) {
    const double radius = 0.01 + 0.001 * i;  // 1 km/s at all of them
    gauges << fmt::format("{},0.04,{},{},0,{}\n", 1e-6 * i, radius,
                          i > 1 ? "nan,nan" : fmt::format("0.02,{}", radius), radius);
  }
  gauges.close();
  EXPECT_NEAR(take("wall_speed.w place=30 mm travel=4 mm"), 1000.0, 1e-6);
}

TEST_F(Requests, HistoriesAreComparedWithMeasuredOnesWhateverTheirShift) {
  const auto ramp = [](double t, double begin) { return 300.0 * std::clamp((t - begin) / 0.2e-6, 0.0, 1.0); };
  const auto write = [&](double factor, double begin, double excess) {
    std::ofstream gauges = file("gauges.csv");
    gauges << "time [s],rear.velocity_z [m/s]\n";
    for (int i = 0; i <= 800; ++i) {
      const double t = 5e-9 * i;
      gauges << fmt::format("{},{}\n", t, factor * ramp(t, begin) + (t > 0.5e-6 + 1e-15 ? excess : 0.0));
    }
  };
  std::ofstream record = file("record.csv");
  record << "# a record\ntime [us],velocity [km/s]\n";
  for (int i = 0; i <= 100; ++i)
    record << fmt::format("{},{}\n", 1.0 + 0.01 * i, 1e-3 * ramp(1e-6 + 1e-8 * i, 1.1e-6));
  record.close();
  const std::string error = "history_error.rear.velocity_z table=" + path("record.csv");
  write(1.0, 0.3e-6, 0.0);
  EXPECT_NEAR(take(error), 0.0, 1e-6);
  EXPECT_NEAR(take("history_shift.rear.velocity_z table=" + path("record.csv")), 0.8e-6, 1e-12);
  write(1.0, 0.3e-6, 30.0);
  // Half of the plateau is reached 0.1 us after the begin of a rise whose upper half is as the measured one.
  EXPECT_NEAR(take(error), 30.0 * 0.7 / (300.0 * 0.8), 2e-3);
  EXPECT_NEAR(take(error), 0.08687500000000027, 1e-6);
  write(140.0 / 300.0, 0.3e-6, 0.0);
  EXPECT_TRUE(std::isnan(take(error)));
  write(1.0, 3.2e-6, 0.0);
  EXPECT_TRUE(std::isnan(take(error)));
  for (const char* text :
       {"", "time [us],velocity\n0,1\n1,2\n2,3\n", "time [us],velocity [m/s]\n0,1\n1,a\n2,3\n",
        "time [us],velocity [m/s]\n0,1\n2,2\n1,3\n", "time [us],velocity [m/s]\n0,1\n1,2\n",
        "time [us],velocity [m/s]\n0,1\n1,2,3\n2,3\n"}) {
    file("record.csv") << text;
    EXPECT_THAT(refusal(error), HasSubstr("record.csv")) << text;
  }
}

TEST_F(Requests, ADisplacementIsComparedWithACurveAtItsTimes) {
  file("gauges.csv") << "time [s],tip.x [m]\n0,2\n1,2\n2,2.5\n3,3\n4,3\n";
  file("curve.csv") << "time [s],displacement [mm]\n1,0\n2,400\n3,1000\n4,1200\n";
  EXPECT_NEAR(take("change_error.tip.x table=" + path("curve.csv")), (0.05 + 0.05 + 0.1) / (0.2 + 0.7 + 1.1),
              1e-12);
  EXPECT_NEAR(take("peak_change.tip.x"), 1.0, 1e-12);
  file("curve.csv") << "time [s],displacement [mm]\n1,0\n2,400\n5,1000\n";
  EXPECT_TRUE(std::isnan(take("change_error.tip.x table=" + path("curve.csv")))) << "the run ends before";
}

/// A run with a body without particles and one with some.
class Jets : public Requests {
 protected:
  struct Particle {
    Vector3 position, velocity;
    double mass, pressure;
  };
  Jets() {
    file("run.toml")
        << "title = \"jets\"\n[domain]\nlower = [\"-1 m\", \"-1 m\", \"-1 m\"]\nupper = [\"2 m\", \"1 m\", "
           "\"1 m\"]\ncell_size = \"1 mm\"\n[time]\nend = \"3 us\"\n"
           "[[body]]\nname = \"air\"\nmaterial = \"air\"\nvelocity = [0, 0, 0]\nshape = { sphere = { "
           "center = [0, 0, 0], radius = \"1 mm\" } }\n"
           "[[body]]\nname = \"strip\"\nmaterial = \"copper\"\nvelocity = [\"10 m/s\", \"-100 m/s\", 0]\n"
           "shape = { sphere = { center = [0, 0, 0], radius = \"2 mm\" } }\n";
  }
  void write(const std::vector<std::pair<double, std::vector<Particle>>>& snapshots) {
    std::string list;
    for (const auto& [time, particles] : snapshots) {
      const std::string name = fmt::format("made_{}.particles.hdf", snapshots.size() > 1 ? time : 0.0);
      list += fmt::format("{}{{\"name\": \"{}\", \"time\": {}}}", list.empty() ? "" : ", ", name, time);
      hdf5::File made = hdf5::File::create(folder.path() / name, hdf5::File::Compatibility::compact);
      const hdf5::Group vtk = made.root.create_group("VTKHDF"), data = vtk.create_group("PointData");
      const std::size_t n = particles.size();
      std::vector<float> points, velocity, mass, pressure;
      std::vector<std::uint64_t> id;
      for (const Particle& p : particles) {
        for (int a = 0; a < 3; ++a) {
          points.push_back(static_cast<float>(p.position[a]));
          velocity.push_back(static_cast<float>(p.velocity[a]));
        }
        mass.push_back(static_cast<float>(p.mass));
        pressure.push_back(static_cast<float>(p.pressure));
        id.push_back(id.size());
      }
      const auto whole = hdf5::Slab::whole(n);
      vtk.write<float>("Points", points, whole, {.columns = 3});
      data.write<float>("velocity", velocity, whole, {.columns = 3});
      data.write<float>("mass", mass, whole);
      data.write<float>("pressure", pressure, whole);
      data.write<std::uint64_t>("id", id, whole);
      data.write<std::uint16_t>("body", std::vector<std::uint16_t>(n, 1), whole);
      made.close();
    }
    file("made.particles.hdf.series") << "{\"file-series-version\": \"1.0\", \"files\": [" << list << "]}";
  }
};

TEST_F(Jets, ReachAndHeightOfAHeap) {
  // A triangle of a hundred columns of 1 mm, of equal masses, behind one grain that lies ahead of it.
  std::vector<Particle> heap;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100 - i; ++k)
      heap.push_back({{1e-3 * (i + 0.5), 0.0, 1e-3 * k}, {0, 0, 0}, 1e-6, 0.0});
  }
  heap.push_back({{0.5, 0.0, 0.0}, {0, 0, 0}, 1e-6, 0.0});
  write({{3e-6, heap}});
  EXPECT_NEAR(take("reach.strip.x fraction=1 %"), 90.5e-3, 1e-3);  // 50 of 5051 lie in the last ten columns
  EXPECT_NEAR(take("reach.strip.x fraction=0.01 %"), 0.5, 1e-6);
  EXPECT_NEAR(take("reach.strip.z fraction=50 %"), 29e-3, 1e-3);  // 1 - 1/sqrt(2) of the height
  EXPECT_NEAR(take("height.strip.z.x place=20.5 mm"), 79e-3, 1e-6);
  EXPECT_TRUE(std::isnan(take("height.strip.z.x place=200 mm")));
  EXPECT_THAT(refusal("reach.strip.r fraction=1 %"),
              HasSubstr("reach.strip.r fraction=1 %\": \"r\" is no axis"));
  EXPECT_THAT(refusal("reach.strip.x fraction=2"), HasSubstr("must be > 0 and < 1"));
  EXPECT_THAT(refusal("height.strip.z place=1 mm"), HasSubstr("BODY.AXIS.AXIS"));
}

TEST_F(Jets, TheErrorOfAProfileIsWeightedByMassWithinTheTable) {
  file("exact.csv") << "# made up\nx [m],pressure [Pa],velocity [m/s]\n0,10,0\n1,20,100\n";
  write({{1e-6,
          {{Vector3(0, 0, 0), Vector3(0, 1, 0), 1.0, 11.0},
           {Vector3(0.5, 0, 0), Vector3(60, 0, 0), 2.0, 15.0},
           {Vector3(1.5, 0, 0), Vector3(0, 0, 0), 9.0, 99.0}}}});
  const std::string table = " table=" + path("exact.csv");
  EXPECT_DOUBLE_EQ(take("profile_error.strip.pressure" + table), 1.0 / 40.0);
  EXPECT_DOUBLE_EQ(take("profile_error.strip.velocity" + table), 20.0 / 100.0);
  EXPECT_THAT(refusal("profile_error.strip.density" + table), HasSubstr("has no column \"density\""));
  EXPECT_THAT(refusal("profile_error.strip.pressure table=" + path("none.csv")), HasSubstr("no such table"));
  EXPECT_TRUE(std::isnan(take("profile_error.air.pressure" + table)));
  EXPECT_THAT(refusal("profile_error.copper.pressure" + table),
              HasSubstr("there is no body \"copper\"; there are air, strip"));
  const auto of_table = [&](const std::string& text) {
    file("other.csv") << text;
    return "profile_error.strip.pressure table=" + path("other.csv");
  };
  EXPECT_DOUBLE_EQ(take(of_table("x [mm],pressure [kPa]\n0,0.01\n1000,0.02\n")), 1.0 / 40.0);
  EXPECT_THAT(refusal(of_table("x,pressure\n0,10\n1,20\n")), HasSubstr("column \"x\" has no unit"));
  EXPECT_THAT(refusal(of_table("x [m],pressure [K]\n0,10\n1,20\n")), HasSubstr("wrong dimension"));
  EXPECT_THAT(refusal(of_table("x [m],pressure [Pa]\n1,10\n0,20\n")), HasSubstr("x must increase"));
  EXPECT_THAT(refusal(of_table("x [m],pressure [Pa]\n0,10\n")), HasSubstr("two or more complete rows"));
  EXPECT_THAT(refusal("profile_error.strip.colour" + table), HasSubstr("accepted are pressure, density"));
}

TEST_F(Jets, TheSpeedIsExceededByTheFraction) {
  std::vector<Particle> particles;
  for (int i = 0; i < 100; ++i) particles.push_back({Vector3::Zero(), Vector3(i, 0, 0), 1.0, 0.0});
  write({{1e-6, particles}});
  EXPECT_EQ(take("jet_speed.strip fraction=1 %"), 99.0);
  EXPECT_EQ(take("jet_speed.strip fraction=0.1"), 90.0);
  EXPECT_TRUE(std::isnan(take("jet_speed.air fraction=0.1")));
}

TEST_F(Jets, GapsAreWhatIsEmptyBetweenTipAndTail) {
  std::vector<Particle> particles;  // one in each cell
  for (int i = 0; i < 100; ++i)
    particles.push_back({Vector3(1e-3 * (i + 0.5), 0, 0), Vector3(10 * i, 0, 0), 1.0, 0.0});
  write({{1e-6, particles}});
  EXPECT_EQ(take("jet_gap.strip fraction=0.01"), 0.0);
  // The first is no jet: slower than a quarter of the tip. 41 comes to 42, and 40 to 41.
  for (const std::size_t i : {10U, 40U, 41U, 60U}) particles[i].position.x() += 1e-3;
  write({{1e-6, particles}});
  EXPECT_NEAR(take("jet_gap.strip fraction=0.01"), 2.0 / 75.0, 1e-15);
}

TEST_F(Jets, TheFractionCountsWhatTurnsBetweenTwoSnapshots) {
  // Of ten particles that fall with 100 m/s three are slug and one is jet at 1 us; at 2 us six and two.
  const auto at = [](int slug, int jet) {
    std::vector<Particle> particles(10, {Vector3::Zero(), Vector3(10, -100, 0), 1.0, 0.0});
    for (int i = 0; i < slug + jet; ++i) {
      particles[static_cast<std::size_t>(i)].velocity = i < slug ? Vector3(5, 0, 0) : Vector3(90, -1, 0);
    }
    return particles;
  };
  write({{1e-6, at(3, 1)}, {2e-6, at(6, 2)}});
  EXPECT_DOUBLE_EQ(take("jet_fraction.strip time=1 us speed=50 m/s"), 0.25);
  EXPECT_TRUE(std::isnan(take("jet_fraction.strip time=2 us speed=50 m/s")));  // nothing turns after the last
  EXPECT_TRUE(std::isnan(take("jet_fraction.strip time=0.5 us speed=50 m/s")));  // no snapshot so early
}

TEST(RequestedMeasures, TheTableOfTheManualIsThatOfTheProgram) {
  std::ifstream file(std::filesystem::path(whipple::tests::source_folder()) / "docs/manual/output.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(page, HasSubstr(requested_measures_as_markdown()));
}

}  // namespace
}  // namespace whipple::analysis
