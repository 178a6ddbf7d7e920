// SPDX-License-Identifier: BSD-3-Clause
// One list of accounts: in the ledger, in history.csv, in columns.json and in the manual.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/run/observers/history_columns.hpp"
#include "src/solver/accounts.hpp"
#include "tests/folders.hpp"
#include "tests/unit/ball_on_plate.hpp"

namespace whipple::run {
namespace {

using ::testing::HasSubstr;

TEST(HistoryColumns, StandInTheManual) {
  const std::string table = history_columns_as_markdown();
  EXPECT_THAT(read_text(whipple::tests::source_folder() + "/docs/manual/output.md"), HasSubstr(table))
      << "docs/manual/output.md must hold:\n"
      << table;
}

TEST(Accounts, StandInTheManual) {
  const std::string tables = accounts_as_markdown();
  EXPECT_THAT(read_text(whipple::tests::source_folder() + "/docs/manual/output.md"), HasSubstr(tables))
      << "docs/manual/output.md must hold:\n"
      << tables;
}

// One list for checkpoints, history.csv and columns.json: every limiter is a column that says what it limits.
TEST(Accounts, AreDescribedForPrograms) {
  const std::vector<HistoryColumn> columns = history_columns(ball_on_plate());
  const nlohmann::json list = parse_json(columns_as_json(columns));
  ASSERT_EQ(list.size(), columns.size());
  std::size_t limiters = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    EXPECT_EQ(list[i].at("name"), columns[i].name);
    EXPECT_EQ(list[i].at("unit"), columns[i].unit);
    limiters += list[i].count("limiter");
  }
  EXPECT_EQ(limiters, static_cast<std::size_t>(std::ranges::count(solver::accounts, solver::Shown::limiter,
                                                                  &solver::Account::shown)));
  const auto transfers = std::ranges::find(list, "transfer_heat", [](const auto& c) { return c.at("name"); });
  ASSERT_NE(transfers, list.end());
  EXPECT_EQ(transfers->at("taken_to"), "internal energy");
}

TEST(Accounts, AddUpInTheLedger) {
  solver::Ledger step, sum;
  double number = 1.0;
  for (const solver::Account& account : solver::accounts) step.*account.sum = number++;
  sum.add(step);
  sum.add(step);
  number = 1.0;
  for (const solver::Account& account : solver::accounts)
    EXPECT_EQ(sum.*account.sum, 2.0 * number++) << account.name;
}

TEST(HistoryColumns, DivideTheInternalEnergy) {
  const cases::Case setup = ball_on_plate();
  const std::vector<HistoryColumn> columns = history_columns(setup);
  solver::Simulation simulation(setup, parallel::world());
  const auto value = [&](const std::vector<io::HistoryValue>& row, const char* name) {
    return std::ranges::find(row, std::string(name), &io::HistoryValue::name)->value;
  };
  double plastic = 0.0, elastic = 0.0;
  const double start = value(history_row(columns, simulation), "volume_energy");
  EXPECT_DOUBLE_EQ(start, simulation.totals().internal_energy);
  while (simulation.state().time < 0.4e-6) {
    simulation.advance(0.4e-6);
    const std::vector<io::HistoryValue> row = history_row(columns, simulation);
    EXPECT_GE(value(row, "plastic_heat"), plastic);
    plastic = value(row, "plastic_heat");
    elastic = std::max(elastic, value(row, "elastic_energy"));
    double sum = 0.0;
    for (const char* part :
         {"elastic_energy", "stored_energy", "plastic_heat", "viscous_heat", "other_heat", "volume_energy"}) {
      sum += value(row, part);
    }
    EXPECT_NEAR(sum, value(row, "internal_energy"), 1e-12 * value(row, "total_energy"));
    // Nothing is stored, fluid or relaxing.
    EXPECT_EQ(value(row, "stored_energy"), 0.0);
    EXPECT_EQ(value(row, "viscous_heat"), value(row, "viscous_work"));
    EXPECT_GE(value(row, "other_heat"), value(row, "transfer_heat"));
  }
  EXPECT_GT(plastic, 0.0);
  EXPECT_GT(elastic, 0.0);
  EXPECT_LT(elastic, plastic);
}

TEST(HistoryColumns, HaveNamesOfTheirOwn) {
  std::vector<std::string> names;
  for (const HistoryColumn& column : history_columns(ball_on_plate())) {
    names.push_back(column.name);
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
  EXPECT_EQ(names.front(), "step");
  EXPECT_EQ(names.back(), "outflow_energy.plate");
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

}  // namespace
}  // namespace whipple::run
