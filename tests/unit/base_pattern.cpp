// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/core/base/json.hpp"
#include "src/core/base/pattern.hpp"

namespace whipple {
namespace {

using testing::ElementsAre;

TEST(Pattern, MatchesTheWholeTextOrFindsAPart) {
  const Pattern temperature("([0-9]+)(\\.[0-9]+)? K");
  EXPECT_TRUE(temperature.matches("298 K"));
  EXPECT_FALSE(temperature.matches("at 298 K"));
  EXPECT_TRUE(temperature.is_in("at 298 K"));
  EXPECT_THAT(*temperature.find("at 298.15 K, then 300 K"), ElementsAre("298.15 K", "298", ".15"));
  EXPECT_THAT(*temperature.match("298 K"), ElementsAre("298 K", "298", ""));
  EXPECT_FALSE(temperature.match("at 298 K"));
  EXPECT_EQ(temperature.replace("from 298 K to 300 K", "T"), "from T to T");
  EXPECT_FALSE(Pattern("hugoniot").is_in("Hugoniot"));
  EXPECT_TRUE(Pattern("hugoniot", Pattern::Case::ignored).is_in("Hugoniot"));
}

TEST(Json, NamesThatAreNoUtf8AreWrittenWithAReplacement) {
  const nlohmann::json document = {{"name", "a\xff"}, {"value", 1}};
  EXPECT_EQ(json_text(document, -1), "{\"name\":\"a\xef\xbf\xbd\",\"value\":1}");
  EXPECT_EQ(parse_json(json_text(document, 2)).at("value"), 1);
  EXPECT_EQ(json_text(parse_ordered_json(R"({"b": 1, "a": 2})"), -1), R"({"b":1,"a":2})");
  EXPECT_THROW(parse_json("{"), nlohmann::json::parse_error);
}

}  // namespace
}  // namespace whipple
