// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/machine.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "src/bench/reference_kernel.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/registers.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int repetitions = 5;

template <class Work>
double best_seconds(Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repetitions; ++repeat) {
    const Clock::time_point begin = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return best;
}

/// Measures bytes per second of the STREAM triad (McCalpin, IEEE TCCA Newsletter, 1995): two arrays read, one written.
double triad() {
  constexpr std::size_t n = std::size_t{1} << 24;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  const double seconds =
      best_seconds([&] { parallel::for_each(n, [&](std::size_t i) { a[i] = b[i] + 3.0 * c[i]; }); });
  if (a[n / 2] != 7.0) throw InternalError("the triad computed nothing");
  return 3.0 * sizeof(double) * static_cast<double>(n) / seconds;
}

/// Measures flops per second of independent chains, enough of them to hide the latency of a multiply-add (four cycles
/// on two units).
double multiply_adds(int threads) {
  constexpr int chains = 12;
  constexpr long rounds = 2'000'000;
  std::vector<double> results(static_cast<std::size_t>(threads));
  const double seconds = best_seconds([&] {
    parallel::for_each(results.size(), [&](std::size_t thread) {
      std::array<Lanes, chains> x{};
      Lanes factor = broadcast(0.999999 + 1e-9 * static_cast<double>(thread)), term = broadcast(1e-6);
      asm volatile("" : "+m"(factor), "+m"(term));  // unknown to the compiler, so nothing folds
      for (long i = 0; i < rounds; ++i) {
        for (Lanes& chain : x) chain = chain * factor + term;
      }
      Lanes sum = broadcast(0.0);
      for (const Lanes& chain : x) sum += chain;
      results[thread] = sum3(sum);
    });
  });
  for (const double result : results) {
    if (!(result > 0.0)) throw InternalError("the multiply-adds computed nothing");
  }
  return 2.0 * 4.0 * chains * static_cast<double>(rounds) * threads / seconds;
}

/// Measures the reference kernel on all threads. Cores may differ in speed, and other processes may slow some of them:
/// the rate of the machine is the sum of the rates of the threads.
double reference_kernel(int threads) {
  std::vector<double> seconds(static_cast<std::size_t>(threads));
  parallel::for_each(seconds.size(),
                     [&](std::size_t thread) { seconds[thread] = measure_reference_kernel(); });
  double rate = 0.0;
  for (const double of_thread : seconds) rate += 1.0 / of_thread;
  return 1.0 / rate;
}

}  // namespace

MachineRates measure_machine(int threads) {
  parallel::set_threads(threads);
  return {.bandwidth = triad(),
          .arithmetic = multiply_adds(threads),
          .reference_kernel = reference_kernel(threads)};
}

}  // namespace whipple::bench
