// SPDX-License-Identifier: BSD-3-Clause
// Proves: a run that is killed (SIGKILL) and restarted gives bitwise the history of an undisturbed run; one
// and two threads give bitwise the same; SIGTERM writes a checkpoint and ends cleanly; a failed state is
// saved and named. Every run is a child process, as a user's would be, and MPI is started in none of the
// parents. And that a run goes on from a checkpoint of its own input only: grid, bodies, materials, gauges,
// rows of its tables, numbers that a state can have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/checkpoint.hpp"
#include "src/material/constitutive_catalogue.hpp"
#include "src/run/restart.hpp"
#include "src/run/run.hpp"
#include "tests/folders.hpp"
#include "tests/parallel/debris_case.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;

/// A coarse copper disk through an aluminium plate with the three-phase equation of state: shocks, spall,
/// melting, symmetry planes, particles that leave the domain.
const char* const debris_head = R"(
title = "coarse debris cloud"
[domain]
lower = ["0 mm", "0 mm", "-8 mm"]
upper = ["12 mm", "12 mm", "14 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "4 us"
[output]
snapshot_every = "1 us"
checkpoint_every = "1 ms"
[[gauge]]
name = "axis"
position = ["0.5 mm", "0.5 mm", "1 mm"]
[[gauge]]
name = "rear"
kind = "moving"
position = ["1 mm", "1 mm", "2.8 mm"]
[[tracers]]
name = "line"
from = ["0 mm", "0 mm", "-3 mm"]
to = ["4 mm", "0 mm", "-3 mm"]
count = 3
[[force_gauge]]
name = "symmetry"
face = "x_lower"
[[force_gauge]]
name = "blow"
body = "plate"
[[load]]
body = "disk"
force = ["0 N", "0 N", "-50 kN"]
times = ["0.5 us", "1.5 us", "3.5 us"]
factors = [0, 1, -1]
)";

class Run : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("whipple_run_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "debris.toml") << debris_head << debris_case::bodies;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] run::RunOptions options(const std::string& directory, int threads = 1) const {
    return {.case_file = folder_ / "debris.toml",
            .output_directory = folder_ / directory,
            .restart = false,
            .force = false,
            .threads = threads,
            .program = "test",
            .overrides = {}};
  }

  /// Runs in a child; `watch` may send it signals. @returns the status of waitpid
  static int run_in_child(const run::RunOptions& options, const std::function<void(pid_t)>& watch = {}) {
    const pid_t child = fork();
    if (child == 0) {
      log::set_level(log::Level::quiet);
      set_progress_visible(false);
      int code = 99;
      try {
        code = run::run_case(options, parallel::world());
      } catch (const StateError& error) {
        std::ofstream(options.output_directory / "error.txt") << error.what();
        code = 3;
      } catch (const InputError& error) {
        std::ofstream(options.output_directory / "error.txt") << error.what();
        code = 2;
      }
      _exit(code);
    }
    if (watch) watch(child);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  static std::string text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
  }
  [[nodiscard]] std::string history(const std::string& directory) const {
    return text(folder_ / directory / "history.csv");
  }
  [[nodiscard]] std::string gauges(const std::string& directory) const {
    const std::string content = text(folder_ / directory / "gauges.csv");
    EXPECT_GT(content.size(), 1000U);
    return content;
  }
  /// Bytes of the last checkpoint: every field of every particle in full precision.
  [[nodiscard]] std::string newest_checkpoint(const std::string& directory) const {
    const std::vector<fs::path> paths = io::list_checkpoints(folder_ / directory / "checkpoint");
    EXPECT_FALSE(paths.empty());
    return paths.empty() ? directory : text(paths.front());
  }
  [[nodiscard]] std::size_t history_rows(const std::string& directory) const {
    const std::string content = history(directory);
    return static_cast<std::size_t>(std::count(content.begin(), content.end(), '\n'));
  }
  /// The first line in which two tables differ, empty if they are the same.
  static std::string first_difference(const std::string& a, const std::string& b) {
    std::istringstream left(a), right(b);
    std::string left_line, right_line;
    while (true) {
      const bool more_left = static_cast<bool>(std::getline(left, left_line));
      const bool more_right = static_cast<bool>(std::getline(right, right_line));
      if (!more_left && !more_right) return "";
      if (more_left != more_right) return "one table ends before the other";
      if (left_line != right_line) return left_line + "\n" + right_line;
    }
  }
  /// Sends a signal once the history has so many rows.
  [[nodiscard]] std::function<void(pid_t)> signal_at(const std::string& directory, std::size_t rows,
                                                     int signal) const {
    return [this, directory, rows, signal](pid_t child) {
      for (int i = 0; i < 60000 && history_rows(directory) < rows; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      kill(child, signal);
    };
  }

  fs::path folder_;
};

TEST_F(Run, KilledAndRestartedGivesBitwiseTheSameHistory) {
  // The force on a driven body depends on that of the step before.
  run::RunOptions whole = options("whole"), killed = options("killed");
  whole.overrides = killed.overrides = {{"body.1.driven", "true"}, {"output.gauges_every", "7"}};
  ASSERT_EQ(run_in_child(whole), 0);
  ASSERT_GT(history_rows("whole"), 50U);

  const int status = run_in_child(killed, signal_at("killed", 30, SIGKILL));
  ASSERT_TRUE(WIFSIGNALED(status)) << "the run ended before it could be killed";
  ASSERT_LT(history_rows("killed"), history_rows("whole"));
  run::RunOptions again = options("killed");
  again.case_file.clear();
  again.restart = true;
  ASSERT_EQ(run_in_child(again), 0);
  EXPECT_EQ(first_difference(history("killed"), history("whole")), "");
  EXPECT_EQ(first_difference(gauges("killed"), gauges("whole")), "");
  EXPECT_TRUE(newest_checkpoint("killed") == newest_checkpoint("whole"));
  for (const char* run : {"whole", "killed"}) {  // columns.json describes the columns of history.csv
    const auto columns = parse_json(text(folder_ / run / "columns.json"));
    std::string head;
    for (const auto& column : columns) {
      const auto unit = column.at("unit").get<std::string>();
      head += (head.empty() ? "" : ",") + column.at("name").get<std::string>() +
              (unit.empty() ? "" : " [" + unit + "]");
    }
    const std::string table = history(run);
    EXPECT_EQ(head, table.substr(0, table.find('\n'))) << run;
  }
  // The index names the same snapshots.
  EXPECT_EQ(first_difference(text(folder_ / "killed" / "debris.particles.hdf.series"),
                             text(folder_ / "whole" / "debris.particles.hdf.series")),
            "");
}

TEST_F(Run, OneAndTwoThreadsGiveBitwiseTheSame) {
  ASSERT_EQ(run_in_child(options("one", 1)), 0);
  ASSERT_EQ(run_in_child(options("two", 2)), 0);
  EXPECT_EQ(first_difference(history("one"), history("two")), "");
  EXPECT_EQ(first_difference(gauges("one"), gauges("two")), "");
  EXPECT_TRUE(newest_checkpoint("one") == newest_checkpoint("two"));
}

TEST_F(Run, TerminationWritesACheckpointAndEndsCleanly) {
  const int status = run_in_child(options("stopped"), signal_at("stopped", 10, SIGTERM));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
  EXPECT_FALSE(fs::is_empty(folder_ / "stopped" / "checkpoint"));
}

TEST_F(Run, EnergyOutOfBoundsStopsWithTheStateSaved) {
  // MUSL loses energy in the impact; with a tight limit the run must stop, name the step, and save the state.
  run::RunOptions tight = options("tight");
  tight.overrides = {{"time.scheme", "musl"}, {"output.maximum_energy_error", "1e-6"}};
  const int status = run_in_child(tight);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const std::string error = text(folder_ / "tight" / "error.txt");
  EXPECT_NE(error.find("relative error of the total energy"), std::string::npos) << error;
  EXPECT_NE(error.find("step "), std::string::npos) << error;
  EXPECT_FALSE(fs::is_empty(folder_ / "tight" / "failed"));
}

TEST_F(Run, NothingIsOverwritten) {
  ASSERT_EQ(run_in_child(options("whole")), 0);
  const std::string before = history("whole");
  const int status = run_in_child(options("whole"));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(first_difference(history("whole"), before), "");
}

/// A ball in flight, its run ended after the first step.
class Restart : public Run {
 protected:
  void SetUp() override {
    Run::SetUp();
    fs::copy_file(whipple::tests::source_folder() + "/eos/materials/aluminium_1100_mie_gruneisen.toml",
                  folder_ / "metal.toml");
    std::ofstream(folder_ / "debris.toml") << R"(
[domain]
lower = ["-3 mm", "-3 mm", "-3 mm"]
upper = ["3 mm", "3 mm", "3 mm"]
cell_size = "1 mm"
[time]
end = "4 us"
[[body]]
name = "ball"
material = "metal.toml"
velocity = ["1 km/s", "0 m/s", "0 m/s"]
shape = { sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "2 mm" } }
[[body]]
name = "plate"
material = "metal.toml"
shape = { box = { lower = ["-3 mm", "-3 mm", "2 mm"], upper = ["3 mm", "3 mm", "3 mm"] } }
[[gauge]]
name = "rear"
kind = "moving"
position = ["1 mm", "1 mm", "1 mm"]
)";
    begin({});
  }
  void begin(const std::vector<std::pair<std::string, std::string>>& overrides) const {
    run::RunOptions first = options("run");
    first.force = true;
    first.wall_time = 1e-9;
    first.overrides = overrides;
    ASSERT_EQ(WEXITSTATUS(run_in_child(first)), 124);
  }
  /// Goes on for another step. @returns the exit code
  int restart(const std::vector<std::pair<std::string, std::string>>& changes = {}, bool force = false) {
    run::RunOptions again = options("run");
    again.case_file.clear();
    again.restart = true;
    again.force = force;
    again.wall_time = 1e-9;
    again.overrides = changes;
    fs::remove(folder_ / "run" / "error.txt");
    return WEXITSTATUS(run_in_child(again));
  }
  [[nodiscard]] std::string error() const { return text(folder_ / "run" / "error.txt"); }
  void replace(const fs::path& file, const std::string& old, const std::string& by) const {
    std::string content = text(folder_ / "run" / file);
    const std::size_t at = content.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    content.replace(at, old.size(), by);
    std::ofstream(folder_ / "run" / file, std::ios::binary) << content;
  }
};

TEST_F(Restart, WithAnotherSnapshotIntervalGoesOnAtItsMultiples) {
  begin({{"output.snapshot_every", "1 ns"}});  // the next multiple is then a large one
  run::RunOptions again = options("run");
  again.case_file.clear();
  again.restart = true;
  again.overrides = {{"output.snapshot_every", "1 us"}};
  ASSERT_EQ(run_in_child(again), 0);
  const std::string index = text(folder_ / "run" / "debris.particles.hdf.series");
  std::size_t snapshots = 0;
  for (std::size_t at = index.find("\"time\""); at != std::string::npos; at = index.find("\"time\"", at + 1))
    ++snapshots;
  EXPECT_EQ(snapshots, 6U) << "at the start, after the first step, and at 1, 2, 3 and 4 us: " << index;
}

TEST_F(Restart, WithAnotherInputIsRefusedAndNamesWhatDiffers) {
  using testing::HasSubstr;
  const io::CheckpointValues values =
      io::read_checkpoint(io::list_checkpoints(folder_ / "run" / "checkpoint").front(), MPI_COMM_SELF).values;
  const auto refused = [&](const fs::path& file, const std::string& old, const std::string& by,
                           const std::string& named) {
    const std::string before = text(folder_ / "run" / file);
    replace(file, old, by);
    try {
      run::require_same_input(cases::read_case(folder_ / "run" / "run.toml", {}), values);
      ADD_FAILURE() << "accepted: " << by;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(named), HasSubstr("put them back")));
    }
    std::ofstream(folder_ / "run" / file, std::ios::binary) << before;
  };
  refused("run.toml", "cell_size = \"0.001 m\"", "cell_size = \"0.9 mm\"",
          "domain.cell_size = \"0.0009 m\", was \"0.001 m\"");
  refused("run.toml", "radius = \"0.002 m\"", "radius = \"2.1 mm\"", "body[0].shape");
  refused("run.toml", "name = \"rear\"", "name = \"back\"", "gauge[0].name = \"back\", was \"rear\"");
  refused("materials/metal.toml", "\ngruneisen = 1.97", "\ngruneisen = 1.96",
          "the material of body \"ball\" is another");
  EXPECT_EQ(restart({{"gauge.0.position", "[\"0 m\", \"0 m\", \"0 m\"]"}}), 2);
  EXPECT_THAT(error(), HasSubstr("gauge[0].position"));
  EXPECT_EQ(restart({{"time.end", "5 us"}, {"output.snapshot_every", "2 us"}}), 124) << error();
  EXPECT_EQ(restart(), 124) << "run.toml holds the change now: " << error();
}

TEST_F(Restart, WithAMethodThatTheStateDoesNotServeNamesTheKeyAndLeavesTheInput) {
  begin({{"contact.method", "none"}});
  const std::string before = text(folder_ / "run" / "run.toml");
  EXPECT_EQ(restart({{"contact.method", "multi_field"}}), 2);
  EXPECT_THAT(error(),
              testing::HasSubstr("changed since then: contact.method = \"multi_field\", was \"none\""));
  EXPECT_EQ(text(folder_ / "run" / "run.toml"), before);
}

TEST_F(Restart, WithRowsMissingBeforeTheCheckpointIsRefusedUnlessForced) {
  const std::string whole = history("run");
  const std::size_t last_row = whole.rfind('\n', whole.size() - 2) + 1;
  std::ofstream(folder_ / "run" / "history.csv", std::ios::binary) << whole.substr(0, last_row);
  EXPECT_EQ(restart(), 2);
  EXPECT_THAT(error(), testing::HasSubstr("has 1 rows up to step 1 of the checkpoint, but 2 were written"));
  EXPECT_EQ(restart({}, true), 124) << error();
  EXPECT_EQ(restart(), 124) << "what was given up is not asked for again: " << error();
}

TEST_F(Restart, WithNumbersThatNoStateHasIsRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const fs::path path = io::list_checkpoints(folder_ / "run" / "checkpoint").front();
  const io::Checkpoint whole = io::read_checkpoint(path, MPI_COMM_SELF);
  const cases::Case setup = cases::read_case(folder_ / "run" / "run.toml", {});
  EXPECT_NO_THROW(run::require_admissible(setup, whole, MPI_COMM_SELF));
  using Forgery = std::function<void(io::Checkpoint&)>;
  const std::vector<std::pair<const char*, Forgery>> forgeries = {
      {"particles/body", [](io::Checkpoint& c) { c.particles.body[5] = 255; }},
      {"particles/damage",
       [](io::Checkpoint& c) {
         const auto& fields = material::history_fields();
         const auto damage = std::ranges::find(fields, "damage", &HistoryField::name);
         c.particles.history.declare(*damage, c.particles.size());
         c.particles.history.scalar("damage")[0] = 1.5;
       }},
      {"particles/failed", [](io::Checkpoint& c) { c.particles.failed[7] = 200; }},
      {"particles/maximum_pressure", [](io::Checkpoint& c) { c.particles.maximum_pressure[9] = nan; }},
      {"particles/melting_time", [](io::Checkpoint& c) { c.particles.melting_time[1] = -2.0; }},
      {"particles/position", [](io::Checkpoint& c) { c.particles.position[3][1] = nan; }},
      {"particles/deviatoric_stress",
       [](io::Checkpoint& c) { c.particles.deviatoric_stress[2].xy = 1.0 / 0.0; }},
      {"values/initial_mass", [](io::Checkpoint& c) { c.values.reals["initial_mass"] = nan; }},
      {"values/time", [](io::Checkpoint& c) { c.values.reals["time"] = nan; }},
      {"values/step", [](io::Checkpoint& c) { c.values.integers["step"] = -1; }},
      {"values/touched", [](io::Checkpoint& c) { c.values.arrays["touched"].assign(2, 1e300); }},
  };
  for (const auto& [named, forge] : forgeries) {
    io::Checkpoint forged = whole;
    forge(forged);
    try {
      run::require_admissible(setup, forged, MPI_COMM_SELF);
      ADD_FAILURE() << "accepted: " << named;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(named));
    }
  }
  io::Checkpoint forged = whole;
  forgeries.front().second(forged);
  io::write_checkpoint(folder_ / "run" / "checkpoint", 1, forged.particles, forged.values, MPI_COMM_SELF);
  EXPECT_EQ(restart(), 2);
  EXPECT_THAT(error(), testing::HasSubstr(forgeries.front().first));
}

}  // namespace
}  // namespace whipple
