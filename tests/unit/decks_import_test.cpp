// SPDX-License-Identifier: BSD-3-Clause
// Decks of other codes: what is read, what a case makes of it, and which faults are named. The decks were written for
// these tests.
#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/decks/dyna_case.hpp"
#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"
#include "src/decks/lattice.hpp"
#include "src/decks/mpm3d_case.hpp"
#include "src/decks/mpm3d_deck.hpp"
#include "tests/folders.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::decks {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path folder_of_decks = fs::path(whipple::tests::source_folder()) / "tests" / "data" / "decks";

std::string deck_text(const std::string& name) { return read_text(folder_of_decks / name); }

/// The deck of the sphere with a text replaced.
std::string sphere_deck(const std::string& from, const std::string& to) {
  std::string text = deck_text("sphere_on_plate.mpm");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Import import_text(const std::string& text, const ImportOptions& options = {}) {
  return mpm3d::to_case(mpm3d::parse("deck.mpm", text), options);
}

std::string fault_of(const std::string& text, const ImportOptions& options = {}) {
  return message_of<InputError>([&] { static_cast<void>(import_text(text, options)); });
}

const ImportOptions in_si = {.units = UnitSystem{"m", "kg", "s"}};

TEST(UnitsOfDecks, MakeTheUnitsOfOtherQuantities) {
  const UnitSystem units = parse_unit_system("mm g N ms MPa").value();
  EXPECT_EQ(units.quantity(0.01135, dimension::density), "\"0.01135 g/mm^3\"");
  EXPECT_EQ(units.quantity(12.0, dimension::pressure), "\"12 MPa\"");
  EXPECT_EQ(units.quantity(6580.0, dimension::velocity), "\"6580 m/s\"");
  EXPECT_EQ(units.quantity(383.0, dimension::heat_capacity), "\"383 J/(kg K)\"");
  EXPECT_DOUBLE_EQ(units.in_si(0.01135, dimension::density), 11350.0);
  EXPECT_EQ(parse_unit_system("cm, g, us").value().unit(dimension::pressure), "Mbar");
  EXPECT_EQ(parse_unit_system("m Kg N s Pa").value().mass, "kg");
  EXPECT_FALSE(parse_unit_system("mm g"));
  EXPECT_THROW(static_cast<void>(parse_unit_system("mm g N ms GPa")), InputError);
}

TEST(Lattice, FindsTheBoxesOfItsPoints) {
  std::vector<Vector3> points;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 5; ++z) {
        if (x < 2 || y < 2) points.emplace_back(0.1 * x, 0.1 * y, 0.1 * z);  // a bar with a step
      }
    }
  }
  const auto boxes = boxes_of_points(points, 0.1, 10);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->size(), 2);
  double volume = 0.0;
  for (const LatticeBox& box : *boxes) volume += (box.upper - box.lower).prod();
  EXPECT_NEAR(volume, 1e-3 * static_cast<double>(points.size()), 1e-12);
  EXPECT_FALSE(boxes_of_points(points, 0.1, 1)) << "more boxes than allowed";
  EXPECT_FALSE(boxes_of_points(points, 0.07, 10)) << "another spacing";
  points.push_back(points.front());
  EXPECT_FALSE(boxes_of_points(points, 0.1, 10)) << "two points in a cell";
}

TEST(Mpm3dDeck, BecomesACaseWithUnits) {
  const Import import = import_text(deck_text("sphere_on_plate.mpm"));
  EXPECT_EQ(import.units, "mm g ms");
  EXPECT_EQ(import.count(Outcome::missing), 0U);
  EXPECT_THAT(import.case_text, HasSubstr("title = \"Sphere on plate\""));
  EXPECT_THAT(import.case_text, HasSubstr("cell_size = \"1 mm\""));
  EXPECT_THAT(import.case_text, HasSubstr("upper = [\"12 mm\", \"8 mm\", \"8 mm\"]")) << "16.2 cells are 16";
  EXPECT_THAT(import.case_text, HasSubstr("lower = [\"-4 mm\", \"-8 mm\", \"-8 mm\"]"));
  EXPECT_THAT(
      import.case_text,
      HasSubstr("shape = { sphere = { center = [\"-2 mm\", \"0 mm\", \"0 mm\"], radius = \"1.5 mm\" } }"));
  EXPECT_THAT(import.case_text, HasSubstr("shape = { box = { lower = [\"0 mm\", \"-4 mm\", \"-4 mm\"], upper "
                                          "= [\"2 mm\", \"4 mm\", \"4 mm\"] } }"));
  EXPECT_THAT(import.case_text, HasSubstr("velocity = [\"3000 m/s\", \"0 m/s\", \"0 m/s\"]"));
  EXPECT_THAT(import.case_text, HasSubstr("fields = [\"von_mises_stress\"]"));
  EXPECT_THAT(import.case_text, HasSubstr("[[gauge]]"));
  EXPECT_THAT(import.case_text, Not(HasSubstr("scheme")));
  ASSERT_EQ(import.files.size(), 2U);
  EXPECT_THAT(import.files[0].text, HasSubstr("hardening_modulus = \"125 MPa\""));
  EXPECT_THAT(import.files[0].text, HasSubstr("failure_strain = 3"));
  EXPECT_THAT(import.files[0].text, HasSubstr("heat_capacity = \"124 J/(kg K)\""))
      << "that of lead, by its density";
  EXPECT_THAT(import.files[1].text, HasSubstr("melting_temperature = \"1356 K\""));
  EXPECT_THAT(import.files[1].text, HasSubstr("heat_capacity = \"383 J/(kg K)\""));
  ASSERT_EQ(import.bodies.size(), 2U);
  EXPECT_EQ(import.bodies[0].particles, 136) << "centres within three spacings";
  EXPECT_EQ(import.bodies[1].particles, 1024);
  EXPECT_NEAR(import.bodies[1].mass, 2e-3 * 8e-3 * 8e-3 * 8930.0, 1e-12);
}

TEST(Mpm3dDeck, EveryStatementHasItsRemark) {
  for (const char* name : {"sphere_on_plate.mpm", "columns_of_water.mpm", "missing.mpm"}) {
    const mpm3d::Deck deck = mpm3d::parse(name, deck_text(name));
    const Import import = mpm3d::to_case(deck, in_si);
    for (const mpm3d::Statement& statement : deck.statements) {
      // given forces of one kind, and gravity, have one remark together
      const bool remarked = std::ranges::any_of(
          import.remarks, [&](const Remark& remark) { return remark.keyword == statement.name(); });
      EXPECT_TRUE(remarked) << name << ":" << statement.line << ": " << statement.name();
    }
    for (const Word<Outcome>& word : words(Outcome{}))
      EXPECT_THAT(import.report(), HasSubstr("\n" + std::string(word.text) + " ("));
  }
}

TEST(Mpm3dDeck, ShapesAndLawsOfEveryKind) {
  const Import import = import_text(deck_text("columns_of_water.mpm"), in_si);
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(
      import.case_text,
      HasSubstr("boundary = { x_lower = \"no_slip\", y_lower = \"symmetry\", z_lower = \"symmetry\" }"));
  EXPECT_THAT(import.case_text,
              HasSubstr("box = { lower = [\"0 m\", \"0 m\", \"0 m\"], upper = [\"1 m\", \"1 m\", \"1 m\"] }"))
      << "of eight points";
  EXPECT_THAT(import.case_text, HasSubstr("difference"));
  EXPECT_THAT(import.case_text, HasSubstr("cylinder = { center = [\"7.5 m\", \"7.5 m\", \"0.5 m\"], axis = "
                                          "\"z\", radius = \"2 m\", height = \"1 m\" }"));
  EXPECT_THAT(import.case_text, HasSubstr("acceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]"));
  EXPECT_THAT(import.case_text, HasSubstr("method = \"multi_field\""));
  EXPECT_THAT(import.case_text, HasSubstr("contact_group = \"component_2\""));
  EXPECT_THAT(import.case_text, HasSubstr("per_cell = 1"));
  EXPECT_THAT(import.files[0].text, HasSubstr("viscosity = \"0.001 Pa s\""));
  EXPECT_THAT(import.files[0].text, HasSubstr("C1 = \"2500000 Pa\""));
  EXPECT_THAT(import.files[3].text, HasSubstr("hardening_modulus = \"111111111.111 Pa\""));
  EXPECT_THAT(import.files[4].text, HasSubstr("reference_temperature = \"1e8 K\""));
}

TEST(Mpm3dDeck, MissingPhysicsIsNamed) {
  const Import import = import_text(deck_text("missing.mpm"));
  std::string missing;
  for (const Remark& remark : import.remarks) {
    if (remark.outcome == Outcome::missing) missing += fmt::format("{}: {}\n", remark.keyword, remark.text);
  }
  EXPECT_THAT(missing, HasSubstr("dynamic relaxation"));
  EXPECT_THAT(import.case_text, HasSubstr("[[detonation]]"));
}

TEST(Mpm3dDeck, TheSameMethodIsKeptOnRequest) {
  ImportOptions options = in_si;
  options.same_method = true;
  const Import import = import_text(deck_text("columns_of_water.mpm"), options);
  EXPECT_THAT(import.case_text, HasSubstr("scheme = \"musl\""));
  EXPECT_THAT(import.case_text, HasSubstr("shape_function = \"gimp\""));
}

TEST(Mpm3dDeck, MassesOfTheOldFormatAreNotTakenInSilence) {
  const std::string old = sphere_deck("1 1 11.35e-3 0.5", "1 1 1.419e-3 0.5");
  const Import as_read = import_text(old);
  EXPECT_EQ(as_read.count(Outcome::missing), 1U);
  EXPECT_THAT(as_read.report(), HasSubstr("--old-mass"));
  const Import converted = import_text(old, {.old_mass = true});
  EXPECT_EQ(converted.count(Outcome::missing), 0U);
  EXPECT_NEAR(converted.bodies[0].mass, 136 * 1.419e-6, 1e-12);
}

TEST(Mpm3dDeck, GrowsTheDomainAroundItsBodies) {
  const Import import = import_text(sphere_deck("0 -4 -4   4 16 16", "0 -9.5 -4   4 38 16"));
  EXPECT_THAT(import.case_text, HasSubstr("lower = [\"-4 mm\", \"-10 mm\", \"-8 mm\"]"));
  EXPECT_THAT(import.case_text, HasSubstr("upper = [\"12 mm\", \"10 mm\", \"8 mm\"]"));
  EXPECT_THAT(import.report(), HasSubstr("4 cells more"));
}

TEST(Mpm3dDeck, FaultsAreNamedWithTheirPlace) {
  EXPECT_THAT(fault_of(sphere_deck("bulk 1.5", "bulg 1.5")),
              HasSubstr("deck.mpm:24:1: error: unknown keyword 'bulg', did you mean \"bulk\"?"));
  EXPECT_THAT(fault_of(sphere_deck("bulk 1.5 0.06", "bulk 1.5")),
              HasSubstr("deck.mpm:25:1: error: 'dtscale' where number 2 of 2 after 'bulk'"));
  EXPECT_THAT(fault_of(sphere_deck("bulk 1.5 0.06", "bulk 1.5 0.06 7")),
              HasSubstr("deck.mpm:24:15: error: '7' where a keyword is expected: too many"));
  EXPECT_THAT(fault_of(sphere_deck("bulk 1.5 0.06", "bulk 1.5 .06")), HasSubstr("no number that begins so"));
  EXPECT_THAT(fault_of(sphere_deck("  1 sjcf", "  1 steel")),
              HasSubstr("'steel' where the model of a material is expected: elas, pla1"));
  EXPECT_THAT(fault_of(sphere_deck("endinput2013\nthis is not read\n", "")),
              HasSubstr("a deck ends with 'endi'"));
  EXPECT_THAT(fault_of(sphere_deck("body 1 3000", "body 7 3000")), HasSubstr("there is no body 7"));
  EXPECT_THAT(fault_of(sphere_deck("  2 8.93e-3 0.5 ", "  4 8.93e-3 0.5 ")),
              HasSubstr("material 4 is not among those of 'mate'"));
  EXPECT_THAT(fault_of(sphere_deck("nbmp 3000", "nbmp 30")),
              HasSubstr("nbmp is 30, the bodies have 1160 particles"));
  EXPECT_THAT(fault_of(sphere_deck("! Unit: mm g N ms MPa", "!")), HasSubstr("--units 'mm g ms'"));
  EXPECT_THAT(fault_of(sphere_deck("N ms MPa", "N ms GPa")), HasSubstr("make MPa, not GPa"));
  const std::string two = fault_of(sphere_deck("bulk 1.5 0.06\ndtscale", "bulk a b\nfoo 1\ndtscale"));
  EXPECT_THAT(two, HasSubstr("deck.mpm:24:6: error: 'a'"));
}

TEST(Mpm3dDeck, SeveralFaultsComeTogether) {
  std::string text = sphere_deck("bulk 1.5 0.06", "bulk a b");
  text.replace(text.find("nbco 1"), 6, "nbco x");
  EXPECT_THAT(fault_of(text), ::testing::AllOf(HasSubstr("deck.mpm:5:6"), HasSubstr("deck.mpm:24:6")));
}

class ImportFolder : public FolderTest {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string refusal(const std::string& text) const {
    return message_of<InputError>([&] { static_cast<void>(import_deck(write("deck.mpm", text), {})); });
  }
};

TEST_F(ImportFolder, ANeoHookeanSolidIsAConstitutiveModel) {
  std::string text = deck_text("missing.mpm");
  text.erase(text.find(" 2 dpm"), text.find(" 3 neoh") - text.find(" 2 dpm"));  // what has no law here
  text.replace(text.find("nmat 3"), 6, "nmat 2");
  text.replace(text.find(" 3 neoh"), 7, " 2 neoh");
  text.replace(text.find("block 1 3 1000"), 14, "block 1 2 1000");
  text.erase(text.find("particle block 1 2 1700"),
             text.find("particle block 1 2 1000") - text.find("particle block 1 2 1700"));
  text.erase(text.find("drda\n"), 5);
  text.erase(text.find("nbmp 100\n"), 9);
  const Import import = import_text(text);
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const CaseFolder written(import, folder_ / "case");
  const cases::Case setup = cases::read_case(written.case_file(), {});
  EXPECT_EQ(setup.materials.back()->constitutive->model(), "neo_hookean");
  EXPECT_THAT(import.files.back().text, HasSubstr("shear_modulus = \"38461.5384615"));
}

TEST_F(ImportFolder, DecksOfOtherCodesAreRecognised) {
  EXPECT_THAT(refusal("# two disks\nE=1e3\nregion(box, block, 0, 1)\n"), HasSubstr("Karamelo"));
  EXPECT_THAT(refusal("dimension(2, -1, 1)\nregion(box, block, 0, 1)\n"), HasSubstr("Karamelo"));
  EXPECT_THAT(refusal("<OpenMPM3D>\n</OpenMPM3D>\n"), HasSubstr("XML"));
  EXPECT_THAT(refusal("*HEADING\nx\n*NODE, NSET=all\n"), HasSubstr("keyword deck"));
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("#RADIOSS STARTER\n/BEGIN\n"), HasSubstr("OpenRadioss"));
  EXPECT_THAT(refusal(std::string("\xFF\xFE*\0K\0", 6)), HasSubstr("UTF-16"));
  EXPECT_THAT(refusal("hello world"), HasSubstr("of no code that is known"));
}

TEST_F(ImportFolder, TheFolderAppearsWholeAndReadsAsACase) {
  const Import import = import_deck(folder_of_decks / "sphere_on_plate.mpm", {});
  const fs::path target = folder_ / "new" / "case";
  {
    const CaseFolder given_up(import, target);
    EXPECT_FALSE(fs::exists(target));
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "new")) << "what is given up leaves nothing";
  {
    CaseFolder written(import, target);
    const cases::Case setup = cases::read_case(written.case_file(), {});
    EXPECT_EQ(setup.bodies.size(), 2U);
    EXPECT_DOUBLE_EQ(setup.domain.cell_size, 1e-3);
    EXPECT_DOUBLE_EQ(setup.time.end, 2e-6);
    EXPECT_DOUBLE_EQ(setup.bodies[0].velocity[0], 3000.0);
    written.publish();
  }
  EXPECT_TRUE(fs::exists(target / "import.txt"));
  EXPECT_TRUE(fs::exists(target / "materials" / "material_2.toml"));
  EXPECT_THAT(message_of<InputError>([&] { const CaseFolder again(import, target); }),
              HasSubstr("nothing is overwritten"));
  EXPECT_THROW(write_case_only(import, target), InputError);
  fs::remove(target / "case.toml");
  write_case_only(import, target);
  EXPECT_TRUE(fs::exists(target / "case.toml"));
  EXPECT_THROW(write_case_only(import, folder_), InputError) << "no materials there";
}

TEST_F(ImportFolder, ADeckOfEveryShapeReadsAsACase) {
  const Import import = import_deck(folder_of_decks / "columns_of_water.mpm", in_si);
  const CaseFolder written(import, folder_ / "case");
  EXPECT_EQ(cases::read_case(written.case_file(), {}).bodies.size(), 4U);
}

const ImportOptions in_gpa = {.units = UnitSystem{"mm", "kg", "ms"}, .cell_size = 0.5e-3};

std::string bar_deck(const std::string& from = "", const std::string& to = "") {
  std::string text = deck_text("bar_on_plate.k");
  return from.empty() ? text : text.replace(text.find(from), from.size(), to);
}
Import import_keywords(const std::string& text, const ImportOptions& options = in_gpa) {
  return dyna::to_case(dyna::parse("deck.k", text), options);
}

TEST(DynaDeck, BecomesACaseWithMeshesAndBoxes) {
  const Import import = import_keywords(bar_deck());
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(import.case_text, HasSubstr("title = \"Bar on plate\""));
  EXPECT_THAT(import.case_text, HasSubstr("end = \"0.002 ms\""));
  EXPECT_THAT(import.case_text, HasSubstr("velocity = [\"0 m/s\", \"0 m/s\", \"-200 m/s\"]"))
      << "of a parameter";
  EXPECT_THAT(import.case_text, HasSubstr("friction = 0.2"));
  EXPECT_THAT(import.case_text,
              HasSubstr("method = \"adaptive\", mesh = \"meshes/bar.msh\", mesh_unit = \"1 mm\""));
  EXPECT_THAT(
      import.case_text,
      HasSubstr(
          "box = { lower = [\"-2 mm\", \"-2 mm\", \"-1 mm\"], upper = [\"2 mm\", \"2 mm\", \"0 mm\"] }"));
  ASSERT_EQ(import.files.size(), 3U);
  const std::string& copper = import.files[0].text;
  EXPECT_THAT(copper, HasSubstr("reference_rate = \"0.001 1/ms\""))
      << "of a field that touches its neighbour";
  EXPECT_THAT(copper, HasSubstr("spall_strength = \"3 GPa\"")) << "of a typographic minus";
  EXPECT_THAT(copper, HasSubstr("reference_density = \"8.96e-06 kg/mm^3\""))
      << "of an exponent without its letter";
  EXPECT_THAT(copper, HasSubstr("gruneisen_slope = 0.47"));
  EXPECT_THAT(copper, HasSubstr("d5 = 1.12"));
  ASSERT_EQ(import.bodies.size(), 2U);
  EXPECT_NEAR(import.bodies[0].mass, 2 * 8.96e-6, 1e-12);
  EXPECT_NEAR(import.bodies[1].mass, 16 * 7.85e-6, 1e-12);
}

TEST(DynaDeck, WhatIsNotReadIsMissingByNameAndNumber) {
  const Import import =
      import_keywords(bar_deck("*CONTROL_ENERGY\n", "*RIGIDWALL_PLANAR\n         0\n*RIGIDWALL_PLANAR\n"));
  EXPECT_THAT(import.report(), HasSubstr("*RIGIDWALL_PLANAR  not read, 2 times"));
  EXPECT_EQ(import.count(Outcome::missing), 1U);
  const Import foam = import_keywords(bar_deck("*MAT_PLASTIC_KINEMATIC", "*MAT_LOW_DENSITY_FOAM"));
  EXPECT_THAT(foam.report(), HasSubstr("plate: this material law"));
}

/// What a card says beyond what is read is not left out in silence.
TEST(DynaDeck, OptionsThatChangeTheMeaningOfCardsAreMissing) {
  const auto report = [](const std::string& from, const std::string& to) {
    return import_keywords(bar_deck(from, to)).report();
  };
  const std::string start =
      "*INITIAL_VELOCITY_GENERATION\n         7         1       0.0       0.0       0.0    &speed\n";
  EXPECT_THAT(report(start, "*INITIAL_VELOCITY\n0, 0, 3\n0.0, 0.0, -200.0\n"),
              HasSubstr("BOXID = 3: nodes of a box"));
  EXPECT_THAT(report(start, "*INITIAL_VELOCITY\n0, 9, 0\n0.0, 0.0, -200.0\n"),
              HasSubstr("NSIDEX = 9: nodes that are exempt"));
  EXPECT_THAT(report(start, "*INITIAL_VELOCITY\n0\n0.0, 0.0, -200.0, 0.0, 5.0\n"),
              HasSubstr("angular velocity"));
  EXPECT_THAT(report(start, "*INITIAL_VELOCITY\n0\n0.0, 0.0, -200.0\n"), HasSubstr("missing (0)"));
  EXPECT_THAT(report("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n",
                     "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MPP\n0, 200\n"),
              HasSubstr("missing (0)"));
  EXPECT_THAT(report("*CONTACT_", "*SET_NODE_ADD\n9\n1, 2\n*CONTACT_"),
              HasSubstr("*SET_NODE_ADD  not read, 1 time"))
      << "its members are sets";
  EXPECT_THAT(
      report("*MAT_PLASTIC_KINEMATIC\n2, 7.85e-6, 210.0, 0.3, 0.4, 1.0, 1.0\n",
             "*MAT_SIMPLIFIED_JOHNSON_COOK\n2, 7.85e-6, 210.0, 0.3\n0.4, 0.5, 0.3, 0.01, 0, 0, 0.9, 1e-3\n"),
      HasSubstr("SIGSAT = 0.9: greatest stress"));
}

TEST_F(ImportFolder, AnExplosiveOfAKeywordDeckIsLit) {
  const auto deck = [](const std::string& detonation) {
    std::string text = bar_deck("*MAT_PLASTIC_KINEMATIC\n2, 7.85e-6, 210.0, 0.3, 0.4, 1.0, 1.0\n",
                                "*MAT_HIGH_EXPLOSIVE_BURN\n2, 1.63e-6, 6930.0, 21.0\n"
                                "*EOS_JWL\n2, 371.2, 3.231, 4.15, 0.95, 0.3, 7.0\n" +
                                    detonation);
    const std::string part = "plate\n         2         2         2\n";
    text.replace(text.find(part), part.size(), "plate\n         2         2         2         2\n");
    for (std::size_t at = 0; (at = text.find("7.850000e-06", at)) != std::string::npos;)
      text.replace(at, 12, "1.630000e-06");
    return text;
  };
  const Import lit = import_keywords(deck("*INITIAL_DETONATION\n2, 0.0, 0.0, -0.5, 0.001\n"));
  EXPECT_EQ(lit.count(Outcome::missing), 0U) << lit.report();
  EXPECT_THAT(lit.case_text, HasSubstr("[[detonation]]"));
  EXPECT_THAT(lit.case_text, HasSubstr("delay = \"0.001 ms\""));
  const CaseFolder written(lit, folder_ / "case");
  const cases::Case read = cases::read_case(written.case_file(), {});
  EXPECT_TRUE(read.materials.at(1)->burns());
  const Import unlit = import_keywords(deck(""));
  EXPECT_THAT(unlit.report(), HasSubstr("is lit by nothing"));
  EXPECT_THAT(unlit.case_text, HasSubstr("detonation = \"instantaneous\""));
}

TEST(DynaDeck, FaultsAreNamedWithTheirPlace) {
  const auto fault = [](const std::string& from, const std::string& to) {
    return message_of<InputError>([&] { static_cast<void>(import_keywords(bar_deck(from, to))); });
  };
  EXPECT_THAT(fault("      1.09    1356.0", "      1.09    13x6.0"),
              HasSubstr("'13x6.0' in field 6 is no number"));
  EXPECT_THAT(fault("&speed", "&spead"), HasSubstr("is no parameter"));
  EXPECT_THAT(fault("         1    3940.0", "         1\t3940.0"), HasSubstr("a tab in a card"))
      << "columns are lost";
  EXPECT_THAT(fault("         2         2         2\n", "         2         2         5\n"),
              HasSubstr("there is no *MAT 5"));
  EXPECT_THAT(fault("         7         1       0.0", "         8         1       0.0"),
              HasSubstr("there is no set 8"));
  EXPECT_THAT(fault("      12            -0.5", "      13            -0.5"),
              HasSubstr("there is no node 12"));
  EXPECT_THAT(fault("         1   8.960-6", "         1          "),
              HasSubstr("field 2, the density, is blank"));
  EXPECT_THAT(fault("*CONTROL_TERMINATION\n     0.002\n", ""), HasSubstr("no *CONTROL_TERMINATION"));
  EXPECT_THAT(message_of<InputError>([&] { static_cast<void>(import_keywords(bar_deck(), {})); }),
              ::testing::AllOf(HasSubstr("--units"), HasSubstr("--cell-size")));
}

TEST_F(ImportFolder, AKeywordDeckReadsAsACase) {
  const Import import = import_deck(folder_of_decks / "bar_on_plate.k", in_gpa);
  const CaseFolder written(import, folder_ / "case");
  EXPECT_EQ(cases::read_case(written.case_file(), {}).bodies.size(), 2U);
  EXPECT_THAT(refusal("*HEADING\nx\n*NODE, NSET=all\n"), HasSubstr("Abaqus"));
}

/// Line breaks of Windows, a mark of UTF-8 at the beginning, tabs between the words of MPM3D-F90 and behind
/// cards.
TEST_F(ImportFolder, HabitsOfOtherEditorsChangeNothing) {
  const auto imported = [&](std::string text, const ImportOptions& options, bool tabs) {
    const auto replace = [&](const std::string& from, const std::string& to) {
      for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
      }
    };
    if (tabs) replace(" ", "\t");
    replace("\n", tabs ? "\t\r\n" : " \t\r\n");
    std::ofstream(folder_ / "deck", std::ios::binary) << "\xEF\xBB\xBF" << text;
    return import_deck(folder_ / "deck", options).case_text;
  };
  const auto below_title = [](const std::string& text) { return text.substr(text.find("[domain]")); };
  const std::string columns = deck_text("columns_of_water.mpm"), bar = deck_text("bar_on_plate.k");
  EXPECT_EQ(below_title(imported(columns, in_si, true)),
            below_title(import_deck(folder_of_decks / "columns_of_water.mpm", in_si).case_text));
  EXPECT_EQ(below_title(imported(bar, in_gpa, false)),
            below_title(import_deck(folder_of_decks / "bar_on_plate.k", in_gpa).case_text));
}

/// Decks with bytes changed, words exchanged and parts cut out: read or refused, nothing else.
TEST(Decks, DamagedOnesAreReadOrRefused) {
  const char* wanted = std::getenv("WHIPPLE_FUZZ_TRIALS");
  const int trials = wanted != nullptr ? std::atoi(wanted) : 300;
  const std::vector<std::string> odd = {"-1",
                                        "1e300",
                                        "-1e300",
                                        "0",
                                        "999999999",
                                        "endi",
                                        "part",
                                        "poin",
                                        "nan",
                                        "!",
                                        "\n",
                                        "\0",
                                        "sphere",
                                        "1e-300",
                                        "*NODE",
                                        "*INCLUDE",
                                        "&speed",
                                        "1-3",
                                        ",",
                                        "*SET_PART_LIST_GENERATE",
                                        "*BOUNDARY_SPC_SET",
                                        "*PARAMETER_EXPRESSION",
                                        "*SET_NODE_GENERAL"};
  for (int trial = 0; trial < trials; ++trial) {
    std::mt19937_64 random(static_cast<std::uint64_t>(trial));
    const std::size_t which = random() % 4;
    std::string text = deck_text(
        std::array{"sphere_on_plate.mpm", "columns_of_water.mpm", "missing.mpm", "bar_on_plate.k"}[which]);
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, random() % 40);
          break;
        case 2: {
          const std::size_t begin = text.find_last_of(" \n", at), end = text.find_first_of(" \n", at);
          if (begin == std::string::npos || end == std::string::npos) break;
          text.replace(begin + 1, end > begin ? end - begin - 1 : 0, odd[random() % odd.size()]);
          break;
        }
        default:
          text.insert(at, text.substr(random() % text.size(), 30U));
      }
      if (text.empty()) text = " ";
    }
    try {
      static_cast<void>(which == 3 ? import_keywords(text) : import_text(text, in_si));
    } catch (const InputError&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace whipple::decks
