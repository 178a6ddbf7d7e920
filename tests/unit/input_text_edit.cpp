// SPDX-License-Identifier: BSD-3-Clause
// Values set in the text of a file: all else stays as it is, and what cannot be placed is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/base/error.hpp"
#include "src/core/input/text_edit.hpp"

namespace whipple::input {
namespace {

using ::testing::HasSubstr;

constexpr const char* case_text =
    "# Größe in µm: a comment\n"
    "title = \"Scheibe µ\"  # of the case\n"
    "\n"
    "[domain]\n"
    "  cell_size = \"1 mm\"   # coarse\n"
    "  boundary.x_lower = \"symmetry\"\n"
    "lower = [\"0 mm\", # left\n"
    "         \"-1 mm\", \"-1 mm\"]  # corner\n"
    "\n"
    "[[body]]\n"
    "name = \"disk µ\"\n"
    "shape = { sphere = { radius = \"2 mm\" } } # round\n"
    "[body.initial]\n"
    "temperature = \"300 K\"\n"
    "\n"
    "[[body]]\n"
    "# no keys yet\n";

std::string with_key(const std::string& before, const std::string& key, const std::string& value) {
  try {
    return set_in_text(before, "case.toml", key, value).text;
  } catch (const InputError& error) {
    return error.what();
  }
}

/// The text with one piece replaced by another.
std::string replaced(std::string before, const std::string& piece, const std::string& other) {
  const std::size_t at = before.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return before.replace(at, piece.size(), other);
}

TEST(TextEdit, ReplacesValuesAndNothingElse) {
  EXPECT_EQ(with_key(case_text, "domain.cell_size", "0.5 mm"),
            replaced(case_text, "\"1 mm\"   # coarse", "\"0.5 mm\"   # coarse"));
  EXPECT_EQ(with_key(case_text, "title", "Plate"), replaced(case_text, "\"Scheibe µ\"", "\"Plate\""));
  EXPECT_EQ(with_key(case_text, "domain.lower.1", "-3 mm"),
            replaced(case_text, "\"-1 mm\", \"-1 mm\"]", "\"-3 mm\", \"-1 mm\"]"));
  EXPECT_EQ(with_key(case_text, "domain.lower", "[0, 0, 0]"),
            replaced(case_text, "[\"0 mm\", # left\n         \"-1 mm\", \"-1 mm\"]", "[0, 0, 0]"));
  EXPECT_EQ(with_key(case_text, "body.0.shape.sphere.radius", "3 mm"),
            replaced(case_text, "\"2 mm\" } }", "\"3 mm\" } }"));
  EXPECT_EQ(with_key(case_text, "body.0.shape", "{ box = {} }"),
            replaced(case_text, "{ sphere = { radius = \"2 mm\" } }", "{ box = {} }"));
  EXPECT_EQ(with_key(case_text, "domain.boundary.x_lower", "no_slip"),
            replaced(case_text, "\"symmetry\"", "\"no_slip\""));
}

/// What is no number differs from itself, but a text that holds it can be changed elsewhere.
TEST(TextEdit, ChangesTextsThatHoldWhatIsNoNumber) {
  const std::string text = "rate = nan\nlist = [1.0, nan, -inf]\nslope = 1.5\n[eos]\na = 1\n";
  EXPECT_EQ(with_key(text, "slope", "2.5"), replaced(text, "1.5", "2.5"));
  EXPECT_EQ(with_key(text, "rate", "3.5"), replaced(text, "rate = nan", "rate = 3.5"));
  EXPECT_EQ(with_key(text, "slope", "nan"), replaced(text, "1.5", "nan"));
  EXPECT_EQ(with_key(text, "eos.b", "2"), replaced(text, "a = 1\n", "a = 1\nb = 2\n"));
}

TEST(TextEdit, SaysWhatWasReplacedAndWhere) {
  const TextEdit edit = set_in_text(case_text, "case.toml", "domain.cell_size", "0.5 mm");
  EXPECT_EQ(edit.before, "\"1 mm\"");
  EXPECT_EQ(edit.after, "\"0.5 mm\"");
  EXPECT_EQ(edit.line, 5U);
  EXPECT_EQ(set_in_text(case_text, "case.toml", "domain.cell_size", "1 mm").line, 5U);  // as it was
}

TEST(TextEdit, PutsNewKeysIntoTheirTable) {
  EXPECT_EQ(with_key(case_text, "domain.upper", "[1, 1, 1]"),
            replaced(case_text, "]  # corner\n", "]  # corner\n         upper = [1, 1, 1]\n"));
  EXPECT_EQ(with_key(case_text, "body.0.material", "copper"),
            replaced(case_text, "# round\n", "# round\nmaterial = \"copper\"\n"));
  EXPECT_EQ(with_key(case_text, "body.0.initial.pressure", "0"),
            replaced(case_text, "\"300 K\"\n", "\"300 K\"\npressure = 0\n"));
  EXPECT_EQ(with_key(case_text, "body.1.name", "plate"),
            replaced(case_text, "[[body]]\n# no", "[[body]]\nname = \"plate\"\n# no"));
  EXPECT_EQ(with_key(case_text, "body.0.shape.sphere.center", "[0, 0, 0]"),
            replaced(case_text, "\"2 mm\" }", "\"2 mm\", center = [0, 0, 0] }"));
  EXPECT_EQ(with_key(case_text, "version", "2"),
            replaced(case_text, "of the case\n", "of the case\nversion = 2\n"));
}

TEST(TextEdit, MakesTablesThatAreMissing) {
  EXPECT_EQ(with_key(case_text, "time.end", "5 us"), std::string(case_text) + "\n[time]\nend = \"5 us\"\n");
  EXPECT_EQ(with_key(case_text, "body.0.discretization.per_cell", "8"),
            replaced(case_text, "# round\n", "# round\ndiscretization.per_cell = 8\n"));
  EXPECT_EQ(with_key(case_text, "domain.boundary.y_lower", "no_slip"),
            replaced(case_text, "]  # corner\n", "]  # corner\n         boundary.y_lower = \"no_slip\"\n"));
  EXPECT_EQ(with_key("", "time.end", "5 us"), "[time]\nend = \"5 us\"\n");
  EXPECT_EQ(with_key("a = 1", "b", "2"), "a = 1\nb = 2\n");
}

TEST(TextEdit, KeepsLineBreaksOfWindows) {
  EXPECT_EQ(with_key("a = 1 # one\r\n[t]\r\nc = 3\r\n", "b", "2"),
            "a = 1 # one\r\nb = 2\r\n[t]\r\nc = 3\r\n");
  EXPECT_EQ(with_key("a = 1\r\n", "t.b", "2"), "a = 1\r\n\r\n[t]\r\nb = 2\r\n");
}

TEST(TextEdit, RefusesWhatHasNoPlace) {
  EXPECT_THAT(with_key(case_text, "domain", "{ cell_size = 1 }"), HasSubstr("change it in an editor"));
  EXPECT_THAT(with_key(case_text, "body.2.name", "x"), HasSubstr("the list has 2 entries"));
  EXPECT_THAT(with_key(case_text, "domain.cell_size.x", "1"), HasSubstr("neither a table nor a list"));
  EXPECT_THAT(with_key(case_text, "domain..x", "1"), HasSubstr("expected table.key=value"));
  EXPECT_THAT(with_key("a = [", "a", "1"), HasSubstr("case.toml:1"));
}

// "1\nb = 2" must not smuggle a second key into the text: it becomes a text in quotes.
TEST(TextEdit, AValueCannotHoldASecondKey) {
  EXPECT_EQ(with_key("a = 1\n", "a", "1\nb = 2"), "a = \"1\\nb = 2\"\n");
}

}  // namespace
}  // namespace whipple::input
