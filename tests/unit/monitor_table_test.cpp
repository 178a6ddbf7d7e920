// SPDX-License-Identifier: BSD-3-Clause
// Tables that grow while they are read, and requests that are answered without a network.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "src/monitor/handler.hpp"
#include "src/monitor/table.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::monitor {
namespace {

void append(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::app | std::ios::binary) << text;
}

TEST(GrowingTable, ReadsWhatIsNewAndBeginsAgainWhenTheTableIsAnother) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "history.csv";
  GrowingTable table(file);
  table.look();
  EXPECT_EQ(table.rows(), 0U);
  append(file, "step,time [s]\n1,0.5\n2,1.");
  table.look();
  EXPECT_EQ(table.heads(), (std::vector<std::string>{"step", "time [s]"}));
  EXPECT_EQ(table.column(1), std::vector<double>{0.5});  // the second row is not finished
  append(file, "5\n3,nan\n4,\n");
  table.look();
  EXPECT_EQ(table.rows(), 4U);
  EXPECT_EQ(table.column(1)[1], 1.5);
  EXPECT_TRUE(std::isnan(table.column(1)[2]) && std::isnan(table.column(1)[3]));
  std::filesystem::resize_file(file, 20);  // continued from an earlier checkpoint
  append(file, "\n7,7\n");
  table.look();
  EXPECT_EQ(table.column(0), (std::vector<double>{1, 7}));
  std::filesystem::remove(file);
  append(file, "step,time [s],dt [s]\n" + std::string(100, '1') + ",2,3\n");  // another table, longer
  table.look();
  EXPECT_EQ(table.heads().size(), 3U);
  EXPECT_EQ(table.rows(), 1U);
}

/// A run that started again between two looks has written more than was read before, below the same heads.
TEST(GrowingTable, DoesNotMixTheRowsOfTwoRuns) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "history.csv";
  GrowingTable table(file);
  append(file, "step,time [s]\n1,0.5\n2,1.5\n");
  table.look();
  append(file, "3,2.5\n");
  table.look();
  EXPECT_EQ(table.column(1), (std::vector<double>{0.5, 1.5, 2.5}));
  std::filesystem::remove(file);
  append(file, "step,time [s]\n1,0.1\n2,0.2\n3,0.3\n4,0.4\n5,0.5\n");
  table.look();
  EXPECT_EQ(table.column(1), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
}

TEST(GrowingTable, DrawsPeaksBesideWhatIsNoNumber) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "gauges.csv";
  std::ofstream out(file);
  out << "step,y\n";
  for (int i = 0; i < 1000; ++i) out << i << ',' << (i % 100 < 3 ? "nan" : i % 100 == 50 ? "9" : "1") << '\n';
  out.close();
  GrowingTable table(file);
  table.look();
  const std::vector<std::size_t> rows =
      table.rows_to_draw(1, 40);  // ten parts, each of which begins with nan
  for (std::size_t peak = 50; peak < 1000; peak += 100)
    EXPECT_TRUE(std::ranges::find(rows, peak) != rows.end()) << peak;
}

TEST(GrowingTable, DrawsFewRowsAndEveryPeak) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "history.csv";
  std::ofstream out(file);
  out << "step,y\n";
  for (int i = 0; i < 5000; ++i)
    out << i << ',' << (i == 1234 ? 9.0 : i == 4321 ? -9.0 : std::sin(i)) << '\n';
  out.close();
  GrowingTable table(file);
  table.look();
  const std::vector<std::size_t> rows = table.rows_to_draw(1, 400);
  EXPECT_LE(rows.size(), 400U);
  EXPECT_TRUE(std::ranges::is_sorted(rows) && std::ranges::find(rows, 1234U) != rows.end() &&
              std::ranges::find(rows, 4321U) != rows.end());
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 4999U);
  EXPECT_EQ(table.rows_to_draw(1, 20000).size(), 5000U);
}

/// Whatever a request contains, it is answered, and nobody without the key is told anything of a run.
TEST(Handler, AnswersTenThousandDamagedQuestions) {
  const TemporaryFolder folder;
  Handler handler(Folder(folder.path()), {.host = "127.0.0.1:1", .token = std::string(32, 'a')},
                  folder.path(), folder.path(), folder.path(),
                  [](const std::vector<std::string>&) { FAIL() << "nothing may be started"; });
  const std::vector<std::string> targets = {"/",
                                            "/runs",
                                            "/run?run=.",
                                            "/curves?run=a&table=history&x=a&y=b&points=3",
                                            "/cloud?run=a&index=1&particles=9",
                                            "/steer",
                                            "/start",
                                            "/resume",
                                            "/../x.js"};
  const std::vector<std::string> bodies = {"",     "{}",   R"({"run": "a", "request": "pause", "value": ""})",
                                           "[[[[", "null", R"({"case": "a", "run": "b", "set": [1]})"};
  std::uint64_t state = 1;
  const auto random = [&state](std::size_t below) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>(state >> 33U) % below;
  };
  const auto damaged = [&](std::string text) {
    for (std::size_t i = random(4); i > 0 && !text.empty(); --i)
      text[random(text.size())] = static_cast<char>(random(256));
    return text;
  };
  for (int n = 0; n < 10000; ++n) {
    const bool has_key = random(2) == 0;
    const Response answer =
        handler.handle({.changes = random(2) == 0,
                        .target = damaged(targets[random(targets.size())]),
                        .host = "127.0.0.1:1",
                        .origin = {},
                        .site = {},
                        .token = has_key ? std::string(32, 'a') : damaged(std::string(31, 'a')),
                        .content_type = "application/json",
                        .body = damaged(bodies[random(bodies.size())])});
    EXPECT_TRUE(answer.status == 200 || (answer.status >= 400 && answer.status < 500)) << answer.status;
    EXPECT_TRUE(has_key || answer.status == 401) << answer.status;
  }
}

}  // namespace
}  // namespace whipple::monitor
