// SPDX-License-Identifier: BSD-3-Clause
// Tables of shots and shield files, and the cases made of them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"
#include "src/shields/alloys.hpp"
#include "src/shields/case_text.hpp"
#include "src/shields/layout.hpp"
#include "src/shields/shots.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::shields {
namespace {

using testing::HasSubstr;

constexpr const char* heading =
    "shot,sphere,diameter [mm],angle [degree],velocity [km/s],bumper,bumper thickness [mm],spacing "
    "[mm],wall,wall "
    "thickness [mm],result\n";
constexpr const char* ryan = "R31,2017-T4,3.175,0,3.1,6061-T6,0.7874,50.8,6061-T6,4.064,P\n";

std::filesystem::path written(const TemporaryFolder& folder, const std::string& name,
                              const std::string& text) {
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file) << text;
  return file;
}

std::string fault_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

Impact ryan_impact(double angle = 0.0) {
  const TemporaryFolder folder;
  Impact impact = read_shots(written(folder, "shots.csv", std::string(heading) + ryan)).front().impact;
  impact.projectile.angle = angle;
  return impact;
}

TEST(Shots, AreReadInTheirUnits) {
  const TemporaryFolder folder;
  const auto shots =
      read_shots(written(folder, "shots.csv",
                         std::string("# a remark\n") + heading + ryan +
                             "R60,AA2017-T4,3.175,45,6,6061-T6,0.7874,50.8,7075-T6,4.064,NP\n"));
  ASSERT_EQ(shots.size(), 2U);
  EXPECT_EQ(shots[0].impact.name, "R31");
  EXPECT_EQ(shots[0].result, Result::failed);
  EXPECT_DOUBLE_EQ(shots[0].impact.projectile.velocity, 3100.0);
  EXPECT_DOUBLE_EQ(shots[0].impact.projectile.density, 2800.0);
  EXPECT_EQ(shots[1].impact.projectile.alloy, "2017-T4");
  EXPECT_NEAR(shots[1].impact.projectile.angle, 0.25 * std::numbers::pi, 1e-15);
  EXPECT_DOUBLE_EQ(shots[1].impact.shield.wall.yield, 503e6);
  EXPECT_EQ(shots[1].result, Result::held);
}

TEST(Shots, FaultsNameLineAndAcceptedValues) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    const auto file = written(folder, "bad.csv", text);
    return fault_of([&] { static_cast<void>(read_shots(file)); });
  };
  const std::string unknown =
      fault(std::string(heading) + "R31,2017-T9,3.175,0,3.1,6061-T6,0.7874,50.8,6061-T6,4.064,P\n");
  EXPECT_THAT(unknown, HasSubstr("bad.csv:2:1"));
  EXPECT_THAT(unknown, HasSubstr("unknown alloy \"2017-T9\", did you mean \"2017-T4\"?"));
  EXPECT_THAT(unknown, HasSubstr("7075-T6"));
  EXPECT_THAT(fault("shot,sphere\n"), HasSubstr("column \"diameter\" is missing"));
  EXPECT_THAT(fault("diameter\n"), HasSubstr("column \"diameter\" needs a unit, as in \"diameter [m]\""));
  EXPECT_THAT(fault("diameter [kg]\n"), HasSubstr("kg"));
  EXPECT_THAT(fault("dimeter [mm]\n"), HasSubstr("did you mean \"diameter\"?"));
  EXPECT_THAT(fault(std::string(heading) + "R31,2017-T4,3.175,95,3.1,6061-T6,0.7874,50.8,6061-T6,4.064,P\n"),
              HasSubstr("angle is 95"));
  EXPECT_THAT(
      fault(std::string(heading) + "R31,2017-T4,3.175,0,3.1,6061-T6,0.7874,50.8,6061-T6,4.064,maybe\n"),
      HasSubstr("result is \"maybe\""));
  EXPECT_THAT(fault(std::string(heading) + "R31,2017-T4\n"), HasSubstr("2 cells, the heading has 11"));
  for (const char* number : {"inf", "nan", "1e999"}) {
    const std::string text =
        fault(std::string(heading) +
              fmt::format("R31,2017-T4,3.175,0,3.1,6061-T6,0.7874,{},6061-T6,4.064,P\n", number));
    EXPECT_THAT(text, HasSubstr("bad.csv:2:1"));
    EXPECT_THAT(text, HasSubstr(fmt::format("spacing is \"{}\", expected a finite number", number)));
  }
  EXPECT_THAT(fault(heading), HasSubstr("has a heading but no shots"));
}

TEST(ShieldFile, IsReadWithAllItsSheets) {
  const TemporaryFolder folder;
  const std::string text =
      "name = \"two bumpers\"\n[projectile]\nalloy = \"2017-T4\"\ndiameter = \"4 mm\"\nvelocity = \"6.5 "
      "km/s\"\n"
      "angle = \"30 degree\"\n[[shield.bumper]]\nalloy = \"6061-T6\"\nthickness = \"1 mm\"\nspacing = \"5 "
      "cm\"\n"
      "[[shield.bumper]]\nalloy = \"2024-T3\"\nthickness = \"0.5 mm\"\nspacing = \"4 cm\"\n[shield.wall]\n"
      "alloy = \"2219-T87\"\nthickness = \"3 mm\"\nyield = \"60 ksi\"\n";
  const Impact impact = read_impact(written(folder, "shield.toml", text));
  ASSERT_EQ(impact.shield.bumpers.size(), 2U);
  EXPECT_DOUBLE_EQ(impact.shield.bumpers[1].spacing, 0.04);
  EXPECT_DOUBLE_EQ(impact.shield.bumpers[1].sheet.density, 2770.0);
  EXPECT_NEAR(impact.shield.wall.yield, 60 * 6894757.293, 1.0);
  const std::string bad = fault_of([&] {
    static_cast<void>(
        read_impact(written(folder, "bad.toml", "[projectile]\nalloy = \"6061-T66\"\ndiameter = \"4\"\n")));
  });
  EXPECT_THAT(bad, HasSubstr("bad.toml:2"));
  EXPECT_THAT(bad, HasSubstr("unknown alloy"));
  EXPECT_THAT(bad, HasSubstr("velocity"));
  EXPECT_THAT(bad, HasSubstr("shield"));
}

TEST(Layout, CellsComeFromSphereSheetsAndCap) {
  Impact impact = ryan_impact();
  Layout layout = layout_of(impact, {});
  EXPECT_NEAR(layout.cell_size, 0.7874e-3 / 4.0, 1e-9);
  EXPECT_THAT(layout.chosen_by, HasSubstr("bumper"));
  impact.shield.bumpers[0].sheet.thickness = 2e-3;
  layout = layout_of(impact, {});
  EXPECT_NEAR(layout.cell_size, 3.175e-3 / 12.0, 1e-9);
  impact.shield.bumpers[0].sheet.thickness = 0.1e-3;
  layout = layout_of(impact, {});
  EXPECT_NEAR(layout.cell_size, 3.175e-3 / 32.0, 1e-9);
  EXPECT_THAT(layout.chosen_by, HasSubstr("cap of 32"));
  EXPECT_FALSE(layout.plates[0].resolved);
  EXPECT_TRUE(layout.plates[1].resolved);
  EXPECT_THAT(not_resolved(layout), HasSubstr("bumper (1.01 cells)"));
  layout = layout_of(impact, {.cell_size = 0.05e-3});
  EXPECT_TRUE(layout.plates[0].resolved);
  EXPECT_EQ(not_resolved(layout), "");
}

TEST(Layout, WhoseCountsAreNotFiniteIsRefused) {
  Impact impact = ryan_impact();
  impact.shield.bumpers[0].spacing = 1e200;
  EXPECT_THAT(fault_of([&] { static_cast<void>(layout_of(impact, {.model = Model::space})); }),
              HasSubstr("R31: sphere, sheets and cells differ too much in size"));
  EXPECT_THAT(fault_of([] { static_cast<void>(layout_of(ryan_impact(), {.cell_size = 1e-320})); }),
              HasSubstr("particles"));
}

TEST(Layout, WallCoversTheConeAndTheDomainTheWall) {
  for (const double angle : {0.0, 0.8}) {
    const Layout layout = layout_of(ryan_impact(angle), {.model = Model::space});
    const Plate& wall = layout.plates.back();
    EXPECT_NEAR(wall.front, 51.5874e-3, 1e-9);
    EXPECT_GE(wall.radius, 0.5 * wall.front);
    EXPECT_GE(wall.along[1], wall.front * std::tan(angle) + 0.5 * wall.front);
    EXPECT_GT(layout.upper[0], wall.along[1]);
    EXPECT_GT(layout.upper[1], wall.radius);
    EXPECT_GT(layout.upper[2], wall.front + wall.thickness);
    EXPECT_LT(layout.lower[2], -3.175e-3);
    if (angle > 0.0) {
      EXPECT_LT(layout.lower[0], wall.along[0]);
    } else {
      EXPECT_EQ(layout.lower[0], 0.0);
    }
  }
  EXPECT_THAT(fault_of([] { static_cast<void>(layout_of(ryan_impact(0.5), {})); }),
              HasSubstr("--model space"));
}

/// Reads the text as `whipple run` does.
cases::Case read_text_of_case(const std::string& text) {
  const TemporaryFolder folder;
  return cases::read_case(written(folder, "case.toml", text), {});
}

TEST(CaseText, IsAValidCaseOfEachModel) {
  const Impact normal = ryan_impact();
  const cases::Case section = read_text_of_case(case_text(normal, layout_of(normal, {})));
  ASSERT_EQ(section.bodies.size(), 3U);
  EXPECT_EQ(section.bodies[0].name, "sphere");
  EXPECT_EQ(section.bodies[2].name, "wall");
  ASSERT_EQ(section.stops.size(), 1U);
  EXPECT_EQ(section.stops[0].when, cases::StopWhen::decided);

  const cases::Case quarter =
      read_text_of_case(case_text(normal, layout_of(normal, {.model = Model::space})));
  EXPECT_NEAR(quarter.bodies[0].velocity.z(), 3100.0, 1e-6);
  EXPECT_EQ(quarter.bodies[0].velocity.x(), 0.0);

  const Impact oblique = ryan_impact(0.25 * std::numbers::pi);
  const cases::Case half = read_text_of_case(case_text(oblique, layout_of(oblique, {.model = Model::space})));
  EXPECT_NEAR(half.bodies[0].velocity.x(), 3100.0 * std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(half.bodies[0].velocity.z(), 3100.0 * std::sqrt(0.5), 1e-4);
}

Impact panel(double angle = 0.0) {
  const TemporaryFolder folder;
  Impact impact = read_shots(written(folder, "panels.csv",
                                     "shot,sphere,diameter [mm],angle [degree],velocity [km/s],bumper,bumper "
                                     "thickness [mm],spacing [mm],wall,wall thickness [mm],foam density "
                                     "[g/cm3],foam cell [mm],result\n"
                                     "F,2017-T4,1.2,0,6.9,6061-T6,0.254,12.7,6061-T6,0.254,0.189,2.087,NP\n"))
                      .front()
                      .impact;
  impact.projectile.angle = angle;
  return impact;
}

// The foam fills the spacing: as a porous material of its density, or as struts of its relative density.
TEST(CaseText, FoamOfPanelsIsALayerOrStruts) {
  const Impact normal = panel();
  EXPECT_DOUBLE_EQ(normal.shield.foam.density, 189.0);
  const cases::Case section = read_text_of_case(case_text(normal, layout_of(normal, {})));
  ASSERT_EQ(section.bodies.size(), 4U);
  EXPECT_EQ(section.bodies[3].name, "foam");
  EXPECT_THAT(section.bodies[3].material, HasSubstr("foam_6101"));
  EXPECT_NEAR(read_material(section.bodies[3].material).reference.density, 189.0, 1.0);

  for (const double angle : {0.0, 0.25 * std::numbers::pi}) {
    const Impact impact = panel(angle);
    const CaseOptions options{.model = Model::space, .foam = FoamModel::struts, .seed = 7};
    const Layout layout = layout_of(impact, options);
    const std::string text = case_text(impact, layout);
    EXPECT_THAT(text, HasSubstr("Foam of 6101-T6"));
    EXPECT_THAT(text, HasSubstr("seed = 7"));
    const cases::Case space = read_text_of_case(text);
    ASSERT_EQ(space.bodies.size(), 4U);
    const auto& struts = *space.bodies[3].shape;
    const auto bounds = struts.bounds();
    EXPECT_NEAR(bounds.lower.z(), 0.254e-3, 1e-12);
    EXPECT_NEAR(bounds.upper.z(), 12.954e-3, 1e-12);
    EXPECT_NEAR(struts.volume() / (bounds.upper - bounds.lower).prod(), 0.07, 1e-9);
    EXPECT_EQ(bounds.lower.x() < 0.0, angle > 0.0);
    EXPECT_GE(bounds.upper.x(), layout.plates[0].along[1]);
    Impact bare = impact;
    bare.shield.foam.density = 0.0;
    EXPECT_GT(layout.particles, 1.5 * layout_of(bare, options).particles);
  }
}

TEST(Layout, RefusesFoamThatNoCaseIsMadeOf) {
  const auto refused = [](const CaseOptions& options, const std::function<void(Impact&)>& change) {
    return fault_of([&] {
      Impact impact = panel();
      change(impact);
      static_cast<void>(layout_of(impact, options));
    });
  };
  const CaseOptions struts{.model = Model::space, .foam = FoamModel::struts};
  EXPECT_THAT(refused({.foam = FoamModel::struts}, [](Impact&) {}), HasSubstr("--model space"));
  EXPECT_THAT(refused(struts, [](Impact& i) { i.shield.foam.cell = 0.0; }), HasSubstr("shield.foam.cell"));
  EXPECT_THAT(refused(struts, [](Impact& i) { i.shield.foam.density = 2700.0; }), HasSubstr("denser"));
  EXPECT_THAT(refused({}, [](Impact& i) { i.shield.foam.density = 108.0; }), HasSubstr("--foam struts"));
  EXPECT_THAT(refused({}, [](Impact& i) { i.shield.bumpers.push_back(i.shield.bumpers[0]); }),
              HasSubstr("one bumper, the shield has 2"));
  EXPECT_THAT(refused({}, [](Impact& i) { i.shield.stuffing.areal_density = 1.0; }), HasSubstr("stuffing"));
}

TEST(CaseText, RefusesAlloysWithoutMaterial) {
  Impact impact = ryan_impact();
  impact.shield.wall.alloy = "3003-H12";
  const std::string fault = fault_of([&] { static_cast<void>(case_text(impact, layout_of(impact, {}))); });
  EXPECT_THAT(fault, HasSubstr("no material for the alloy \"3003-H12\""));
  EXPECT_THAT(fault, HasSubstr("2219-T87: aluminium_2219_t87_mie_gruneisen.toml"));
  impact.shield.wall.alloy = "2219-T851";
  const auto remarks = remarks_on_materials(impact, layout_of(impact, {}));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_THAT(remarks[0], HasSubstr("Wall of 2219-T851"));
}

// Each alloy that names a material names one of the library.
TEST(Alloys, HaveMaterialsOfTheLibrary) {
  Impact impact = ryan_impact();
  for (const Alloy& alloy : alloys()) {
    if (alloy.material.empty()) continue;
    impact.shield.wall.alloy = alloy.name;
    EXPECT_EQ(
        fault_of([&] { static_cast<void>(read_text_of_case(case_text(impact, layout_of(impact, {})))); }),
        "no fault")
        << alloy.name;
  }
}

/// A material is that of the alloy without a remark, or of the one that the remark of an exception names.
TEST(Alloys, ShareAMaterialWhereTheirYieldStressesAreClose) {
  std::size_t shared = 0;
  for (const Alloy& alloy : alloys()) {
    if (alloy.material.empty() || alloy.remark.empty()) continue;
    const auto own = std::ranges::find_if(alloys(), [&](const Alloy& other) {
      return other.material == alloy.material && other.remark.empty();
    });
    ASSERT_NE(own, alloys().end()) << alloy.name;
    const double difference = std::abs(alloy.yield - own->yield) / std::max(alloy.yield, own->yield);
    const bool exception = alloy.name == "99.9%" || alloy.name == "2024-T351" || alloy.name == "6101-T6";
    EXPECT_EQ(difference > 0.11, exception) << alloy.name << ": " << difference;
    EXPECT_EQ(alloy.remark.find("yield stress") != std::string_view::npos, exception) << alloy.name;
    shared += exception ? 0 : 1;
  }
  EXPECT_EQ(shared, 2U);
}

TEST(StudyText, NameOfAShieldStaysInItsComment) {
  Impact impact = ryan_impact();
  impact.name = "a\nb = 1";
  const std::string text = study_text(impact, layout_of(impact, {}), {3000.0}, {1e-3, 2e-3});
  EXPECT_THAT(text, HasSubstr("# \"a\\nb = 1: "));
  EXPECT_EQ(text.find("\nb = 1"), std::string::npos);
}

}  // namespace
}  // namespace whipple::shields
