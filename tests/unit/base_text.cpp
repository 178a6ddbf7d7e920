// SPDX-License-Identifier: BSD-3-Clause
// Words to the user: suggestions, quoting, durations, sizes; and the exit codes of the three kinds of errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> known_words = {"cell_size", "courant", "scheme", "end"};

TEST(DidYouMean, FindsTheNearestWordWithoutRegardToCase) {
  EXPECT_EQ(did_you_mean("cell_sze", known_words), ", did you mean \"cell_size\"?");
  EXPECT_EQ(did_you_mean("COURANT", known_words), ", did you mean \"courant\"?");
  EXPECT_EQ(did_you_mean("schema", known_words), ", did you mean \"scheme\"?");
}

TEST(TextTable, AlignsColumnsByCharactersAndEndsLinesWithoutBlanks) {
  EXPECT_EQ(text_table({{"name", "value", "unit"}, {"c", "3940", ""}, {"Grüneisen", "1.97"}}, "lrl"),
            "name       value  unit\n"
            "c           3940\n"
            "Grüneisen   1.97\n");
  EXPECT_EQ(text_table({}, "l"), "");
}

TEST(DidYouMean, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("velocity", known_words), "");
  EXPECT_EQ(did_you_mean("courant", {}), "");
}

TEST(Quoted, EscapesWhatTomlReserves) {
  EXPECT_EQ(whipple::toml_string("plain"), "\"plain\"");
  EXPECT_EQ(whipple::toml_string("say \"no\""), "\"say \\\"no\\\"\"");
  EXPECT_EQ(whipple::toml_string("a\\b\nc\td"), "\"a\\\\b\\nc\\td\"");
}

TEST(Quoted, EscapesControlCharactersByNumber) {
  EXPECT_EQ(whipple::toml_string(std::string("a\x01z\x7f")), "\"a\\u0001z\\u007F\"");
  EXPECT_EQ(whipple::toml_string("a\r\b"), "\"a\\u000D\\u0008\"");
}

TEST(FormatDuration, ChoosesTheUnits) {
  EXPECT_EQ(format_duration(0.4), "0 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(200), "3 min 20 s");
  EXPECT_EQ(format_duration(7500), "2 h 05 min");
  EXPECT_EQ(format_duration(-3), "0 s");
  EXPECT_EQ(format_duration(std::numeric_limits<double>::infinity()), "unknown");
}

TEST(FormatDuration, HugeTimesDoNotOverflow) { EXPECT_EQ(format_duration(1e300), "unknown"); }

TEST(FormatBytes, ChoosesTheUnit) {
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(999), "999 B");
  EXPECT_EQ(format_bytes(12345), "12.3 kB");
  EXPECT_EQ(format_bytes(2.5e9), "2.5 GB");
  EXPECT_EQ(format_bytes(7e16), "70000.0 TB");
}

template <class Error>
int throwing(int /*argc*/, char** /*argv*/) {
  throw Error("what happened");
}

// Scripts and job schedulers branch on these numbers.
TEST(RunGuarded, TurnsErrorsIntoExitCodesAndMessages) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run_guarded("prog", [](int, char**) { return 0; }, 0, nullptr), 0);
  EXPECT_EQ(run_guarded("prog", throwing<InputError>, 0, nullptr), 2);
  EXPECT_EQ(run_guarded("prog", throwing<StateError>, 0, nullptr), 3);
  EXPECT_EQ(run_guarded("prog", throwing<InternalError>, 0, nullptr), 4);
  EXPECT_EQ(run_guarded("prog", throwing<std::runtime_error>, 0, nullptr), 4);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "prog: error: what happened\n"
            "prog: physics error: what happened\n"
            "prog: internal error (please report it): what happened\n"
            "prog: internal error (please report it): what happened\n");
}

TEST(RunGuarded, AMessageThatNamesItsPlaceStandsAlone) {
  ::testing::internal::CaptureStderr();
  const auto body = [](int, char**) -> int { throw InputError("case.toml:3:1: error: unknown key 'x'"); };
  EXPECT_EQ(run_guarded("prog", body, 0, nullptr), 2);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "case.toml:3:1: error: unknown key 'x'\n");
}

TEST(Progress, EndsWithShareTimeAndRemarkAndCanBeSilenced) {
  ::testing::internal::CaptureStderr();
  {
    Progress(std::string("run"), 10.0).update(5.0, "step 7");
  }
  const std::string shown = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(shown, HasSubstr("run"));
  EXPECT_THAT(shown, HasSubstr("50.0 %"));
  EXPECT_THAT(shown, HasSubstr("step 7"));

  set_progress_visible(false);
  ::testing::internal::CaptureStderr();
  {
    Progress(std::string("run"), 10.0).update(5.0, "step 7");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  set_progress_visible(true);
}

TEST(Progress, WithoutWorkDoneNothingIsSaid) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("run", 10.0);
    progress.start_from(4.0);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Csv, CellsSurviveARow) {
  const std::vector<std::string> cells = {"plain", "", "a, b", "the \"steel\" plate", ",\"", ""};
  std::string line;
  for (const std::string& cell : cells) line += (&cell == cells.data() ? "" : ",") + csv_cell(cell);
  EXPECT_EQ(csv_cells(line), cells);
  EXPECT_EQ(csv_cells(line + "\r"), cells);
  EXPECT_EQ(csv_cell("two\nlines"), "\"two lines\"");
  EXPECT_EQ(csv_cells("").size(), 1U);
}

TEST(SymmetricTensor, KeepsTheOrderOfTheOutputFiles) {
  const SymmetricTensor tensor{1, 2, 3, 4, 5, 6};
  const Matrix3 m = tensor.matrix();
  EXPECT_EQ(m(0, 1), 4);
  EXPECT_EQ(m(1, 2), 5);
  EXPECT_EQ(m(2, 0), 6);
  EXPECT_EQ(m, m.transpose());
  const SymmetricTensor back = SymmetricTensor::from(m);
  EXPECT_EQ(back.xx, 1);
  EXPECT_EQ(back.zx, 6);
  EXPECT_DOUBLE_EQ(tensor.squared_norm(), m.squaredNorm());
}

}  // namespace
}  // namespace whipple
