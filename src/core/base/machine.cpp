// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/machine.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <thread>

#include "src/core/base/log.hpp"

namespace whipple {
namespace {

/// Returns the number of processors allowed by the control group of a container; infinite without a limit.
double quota() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");  // "200000 100000" or "max 100000", microseconds
  double time = 0.0, period = 0.0;
  return file >> time >> period && period > 0.0 ? time / period : HUGE_VAL;
}

}  // namespace

int usable_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  const int count = sched_getaffinity(0, sizeof allowed, &allowed) == 0
                        ? CPU_COUNT(&allowed)
                        : static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, static_cast<int>(std::min<double>(count, std::ceil(quota()))));
}

int threads_of_environment() {
  constexpr int most = 4096;
  for (const char* variable : {"OMP_NUM_THREADS", "SLURM_CPUS_PER_TASK"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value == '\0') continue;
    const std::string_view text(value);
    const std::string_view first = text.substr(0, text.find(','));  // "4,2": one number per nesting level
    int threads = 0;
    const auto [end, fault] = std::from_chars(first.data(), first.data() + first.size(), threads);
    if (fault == std::errc{} && end == first.data() + first.size() && threads >= 1 && threads <= most)
      return threads;
    log::warning("{} is '{}', expected a number from 1 to {}: ignored", variable, text, most);
  }
  return 0;
}

std::string processor_set() {
  std::array<char, 256> machine{};
  gethostname(machine.data(), machine.size() - 1);
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  return fmt::format("{} {}", machine.data(),
                     std::string_view(reinterpret_cast<const char*>(&allowed), sizeof allowed));
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace whipple
