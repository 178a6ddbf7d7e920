// SPDX-License-Identifier: BSD-3-Clause
// What a case allows but hardly means is remarked on; what it means is not.
#include "src/setup/remarks.hpp"

#include "tests/unit/setup_support.hpp"

namespace whipple::setup {
namespace {

const std::string free_domain =
    replaced(replaced(domain, "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }", ""),
             "lower = [\"0 mm\", \"0 mm\"", "lower = [\"-12 mm\", \"-12 mm\"");

std::string plate(const std::string& z) {
  return "[[body]]\nname = \"plate\"\nmaterial = \"aluminium.toml\"\nshape = { box = { lower = [\"0 mm\", \"0 mm\", \"" + z +
         "\"], upper = [\"12 mm\", \"12 mm\", \"15 mm\"] } }\n";
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

TEST(Remarks, NameAGapThatIsNarrowerThanACell) {
  const std::string said = remarks_of(domain + sphere + plate("-0.75 mm"));
  EXPECT_NE(said.find("'sphere' and 'plate' is a gap of 0.25 mm, less than a cell of 1 mm"), std::string::npos) << said;
}

TEST(Remarks, NameABodyThatMeetsNothing) {
  const std::string away = replaced(sphere, "\"5.55 km/s\"", "\"-1 km/s\"");
  EXPECT_NE(remarks_of(free_domain + away + plate("5 mm")).find("'sphere' meets no other body until t = 4 us"),
            std::string::npos);
  const std::string late = replaced(sphere, "\"5.55 km/s\"", "\"1 km/s\"");  // 6 mm in 4 us
  EXPECT_NE(remarks_of(free_domain + late + plate("5 mm")).find("long enough"), std::string::npos);
}

TEST(Remarks, NameSpeedsBeyondTheAuditedShocks) {
  const std::string fast = replaced(sphere, "\"5.55 km/s\"", "\"300 km/s\"");
  const std::string said = remarks_of(domain + fast + plate("-1 mm"));
  EXPECT_NE(said.find("bodies meet at 300 km/s; 'copper' is audited for shocks with up to"), std::string::npos) << said;
}

TEST(Remarks, NameExplosivesThatStartBurnt) {
  const std::string charge = replaced(replaced(sphere, "copper.toml", "tnt.toml"), "\"5.55 km/s\"", "\"3 km/s\"");
  const std::string said = remarks_of(domain + charge + plate("-1 mm"));
  EXPECT_NE(said.find("'sphere' starts burnt"), std::string::npos) << said;
  EXPECT_NE(said.find("no projectile is like that"), std::string::npos) << said;
}

}  // namespace
}  // namespace whipple::setup
