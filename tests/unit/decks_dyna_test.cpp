// SPDX-License-Identifier: BSD-3-Clause
// Decks of LS-DYNA as other people write them: every field is read, has no effect, or is named (tests/data/decks/faults).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/decks/dyna_case.hpp"
#include "src/decks/dyna_constraints.hpp"
#include "src/decks/dyna_deck.hpp"
#include "src/decks/dyna_parameters.hpp"
#include "src/decks/import.hpp"
#include "tests/folders.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::decks {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path folder_of_faults =
    fs::path(whipple::tests::source_folder()) / "tests" / "data" / "decks" / "faults";
const ImportOptions in_mpa = {.units = UnitSystem{"mm", "g", "ms"}, .cell_size = 0.5e-3};

std::string text_of(const std::string& name) { return read_text(folder_of_faults / name); }
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}
Import import_cards(const std::string& text, const ImportOptions& options = in_mpa) {
  return dyna::to_case(dyna::parse("deck.k", text), options);
}
Import import_file(const std::string& name, const ImportOptions& options = in_mpa) {
  return import_cards(text_of(name), options);
}
/// The base deck with a keyword before its nodes.
Import with_keyword(const std::string& keyword) {
  return import_cards(replaced(text_of("base.k"), "*NODE\n", keyword + "*NODE\n"));
}
std::string missing_of(const Import& import) {
  const std::string report = import.report();
  return report.substr(report.find("\nmissing ("));
}
/// The case below its comments, which name the lines of the deck.
std::string without_comments(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += line.substr(0, line.find('#')) + "\n";
  return result;
}

class DynaImport : public FolderTest {
 protected:
  cases::Case read(const Import& import) {
    const CaseFolder written(import, folder_ / "case");
    return cases::read_case(written.case_file(), {});
  }
};

TEST_F(DynaImport, BaseDeckIsWhole) {
  const Import import = import_file("base.k");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(import.case_text, AllOf(HasSubstr("name = \"flyer\""), HasSubstr("name = \"target\""),
                                      HasSubstr("end = \"0.0005 ms\""), HasSubstr("multi_field")));
  EXPECT_EQ(read(import).bodies.size(), 2U);
}

TEST_F(DynaImport, HeldPlaneOfAllPartsIsASymmetryOfTheDomain) {
  const Import import = import_file("node_constraints_tc.k");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(import.case_text, Not(HasSubstr("node_condition")));
  EXPECT_THAT(import.report(), HasSubstr("held nodes: plane of symmetry y = 0"));
  const cases::Case setup = read(import);
  EXPECT_EQ(setup.geometry.boundary[2], grid::Boundary::symmetry);
  EXPECT_EQ(setup.geometry.lower[1], 0.0);
  EXPECT_EQ(setup.geometry.boundary[0], grid::Boundary::outflow);
}

/// Nodes of one cube along z at its lower face, of the other along all axes at one edge.
TEST_F(DynaImport, OtherHeldNodesAreNodeConditions) {
  const Import import = with_keyword(
      "*SET_NODE_LIST\n5\n1, 2, 3, 4, 5, 6, 7, 8\n9\n*BOUNDARY_SPC_SET\n5, 0, 0, 0, 1, 1, 1, 1\n"
      "*BOUNDARY_SPC_NODE_ID\n1 the first\n48, 0, 1, 1, 1\n2 the second\n51, 0, 1, 1, 1\n");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const cases::Case setup = read(import);
  const cases::Seeding seeding = cases::seed(setup);
  ASSERT_EQ(seeding.meshes.size(), 2U);
  const auto held = [](const fem::Mesh& mesh) {
    std::size_t count = 0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) count += mesh.nodes.constrained[a] != 0 ? 1U : 0U;
    return count;
  };
  EXPECT_EQ(held(seeding.meshes[0]), 9U);
  EXPECT_EQ(held(seeding.meshes[1]), 2U);
  ASSERT_EQ(setup.bodies[0].node_conditions.size(), 1U);
  EXPECT_THAT(setup.bodies[0].node_conditions[0].directions, ::testing::ElementsAre("z"));
  EXPECT_EQ(setup.bodies[1].node_conditions[0].directions.size(), 3U);
  // The same nodes by boxes and parts, and what chooses them otherwise.
  const std::string general =
      "*DEFINE_BOX\n3, -9, 9, -9, 9, 0.9, 9\n*SET_NODE_GENERAL\n6\nBOX, 3\n*BOUNDARY_SPC_SET\n6, 0, 0, 0, "
      "1\n";
  EXPECT_THAT(with_keyword(general).report(), HasSubstr("held nodes: plane of symmetry z = 1"));
  EXPECT_THAT(with_keyword("*SET_NODE_GENERAL\n6\nPART, 1\n").report(), HasSubstr("27 members"));
  EXPECT_THAT(missing_of(with_keyword("*SET_NODE_GENERAL\n6\nSET_XYZ, 1\n")),
              HasSubstr("chosen by something else"));
  EXPECT_THAT(missing_of(with_keyword("*BOUNDARY_SPC_NODE\n1, 7, 1, 1, 1\n")),
              HasSubstr("CID = 7: a local coordinate system"));
}

TEST(HeldNodes, OfARimAreBoxesWithoutTheInside) {
  dyna::HeldPart plate;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      plate.nodes.emplace_back(i, j, 0.0);
      const bool rim = i == 0 || j == 0 || i == 10 || j == 10;
      plate.held.push_back(rim ? dyna::Directions{7} : dyna::Directions{0});
    }
  }
  plate.shortest_edge = 1.0;
  const auto boxes = dyna::boxes_of_held_nodes(plate, 10);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->size(), 4U) << "the same for every axis";
  for (std::size_t i = 0; i < plate.nodes.size(); ++i) {
    const bool inside = std::ranges::any_of(*boxes, [&](const dyna::NodeBox& box) {
      return (plate.nodes[i].array() >= box.lower.array()).all() &&
             (plate.nodes[i].array() <= box.upper.array()).all();
    });
    EXPECT_EQ(inside, plate.held[i] != 0) << i;
  }
  EXPECT_FALSE(dyna::boxes_of_held_nodes(plate, 3)) << "too many";
  plate.nodes[60] = plate.nodes[0];
  EXPECT_FALSE(dyna::boxes_of_held_nodes(plate, 10)) << "a free node where one is held";
}

TEST(HeldNodes, AClampedFaceIsNoSymmetry) {
  dyna::HeldPart cube;
  cube.upper = Vector3::Ones();
  cube.shortest_edge = 1.0;
  for (int i = 0; i < 8; ++i) {
    cube.nodes.emplace_back(i % 2, i / 2 % 2, i / 4);
    const int symmetric = (i % 2 == 0 ? 1 : 0) + (i / 2 % 2 == 0 ? 2 : 0);  // x = 0 and y = 0
    cube.held.push_back(static_cast<dyna::Directions>(symmetric | (i / 4 == 1 ? 7 : 0)));
  }
  std::vector<dyna::HeldPart> parts = {cube};
  const std::vector<dyna::Mirror> planes = dyna::take_mirrors(parts, 0.5);
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_EQ(planes[0].axis, 0);
  EXPECT_EQ(planes[1].axis, 1);
  EXPECT_EQ(parts[0].held[0], 0);
  EXPECT_EQ(parts[0].held[7], 7) << "the clamped face is held by its nodes";
}

TEST(DynaContact, ThatTiesIsMissing) {
  const Import tied = import_file("contact_tied.k");
  EXPECT_THAT(missing_of(tied), HasSubstr("surfaces that are tied"));
  EXPECT_THAT(tied.case_text, Not(HasSubstr("multi_field")));
  const auto report = [](const std::string& type, const std::string& cards = "1, 2\n0.1, 0.1\n") {
    return import_cards(
               replaced(text_of("base.k"),
                        "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n         1         2         0         "
                        "0\n       0.1       0.1\n",
                        "*CONTACT_" + type + "\n" + cards))
        .report();
  };
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK"), HasSubstr("surfaces that are tied"));
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACES"), HasSubstr("this contact is not read"));
  EXPECT_THAT(report("FORCE_TRANSDUCER_PENALTY"), HasSubstr("missing (0)"));
  EXPECT_THAT(report("ERODING_SURFACE_TO_SURFACE_ID", "3 contact, of two cubes\n1, 2\n0.1, 0.1\n"),
              HasSubstr("missing (0)"));
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACE_ID_MPP", "3 contact\n0, 200\n& 1\n1, 2\n0.1, 0.1\n"),
              HasSubstr("missing (0)"));
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACE", "1, 2, 3, 3, 7\n0.1\n"),
              HasSubstr("SBOXID = 7: contact within a box"));
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACE", "1, 2\n0.3, 0.1, 5.0\n"),
              HasSubstr("friction that goes from FS = 0.3 to FD = 0.1"));
  EXPECT_THAT(report("AUTOMATIC_SURFACE_TO_SURFACE", "1, 2\n0.1, 0.1, 0, 0, 20, 0, 0, 1e20\n1, 1\n2, 0.1\n"),
              HasSubstr("missing (0)"));
}

TEST(DynaContact, PartsWithCommonNodesAreBonded) {
  std::string text = text_of("base.k");
  // The cubes meet at x = 0: the first element of the second one takes the nodes of the first one there.
  text = replaced(text, "       9       2      28      29      32      31      37      38      41      40",
                  "       9       2       3      29      32       6      12      38      41      15");
  const Import import = import_cards(text);
  EXPECT_THAT(import.report(), HasSubstr("target has nodes in common with flyer"));
  EXPECT_THAT(import.case_text, HasSubstr("contact_group = \"flyer\""));
}

TEST(DynaParameters, InEveryForm) {
  EXPECT_THAT(import_file("parameter_two_per_comma_card.k").case_text, HasSubstr("end = \"0.0005 ms\""));
  const auto end = [](const std::string& keyword, const std::string& field = "&tend") {
    std::string text = replaced(text_of("parameter_two_per_comma_card.k"),
                                "*PARAMETER\nR tend, 0.0005, R other, 100.0\n", keyword);
    text = replaced(text, "*CONTROL_TERMINATION\n&tend", "*CONTROL_TERMINATION\n" + field);
    const std::string written = import_cards(text).case_text;
    const std::size_t at = written.find("end = ");
    return written.substr(at + 6, written.find('\n', at) - at - 6);
  };
  EXPECT_EQ(end("*PARAMETER\nR    other     100.0R     tend    5.0-4\n"), "\"0.0005 ms\"");
  EXPECT_EQ(
      end(fmt::format("*PARAMETER+\n{:<20}{:>20}{:<20}{:>20}\n", "R other", "100.0", "R tend", "5.0-4")),
      "\"0.0005 ms\"");
  EXPECT_EQ(end("*PARAMETER_LOCAL\nRtend,0.0005\n"), "\"0.0005 ms\"");
  EXPECT_EQ(end("*PARAMETER\nI n, 2\n*PARAMETER_EXPRESSION\nR tend    1e-3 / &n * max(1, 0.5)\n"),
            "\"0.0005 ms\"");
  EXPECT_EQ(end("*PARAMETER_EXPRESSION\nR tend, -2**2 + 4.0005\n"), "\"0.0005 ms\"");
  EXPECT_EQ(end("*PARAMETER\nR tend, -0.0005\nC title, text\n", "-&tend"), "\"0.0005 ms\"");
  const auto fault = [&](const std::string& keyword) {
    return message_of<InputError>([&] { static_cast<void>(end(keyword)); });
  };
  EXPECT_THAT(fault("*PARAMETER_EXPRESSION\nR tend, 2*(3\n"), HasSubstr("deck.k:6:1: error"));
  EXPECT_THAT(fault("*PARAMETER_EXPRESSION\nR tend, 2*(3\n"), HasSubstr("')' is missing"));
  EXPECT_THAT(fault("*PARAMETER_EXPRESSION\nR tend, nothing*2\n"),
              HasSubstr("there is no parameter NOTHING"));
  EXPECT_THAT(fault("*PARAMETER\nI tend, 0.0005\n"), HasSubstr("no integer"));
  EXPECT_THAT(fault("*PARAMETER\ntend, 0.0005\n"), HasSubstr("behind its type"));
  EXPECT_THAT(fault("*PARAMETER\nR other, 1\n"), HasSubstr("'&tend' is no parameter"));
  const auto none = [](std::string_view) -> std::optional<double> { return std::nullopt; };
  EXPECT_DOUBLE_EQ(dyna::evaluate("2**3**2 + 1.5e-3*sqrt(4) - mod(7, 4)", none), 512.0 + 3e-3 - 3.0);
  EXPECT_THROW(dyna::evaluate(std::string(1000, '('), none), InputError);
  EXPECT_THROW(dyna::evaluate("1/0", none), InputError);
}

TEST_F(DynaImport, OfAFileHoldThereAlone) {
  std::ofstream(folder_ / "part.k") << "*PARAMETER_LOCAL\nR tend, 0.0005\n*CONTROL_TERMINATION\n&tend\n";
  std::ofstream(folder_ / "deck.k") << replaced(text_of("base.k"), "*CONTROL_TERMINATION\n    0.0005\n",
                                                "*PARAMETER\nR tend, 7\n*INCLUDE\npart.k\n");
  EXPECT_THAT(import_deck(folder_ / "deck.k", in_mpa).case_text, HasSubstr("end = \"0.0005 ms\""));
}

TEST_F(DynaImport, OfAnIncludedFileWithAByteOrderMark) {
  std::ofstream(folder_ / "part.k") << "\xEF\xBB\xBF*CONTROL_TERMINATION\n    0.0005\n";
  std::ofstream(folder_ / "deck.k") << replaced(text_of("base.k"), "*CONTROL_TERMINATION\n    0.0005\n",
                                                "*INCLUDE\npart.k\n");
  EXPECT_THAT(import_deck(folder_ / "deck.k", in_mpa).case_text, HasSubstr("end = \"0.0005 ms\""));
}

TEST_F(DynaImport, OfAnIncludedFileThatIsMissingNamesTheCard) {
  std::ofstream(folder_ / "deck.k") << "*KEYWORD\n*INCLUDE\n\n  none.k\n";
  EXPECT_EQ(
      message_of<InputError>([&] { static_cast<void>(import_deck(folder_ / "deck.k", in_mpa)); }),
      fmt::format("{0}/deck.k:4:1: error: *INCLUDE: {0}/none.k: there is no such file", folder_.string()));
  std::ofstream(folder_ / "blank.k") << replaced(text_of("base.k"), "*NODE\n", "*INCLUDE\n \n*NODE\n");
  EXPECT_NO_THROW(static_cast<void>(import_deck(folder_ / "blank.k", in_mpa)))
      << "a blank card names no file";
}

TEST_F(DynaImport, OfAnIncludedFileIsRemarkedWithItsName) {
  std::ofstream(folder_ / "part.k") << "*MAT_ADD_EROSION\n1\n";
  std::ofstream(folder_ / "deck.k") << replaced(text_of("base.k"), "*NODE\n", "*INCLUDE\npart.k\n*NODE\n");
  const std::string report = import_deck(folder_ / "deck.k", in_mpa).report();
  EXPECT_THAT(report, testing::ContainsRegex("part.k, line 1 +.MAT_ADD_EROSION"));
  EXPECT_THAT(report, HasSubstr("\n  line 42  *NODE"));
}

// Of two velocities of a node the last one counts, whether it was assigned to the node or to its part.
TEST_F(DynaImport, TheLastVelocityOfANodeCounts) {
  const auto node_by_node = [](const char* velocity) {
    std::string cards = "*INITIAL_VELOCITY_NODE\n";
    for (int node = 1; node <= 27; ++node) cards += fmt::format("{}, {}, 0, 0\n", node, velocity);
    return cards;
  };
  const auto speed = [&](const std::string& before, const std::string& after) {
    const std::string part = "*INITIAL_VELOCITY_GENERATION\n";
    const std::string deck =
        replaced(replaced(text_of("base.k"), part, before + part), "*NODE\n", after + "*NODE\n");
    return read(import_cards(deck)).bodies[0].velocity[0];
  };
  EXPECT_DOUBLE_EQ(speed("", ""), 100.0);
  EXPECT_DOUBLE_EQ(speed(node_by_node("70"), ""), 100.0);
  EXPECT_DOUBLE_EQ(speed("", node_by_node("70")), 70.0);
  EXPECT_DOUBLE_EQ(speed("", node_by_node("70") + node_by_node("60")), 60.0);
}

TEST(DynaFields, ThatNothingReadsAreMissingByName) {
  EXPECT_THAT(missing_of(import_file("jc_rateop.k")),
              HasSubstr("flyer: RATEOP = 3: another law of the strain rate than ln"));
  const auto missing = [](const std::string& from, const std::string& to) {
    return missing_of(import_cards(replaced(text_of("base.k"), from, to)));
  };
  EXPECT_THAT(missing("       0.0     100.0       0.0       0.0\n",
                      "       0.0     100.0       0.0       0.0         0         4\n"),
              HasSubstr("ICID = 4: a local coordinate system"));
  EXPECT_THAT(missing("    0.0005\n", "    0.0005       100\n"), HasSubstr("ENDCYC = 100"));
  EXPECT_THAT(missing("         1         1\n*MAT", "         1         1         4\n*MAT"),
              HasSubstr("AET = 4"));
  EXPECT_THAT(missing("         1         1\n*MAT", "         1        47\n*MAT"), HasSubstr("ELFORM = 47"));
  EXPECT_THAT(missing("      1.99      0.47         0\n         1\n",
                      "      1.99      0.47         0\n       0.9         0         3\n"),
              AllOf(HasSubstr("flyer: V0 = 0.9: an initial relative volume"), HasSubstr("LCID = 3")));
  EXPECT_THAT(
      missing("         1         1         1         1\n*PART",
              "         1         1         1         1         0         0         0         9\n*PART"),
      HasSubstr("TMID = 9: a thermal material"));
  EXPECT_THAT(missing("*NODE\n", "*CONTROL_SOLUTION\n2\n*NODE\n"), HasSubstr("SOLN = 2: heat conduction"));
  EXPECT_THAT(missing("     47700       120         0         0         0\n\n",
                      "     47700       120         0         0         0\n       0.0       0.1\n"),
              HasSubstr("flyer: EPS = 0.1: a table of yield stress"));
  EXPECT_THAT(missing("*INITIAL_VELOCITY_GENERATION\n         1         2       0.0",
                      "*INITIAL_VELOCITY_GENERATION\n         1         2       9.0"),
              HasSubstr("OMEGA = 9: angular velocity"));
  EXPECT_THAT(missing("*NODE\n", "*MAT_ADD_EROSION\n1\n*NODE\n"), HasSubstr("*MAT_ADD_EROSION  not read"));
}

TEST(DynaFields, OfKeywordsAndOutputAreNoPhysics) {
  const std::string base = without_comments(import_file("base.k").case_text);
  const Import memory = import_file("keyword_memory.k");
  EXPECT_EQ(memory.count(Outcome::missing), 0U) << memory.report();
  EXPECT_EQ(without_comments(memory.case_text), base);
  const Import remark = import_file("remark_beyond_80.k");
  EXPECT_EQ(without_comments(remark.case_text), base);
  // A node has 72 columns: what stands behind them is a remark before column 80, too.
  const std::string text = text_of("base.k");
  const std::size_t first_node = text.find("*NODE\n") + 6, end_of_node = text.find('\n', first_node);
  std::string node = text.substr(first_node, end_of_node - first_node);
  node.resize(72, ' ');
  EXPECT_EQ(
      without_comments(
          import_cards(text.substr(0, first_node) + node + "a, corner" + text.substr(end_of_node)).case_text),
      base);
  for (const std::string keyword :
       {"*KEYWORD 200000000\n", "*KEYWORD_ID\nproject                                 stage\n",
        "*DATABASE_GLSTAT\n0.1\n*DATABASE_EXTENT_BINARY\n0, 0, 3, 1\n", "*CONTROL_ENERGY\n2, 2, 2\n",
        "*CONTROL_TIMESTEP\n0.0, 0.6\n", "*DEFINE_CURVE\n1\n0.0, 1.0\n"}) {
    const Import import = with_keyword(keyword);
    EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
    EXPECT_EQ(without_comments(import.case_text), base) << keyword;
  }
  EXPECT_THAT(with_keyword("*CONTROL_TIMESTEP\n0.0, 0.6, 0, 0, -1e-4\n").report(),
              HasSubstr("DT2MS, TSSFAC: of the methods of that code"));
}

TEST_F(DynaImport, NodesOfHistoriesAreGauges) {
  const Import import = with_keyword("*DATABASE_HISTORY_NODE\n        14         1       999\n");
  EXPECT_THAT(import.report(), HasSubstr("2 gauges that move with the material"));
  const cases::Case setup = read(import);
  ASSERT_EQ(setup.gauges.size(), 2U);
  EXPECT_EQ(setup.gauges[0].name, "node_14");
  EXPECT_NEAR((setup.gauges[0].position - Vector3(-0.5e-3, 0.5e-3, 0.5e-3)).norm(), 0.0, 1e-12);
}

TEST(DynaJohnsonCook, SignOfD3IsAskedForOrInferredWithAWarning) {
  const auto d3 = [](const Import& import) {
    const std::string& text = import.files[0].text;
    return std::stod(text.substr(text.find("d3 = ") + 5));
  };
  const auto doubts = [](const Import& import) {
    return std::ranges::count_if(import.remarks, &Remark::doubtful);
  };
  const Import inferred = import_file("jc_d3_positive.k");
  EXPECT_EQ(d3(inferred), -1.5);
  EXPECT_EQ(doubts(inferred), 2) << "of two parts";
  EXPECT_THAT(inferred.report(),
              HasSubstr("failure strain in tension (triaxiality 1) 0.159 with D3 = -1.5, 0.713 with 1.5"));
  ImportOptions options = in_mpa;
  options.triaxiality = Triaxiality::tension;
  EXPECT_EQ(d3(import_file("jc_d3_positive.k", options)), 1.5) << "as the user says";
  options.triaxiality = Triaxiality::pressure;
  EXPECT_EQ(d3(import_file("jc_d3_positive.k", options)), -1.5);
  EXPECT_EQ(doubts(import_file("jc_d3_positive.k", options)), 0);
  EXPECT_EQ(d3(import_file("jc_rateop.k")), -3.03) << "of Johnson and Cook";
  EXPECT_EQ(doubts(import_file("jc_rateop.k")), 0);
  const Import weak = import_cards(replaced(text_of("jc_d3_positive.k"), "0      0.13      0.13       1.5",
                                            "0      -1.0         0         0"));
  EXPECT_THAT(weak.report(), HasSubstr("flyer: D1 + D2 exp(D3 sigma*) is -1 in shear"));
}

TEST_F(DynaImport, ElementsOfWhatFailsBecomeParticles) {
  const Import import = import_file("jc_d3_positive.k");
  EXPECT_THAT(import.case_text, HasSubstr("method = \"adaptive\""));
  EXPECT_THAT(import.report(), HasSubstr("flyer: elements become particles where the material fails"));
  EXPECT_THAT(import_file("base.k").case_text, HasSubstr("method = \"finite_elements\""));
}

TEST_F(DynaImport, SolidExplosiveBecomesParticlesOfItsMass) {
  const Import import = import_file("explosive_solid.k");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(import.report(), HasSubstr("flyer: elements of an explosive become particles"));
  const cases::Case setup = read(import);
  EXPECT_EQ(setup.burn.mode, BurnMode::time) << "BETA = 2";
  EXPECT_EQ(setup.burn.lighting, cases::LightingRule::straight);
  EXPECT_DOUBLE_EQ(setup.bodies[0].detonation_velocity, 6930.0);
  const cases::Seeding seeding = cases::seed(setup);
  EXPECT_NEAR(seeding.bodies[0].mass, 1.63e-6, 1e-12) << "1 mm^3";
  EXPECT_NEAR(seeding.bodies[0].mass, import.bodies[0].mass, 1e-12);
  EXPECT_EQ(seeding.meshes.size(), 1U);
}

TEST_F(DynaImport, PointsOfDetonationLightTheirOwnPart) {
  const Import import = import_file("detonation_pid_shadow.k");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const cases::Case setup = read(import);
  EXPECT_EQ(setup.burn.lighting, cases::LightingRule::straight);
  cases::Seeding seeding = cases::seed(setup);
  const std::vector<double>& times = seeding.particles.history.scalar("lighting_time");
  const Vector3 of_second(0.0, 0.5e-3, 0.5e-3);  // the points coincide; the second one is 0.5 us late
  for (std::size_t p = 0; p < seeding.particles.size(); ++p) {
    const double delay = seeding.particles.body[p] == 0 ? 0.0 : 0.5e-6;
    EXPECT_NEAR(times[p], delay + (seeding.particles.position[p] - of_second).norm() / 6930.0, 1e-12);
  }
  const std::string both = text_of("detonation_pid_shadow.k");
  const Import shadows = import_cards(replaced(both, "*NODE\n", "*CONTROL_EXPLOSIVE_SHADOW\n*NODE\n"));
  EXPECT_THAT(missing_of(shadows), HasSubstr("points of other parts light"));
  const Import early = import_cards(replaced(both, "         2         0       0.5       0.5    0.0005",
                                             "         0         0       0.5       0.5   -0.0005"));
  EXPECT_THAT(early.case_text, AllOf(HasSubstr("shape = \"sphere\""), HasSubstr("radius = \"3.465 mm\"")))
      << "6930 m/s in 0.5 us";
  EXPECT_EQ(early.count(Outcome::missing), 0U);
  EXPECT_THAT(missing_of(import_cards(
                  replaced(both, "         2         0       0.5", "         9         0       0.5"))),
              HasSubstr("PID = 9 is no explosive"));
}

TEST_F(DynaImport, AirOfALinearPolynomialIsAnIdealGas) {
  const Import import = import_file("air_linear_polynomial.k");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const cases::Case setup = read(import);
  const eos::State state = setup.bodies[0].initial.of(*setup.materials[0]);
  EXPECT_NEAR(state.density, 1.29, 1e-9);
  EXPECT_NEAR(state.pressure, 1e5, 1.0) << "0.4 times 0.25 MPa";
  EXPECT_NEAR(state.sound_speed, std::sqrt(1.4 * 1e5 / 1.29), 0.1);
}

TEST_F(DynaImport, ADeckIsNoCase) {
  std::ofstream(folder_ / "deck.k") << text_of("base.k");
  std::ofstream(folder_ / "case.toml") << text_of("base.k");
  EXPECT_THAT(message_of<InputError>([&] { require_no_deck(folder_ / "deck.k"); }),
              HasSubstr("a deck of LS-DYNA, no case: 'whipple import"));
  EXPECT_NO_THROW(require_no_deck(folder_ / "none.k"));
  EXPECT_NO_THROW(require_no_deck(folder_ / "case.toml"));
}

TEST_F(DynaImport, FilesThatIncludeOneAnotherAreLimitedInNumber) {
  for (int i = 0; i < 19; ++i) {
    std::ofstream(folder_ / fmt::format("{}.k", i))
        << fmt::format("*KEYWORD\n*INCLUDE\n{0}.k\n{0}.k\n{0}.k\n{0}.k\n", i + 1);
  }
  std::ofstream(folder_ / "19.k") << "*KEYWORD\n";
  EXPECT_THAT(message_of<InputError>([&] { static_cast<void>(import_deck(folder_ / "0.k", in_mpa)); }),
              HasSubstr("more than 1000 files are included"));
}

TEST_F(DynaImport, FilesThatAreIncludedAreLimitedInTheirSum) {
  const std::string included = "*KEYWORD\n" + std::string(2048, '$') + "\n";
  std::ofstream(folder_ / "a.k") << included;
  const std::string twice = "*KEYWORD\n*INCLUDE\na.k\na.k\n";
  const auto parse = [&](std::size_t bytes) {
    static_cast<void>(dyna::parse(folder_ / "deck.k", twice, {.bytes = bytes}));
  };
  EXPECT_NO_THROW(parse(2 * included.size()));
  EXPECT_THAT(message_of<InputError>([&] { parse(2 * included.size() - 1); }),
              HasSubstr("deck.k:2:1: error: *INCLUDE: files of more than "));
}

TEST_F(DynaImport, WhatIsStatedTwiceIsRefused) {
  const auto fault = [](const std::string& keyword) {
    return message_of<InputError>([&] { static_cast<void>(with_keyword(keyword)); });
  };
  EXPECT_THAT(fault("*CONTROL_TERMINATION\n     0.002\n"),
              HasSubstr("another *CONTROL_TERMINATION has the end time 0.0005"));
  EXPECT_THAT(fault("*EOS_GRUNEISEN\n         1      3940\n"),
              HasSubstr("equation of state 1 is defined at line 29, too"));
  EXPECT_THAT(fault("*MAT_ELASTIC\n         2       1.0\n"),
              HasSubstr("material 2 is defined at line 23, too"));
  EXPECT_THAT(fault("*NODE\n       1            -7.5\n"), HasSubstr("node 1 lies at another place, too"));
  std::ofstream(folder_ / "words") << "root:x:0:0\n";
  EXPECT_THAT(message_of<InputError>(
                  [&] { static_cast<void>(dyna::parse(folder_ / "deck.k", "*KEYWORD\n*INCLUDE\nwords\n")); }),
              HasSubstr("words:1:1: error: *INCLUDE: an included file begins with a keyword"));
}

}  // namespace
}  // namespace whipple::decks
