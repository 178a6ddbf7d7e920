// SPDX-License-Identifier: BSD-3-Clause
// history.csv: shortest exact numbers, a row at a time, and after a restart bitwise the file of an
// undisturbed run.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/io/history.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class HistoryFile : public FolderTest {
 protected:
  std::filesystem::path file() const { return folder_ / "history.csv"; }
};

std::vector<HistoryValue> row(int step) {
  return {{"step", "", static_cast<double>(step)},
          {"time", "s", step * 1e-7 / 3},
          {"mass_liquid.disk, front", "kg", std::sqrt(step + 0.1)}};
}

TEST_F(HistoryFile, has_units_in_the_header_and_numbers_that_read_back_exactly) {
  History history(file());
  const double third = 1.0 / 3.0;
  history.append(std::vector<HistoryValue>{
      {"step", "", 12}, {"time", "s", 2.5e-7}, {"energy_error", "1", -third}, {"odd, name", "Pa", NAN}});
  const std::string text = read_text(file());
  EXPECT_EQ(text, "step,time [s],energy_error [1],\"odd, name [Pa]\"\n12,2.5e-07,-0.3333333333333333,nan\n");
  EXPECT_EQ(std::strtod("-0.3333333333333333", nullptr), -third);
}

TEST_F(HistoryFile, every_row_is_on_the_file_at_once) {
  History history(file());
  for (int step = 0; step < 3; ++step) {
    history.append(row(step));
    const std::string text = read_text(file());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), step + 2);
  }
}

/// Killed anywhere: after any byte of the file, a restart from any step at or before what is left gives the
/// file of the run that was never disturbed.
TEST_F(HistoryFile, a_restart_gives_the_file_of_the_undisturbed_run) {
  constexpr int rows = 12;
  {
    History history(file());
    for (int step = 0; step < rows; ++step) history.append(row(step));
  }
  const std::string whole = read_text(file());
  for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    std::ofstream(file(), std::ios::binary) << whole.substr(0, bytes);
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes), '\n');
    const int last_step =
        std::max(0, static_cast<int>(lines) - 3);  // a step earlier than the last complete row
    History history = History::restart(file(), lines >= 2 ? last_step : -1, row(0));
    for (int step = lines >= 2 ? last_step + 1 : 0; step < rows; ++step) history.append(row(step));
    ASSERT_EQ(read_text(file()), whole) << "killed after byte " << bytes;
  }
}

TEST_F(HistoryFile, a_missing_file_is_an_empty_table) {
  History history = History::restart(file(), 100, row(0));
  history.append(row(101));
  EXPECT_THAT(read_text(file()), HasSubstr("step,time [s]"));
}

TEST_F(HistoryFile, refuses_what_is_not_its_own) {
  std::ofstream(file()) << "a,b\n1,2\n";
  EXPECT_THAT(message_of<InputError>([&] { (void)History::restart(file(), 1, row(0)); }),
              AllOf(HasSubstr(file().string()), HasSubstr("no column \"step\"")));
  const HistoryValue columns[] = {{"step", "", 0.0}, {"b", "", 0.0}};
  std::ofstream(file()) << "step,b\n1,2\n2\n3,4\n";
  EXPECT_THAT(message_of<InputError>([&] { (void)History::restart(file(), 3, columns); }),
              HasSubstr("history.csv:3: damaged row: 1 cells for 2 columns"));
  std::ofstream(file()) << "step,b\n1,2\n3,4\n";
  EXPECT_THAT(message_of<InputError>([&] { (void)History::restart(file(), 1, row(0)); }),
              HasSubstr("other columns"));
  EXPECT_EQ(read_text(file()), "step,b\n1,2\n3,4\n");
}

TEST_F(HistoryFile, columns_may_not_change_on_the_way) {
  History history(file());
  history.append(row(0));
  std::vector<HistoryValue> changed = row(1);
  changed.pop_back();
  EXPECT_THROW(history.append(changed), InternalError);
}

TEST_F(HistoryFile, a_full_disk_is_reported) {
  History history("/dev/full");
  EXPECT_THAT(message_of<InputError>([&] { history.append(row(0)); }), HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace whipple::io
