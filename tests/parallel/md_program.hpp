// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

/// whipple-md as its users start it, alone or under mpirun.
namespace whipple::md::testing {

struct Outcome {
  int code = -1;
  std::string text;  // standard output and standard error
};

/// mpirun in containers (root), with more ranks than cores, without threads.
inline void set_mpi_environment() {
  for (const char* name :
       {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe",
        "OMPI_MCA_mpi_yield_when_idle", "OMP_NUM_THREADS"}) {
    setenv(name, "1", 1);
  }
}

inline Outcome run(const std::string& command) {
  set_mpi_environment();
  Outcome outcome;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  while (pipe != nullptr && fgets(buffer.data(), buffer.size(), pipe) != nullptr)
    outcome.text += buffer.data();
  const int status = pipe == nullptr ? -1 : pclose(pipe);
  if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
  return outcome;
}

inline std::string mpirun(int ranks, const std::string& command) {
  return std::string(WHIPPLE_MPIEXEC) + " -n " + std::to_string(ranks) + " " + command;
}

inline constexpr const char* plan_text = R"(
title = "test"
element = "Cu"
potential = "copper_universal_3"
[zero_pressure_volume]
cells = 3
equilibration_steps = 200
steps = 400
[[isotherm]]
volume_ratio = [1.0, 0.9, 0.8]
cells = 3
equilibration_steps = 100
steps = 400
[hugoniot]
volume_ratio = [0.9, 0.8]
cells = 3
equilibration_steps = 100
steps = 400
)";

class WhippleMd : public ::testing::Test {
 public:
  void SetUp() override { write("plan.toml", plan_text); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  }
  std::string path(const std::string& name) { return (folder.path() / name).string(); }
  std::string command(const std::string& store) {
    return whipple::tests::program("whipple-md") + " " + path("plan.toml") + " -o " + path(store);
  }
  TemporaryFolder folder;
};

inline void expect_same_points(std::vector<PointRecord> first, std::vector<PointRecord> second) {
  ASSERT_EQ(first.size(), second.size());
  const auto by_key = [](const PointRecord& a, const PointRecord& b) { return a.key < b.key; };
  std::sort(first.begin(), first.end(), by_key);
  std::sort(second.begin(), second.end(), by_key);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].key, second[i].key);
    EXPECT_TRUE(first[i].done());
    for (const auto& [name, estimate] : first[i].results) {
      EXPECT_EQ(estimate.value, second[i].result(name).value) << first[i].label() << " " << name;
      EXPECT_EQ(estimate.error, second[i].result(name).error) << first[i].label() << " " << name;
    }
  }
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Processes whose parent, or whose parent's parent, is a process (mpirun starts its ranks itself), by /proc.
inline std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream status(entry.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("PPid:", 0) == 0 && std::atoi(line.c_str() + 5) == parent)
        found.push_back(std::atoi(name.c_str()));
    }
  }
  return found;
}

inline std::size_t points_in(const std::string& store) {
  return std::filesystem::exists(store) ? read_store(store).size() : 0;
}

/// Starts the plan on two ranks and ends a worker or mpirun itself with SIGKILL, `kills` times with one
/// store; then lets it finish. Half of the kills come at a random moment after the start, half at a random
/// moment after one more point was stored, however busy the machine. The store must have the bytes of an
/// undisturbed one.
inline void kill_at_random(WhippleMd& test, int kills) {
  ASSERT_EQ(run(test.command("whole.md.h5")).code, 0);
  set_mpi_environment();
  std::mt19937 generator(20);
  std::uniform_real_distribution<double> moment(0.0, 1.0);
  const std::string program = whipple::tests::program("whipple-md");
  const std::string plan = test.path("plan.toml");
  const std::string store = test.path("killed.md.h5");
  const std::size_t all = points_in(test.path("whole.md.h5"));
  std::size_t stored = 0;
  int at_work = 0;
  for (int i = 0; i < kills; ++i) {
    std::fflush(stdout);  // or the child would print it again
    const pid_t driver = fork();
    if (driver == 0) {
      if (std::freopen("/dev/null", "w", stderr) == nullptr ||
          std::freopen("/dev/null", "w", stdout) == nullptr)
        _exit(1);
      execl(WHIPPLE_MPIEXEC, WHIPPLE_MPIEXEC, "-n", "2", program.c_str(), plan.c_str(), "-o", store.c_str(),
            nullptr);
      _exit(1);
    }
    const auto pause = [](double seconds) {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    };
    if (i % 2 == 1) {
      pause(0.2 + 1.2 * moment(generator));
    } else {
      for (int k = 0; k < 6000 && points_in(store) == stored && stored < all; ++k) pause(0.01);
      pause(0.2 * moment(generator));
    }
    const std::vector<pid_t> workers = children_of(driver);
    const bool kill_worker = i % 4 < 2 && !workers.empty();
    kill(kill_worker ? workers[static_cast<std::size_t>(i / 4) % workers.size()] : driver, SIGKILL);
    int status = 0;
    waitpid(driver, &status, 0);
    for (const pid_t worker : workers) kill(worker, SIGKILL);  // what mpirun leaves behind when it is killed
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (!std::filesystem::exists(store)) continue;
    const std::vector<PointRecord> points = read_store(store);
    std::printf("  SIGKILL %d, %s: %zu of %zu points in the store\n", i + 1,
                kill_worker ? "a worker" : "mpirun", points.size(), all);
    if (!points.empty() && points.size() < all) ++at_work;
    EXPECT_GE(points.size(), stored) << "a point was lost";
    stored = points.size();
    std::vector<std::string> keys;
    for (const PointRecord& point : points) keys.push_back(point.key);
    std::sort(keys.begin(), keys.end());
    EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end()) << "a point was doubled";
  }
  EXPECT_GE(at_work, kills / 2 - 1) << "the kills did not hit a plan at work";
  const Outcome rest = run(mpirun(2, test.command("killed.md.h5")));
  EXPECT_EQ(rest.code, 0) << rest.text;
  EXPECT_EQ(bytes_of(store), bytes_of(test.path("whole.md.h5")));
}

}  // namespace whipple::md::testing
