// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/error.hpp"

namespace whipple::fuzz {

using Random = std::mt19937_64;

inline std::size_t any(Random& random, std::size_t below) { return random() % below; }

/// Seconds of the processor and megabytes that one input may take: a hang does so on a crowded machine as well.
constexpr int longest_trial = 60, most_memory = 1000;

/// What became of the inputs of a kind.
struct Outcomes {
  int read = 0, refused = 0, stopped = 0, faulty = 0;  ///< stopped: read, and ended with a StateError

  /// Returns whether at least these fractions were read and refused: inputs that all fail at the first character would
  /// prove little. A few inputs say nothing.
  [[nodiscard]] bool are_mixed(double least_read, double least_refused) const {
    const int all = read + refused + stopped + faulty;
    return all < 100 || (read + stopped > least_read * all && refused > least_refused * all);
  }
};

/// Feeds a reader with damaged inputs of a kind: each is read or refused with an InputError, or what is made of it ends
/// with a StateError. Fails for any other exception and for an input beyond the limits; ends the process where an input
/// does not end. A trial depends on its number alone. WHIPPLE_FUZZ_TRIALS sets how many there are, WHIPPLE_FUZZ_FIRST
/// the number of the first; with WHIPPLE_FUZZ_NAMES each is named before it begins (scripts/fuzz.py).
/// @param trials  where WHIPPLE_FUZZ_TRIALS is not set
/// @param read    called with the random numbers of the trial
template <class Read>
Outcomes try_inputs(const char* kind, int trials, Read read) {
  const auto wanted = [](const char* variable, int otherwise) {
    const char* value = std::getenv(variable);
    return value != nullptr ? std::atoi(value) : otherwise;
  };
  const auto memory = [] {  // MB, the most until now
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  };
  const auto end_within = [](int seconds) {
    const itimerval timer{{}, {seconds, 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
  };
  std::signal(SIGPROF, [](int) {
    constexpr char message[] = "no end within the limit of processor time\n";
    static_cast<void>(!::write(STDERR_FILENO, message, sizeof message - 1));
    ::_exit(124);
  });
  const int first = wanted("WHIPPLE_FUZZ_FIRST", 0);
  const bool names = std::getenv("WHIPPLE_FUZZ_NAMES") != nullptr;
  trials = wanted("WHIPPLE_FUZZ_TRIALS", trials);
  Outcomes outcomes;
  double slowest_time = 0.0;
  int slowest = first;
  for (int trial = first; trial < first + trials; ++trial) {
    if (names) std::fprintf(stderr, "%s: trial %d\n", kind, trial);
    Random random(static_cast<std::uint64_t>(trial));
    const std::clock_t begin = std::clock();
    const auto memory_before = memory();
    end_within(longest_trial);
    try {
      read(random);
      ++outcomes.read;
    } catch (const InputError& error) {
      EXPECT_GT(std::string_view(error.what()).size(), 20U)
          << kind << ", trial " << trial;  // it names what is wrong
      ++outcomes.refused;
    } catch (const StateError&) {
      ++outcomes.stopped;
    } catch (const std::exception& error) {
      ++outcomes.faulty;
      ADD_FAILURE() << kind << ", trial " << trial << ": neither InputError nor StateError: " << error.what();
    }
    end_within(0);
    EXPECT_LT(memory() - memory_before, most_memory) << kind << ", trial " << trial << ": MB";
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (seconds > slowest_time) {
      slowest_time = seconds;
      slowest = trial;
    }
  }
  std::printf("%s: %d read, %d refused, %d stopped, %d faulty; slowest: trial %d, %.1f s\n", kind,
              outcomes.read, outcomes.refused, outcomes.stopped, outcomes.faulty, slowest, slowest_time);
  return outcomes;
}

/// Returns bytes with bits flipped, blocks overwritten, the end cut off.
inline std::string damaged(std::string bytes, Random& random) {
  for (std::size_t n = 1 + any(random, 4); n > 0; --n) {
    const std::size_t at = any(random, bytes.size());
    switch (any(random, 4)) {
      case 0:
        bytes.resize(std::max<std::size_t>(at, 1));
        break;
      case 1:
        bytes.replace(at, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));  // NaN
        break;
      case 2:
        bytes.replace(at, 8, bytes.substr(any(random, bytes.size()), 8));
        break;
      default:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << any(random, 8)));
    }
  }
  return bytes;
}

/// Returns a text with words and lines replaced, doubled, left out.
inline std::string garbled(std::string text, Random& random) {
  static const std::vector<std::string> words = {"nan", "-1", "1e999", "0",    "",           "\n", ",",
                                                 ";",   "\"", "2",     "1e30", "\xc3\xa4",   "#",  "\t",
                                                 "-",   "+",  ".",     " ",    "99999999999"};
  for (std::size_t n = 1 + any(random, 4); n > 0; --n) {
    const std::size_t at = any(random, text.size()), length = any(random, 12);
    switch (any(random, 5)) {
      case 0:
        text.insert(at, text.substr(any(random, text.size()), 80));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:  // another digit: a number that means something else
        for (std::size_t i = at; i < std::min(at + 8, text.size()); ++i) {
          if (text[i] >= '0' && text[i] <= '9') text[i] = static_cast<char>('0' + any(random, 10));
        }
        break;
      default:
        text.replace(at, length, words[any(random, words.size())]);
    }
    if (text.empty()) text = "x";
  }
  return text;
}

}  // namespace whipple::fuzz
