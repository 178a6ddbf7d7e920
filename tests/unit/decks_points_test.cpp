// SPDX-License-Identifier: BSD-3-Clause
// Decks whose points lie on no lattice: the import writes their particles to a file, and the case has them as they are.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"
#include "src/core/base/files.hpp"
#include "src/decks/import.hpp"
#include "tests/folders.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::decks {
namespace deck_points_test {

class DecksOfPoints : public FolderTest {
 protected:
  /// Reads a deck of the tests with two lines replaced.
  Import import(const char* name, std::initializer_list<std::pair<std::string, std::string>> changes,
                const ImportOptions& options) const {
    std::string text =
        read_text(std::filesystem::path(whipple::tests::source_folder()) / "tests/data/decks" / name);
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return import_deck(folder_ / name, options);
  }
  Particles particles_of(const Import& import) const {
    CaseFolder written(import, folder_ / "case");
    written.publish();
    return cases::seed(cases::read_case(folder_ / "case" / "case.toml", {})).particles;
  }
};

TEST_F(DecksOfPoints, OfMpm3dBecomeTheirParticles) {
  const Import made = import("columns_of_water.mpm",
                             {{" 1 1 125 0.25 0.25 0.25", " 1 1 120 0.3 0.25 0.25"},
                              {" 8 1 125 0.75 0.75 0.75", " 8 1 130 0.75 0.75 0.8"}},
                             {.units = UnitSystem{"m", "kg", "s"}});
  EXPECT_EQ(made.count(Outcome::missing), 0U) << made.report();
  EXPECT_THAT(made.report(), testing::HasSubstr("8 points that fill no cubic lattice of equal particles: its "
                                                "particles, in a file"));
  EXPECT_THAT(made.report(), testing::HasSubstr("5 materials"));
  EXPECT_THAT(made.case_text, testing::HasSubstr("shape = { points = { file = \"points/body_1.csv\" } }"));
  const Particles p = particles_of(made);
  ASSERT_GT(p.size(), 8U);
  EXPECT_EQ(p.position[0], Vector3(0.3, 0.25, 0.25));
  EXPECT_EQ(p.position[7], Vector3(0.75, 0.75, 0.8));
  EXPECT_NEAR(p.mass[0], 120.0, 1e-10);
  EXPECT_NEAR(p.mass[7], 130.0, 1e-10);
  EXPECT_EQ(p.body[7], 0U);
  EXPECT_EQ(p.body[8], 1U);
}

TEST_F(DecksOfPoints, OfLsDynaBecomeTheirParticles) {
  const Import made =
      import("bar_on_plate.k",
             {{"     101          -1.500", "     101          -1.450"},
              {"     102       2    7.850000e-06", "     102       2       -0.990000"}},  // a volume
             {.units = UnitSystem{"mm", "kg", "ms"}, .cell_size = 1e-3});
  EXPECT_EQ(made.count(Outcome::missing), 0U) << made.report();
  EXPECT_THAT(made.case_text, testing::HasSubstr("shape = { points = { file = \"points/plate.csv\" } }"));
  const Particles p = particles_of(made);
  ASSERT_EQ(p.size(), 16U);
  EXPECT_NEAR((p.position[0] - Vector3(-1.45e-3, -1.5e-3, -0.5e-3)).norm(), 0.0, 1e-18);
  EXPECT_NEAR(p.mass[0], 7.85e-6, 1e-18);
  EXPECT_NEAR(p.mass[1], 0.99e-9 * 7850.0, 1e-18);
  EXPECT_EQ(import("bar_on_plate.k",
                   {{"     101          -1.500", "     101          -1.450"},
                    {"     102       2    7.850000e-06", "     102       2       0.000000"}},
                   {.units = UnitSystem{"mm", "kg", "ms"}, .cell_size = 1e-3})
                .count(Outcome::missing),
            1U)
      << "a point without mass";
}

}  // namespace deck_points_test
}  // namespace whipple::decks
