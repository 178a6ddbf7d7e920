// SPDX-License-Identifier: BSD-3-Clause
// Decks of soil: the cone and the loads of a deck are those of the case that is made of it.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/decks/import.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "tests/folders.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::decks {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(whipple::tests::source_folder()) / "tests" / "data" / "decks";

class SoilDeck : public FolderTest {
 protected:
  /// Returns the deck of the column with one text replaced.
  Import with(const std::string& from, const std::string& to) const {
    std::string text = read_text(folder / "soil_column.mpm");
    std::ofstream(folder_ / "deck.mpm") << text.replace(text.find(from), from.size(), to);
    return import_deck(folder_ / "deck.mpm", {});
  }
};

TEST_F(SoilDeck, ADeckOfSoilUnderLoadsIsACase) {
  const Import import = import_deck(folder / "soil_column.mpm", {});
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const CaseFolder written(import, folder_ / "case");
  const cases::Case setup = cases::read_case(written.case_file(), {});
  const auto* soil =
      dynamic_cast<const strength::DruckerPragerModel*>(setup.materials.front()->strength.get());
  ASSERT_NE(soil, nullptr);
  const strength::DruckerPrager::Cone cone = soil->law().cone();
  EXPECT_NEAR(cone.slope, std::sqrt(3.0) * 0.3545, 1e-6) << "q_phi of the deck";
  EXPECT_NEAR(cone.cohesion, std::sqrt(3.0) * 9740, 0.1) << "k_phi";
  EXPECT_NEAR(soil->law().tensile_strength, 5000, 1e-6);
  ASSERT_EQ(setup.loads.size(), 3U);
  EXPECT_NEAR(setup.loads[0].force[0], 0.5 * 64, 1e-9) << "that of a particle times their number";
  EXPECT_EQ(setup.loads[0].body, "body_2");
  EXPECT_NEAR(setup.loads[1].acceleration[2], -9.8, 1e-12);
  EXPECT_NEAR(setup.loads[2].acceleration[2], -4.9, 1e-12) << "of the other body";
}

TEST_F(SoilDeck, DilationBeginsAsInTheDeck) {
  const Import import = with("9740 0 5000", "9740 0.1 5000");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  EXPECT_THAT(import.report(), testing::HasSubstr("ends at 'maximum_dilation'"));
  const CaseFolder written(import, folder_ / "case");
  const cases::Case setup = cases::read_case(written.case_file(), {});
  const auto* soil =
      dynamic_cast<const strength::DruckerPragerModel*>(setup.materials.front()->strength.get());
  ASSERT_NE(soil, nullptr);
  EXPECT_NEAR(soil->law().dilation_slope(), std::sqrt(3.0) * 0.1, 1e-6) << "q_psi of the deck";
  EXPECT_THAT(message_of<InputError>([&] { (void)with("9740 0 5000", "9740 0.36 5000"); }),
              testing::HasSubstr("q_psi must be >= 0 and not above q_phi"));
}

TEST_F(SoilDeck, ForcesGrowAndMotionIsDampedAsInTheDeck) {
  const Import import = with("endtime", "qulo 0.25\ndamp 30\nendtime");
  EXPECT_EQ(import.count(Outcome::missing), 0U) << import.report();
  const CaseFolder written(import, folder_ / "case");
  const cases::Case setup = cases::read_case(written.case_file(), {});
  ASSERT_EQ(setup.loads.size(), 4U);
  const cases::AppliedLoad *damping = nullptr, *force = nullptr;
  for (const cases::AppliedLoad& load : setup.loads) {
    if (load.is_damping()) damping = &load;
    if (load.is_force()) force = &load;
    if (!load.acceleration.isZero(0.0)) {
      EXPECT_TRUE(load.table.is_default()) << "gravity does not grow";
    }
  }
  ASSERT_NE(damping, nullptr);
  EXPECT_NEAR(damping->damping, 30.0, 1e-12);
  EXPECT_TRUE(damping->body.empty() && !damping->box) << "of all material";
  ASSERT_NE(force, nullptr);
  EXPECT_NEAR(force->force[0], 0.5 * 64, 1e-9);
  EXPECT_EQ(force->table.times, (std::vector<double>{0.0, 0.25}));
  EXPECT_EQ(force->table.factors, (std::vector<double>{0.0, 1.0}));
}

TEST_F(SoilDeck, DampingThatDrivesAndTimesThatEndBeforeTheyBeginAreRefused) {
  EXPECT_THAT(message_of<InputError>([&] { (void)with("endtime", "damp -1\nendtime"); }),
              testing::HasSubstr("'damp' must be >= 0: it would drive the motion"));
  EXPECT_THAT(message_of<InputError>([&] { (void)with("endtime", "qulo 0\nendtime"); }),
              testing::HasSubstr("'qulo' must be > 0: the time over which forces grow"));
}

TEST_F(SoilDeck, ForcesOnParticlesAreMissing) {
  EXPECT_THAT(with("body 2 0.5", "part 2 0.5").report(), testing::HasSubstr("forces on single particles"));
}

TEST_F(SoilDeck, ConesThatNoAngleHasAreRefused) {
  for (const char* slope : {"0", "1.74"}) {
    EXPECT_THAT(message_of<InputError>([&] { (void)with("0.3545", slope); }),
                testing::HasSubstr("deck.mpm:10:1: error: mate dpm: q_phi must be > 0 and < sqrt(3)"));
  }
}

}  // namespace
}  // namespace whipple::decks
