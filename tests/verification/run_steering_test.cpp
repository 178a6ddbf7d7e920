// SPDX-License-Identifier: BSD-3-Clause
// Requests to a run, through C++ and through files: pause, extra outputs, other intervals, another end. Outputs
// change nothing of the particles, bit for bit; a bad request changes nothing at all and is answered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/pattern.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/material_copies.hpp"
#include "src/run/observers/checkpoints.hpp"
#include "src/run/observers/history.hpp"
#include "src/run/observers/input_record.hpp"
#include "src/run/observers/snapshots.hpp"
#include "src/run/observers/status_file.hpp"
#include "src/run/replay_control.hpp"
#include "src/run/runner.hpp"
#include "src/run/status.hpp"
#include "tests/folders.hpp"
#include "tests/unit/ball_on_plate.hpp"
#include "tests/unit/folder_test.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream text(text_of(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Asks for something after given steps; while the run is paused, for the next thing of the same step.
class Script : public RunControl {
 public:
  explicit Script(std::multimap<std::int64_t, Request> requests) : requests_(std::move(requests)) {}
  void ask(const Moment& moment, Requests& requests) override {
    const auto next = requests_.lower_bound(moment.step());
    if (next == requests_.end() || next->first != moment.step()) return;
    requests.steering = next->second;
    requests_.erase(next);
  }

 private:
  std::multimap<std::int64_t, Request> requests_;
};

/// Counts how often a paused run is looked at.
class Watch : public RunObserver {
 public:
  explicit Watch(std::vector<std::int64_t>& paused) : paused_(paused) {}
  void after_step(const Moment& moment) override {
    if (moment.paused) paused_.push_back(moment.step());
  }

 private:
  std::vector<std::int64_t>& paused_;
};

class Steering : public ::testing::Test {
 protected:
  void SetUp() override { log::set_level(log::Level::quiet); }

  struct Result {
    int code = -1;
    double time = 0.0;
    std::int64_t steps = 0;
    std::vector<Vector3> positions, velocities;
    std::vector<std::int64_t> history;  // steps of the rows
    std::vector<double> snapshots;      // times, us
    std::vector<std::int64_t> paused;   // steps, one for each look
    std::size_t checkpoints = 0;
    fs::path folder;
  };

  /// Runs the case in a new folder; `files` are put into its folder control/ before.
  Result run(std::multimap<std::int64_t, Request> script,
             const std::vector<std::pair<std::string, std::string>>& files = {},
             RunControl* replay = nullptr) {
    Result result;
    result.folder = temporary_.path() / std::to_string(++runs_);
    const cases::Case setup = ball_on_plate();
    const io::Ranks ranks(parallel::world());
    const io::RunDirectory directory = io::RunDirectory::create(result.folder, "ball", false);
    directory.write_input(cases::to_toml(setup, material_copies(setup)) +
                          "\n[provenance]\nprogram = \"test\"\n");
    solver::Simulation simulation(setup, parallel::world());
    Observers observers;
    observers.push_back(std::make_unique<Watch>(result.paused));
    observers.push_back(std::make_unique<InputRecord>(directory, ranks));
    observers.push_back(std::make_unique<HistoryTable>(
        setup, Table::Options{directory.history_file(), "history_rows", &Schedule::history_every}, ranks));
    observers.push_back(std::make_unique<Snapshots>(setup, directory, simulation.communicator()));
    observers.push_back(std::make_unique<Checkpoints>(directory));
    observers.push_back(std::make_unique<StatusFile>(directory, "test", ranks));
    Runner runner(simulation, std::move(observers));
    runner.begin();
    Script control(std::move(script));
    DirectoryControl requests(directory, std::chrono::seconds(0));
    for (const auto& [name, content] : files) std::ofstream(directory.control_folder() / name) << content;
    std::vector<RunControl*> controls = {&control, &requests};
    if (replay != nullptr) controls.push_back(replay);
    result.code = runner.run(controls);
    result.time = simulation.state().time;
    result.steps = simulation.state().step;
    result.positions = simulation.particles().position;
    result.velocities = simulation.particles().velocity;
    for (const std::string& line : lines_of(directory.history_file())) {
      if (!line.starts_with("step")) result.history.push_back(std::stoll(line));
    }
    const auto index = parse_json(text_of(result.folder / "ball.particles.hdf.series"));
    for (const auto& entry : index.at("files"))
      result.snapshots.push_back(1e6 * entry.at("time").get<double>());
    result.checkpoints = io::list_checkpoints(directory.checkpoint_folder()).size();
    return result;
  }

  static void expect_same_particles(const Result& a, const Result& b) {
    ASSERT_EQ(a.steps, b.steps);
    ASSERT_EQ(a.positions.size(), b.positions.size());
    const std::size_t bytes = a.positions.size() * sizeof(Vector3);
    EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), bytes), 0);
    EXPECT_EQ(std::memcmp(a.velocities.data(), b.velocities.data(), bytes), 0);
  }

  TemporaryFolder temporary_;
  int runs_ = 0;
};

TEST_F(Steering, OutputsAndPausesChangeNothingOfTheParticles) {
  const Result free = run({});
  ASSERT_GT(free.steps, 12);
  EXPECT_EQ(free.snapshots.size(), 2U);  // at the start and at the end
  EXPECT_EQ(free.checkpoints, 1U);
  EXPECT_EQ(free.history.size(), static_cast<std::size_t>(free.steps) + 1);

  const Result steered = run({{2, {Act::snapshot}},
                              {3, {Act::history_every, 4.0}},
                              {5, {Act::pause}},
                              {5, {Act::snapshot}},
                              {5, {Act::checkpoint}},
                              {5, {Act::resume}},
                              {9, {Act::checkpoint_every, 0.0}}});
  EXPECT_EQ(steered.code, 0);
  EXPECT_EQ(steered.time, free.time);
  expect_same_particles(free, steered);
  EXPECT_EQ(steered.snapshots.size(), 4U);
  EXPECT_EQ(steered.checkpoints, 2U);
  EXPECT_THAT(std::vector(steered.history.begin(), steered.history.begin() + 6),
              ElementsAre(0, 1, 2, 4, 8, 12));
  EXPECT_EQ(steered.history.back(), steered.steps);
  EXPECT_THAT(steered.paused, ElementsAre(5, 5, 5)) << "resumed at the fourth look";
}

TEST_F(Steering, SnapshotsLieAtTheMultiplesOfTheirIntervalAndCostAStepEach) {
  const Result free = run({});
  const Result result = run({{4, {Act::snapshot_every, 0.1e-6}}});
  ASSERT_EQ(result.snapshots.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(result.snapshots[i], 0.1 * static_cast<double>(i), 1e-12);
  EXPECT_LE(result.steps, free.steps + 4);
}

TEST_F(Steering, AMultipleThatIsTheEndButForRoundOffIsTheEnd) {
  const Result free = run({});
  std::size_t parts = 2;
  while (parts < 60 && static_cast<double>(parts) * (free.time / static_cast<double>(parts)) >= free.time)
    ++parts;
  ASSERT_LT(parts, 60U) << "no interval whose multiple lies below the end";
  const Result result = run({{1, {Act::snapshot_every, free.time / static_cast<double>(parts)}}});
  EXPECT_EQ(result.snapshots.size(), parts + 1);
  EXPECT_EQ(result.time, free.time);
}

TEST_F(Steering, EndNowEndsAsAWholeRunDoes) {
  const Result result = run({{6, {Act::end}}});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.steps, 6);
  EXPECT_EQ(result.history.back(), 6);
  EXPECT_EQ(result.snapshots.size(), 2U);
  EXPECT_EQ(result.checkpoints, 1U);
  EXPECT_EQ(read_status(result.folder).state, Activity::done);
}

TEST_F(Steering, StopCanBeContinued) {
  const Result result = run({{6, {Act::stop}}});
  EXPECT_EQ(result.code, 128 + 15);
  EXPECT_EQ(result.steps, 6);
  EXPECT_EQ(result.checkpoints, 1U);
  EXPECT_EQ(read_status(result.folder).state, Activity::stopped);
}

TEST_F(Steering, AReplayIsTheSteeredRunBitForBit) {
  const Result free = run({});
  const Result steered = run({}, {{"1.toml", "request = \"snapshot_every\"\nvalue = \"0.07 us\"\n"},
                                  {"2.toml", "request = \"pause\"\n"},
                                  {"3.toml", "request = \"nonsense\"\n"},
                                  {"4.toml", "request = \"history_every\"\nvalue = \"2\"\n"},
                                  {"5.toml", "request = \"resume\"\n"},
                                  {"6.toml", "request = \"end\"\nvalue = \"0.31 us\"\n"}});
  ReplayControl replay(steered.folder / "steering.csv");
  const Result again = run({}, {}, &replay);
  expect_same_particles(steered, again);
  EXPECT_NE(steered.steps, free.steps);  // the requests changed something
  EXPECT_EQ(text_of(steered.folder / "history.csv"), text_of(again.folder / "history.csv"));
  EXPECT_EQ(steered.snapshots, again.snapshots);
}

TEST_F(Steering, ATableThatCannotBeRepeatedIsRefused) {
  const fs::path table = temporary_.path() / "steering.csv";
  const auto refused = [&](const std::string& content) {
    std::ofstream(table) << content;
    try {
      ReplayControl replay(table);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string head = std::string(DirectoryControl::header) + "\n";
  EXPECT_EQ(refused(head), "");
  EXPECT_THAT(refused("step\n"), HasSubstr("is no steering.csv"));
  EXPECT_THAT(refused(head + "0,1,a,pause,,accepted\n"),
              HasSubstr("steering.csv:2: error: expected 7 cells"));
  EXPECT_THAT(refused(head + "0,x,a,pause,,accepted,\n"), HasSubstr("number of a step"));
  EXPECT_THAT(refused(head + "0,5,a,pause,,accepted,\n0,4,b,resume,,accepted,\n"),
              HasSubstr(":3: error: step 4 after step 5"));
  EXPECT_THAT(refused(head + "0,5,a,end,1 kg,accepted,\n"), HasSubstr(":2: error: "));
}

/// A signal that comes while a run is paused.
class SignalAtPause : public RunControl {
 public:
  void ask(const Moment& moment, Requests& requests) override {
    if (moment.paused) requests.signal = 15;
    if (moment.step() == 4) requests.steering = {Act::pause};
  }
};

TEST_F(Steering, APausedRunEndsByASignal) {
  solver::Simulation simulation(ball_on_plate(), parallel::world());
  std::vector<std::int64_t> paused;
  Observers observers;
  observers.push_back(std::make_unique<Watch>(paused));
  Runner runner(simulation, std::move(observers));
  runner.begin();
  SignalAtPause control;
  const std::vector<RunControl*> controls = {&control};
  EXPECT_EQ(runner.run(controls), 128 + 15);
  EXPECT_EQ(simulation.state().step, 4);
  EXPECT_THAT(paused, ElementsAre(4, 4));
}

TEST_F(Steering, AnotherEndIsReachedExactlyAndStandsInTheInput) {
  const Result result = run({{3, {Act::end, 0.25e-6}}});
  EXPECT_NEAR(result.time, 0.25e-6, 1e-20);
  EXPECT_THAT(text_of(result.folder / "run.toml"), HasSubstr("\nend = \"2.5e-07 s\""));
  EXPECT_THAT(text_of(result.folder / "run.toml"), HasSubstr("program = \"test\""));
}

TEST_F(Steering, RequestsInFilesAreAnsweredOneByOne) {
  const Result free = run({});
  const Result steered = run({}, {{"1.toml", "request = \"snapshot\"\n"},
                                  {"2.toml", "request = \"history_every\"\nvalue = \"3\"\n"},
                                  {"3.toml", "request = \"pause\"\n"},
                                  {"4.toml", "request = \"resume\"\n"},
                                  {"notes.txt", "not a request"}});
  expect_same_particles(free, steered);
  EXPECT_EQ(steered.snapshots.size(), 3U);
  const std::vector<std::string> answers = lines_of(steered.folder / "steering.csv");
  ASSERT_EQ(answers.size(), 5U);
  EXPECT_EQ(answers[0], "time [s],step,file,request,value,answer,detail");
  EXPECT_THAT(answers[1], HasSubstr(",1,1.toml,snapshot,,accepted,"));
  EXPECT_THAT(answers[2], HasSubstr(",2,2.toml,history_every,3,accepted,was 1"));
  EXPECT_THAT(answers[3], HasSubstr(",3,3.toml,pause,,accepted,"));
  EXPECT_THAT(answers[4], HasSubstr(",3,4.toml,resume,,accepted,"));
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(steered.folder / "control"))
    left.push_back(entry.path().filename());
  EXPECT_THAT(left, ElementsAre("notes.txt"));
}

TEST_F(Steering, ABadRequestIsAnsweredAndChangesNothing) {
  const Result free = run({});
  const Result steered = run({}, {{"1.toml", "request = \"snapshots\"\n"},
                                  {"2.toml", "request = \"end\"\nvalue = \"3 mm\"\n"},
                                  {"3.toml", "request = \"snapshot_every\"\nvalue = \"-1 us\"\n"},
                                  {"4.toml", "request = \"history_every\"\nvalue = \"0\"\n"},
                                  {"5.toml", "request = \"resume\"\n"},
                                  {"6.toml", "request = [\n"},
                                  {"7.toml", "request = \"end\"\nvalue = \"1e-12 s\"\n"},
                                  {"8.toml", "demand = \"end\"\n"},
                                  {"9.toml", "request = \"pause\"\nvalue = \"1 s\"\n"}});
  expect_same_particles(free, steered);
  EXPECT_EQ(free.snapshots, steered.snapshots);
  EXPECT_EQ(free.history, steered.history);
  EXPECT_EQ(text_of(free.folder / "run.toml"), text_of(steered.folder / "run.toml"));
  const std::string answers = text_of(steered.folder / "steering.csv");
  EXPECT_EQ(lines_of(steered.folder / "steering.csv").size(), 10U) << answers;
  for (const char* reason :
       {"did you mean \"\"snapshot\"\"?", "mm", "must be >= 0 s", "must be >= 1 and <= 1",
        "the run is not paused", "6.toml", "already", "unknown key", "takes no value"}) {
    EXPECT_THAT(answers, HasSubstr(reason));
  }
  EXPECT_TRUE(fs::is_empty(steered.folder / "control"));
}

/// Puts a request into the folder control/ when the run has made its last step.
class LateRequest : public RunObserver {
 public:
  explicit LateRequest(fs::path folder) : folder_(std::move(folder)) {}
  void end(const Moment&, Outcome&) override {
    std::ofstream(folder_ / "late.toml") << "request = \"pause\"\n";
  }

 private:
  fs::path folder_;
};

TEST_F(Steering, ARequestAfterTheLastStepIsRefused) {
  const fs::path folder = temporary_.path() / "late";
  const cases::Case setup = ball_on_plate();
  const io::RunDirectory directory = io::RunDirectory::create(folder, "ball", false);
  solver::Simulation simulation(setup, parallel::world());
  Observers observers;
  observers.push_back(std::make_unique<LateRequest>(directory.control_folder()));
  Runner runner(simulation, std::move(observers));
  runner.begin();
  DirectoryControl requests(directory, std::chrono::seconds(3600));
  const std::vector<RunControl*> controls = {&requests};
  EXPECT_EQ(runner.run(controls), 0);
  EXPECT_THAT(text_of(folder / "steering.csv"), HasSubstr("late.toml,pause,,refused,the run has ended"));
  EXPECT_TRUE(fs::is_empty(folder / "control"));
}

TEST_F(Steering, TheStatusTellsHowFarARunIs) {
  const Result result = run({});
  const RunStatus status = read_status(result.folder);
  EXPECT_EQ(status.state, Activity::done);
  EXPECT_EQ(status.time, result.time);
  EXPECT_EQ(status.step, result.steps);
  EXPECT_EQ(status.end, ball_on_plate().time.end);
  EXPECT_GT(status.wall_time, 0.0);
  EXPECT_EQ(status.time_left, 0.0);
  EXPECT_EQ(status.revision, "test");
}

TEST_F(Steering, TheStatusOfARunThatNoProcessHoldsIsLost) {
  RunStatus status;
  status.state = Activity::running;
  status.step = 7;
  status.message = "with \"quotes\"";
  write_status(temporary_.path() / "status.json", status);
  const RunStatus read = read_status(temporary_.path());
  EXPECT_EQ(read.state, Activity::lost);
  EXPECT_EQ(read.step, 7);
  EXPECT_EQ(read.message, status.message);
  EXPECT_EQ(read.time_left, std::nullopt);
  const auto lock = io::lock_run(temporary_.path());
  EXPECT_EQ(read_status(temporary_.path()).state, Activity::running);
  EXPECT_TRUE(any_goes_on(temporary_.path()));
  const std::string text = read_text(temporary_.path() / "status.json");
  EXPECT_THAT(text, HasSubstr("\"state\": \"running\""));
  std::ofstream(temporary_.path() / "status.json") << Pattern("running").replace(text, "asleep");
  EXPECT_THROW((void)read_status(temporary_.path()), InputError);
  EXPECT_FALSE(any_goes_on(temporary_.path()));
  std::ofstream(temporary_.path() / "status.json") << "{}";
  EXPECT_THROW((void)read_status(temporary_.path()), InputError);
}

TEST_F(Steering, WithoutARunNothingCanBeAsked) {
  EXPECT_THROW(steer(temporary_.path(), "snapshot", ""), InputError);
  std::ofstream(temporary_.path() / "run.toml") << "";
  EXPECT_THROW(steer(temporary_.path(), "snapshot", ""), InputError) << "no process holds the folder";
  fs::create_directory(temporary_.path() / "control");
  const auto lock = io::lock_run(temporary_.path());
  EXPECT_THROW(steer(temporary_.path(), "snapshot", "2"), InputError);
  EXPECT_TRUE(fs::is_empty(temporary_.path() / "control"));
  steer(temporary_.path(), "end", "3 us");
  const fs::path file = fs::directory_iterator(temporary_.path() / "control")->path();
  const RequestWords words = read_request(file);
  EXPECT_EQ(words.request, "end");
  EXPECT_EQ(words.value, "3 us");
}

/// Fails in the second step.
template <class Error>
class Fails : public RunObserver {
 public:
  void after_step(const Moment& moment) override {
    if (moment.step() == 2) throw Error("out of range");
  }
};

class Ends : public RunObserver {
 public:
  explicit Ends(std::optional<Outcome>& outcome) : outcome_(outcome) {}
  void end(const Moment&, Outcome& outcome) override {
    outcome.message += "; noted";
    outcome_ = outcome;
  }

 private:
  std::optional<Outcome>& outcome_;
};

template <class Error>
std::string message_of_failure(Outcome::Kind expected) {
  solver::Simulation simulation(ball_on_plate(), parallel::world());
  std::optional<Outcome> seen;
  Observers observers;
  observers.push_back(std::make_unique<Fails<Error>>());
  observers.push_back(std::make_unique<Ends>(seen));
  Runner runner(simulation, std::move(observers));
  runner.begin();
  const std::string message = message_of<Error>([&] { runner.run({}); });
  EXPECT_TRUE(seen.has_value() && seen->kind == expected);
  return message;
}

TEST_F(Steering, ObserversSeeTheFailureOfARun) {
  EXPECT_EQ(message_of_failure<StateError>(Outcome::Kind::left_range), "out of range; noted");
  EXPECT_THAT(message_of_failure<ResourceError>(Outcome::Kind::out_of_resources),
              testing::StartsWith("out of range\n  stopped at step 2,"));
}

TEST(Requests, StandInTheManual) {
  const std::string manual = text_of(whipple::tests::source_folder() + "/docs/manual/output.md");
  for (const ActEntry& entry : acts())
    EXPECT_THAT(manual,
                HasSubstr("| `" + std::string(entry.word) + "` | " + std::string(entry.meaning) + " |"));
}

}  // namespace
}  // namespace whipple::run
