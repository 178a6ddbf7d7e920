// SPDX-License-Identifier: BSD-3-Clause
// Reading of TOML inputs: exact texts with file:line:column, all errors at once, unknown keys, --set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/input/document.hpp"

namespace whipple::input {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

enum class Rim : std::uint8_t { outflow, symmetry, wall };
constexpr std::array<Word<Rim>, 3> words(Rim) {
  return {{{Rim::outflow, "outflow"}, {Rim::symmetry, "symmetry"}, {Rim::wall, "wall"}}};
}

struct Domain {
  double cell_size = 1e-3;
  Vector3 lower = Vector3::Zero();
  Rim boundary = Rim::outflow;
  std::int64_t layers = 2;
};

ParameterTable<Domain> domain_table() {
  return {real("cell_size", &Domain::cell_size, "m", range::positive(), "edge of a cell"),
          vector("lower", &Domain::lower, "m", range::any(), "lower corner"),
          choice("boundary", &Domain::boundary, "what happens at the rim").optional(),
          integer("layers", &Domain::layers, range::between(1, 8), "layers of ghosts").optional()};
}

/// Reads [domain] and every [[body]] with a name; returns the errors, or an empty text.
std::string read(Document document, Domain* domain, std::vector<std::string>* bodies = nullptr) {
  try {
    Table root = document.root();
    if (auto table = root.required_table("domain")) table->read(domain_table(), *domain);
    for (Table& body : root.list("body")) {
      struct Body {
        std::string name;
      } one;
      body.read(ParameterTable<Body>{text("name", &Body::name, "what it is called")}, one);
      if (bodies != nullptr) bodies->push_back(one.name);
    }
    document.finish();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string read_text(const std::string& text) {
  Domain domain;
  try {
    return read(Document::from_text(text, "case.toml"), &domain);
  } catch (const InputError& error) {
    return error.what();
  }
}

const std::string good =
    "[domain]\n"
    "cell_size = \"0.5 mm\"\n"
    "lower = [\"0 mm\", \"1 cm\", 2]\n"
    "boundary = \"wall\"\n"
    "[[body]]\n"
    "name = \"disk\"\n"
    "[[body]]\n"
    "name = \"plate\"\n";

TEST(Document, ReadsQuantitiesInSi) {
  Domain domain;
  std::vector<std::string> bodies;
  EXPECT_EQ(read(Document::from_text(good, "case.toml"), &domain, &bodies), "");
  EXPECT_DOUBLE_EQ(domain.cell_size, 5e-4);
  EXPECT_DOUBLE_EQ(domain.lower[1], 1e-2);
  EXPECT_DOUBLE_EQ(domain.lower[2], 2.0);
  EXPECT_EQ(domain.boundary, Rim::wall);
  EXPECT_EQ(domain.layers, 2) << "a missing optional key keeps its default";
  EXPECT_EQ(bodies, (std::vector<std::string>{"disk", "plate"}));
}

TEST(Document, SyntaxErrorHasItsPosition) {
  EXPECT_THAT(read_text("[domain]\ncell_size = = 3\n"), HasSubstr("case.toml:2:13: error: "));
}

// The parser below asserts that a key begins as keys do; in a build with assertions such input aborted.
TEST(Document, AKeyMayBeginWithAnything) {
  EXPECT_THAT(read_text("[domain]\ncell_size = 1\n[=]\n"), HasSubstr("case.toml:3:2: error: "));
  EXPECT_THAT(read_text("x = { = 1 }\n"), HasSubstr("case.toml:1:"));
}

// Bare keys and values are ASCII in TOML; the parser below would run into undefined behaviour.
TEST(Document, CharactersBeyondAsciiBelongInQuotesOrComments) {
  const std::string fault = ": error: a character beyond ASCII outside of quotes";
  EXPECT_EQ(read_text("[domain]\nb\xc3\xa4r = 1\n"), "case.toml:2:2" + fault);
  EXPECT_EQ(read_text("x = 3 \xc2\xb5\n"), "case.toml:1:7" + fault);
  EXPECT_EQ(read_text("x = \"\"\"a\\\n\xc2\xa7\"\"\"\n"), "case.toml:2:1" + fault);
  Domain domain;
  const std::string text =
      "# \xc2\xb5\n[domain] # '\xc2\xb5\ncell_size = \"3 \xc2\xb5m\"\n"
      "lower = ['1 \xc2\xb5m', '''0 m''', \"\"\"2 \xc2\xb5m\"\"\"]\nboundary = '\xc2\xb5\\'\n";
  EXPECT_THAT(read(Document::from_text(text, "case.toml"), &domain),
              HasSubstr("case.toml:5:12: error: 'boundary' is"));
  EXPECT_DOUBLE_EQ(domain.cell_size, 3e-6);
  EXPECT_DOUBLE_EQ(domain.lower[2], 2e-6);
}

// Files as editors of other systems leave them.
TEST(Document, ReadsByteOrderMarksAndOtherLineEndsAndNamesOtherEncodings) {
  const auto refusal = [](const std::string& text) {
    try {
      Document::from_text(text, "case.toml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(refusal("\xEF\xBB\xBF# gr\xC3\xB6\xC3\x9F"
                    "er\r\ntitle = \"a\"\r\n"),
            "no error");
  EXPECT_EQ(refusal("title = \"a\"\n# gr\xF6\xDF"
                    "er\n"),
            "case.toml:2:4: error: Encountered invalid utf-8 sequence: letters beyond ASCII in another "
            "encoding; save "
            "the file as UTF-8");
  const std::string utf_16("\xFF\xFEt\0i\0", 6);
  for (const std::string& text : {utf_16, utf_16.substr(2)}) {
    EXPECT_EQ(refusal(text),
              "case.toml:1:1: error: not a text in UTF-8 but, as it seems, in UTF-16; save it as UTF-8");
  }
}

// Each part of a dotted key is a table in a table, which the parser below takes apart by recursion.
TEST(Document, KeysHaveABoundedNumberOfParts) {
  const auto parts = [](int count, const std::string& point) {
    std::string key = "a";
    for (int i = 1; i < count; ++i) key += point + "a";
    return key;
  };
  EXPECT_EQ(read_text(parts(300'000, ".") + " = 1\n"), "case.toml:1:64: error: a key of more than 32 parts");
  EXPECT_THAT(read_text("x = { " + parts(33, " . ") + " = 1 }\n"), HasSubstr("more than 32 parts"));
  EXPECT_THAT(read_text("[" + parts(33, ".") + "]\n"), HasSubstr("more than 32 parts"));
  EXPECT_THAT(read_text(parts(32, ".") + " = 1\n"), HasSubstr("unknown key"));
  std::string numbers = "x = [0.5";
  for (int i = 0; i < 100; ++i) numbers += ", 0.5";
  EXPECT_THAT(read_text(numbers + "]\n"), Not(HasSubstr("parts")));
}

TEST(Document, UnknownKeyIsAnErrorWithTheNearestName) {
  EXPECT_EQ(read_text("[domain]\ncell_sze = 1\ncell_size = 1\nlower = [0, 0, 0]\n"),
            "case.toml:2:1: error: unknown key 'domain.cell_sze', did you mean \"cell_size\"? "
            "Accepted here: boundary, cell_size, layers, lower");
}

TEST(Document, UnknownTableIsAnError) {
  EXPECT_EQ(read_text(good + "[outptu]\nx = 1\n"),
            "case.toml:9:2: error: unknown key 'outptu'. Accepted here: body, domain");
}

TEST(Document, UnknownKeyInAListEntryNamesTheEntry) {
  EXPECT_EQ(read_text(good + "colour = \"red\"\n"),
            "case.toml:9:1: error: unknown key 'body[1].colour'. Accepted here: name");
}

TEST(Document, MissingKeySaysWhatItMeans) {
  EXPECT_EQ(read_text("[domain]\nlower = [0, 0, 0]\n"),
            "case.toml:1:1: error: missing key 'cell_size' in [domain]: edge of a cell (unit m)");
  EXPECT_EQ(read_text("x = 1\n"),
            "case.toml:1:1: error: missing table [domain]\n"
            "case.toml:1:1: error: unknown key 'x'. Accepted here: body, domain");
}

TEST(Document, WrongValuesNamePositionValueAndWhatIsAccepted) {
  const std::string head = "[domain]\nlower = [0, 0, 0]\n";
  EXPECT_EQ(read_text(head + "cell_size = \"0.5 mn\"\n"),
            "case.toml:3:13: error: 'cell_size' unknown unit 'mn': expected a unit of the kind 'm'");
  EXPECT_EQ(
      read_text(head + "cell_size = \"5 s\"\n"),
      "case.toml:3:13: error: 'cell_size' unit 's' has the wrong dimension: expected a unit of the kind 'm'");
  EXPECT_EQ(read_text(head + "cell_size = \"-1 mm\"\n"),
            "case.toml:3:13: error: 'cell_size' is -0.001 m, but must be > 0 m");
  EXPECT_EQ(
      read_text(head + "cell_size = true\n"),
      "case.toml:3:13: error: 'cell_size' is true or false, expected a number with a unit, like \"1.5 m\"");
  EXPECT_EQ(read_text(head + "cell_size = 1\nlayers = 2.5\n"),
            "case.toml:4:10: error: 'layers' is a number, expected an integer");
  EXPECT_EQ(read_text(head + "cell_size = 1\nlayers = 9\n"),
            "case.toml:4:10: error: 'layers' is 9, but must be >= 1 and <= 8");
  EXPECT_EQ(read_text(head + "cell_size = 1\nboundary = \"symetry\"\n"),
            "case.toml:4:12: error: 'boundary' is \"symetry\", did you mean \"symmetry\"? "
            "Accepted: outflow, symmetry, wall");
  EXPECT_EQ(read_text("[domain]\ncell_size = 1\nlower = [0, 0]\n"),
            "case.toml:3:9: error: 'lower' has 2 entries, expected 3");
  EXPECT_EQ(read_text("[domain]\ncell_size = inf\nlower = [0, 0, nan]\n"),
            "case.toml:2:13: error: 'cell_size' is infinite\n"
            "case.toml:3:9: error: 'lower' is not a number (NaN)");
}

TEST(Document, AllErrorsComeAtOnceInTheOrderOfTheFile) {
  EXPECT_EQ(
      read_text("[domain]\n"
                "cell_size = \"0.5 s\"\n"
                "lower = [0, 0]\n"
                "boundry = \"wall\"\n"
                "[[body]]\n"
                "nam = \"disk\"\n"),
      "case.toml:2:13: error: 'cell_size' unit 's' has the wrong dimension: expected a unit of the kind 'm'\n"
      "case.toml:3:9: error: 'lower' has 2 entries, expected 3\n"
      "case.toml:4:1: error: unknown key 'domain.boundry', did you mean \"boundary\"? "
      "Accepted here: boundary, cell_size, layers, lower\n"
      "case.toml:5:1: error: missing key 'name' in [body[0]]: what it is called\n"
      "case.toml:6:1: error: unknown key 'body[0].nam', did you mean \"name\"? Accepted here: name");
}

TEST(Document, ARejectedValueLeavesTheObjectAsItWas) {
  Domain domain;
  read(Document::from_text("[domain]\ncell_size = -1\nlower = [1, 2, \"3 kg\"]\n", "case.toml"), &domain);
  EXPECT_EQ(domain.cell_size, 1e-3);
  EXPECT_EQ(domain.lower, Vector3(Vector3::Zero()));
}

TEST(Document, WrongKindsOfTablesAreReported) {
  EXPECT_EQ(read_text("domain = 3\n"), "case.toml:1:10: error: 'domain' is an integer, expected a table");
  EXPECT_EQ(read_text("body = [1, {name = \"x\"}]\n[domain]\ncell_size = 1\nlower = [0, 0, 0]\n"),
            "case.toml:1:9: error: entry 0 of 'body' is an integer, expected a table");
  EXPECT_EQ(read_text("[body]\nname = \"x\"\n[domain]\ncell_size = 1\nlower = [0, 0, 0]\n"),
            "case.toml:1:1: error: 'body' is a table, expected a list of tables [[body]]");
}

std::string set_and_read(const std::string& key, const std::string& value, Domain* domain,
                         std::vector<std::string>* bodies = nullptr) {
  Document document = Document::from_text(good, "case.toml");
  try {
    document.set(key, value);
  } catch (const InputError& error) {
    return error.what();
  }
  return read(std::move(document), domain, bodies);
}

TEST(Set, OverridesKeysWithAndWithoutQuotes) {
  Domain domain;
  EXPECT_EQ(set_and_read("domain.cell_size", "0.3 mm", &domain), "");
  EXPECT_DOUBLE_EQ(domain.cell_size, 3e-4);
  EXPECT_EQ(set_and_read("domain.cell_size", "\"0.4 mm\"", &domain), "");
  EXPECT_DOUBLE_EQ(domain.cell_size, 4e-4);
  EXPECT_EQ(set_and_read("domain.layers", "5", &domain), "");
  EXPECT_EQ(domain.layers, 5);
  EXPECT_EQ(set_and_read("domain.lower", "[1, 2, \"3 mm\"]", &domain), "");
  EXPECT_EQ(domain.lower, Vector3(1, 2, 3e-3));
}

TEST(Set, AddressesListEntriesByNumber) {
  Domain domain;
  std::vector<std::string> bodies;
  EXPECT_EQ(set_and_read("body.1.name", "shield", &domain, &bodies), "");
  EXPECT_EQ(bodies, (std::vector<std::string>{"disk", "shield"}));
}

TEST(Set, FaultsNameTheOption) {
  Domain domain;
  EXPECT_EQ(set_and_read("body.2.name", "x", &domain),
            "--set body.2.name=x: the list has 2 entries, numbered from 0");
  EXPECT_EQ(set_and_read("gauge.0.name", "x", &domain),
            "--set gauge.0.name=x: there is no list 'gauge': [[gauge]] in the file makes one");
  EXPECT_EQ(set_and_read("domain..x", "1", &domain), "--set domain..x=1: expected table.key=value");
  EXPECT_EQ(set_and_read("", "1", &domain), "--set =1: expected table.key=value");
  EXPECT_EQ(set_and_read("domain.boundary.x", "1", &domain),
            "--set domain.boundary.x=1: the last part but one is neither a table nor a list");
  EXPECT_EQ(set_and_read("domain.boundary.x.y", "1", &domain),
            "--set domain.boundary.x.y=1: 'x' is neither a table nor a list");
}

TEST(Set, ErrorsInSetValuesSayWhereTheyComeFrom) {
  Domain domain;
  EXPECT_EQ(set_and_read("domain.layers", "99", &domain),
            "case.toml (--set): error: 'layers' is 99, but must be >= 1 and <= 8");
  EXPECT_EQ(set_and_read("domain.layer", "3", &domain),
            "case.toml (--set): error: unknown key 'domain.layer', did you mean \"layers\"? "
            "Accepted here: boundary, cell_size, layers, lower");
}

// "1\nlayers = 7" must not smuggle a second key into the table; it is a text, and no number.
TEST(Set, AValueCannotHoldASecondKey) {
  Domain domain;
  EXPECT_NE(set_and_read("domain.cell_size", "1\nlayers = 7", &domain), "");
  EXPECT_EQ(domain.layers, 2);
}

TEST(Document, FaultsOfACheckStandAtTheirKeys) {
  Document document = Document::from_text(
      "[domain]\ncell_size = \"0 mm\"\nlower = [1, 2, 3]\n[[body]]\nname = \"disk\"\n", "case.toml");
  Domain domain;
  Table root = document.root();
  root.required_table("domain")->read(domain_table(), domain);
  for (Table& body : root.list("body")) body.accept("name");
  // The first is dropped: the value that the check saw is not that of the file.
  document.add({{.key = "domain.cell_size", .text = "checked"},
                {.key = "body.0.name", .text = "no good name"},
                {.key = "body.0.velocity.1", .text = "too fast"},
                {.key = "gauge", .text = "no gauges"}});
  try {
    document.finish();
    ADD_FAILURE() << "no fault was reported";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 4U);
    EXPECT_EQ(error.faults()[0].text,
              "no gauges");  // of a table that is not there: at the one that would hold it
    EXPECT_EQ(error.faults()[1].key, "domain.cell_size");
    EXPECT_EQ(error.faults()[2].key, "body.0.velocity.1");
    EXPECT_EQ(error.faults()[2].line, 4U);
    EXPECT_EQ(error.faults()[3].message(), "case.toml:5:8: error: no good name");
  }
}

TEST(Table, ChoiceFallsBackOrReports) {
  Document document = Document::from_text("method = \"fem\"\n", "case.toml");
  Table root = document.root();
  const std::vector<std::string> choices = {"particles", "finite_elements"};
  EXPECT_EQ(root.choice("kind", choices, "particles"), "particles");
  EXPECT_EQ(root.choice("method", choices, "particles"), "particles")
      << "an error was noted, the fallback stands";
  EXPECT_EQ(root.choice("other", choices), "");
  try {
    document.finish();
    FAIL() << "two errors were expected";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("case.toml:1:10: error: 'method' is \"fem\""));
    EXPECT_THAT(error.what(), HasSubstr("missing key 'other'"));
  }
}

TEST(Table, AcceptedFreeTextMayHoldAnything) {
  Document document =
      Document::from_text("[provenance]\nwho = \"we\"\n[provenance.deep]\nx = 1\n", "case.toml");
  document.root().accept("provenance");
  EXPECT_NO_THROW(document.finish());
}

TEST(Table, NamesOfTablesKeepTheOrderOfTheFile) {
  Document document = Document::from_text("[zinc]\n[alpha]\n[middle]\n", "case.toml");
  EXPECT_EQ(document.root().table_names(), (std::vector<std::string>{"zinc", "alpha", "middle"}));
}

/// What people write has units; what programs write (texts) may be in SI.
TEST(Document, NumbersOfFilesNeedTheirUnits) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("whipple_units_" + std::to_string(getpid()) + ".toml");
  const auto read_file = [&](const std::string& text, const char* set) {
    std::ofstream(path) << text;
    Domain domain;
    Document document = Document::from_file(path);
    if (set != nullptr) document.set("domain.cell_size", set);
    return read(std::move(document), &domain);
  };
  const std::string rest = "\nlower = [0, 0.0, \"-1 mm\"]\n";
  EXPECT_EQ(read_file("[domain]\ncell_size = \"1 mm\"" + rest, nullptr), "");
  EXPECT_THAT(read_file("[domain]\ncell_size = 1" + rest, nullptr),
              HasSubstr(":2:13: error: 'cell_size' is 1 without a unit; in SI units that would be \"1 m\""));
  EXPECT_THAT(read_file("[domain]\ncell_size = \"1\"" + rest, nullptr), HasSubstr("is 1 without a unit"));
  EXPECT_THAT(read_file("[domain]\ncell_size = \"1 mm\"\nlower = [0, 0, -1e-3]\n", nullptr),
              HasSubstr("'lower' is -0.001 without a unit"));
  EXPECT_THAT(read_file("[domain]\ncell_size = \"1 mm\"" + rest, "2"),
              HasSubstr("(--set): error: 'cell_size' is 2"));
  EXPECT_EQ(read_file("[domain]\ncell_size = \"1 mm\"" + rest, "2 mm"), "");
  std::filesystem::remove(path);
}

// A table that replaces constants does not keep the source of those it replaces.
TEST(Document, InheritsRemarksWithAllTheConstantsOrNot) {
  const auto inherited = [](const std::string& own) {
    constexpr std::array<std::string_view, 2> remarks = {"source", "note"};
    Document document = Document::from_text(own, "own.toml");
    document.inherit(Document::from_text("[eos]\nmodel = 'a'\nsource = 'book'\ndensity = 1\nheat = 2\n"
                                         "[eos.part]\nmodel = 'b'\nsource = 'paper'\nslope = 3\nnote = 'n'\n",
                                         "base.toml"),
                     "base", {}, remarks);
    return document.text();
  };
  const std::string replaced = inherited("[eos]\ndensity = 4\n");
  EXPECT_THAT(replaced, AllOf(HasSubstr("density = 4"), HasSubstr("heat = 2"), Not(HasSubstr("book"))));
  EXPECT_THAT(replaced, AllOf(HasSubstr("'paper'"), HasSubstr("'n'"))) << "a table without values of its own";
  const std::string part = inherited("[eos]\nmodel = 'a'\n[eos.part]\nslope = 5\nsource = 'own'\n");
  EXPECT_THAT(part, AllOf(HasSubstr("'book'"), HasSubstr("'own'"), HasSubstr("slope = 5")));
  EXPECT_THAT(part, AllOf(Not(HasSubstr("'paper'")), Not(HasSubstr("'n'"))));
  EXPECT_THAT(inherited("[eos]\nnote = 'mine'\n"), AllOf(HasSubstr("'book'"), HasSubstr("'mine'")));
}

TEST(Document, FileErrorsNameTheFile) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  EXPECT_THROW(Document::from_file(folder), InputError);
  try {
    Document::from_file("/nonexistent/case.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/case.toml: error: there is no such file");
  }
  for (const char* endless : {"/dev/zero", "/dev/null"}) {
    try {
      Document::from_file(endless);
      ADD_FAILURE() << endless;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("expected a regular file"));
    }
  }
  const std::filesystem::path large = folder / ("whipple_large_" + std::to_string(getpid()) + ".toml");
  std::ofstream(large) << "x = 1\n";
  std::filesystem::resize_file(large, 17'000'000);
  EXPECT_THROW(Document::from_file(large), InputError);
  std::filesystem::remove(large);
}

}  // namespace
}  // namespace whipple::input
