// SPDX-License-Identifier: BSD-3-Clause
// One declaration per constant drives ranges, texts, defaults and output; here the declaration itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/base/units.hpp"
#include "src/core/base/words.hpp"

namespace whipple {
namespace {

using ::testing::HasSubstr;

enum class Colour : std::uint8_t { by_temperature, red, blue };
constexpr std::array<Word<Colour>, 2> words(Colour) {
  return {{{Colour::blue, "blue"}, {Colour::red, "red"}}};
}

struct Model {
  double density = 8930.0;
  double ratio = 0.3;
  std::int64_t count = 3;
  bool active = true;
  std::string law = "constant";
  Vector3 velocity = Vector3(1, 2, 3);
  std::vector<double> times = {1e-6, 2e-6};
  std::vector<std::string> fields = {"pressure"};
};

ParameterTable<Model> table() {
  return {real("density", &Model::density, "kg/m^3", range::positive(), "density at rest"),
          real("ratio", &Model::ratio, "", range::open_between(-1.0, 0.5), "ratio of Poisson").optional(),
          integer("count", &Model::count, range::between(1, 9), "how many").optional(),
          boolean("active", &Model::active, "whether it acts").optional(),
          choice("law", &Model::law, {"constant", "linear"}, "which law").optional(),
          vector("velocity", &Model::velocity, "m/s", range::any(), "of the body").optional(),
          real_list("times", &Model::times, "s", range::non_negative(), "when").optional(),
          text_list("fields", &Model::fields, {"pressure", "temperature"}, "what").optional()};
}

TEST(Words, AreFoundByValueAndValuesByWord) {
  EXPECT_EQ(word_of(Colour::red), "red");
  EXPECT_EQ(word_of(Colour::by_temperature), "");
  EXPECT_EQ(value_of<Colour>("blue"), Colour::blue);
  EXPECT_EQ(value_of<Colour>("Blue"), std::nullopt);
  EXPECT_EQ(value_of<Colour>(""), std::nullopt);
  EXPECT_EQ(word_list<Colour>(), (std::vector<std::string>{"blue", "red"}));
}

TEST(Range, TextSaysWhatIsAdmissible) {
  EXPECT_EQ(range::any().text(), "any");
  EXPECT_EQ(range::positive().text(), "> 0");
  EXPECT_EQ(range::non_negative().text(), ">= 0");
  EXPECT_EQ(range::between(1, 2).text(), ">= 1 and <= 2");
  EXPECT_EQ(range::open_between(-1, 0.5).text(), "> -1 and < 0.5");
  EXPECT_EQ((Range{.upper = 2.0}).text(), "<= 2");
}

TEST(Range, OpenEndsAreExcludedAndClosedOnesIncluded) {
  EXPECT_FALSE(range::positive().contains(0.0));
  EXPECT_TRUE(range::positive().contains(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(range::non_negative().contains(0.0));
  EXPECT_FALSE(range::open_between(0, 1).contains(1.0));
  EXPECT_TRUE(range::between(0, 1).contains(1.0));
}

TEST(ParameterTable, DefaultsAreAdmissible) {
  Model model;
  for (const BoundParameter& parameter : whipple::bind(table(), model))
    EXPECT_EQ(check(parameter), "") << parameter.info.name;
}

TEST(ParameterTable, FaultsNameTheValueAndWhatIsAdmissible) {
  Model model;
  const std::vector<BoundParameter> bound = whipple::bind(table(), model);
  model.density = -5;
  EXPECT_EQ(check(bound[0]), "is -5 kg/m^3, but must be > 0 kg/m^3");
  model.ratio = 0.5;
  EXPECT_EQ(check(bound[1]), "is 0.5, but must be > -1 and < 0.5");
  model.count = 12;
  EXPECT_EQ(check(bound[2]), "is 12, but must be >= 1 and <= 9");
  model.law = "liner";
  EXPECT_EQ(check(bound[4]), "is \"liner\", did you mean \"linear\"? Accepted: constant, linear");
  model.law = "quadratic";
  EXPECT_EQ(check(bound[4]), "is \"quadratic\". Accepted: constant, linear");
  model.times = {1.0, -2.0};
  EXPECT_EQ(check(bound[6]), "is -2 s, but must be >= 0 s");
  model.fields = {"pressure", "temprature"};
  EXPECT_EQ(check(bound[7]),
            "is \"temprature\", did you mean \"temperature\"? Accepted: pressure, temperature");
}

TEST(ParameterTable, NanAndInfinityAreNeverAdmissible) {
  Model model;
  const std::vector<BoundParameter> bound = whipple::bind(table(), model);
  model.density = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(bound[0]), "is not a number (NaN)");
  model.velocity[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(bound[5]), "is not a number (NaN)");
  model.velocity[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check(bound[5]), "is infinite");
}

TEST(ParameterTable, WritesValuesAsTheyStandInAnInputFile) {
  Model model;
  EXPECT_EQ(to_toml(whipple::bind(table(), model)),
            "density = \"8930 kg/m^3\"  # density at rest\n"
            "ratio = 0.3  # ratio of Poisson\n"
            "count = 3  # how many\n"
            "active = true  # whether it acts\n"
            "law = \"constant\"  # which law\n"
            "velocity = [\"1 m/s\", \"2 m/s\", \"3 m/s\"]  # of the body\n"
            "times = [\"1e-06 s\", \"2e-06 s\"]  # when\n"
            "fields = [\"pressure\"]  # what\n");
}

TEST(ParameterTable, WholeNumbersStayRealNumbersWhenWritten) {
  Model model;
  model.ratio = 0.0;
  EXPECT_EQ(value_as_toml(whipple::bind(table(), model)[1]), "0.0");
  model.ratio = 1e30;
  EXPECT_EQ(value_as_toml(whipple::bind(table(), model)[1]), "1e+30");
}

TEST(ParameterTable, AnInfiniteDefaultIsWrittenAsAComment) {
  Model model;
  model.density = std::numeric_limits<double>::infinity();
  const std::vector<BoundParameter> bound = whipple::bind(table(), model);
  EXPECT_EQ(to_toml(std::span(bound).first(1)), "# density = \"inf kg/m^3\"  # density at rest\n");
}

TEST(ParameterTable, DescribeShowsUnitRangeDefaultAndMeaning) {
  const std::string text = describe_table(table());
  EXPECT_THAT(text, HasSubstr("density   kg/m^3  > 0                     required"));
  EXPECT_THAT(text, HasSubstr("constant | linear"));
  EXPECT_THAT(text, HasSubstr("ratio of Poisson"));
  EXPECT_THAT(text, HasSubstr("0.3"));
}

TEST(ParameterTable, DescribeSaysWhatStandsInForAMissingValue) {
  struct Owner {
    double same = std::numeric_limits<double>::quiet_NaN();
    double bound = std::numeric_limits<double>::infinity();
  };
  const std::string text = describe_table<Owner>(
      {real("same", &Owner::same, "", range::positive(), "of the liquid").optional("same as the solid"),
       real("bound", &Owner::bound, "Pa", range::positive(), "upper end").optional()});
  EXPECT_THAT(text, HasSubstr("same as the solid  of the liquid"));
  EXPECT_THAT(text, HasSubstr("no bound           upper end"));
}

TEST(ParameterTable, LongListsOfWordsGoBelowTheirRow) {
  std::vector<std::string> words;
  for (int i = 0; i < 20; ++i) words.push_back("a_long_word_" + std::to_string(i));
  struct Owner {
    std::string word = "a_long_word_0";
  };
  const std::string text =
      describe_table<Owner>({choice("word", &Owner::word, words, "pick one").optional()});
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  EXPECT_LE(longest, 100U);
  for (const std::string& word : words) EXPECT_THAT(text, HasSubstr(word));
}

TEST(ParameterTable, WordsStandForTheValuesOfAnEnumeration) {
  EXPECT_EQ(word_of(Colour::red), "red");
  EXPECT_EQ(word_of(Colour::by_temperature), "");
  struct Owner {
    Colour colour = Colour::by_temperature;
  };
  const ParameterTable<Owner> table = {choice("colour", &Owner::colour, "of the light").optional("by heat")};
  EXPECT_THAT(describe_table<Owner>(table), HasSubstr("blue | red  by heat"));
  Owner owner;
  const std::vector<BoundParameter> bound = whipple::bind(table, owner);
  // Not given: no input holds it, and none is written.
  EXPECT_TRUE(is_unset(bound[0]));
  EXPECT_EQ(to_toml(bound), "# colour = \"\"  # of the light\n");
  const auto& target = std::get<ChoiceTarget>(bound[0].target);
  target.set(target.value, "red");
  EXPECT_EQ(owner.colour, Colour::red);
  EXPECT_FALSE(is_unset(bound[0]));
  EXPECT_EQ(to_toml(bound), "colour = \"red\"  # of the light\n");
}

// A unit that does not parse would make every reading of the key fail.
TEST(ParameterTable, UnitsOfTablesAreKnown) {
  for (const UnboundParameter& parameter : table()) {
    EXPECT_NO_THROW(units::conversion(parameter.info.unit, parameter.info.unit)) << parameter.info.name;
  }
}

}  // namespace
}  // namespace whipple
