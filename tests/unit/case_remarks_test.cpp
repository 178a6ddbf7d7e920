// SPDX-License-Identifier: BSD-3-Clause
// What a case allows but hardly means is remarked on; what it means is not.
#include <fstream>
#include <utility>

#include "src/case/remarks.hpp"
#include "tests/unit/case_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::cases {
namespace {

const std::string free_domain =
    replaced(replaced(domain, "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }", ""),
             "lower = [\"0 mm\", \"0 mm\"", "lower = [\"-12 mm\", \"-12 mm\"");

std::string plate(const std::string& z) {
  return "[[body]]\nname = \"plate\"\nmaterial = \"aluminium.toml\"\nshape = { box = { lower = [\"0 mm\", "
         "\"0 mm\", \"" +
         z + "\"], upper = [\"12 mm\", \"12 mm\", \"15 mm\"] } }\n";
}

std::string remarks_of(const std::string& text) {
  std::string all;
  for (const std::string& remark : remarks(read_case_text(text, "case.toml"))) all += remark + "\n";
  return all;
}

TEST(Remarks, SayNothingOfAnImpactThatTouchesOrFliesFirst) {
  EXPECT_EQ(remarks_of(domain + sphere + plate("-1 mm")), "");  // the sphere ends at -1 mm
  EXPECT_EQ(remarks_of(free_domain + sphere + plate("5 mm")), "");
}

TEST(Remarks, NameAFrictionOfCracksWhereNothingCracks) {
  const std::string friction = "[contact]\ncrack_friction = 0.1\n";
  EXPECT_NE(remarks_of(domain + friction + sphere + plate("-1 mm")).find("crack_friction has no effect"),
            std::string::npos);
  EXPECT_EQ(remarks_of(domain + friction + sphere + plate("-1 mm") + "failure = { cracks = \"fields\" }\n"),
            "");
}

TEST(Remarks, NameAGapThatIsNarrowerThanACell) {
  const std::string said = remarks_of(domain + sphere + plate("-0.75 mm"));
  EXPECT_NE(said.find("'sphere' and 'plate' is a gap of 0.25 mm, less than a cell of 1 mm"),
            std::string::npos)
      << said;
}

TEST(Remarks, NameABodyThatMeetsNothing) {
  const std::string away = replaced(sphere, "\"5.55 km/s\"", "\"-1 km/s\"");
  EXPECT_NE(
      remarks_of(free_domain + away + plate("5 mm")).find("'sphere' meets no other body until t = 4 us"),
      std::string::npos);
  EXPECT_NE(remarks_of(domain + away + plate("5 mm")).find("'sphere' meets no other body until t = 4 us"),
            std::string::npos);  // a quarter model: its mirror planes lie along the flight
  const std::string late = replaced(sphere, "\"5.55 km/s\"", "\"1 km/s\"");  // 6 mm in 4 us
  EXPECT_NE(remarks_of(free_domain + late + plate("5 mm")).find("long enough"), std::string::npos);
}

TEST(Remarks, NameSpeedsBeyondTheAuditedShocks) {
  const std::string fast = replaced(sphere, "\"5.55 km/s\"", "\"300 km/s\"");
  const std::string said = remarks_of(domain + fast + plate("-1 mm"));
  EXPECT_NE(said.find("bodies meet at 300 km/s; 'copper' is audited for shocks with up to"),
            std::string::npos)
      << said;
}

TEST(Remarks, NameExplosivesThatStartBurnt) {
  const std::string charge =
      replaced(replaced(sphere, "copper.toml", "tnt.toml"), "\"5.55 km/s\"", "\"3 km/s\"");
  const std::string said = remarks_of(domain + charge + "detonation = \"instantaneous\"\n" + plate("-1 mm"));
  EXPECT_NE(said.find("'sphere' starts burnt"), std::string::npos) << said;
  EXPECT_NE(said.find("no projectile is like that"), std::string::npos) << said;
}

TEST(Remarks, NameWhatADetonationCannotMean) {
  const std::string charge =
      replaced(sphere, "copper.toml", "tetryl.toml") + "detonation_velocity = \"7.5 km/s\"\n";
  const std::string lit =
      "[[detonation]]\nposition = [\"1 mm\", \"0 mm\", \"-5 mm\"]\n"
      "[[detonation]]\nposition = [\"0 mm\", \"0 mm\", \"40 mm\"]\n";
  const std::string said = remarks_of(domain + charge + plate("-1 mm") + lit);
  for (const char* remark :
       {"has no [eos.unreacted]", "is lit at 7.5 km/s, and its products detonate with 7.913 km/s",
        "its lighting times are those of where it starts",
        "detonation 1 lies 1 mm from the symmetry plane x_lower",
        "detonation 2 is outside of all explosive"}) {
    EXPECT_NE(said.find(remark), std::string::npos) << remark << "\n" << said;
  }
}

// The quarter of a sphere about the z axis.
TEST(Remarks, NameMotionAgainstASymmetryPlane) {
  const auto moving = [&](const std::string& velocity, const std::string& more = "") {
    return remarks_of(domain + replaced(sphere, "[\"0 m/s\", \"0 m/s\", \"5.55 km/s\"]", velocity) + more +
                      plate("-1 mm"));
  };
  const std::string off = moving("[\"1 km/s\", \"0 m/s\", \"3 km/s\"]");
  EXPECT_NE(off.find("'sphere' is cut by the symmetry plane x_lower and moves along its normal, at 1000 m/s "
                     "off the plane"),
            std::string::npos)
      << off;
  EXPECT_EQ(off.find("y_lower"), std::string::npos) << off;
  EXPECT_NE(moving("[\"0 m/s\", \"-1 km/s\", \"3 km/s\"]")
                .find("y_lower and moves along its normal, at 1000 m/s through it"),
            std::string::npos);
  const std::string turning = "angular_velocity = [\"0 rad/s\", \"0 rad/s\", \"1e3 rad/s\"]\n";
  EXPECT_NE(moving("[\"0 m/s\", \"0 m/s\", \"5.55 km/s\"]", turning)
                .find("rotates about an axis that is not the plane's normal x"),
            std::string::npos);
  // A body that only touches may move into the plane: it meets its image. Off it, it may not.
  const auto bar = [&](const char* velocity, const std::string& more = "") {
    return remarks_of(
        domain + "[[body]]\nname = \"bar\"\nmaterial = \"copper.toml\"\nvelocity = [\"" + velocity +
        "\", \"0 m/s\", \"0 m/s\"]\nshape = { box = { lower = [\"0 mm\", \"0 mm\", \"-5 mm\"], upper = "
        "[\"5 mm\", \"5 mm\", \"5 mm\"] } }\n" +
        more);
  };
  EXPECT_EQ(bar("-200 m/s"), "");
  // Expansion is about the middle, 2.5 mm from the plane.
  EXPECT_EQ(bar("25 m/s", "expansion_rate = [\"1e4 1/s\", \"0 1/s\", \"0 1/s\"]\n"), "");
  EXPECT_NE(
      bar("0 m/s", "expansion_rate = [\"-1e4 1/s\", \"0 1/s\", \"0 1/s\"]\n").find("at 25 m/s off the plane"),
      std::string::npos);
  EXPECT_NE(bar("200 m/s").find("'bar' touches the symmetry plane x_lower"), std::string::npos);
}

// Two cubes side by side whose common face has nodes twice.
TEST(Remarks, NamePartsOfAMeshThatAreNotJoined) {
  const TemporaryFolder folder;
  const auto remarks_of_gap = [&](const std::string& gap, const std::string& unit = "1 mm") {
    std::ofstream mesh(folder.path() / "parts.msh");
    mesh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n";
    int node = 0;
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"0", "1"}, {gap, "2"}}) {
      for (const char* z : {"0", "1"}) {
        for (const std::string& corner : {from + " 0 ", to + " 0 ", to + " 1 ", from + " 1 "}) {
          mesh << ++node << ' ' << corner << z << '\n';
        }
      }
    }
    mesh << "$EndNodes\n$Elements\n2\n1 5 2 1 1 1 2 3 4 5 6 7 8\n2 5 2 1 1 9 10 11 12 13 14 15 "
            "16\n$EndElements\n";
    mesh.close();
    return remarks_of(free_domain +
                      "[[body]]\nname = \"cubes\"\nmaterial = \"copper.toml\"\ndiscretization = { method = "
                      "\"finite_elements\", mesh = \"" +
                      (folder.path() / "parts.msh").string() + "\", mesh_unit = \"" + unit + "\" }\n");
  };
  EXPECT_NE(remarks_of_gap("1").find("'cubes': 4 nodes of its mesh"), std::string::npos)
      << remarks_of_gap("1");
  EXPECT_EQ(remarks_of_gap("1.1"), "");
  EXPECT_THROW(remarks_of_gap("1.1", "10 km"), InputError);
}

}  // namespace
}  // namespace whipple::cases
