// SPDX-License-Identifier: BSD-3-Clause
// Whatever stands in a case file: it is read or refused with an InputError, and what is read runs or ends
// with a StateError. Nothing else: no crash, no hang, no other exception. WHIPPLE_FUZZ_TRIALS sets the number
// of files (default 200), WHIPPLE_FUZZ_FIRST the first one (a trial depends on its number alone); under the
// preset dev the sanitizers watch.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/io/run_directory.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/case/build/placement.hpp"
#include "src/solver/simulation.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;

int wanted(const char* variable, int otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? std::atoi(value) : otherwise;
}

/// Seconds of the processor that this process has taken: what hangs does so on a busy machine as well.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Words of the case files, and what numbers, units and names are mistaken for.
const std::vector<std::string> words = {"0",
                                        "-1",
                                        "1e-300",
                                        "1e300",
                                        "nan",
                                        "inf",
                                        "7",
                                        "\"0 m\"",
                                        "\"1e-9 mm\"",
                                        "\"-3 km/s\"",
                                        "\"1 parsec\"",
                                        "\"5 K\"",
                                        "\"1e30 m/s\"",
                                        "true",
                                        "[]",
                                        "[1, 2, 3]",
                                        "{}",
                                        "\"symmetry\"",
                                        "\"outflow\"",
                                        "\"no_slip\"",
                                        "\"separating\"",
                                        "\"linear\"",
                                        "\"gimp\"",
                                        "\"musl\"",
                                        "\"usf\"",
                                        "\"usl\"",
                                        "\"apic\"",
                                        "\"fmpm\"",
                                        "\"copper.toml\"",
                                        "\"lead_mie_gruneisen.toml\"",
                                        "\"no_such.toml\"",
                                        "\"../..\"",
                                        "\"\"",
                                        "\"table\"",
                                        "\"cubic_bspline\"",
                                        "\"flip\"",
                                        "\"convected_gimp\""};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to three changes, most of them to a value, a key or a line: files that are almost right.
  std::string operator()(const std::string& text) {
    std::vector<std::string> lines = split(text);
    for (std::size_t i = 0, n = 1 + below(2); i < n; ++i) change(lines);
    std::string result;
    for (const std::string& line : lines) result += line + "\n";
    return result;
  }

 private:
  std::size_t below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }
  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
      if (c == '\n') {
        lines.emplace_back();
      } else {
        lines.back() += c;
      }
    }
    return lines;
  }
  void change(std::vector<std::string>& lines) {
    const std::size_t at = below(lines.size());
    std::string& line = lines[at];
    const std::size_t equals = line.find('=');
    switch (below(10)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        if (lines.empty()) lines.emplace_back();
        return;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size())), line);
        return;
      case 2:
        if (!line.empty()) line.erase(below(line.size()), 1 + below(3));
        return;
      case 3:
        if (!line.empty()) line[below(line.size())] = static_cast<char>(below(256));
        return;
      case 4:
      case 6:
      case 7:  // digits
        for (char& c : line) {
          if (c >= '0' && c <= '9' && below(3) == 0) c = static_cast<char>('0' + below(10));
        }
        return;
      case 5:
        std::swap(line, lines[below(lines.size())]);
        return;
      default:
        if (equals != std::string::npos) line = line.substr(0, equals + 1) + " " + words[below(words.size())];
    }
  }

  std::mt19937_64 random_;
};

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(WHIPPLE_SOURCE_DIR "/cases")) {
    if (fs::exists(entry.path() / "case.toml")) files.push_back(entry.path() / "case.toml");
  }
  std::ranges::sort(files);  // directories are listed in any order
  return files;
}

TEST(CaseFuzz, IsReadOrRefusedAndRunsOrEndsWithAStateError) {
  log::set_level(log::Level::quiet);
  parallel::world();
  const std::vector<fs::path> files = case_files();
  ASSERT_GE(files.size(), 10U);
  constexpr double small = 500.0 * 20000;  // bytes: runs that end soon
  constexpr double longest = 60.0;         // s
  const int trials = wanted("WHIPPLE_FUZZ_TRIALS", 200), first = wanted("WHIPPLE_FUZZ_FIRST", 0);
  int refused = 0, read = 0, run = 0, stopped = 0, slowest = first;
  double slowest_time = 0.0;
  for (int trial = first; trial < first + trials; ++trial) {
    std::mt19937_64 random(static_cast<std::uint64_t>(trial));
    const fs::path& file = files[random() % files.size()];  // materials are looked up beside it
    const std::string text = Mutator(random())(io::read_text(file));
    const double begin = processor_time();
    try {
      cases::Case setup = cases::read_case_text(text, file.string());
      ++read;
      if (cases::expected_memory(setup) < small) {
        solver::Simulation simulation(setup, parallel::world());
        for (int step = 0; step < 2 && simulation.state().time < setup.time.end; ++step) {
          simulation.advance(setup.time.end);
        }
        ++run;
      }
    } catch (const InputError& error) {
      ++refused;
      EXPECT_STRNE(error.what(), "");
    } catch (const StateError&) {
      ++stopped;
    } catch (const std::exception& error) {
      FAIL() << "trial " << trial << ": neither InputError nor StateError: " << error.what() << "\n" << text;
    }
    const double seconds = processor_time() - begin;
    EXPECT_LT(seconds, longest) << "trial " << trial << "\n" << text;
    if (seconds > slowest_time) {
      slowest_time = seconds;
      slowest = trial;
    }
  }
  std::printf(
      "%d refused, %d read, of which %d ran and %d ended with a StateError; the slowest, trial %d, took %.1f "
      "s\n",
      refused, read, run, stopped, slowest, slowest_time);
  EXPECT_GT(refused, trials / 10);
  EXPECT_GT(read, trials / 10);
}

}  // namespace
}  // namespace whipple
