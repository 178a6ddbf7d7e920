// SPDX-License-Identifier: BSD-3-Clause
// Loads, tables of time, lithostatic states and walls with friction: the keys of a case and one message per fault.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "src/case/build/patches.hpp"
#include "src/case/remarks.hpp"
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

const std::string with_wall = replaced(domain, "x_lower = \"symmetry\"", "x_lower = \"separating\"");
std::string load(const std::string& keys) { return with_wall + sphere + "[[load]]\n" + keys; }

TEST(CaseLoads, TablesAreLinearWithExactMeansAndNextEvents) {
  TimeTable table;
  EXPECT_EQ(table.at(-1.0), 1.0);
  EXPECT_EQ(table.mean(2.0, 3.0), 1.0);
  table.times = {1.0, 2.0, 4.0, 5.0};
  table.factors = {0.0, 2.0, 2.0, 0.0};
  EXPECT_EQ(table.at(0.0), 0.0);
  EXPECT_EQ(table.at(1.25), 0.5);
  EXPECT_EQ(table.at(9.0), 0.0);
  EXPECT_DOUBLE_EQ(table.mean(0.0, 10.0), (1.0 + 4.0 + 1.0) / 10.0);
  EXPECT_DOUBLE_EQ(table.mean(1.5, 1.0), 0.5 * 1.5 + 0.5 * 2.0);
  EXPECT_EQ(table.next_event(0.0), 1.0);
  EXPECT_EQ(table.next_event(3.0), 3.0);
  EXPECT_EQ(table.next_event(5.0), std::numeric_limits<double>::infinity());
  table.factors = {3.0, 0.0, 0.0, 1.0};
  EXPECT_EQ(table.next_event(0.0), 0.0);
  EXPECT_EQ(table.next_event(2.5), 4.0);
  EXPECT_EQ(table.next_event(7.0), 7.0);
}

TEST(CaseLoads, FaultsNameTheKeyAndWhatIsAccepted) {
  const std::string force = "force = [1, 0, 0]\n";
  EXPECT_EQ(error_of(load(force)), "");
  expect_error(load(force + "times = [0, 2e-6, 1e-6]\nfactors = [0, 1, 2]\n"),
               {"case.toml", "'times' are not in the order of time: entry 1 is 2e-06 s, entry 2 is 1e-06 s"});
  expect_error(load(force + "times = [0, 1e-6]\n"), {"2 'times' and 1 'factors'"});
  expect_error(load(force + "body = \"sfere\"\n"), {"there is no body \"sfere\" (accepted: sphere)"});
  expect_error(load(force + "acceleration = [0, 1, 0]\n"), {"a load is one of", "2 given"});
  expect_error(load("body = \"sphere\"\n"), {"a load is one of", "0 given"});
  expect_error(load("pressure = \"1 MPa\"\n"), {"a 'pressure' needs the 'face'"});
  expect_error(load(force + "face = \"x_lower\"\n"), {"'face' is that of a 'pressure'"});
  expect_error(load("damping = 1e3\nfactors = [-1]\n"), {"'factors' of a damping must not be negative"});
  expect_error(load(force + "box = { lower = [0, 0, 0.01], upper = [0.01, 0.01, 0.02] }\n"),
               {"the box of the load touches nothing"});
  expect_error(load(force + "box = { lower = [0, 0, 0.02], upper = [0.01, 0.01, 0.01] }\n"),
               {"the box has no extent along z"});
  expect_error(load("pressure = \"1 MPa\"\nface = \"z_upper\"\n"), {"the patch of the load touches nothing"});
  expect_error(load("pressure = \"1 MPa\"\nface = \"y_lower\"\n"),
               {"'y_lower' is of kind \"symmetry\", to which material is bonded"});
  const std::string away = "box = { lower = [0.0005, 0, -0.01], upper = [0.01, 0.01, 0.01] }\n";
  expect_error(load("pressure = \"1 MPa\"\nface = \"x_lower\"\n" + away),
               {"within a cell of its face, x = 0 m to 0.001 m", "found x = 0.0005 m to 0.01 m"});
  const std::string unreadable = error_of(load("pressure = \"1 Mfoo\"\nface = \"x_lower\"\n"));
  EXPECT_NE(unreadable.find("Mfoo"), std::string::npos) << unreadable;
  EXPECT_EQ(unreadable.find("'face' is that"), std::string::npos) << unreadable;
  EXPECT_EQ(error_of(load("pressure = \"1 MPa\"\nface = \"x_lower\"\n")), "");
}

// The nodes of elements and bars lie at their surface: a thin box there holds material.
TEST(CaseLoads, BoxesOnBarsAndElementsTouchThem) {
  const std::string bars =
      "[[body]]\nname = \"bars\"\nmaterial = \"copper.toml\"\ndiscretization = { method = \"bars\", "
      "bar_diameter = 1e-4 }\n[[body.bar]]\nfrom = [0.001, 0.001, 0.001]\nto = [0.005, 0.001, 0.001]\n";
  const std::string block =
      "[[body]]\nname = \"block\"\nmaterial = \"copper.toml\"\ndiscretization = { method = "
      "\"finite_elements\" }\nshape = { box = { lower = [0.001, 0.001, 0.001], upper = [0.005, 0.005, 0.005] "
      "} }\n";
  for (const std::string& body : {bars, block}) {
    const auto with_box = [&](const std::string& bounds) {
      return with_wall + body + "[[load]]\nforce = [1, 0, 0]\nbox = { " + bounds + " }\n";
    };
    const std::string at_end = "lower = [0.00099, 0, 0], upper = [0.00101, 0.01, 0.01]";
    EXPECT_EQ(error_of(with_box(at_end)).find("touches nothing"), std::string::npos)
        << error_of(with_box(at_end));
    expect_error(with_box("lower = [0.006, 0, 0], upper = [0.007, 0.01, 0.01]"), {"touches nothing"});
  }
}

TEST(CaseLoads, AreWrittenAndReadAgain) {
  const Case setup =
      read_case_text(load("pressure = \"1 MPa\"\nface = \"x_lower\"\ntimes = [0, 1e-6]\nfactors = [0, 1]\n"
                          "box = { lower = [0, 0, -0.01], upper = [0.01, 0.002, 0.01] }\n"),
                     "case.toml");
  const std::string text = to_toml(setup, {"copper.toml"});
  EXPECT_EQ(to_toml(read_case_text(text, "run.toml"), {"copper.toml"}), text);
  // The patch inside the domain, 2 mm times 20 mm; of it the part before the sphere, by whole particles
  const Patch patch = patch_of(setup, setup.loads.at(0));
  EXPECT_NEAR(patch.area, 2e-3 * 20e-3, 1e-15);
  const double disk = 2.0 * std::sqrt(5.0) + 9.0 * std::asin(2.0 / 3.0);  // mm^2
  EXPECT_NEAR(1e6 * patch.covered, disk, 0.05 * disk);
  EXPECT_NEAR(setup.loads.at(0).total_force(setup)[0], 1e6 * patch.covered, 1e-9);
}

TEST(CaseLoads, FacesFollowTheSection) {
  const std::string text =
      "[domain]\ndimension = \"axisymmetric\"\naxis = \"z\"\nlower = [0, 0, 0]\nupper = [0.01, 0.01, 0.02]\n"
      "cell_size = 0.001\n[time]\nend = 1e-6\n[[load]]\npressure = 1e6\nface = \"z_lower\"\n"
      "[[body]]\nname = \"disk\"\nmaterial = \"copper.toml\"\n"
      "shape = { cylinder = { center = [0, 0, 0.001], axis = \"z\", radius = 0.005, height = 0.002 } }\n";
  const Case setup = read_case_text(text, "case.toml");
  EXPECT_EQ(setup.loads.at(0).face, Face::x_lower);
  EXPECT_NEAR(setup.loads.at(0).total_force(setup)[0], 1e6 * M_PI * 25e-6, 1e-6);
}

TEST(CaseLoads, GravityHasOneOfRiseTimeAndTable) {
  const std::string gravity = "[gravity]\nacceleration = [0, 0, -9.81]\n";
  EXPECT_EQ(error_of(domain + gravity + "times = [0, 1]\nfactors = [0, 1]\n" + sphere), "");
  expect_error(domain + gravity + "times = [0, 1]\nfactors = [0, 1]\nrise_time = 1\n" + sphere, {"not both"});
  expect_error(domain + gravity + "factors = [2]\nrise_time = 1\n" + sphere, {"not both"});
  expect_error(domain + "[gravity]\ntimes = [0, 1]\nfactors = [0, 1]\n" + sphere,
               {"those of 'acceleration', which is missing or zero"});
  expect_error(domain + gravity + "times = [1, 0]\nfactors = [0, 1]\n" + sphere,
               {"not in the order of time"});
}

TEST(CaseLoads, LithostaticStatesThatCannotBeAreRefused) {
  const std::string gravity = "[gravity]\nacceleration = [0, 0, -9.81]\n";
  const auto with = [&](const std::string& keys) {
    return replaced(sphere, "velocity", "initial = { " + keys + " }\nvelocity");
  };
  const std::string at_rest = "lithostatic = { surface = \"0 mm\", k0 = ";
  EXPECT_EQ(error_of(domain + gravity + with(at_rest + "0.5 }")), "");
  expect_error(domain + gravity + with(at_rest + "1.3 }"),
               {"'k0' is 1.3", "weight alone", "expected 0 to 1"});
  expect_error(domain + gravity + with(at_rest + "-0.1 }"), {"'k0' is -0.1", "nothing pulls it"});
  expect_error(domain + with(at_rest + "0.5 }"), {"needs a gravity along x, y or z"});
  expect_error(domain + gravity + "rise_time = 1\n" + with(at_rest + "0.5 }"), {"without 'rise_time'"});
  expect_error(domain + gravity + with(at_rest + "0.5 }, pressure = \"1 Pa\""),
               {"the weight determines pressure"});
  expect_error(domain + gravity + with("lithostatic = { surface = \"-2 mm\", k0 = 0.5 }"),
               {"the body reaches 0.001 m above the 'surface'"});
  expect_error(domain + gravity + with("lithostatic = { surface = \"1e9 km\", k0 = 1 }"),
               {"case.toml:15", "cannot carry its weight below this 'surface'"});
  // Beyond the strength: copper a thousand kilometres below its surface
  expect_error(domain + gravity + with("lithostatic = { surface = \"1000 km\", k0 = 0 }"),
               {"it would flow at once"});
}

TEST(CaseLoads, RemarksNameLithostaticBodiesThatMove) {
  const std::string text = domain + "[gravity]\nacceleration = [0, 0, -9.81]\n" +
                           replaced(sphere, "velocity = [\"0 m/s\", \"0 m/s\", \"5.55 km/s\"]",
                                    "initial = { lithostatic = { surface = \"-1 mm\", k0 = 1 } }");
  const auto has = [](const std::vector<std::string>& found, const std::string& part) {
    return std::ranges::any_of(found,
                               [&](const std::string& text) { return text.find(part) != std::string::npos; });
  };
  EXPECT_TRUE(has(remarks(read_case_text(text, "case.toml")), "the upper surface of \"sphere\""));
  EXPECT_FALSE(has(remarks(read_case_text(text, "case.toml")), "a load from the start"));
  const Case loaded = read_case_text(text + "[[load]]\nacceleration = [0, 1, 0]\n", "case.toml");
  EXPECT_TRUE(has(remarks(loaded), "a load from the start"));
  const Case flat = read_case_text(
      replaced(text, "sphere = { center = [\"0 mm\", \"0 mm\", \"-4 mm\"], radius = \"3 mm\" }",
               "box = { lower = [0, 0, -0.005], upper = [0.004, 0.004, -0.001] }"),
      "case.toml");
  EXPECT_FALSE(has(remarks(flat), "the upper surface"));
}

TEST(CaseLoads, WallsWithFrictionNeedTheirCoefficient) {
  const std::string rough = replaced(domain, "y_lower = \"symmetry\"", "y_lower = \"friction\"");
  expect_error(rough + sphere, {"need the coefficient 'domain.friction'"});
  EXPECT_EQ(error_of(replaced(rough, "boundary", "friction = 0.3\nboundary") + sphere), "");
  expect_error(replaced(domain, "boundary", "friction = 0.3\nboundary") + sphere, {"there is none"});
  expect_error(
      replaced(replaced(rough, "boundary", "friction = 0.3\nboundary"), "end =", "scheme = \"usf\"\nend =") +
          sphere,
      {"a separating wall, with or without friction"});
}

}  // namespace
}  // namespace whipple::cases
