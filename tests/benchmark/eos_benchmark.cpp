// SPDX-License-Identifier: BSD-3-Clause
// Nanoseconds per point of a batch call, by phase. Compare ratios on one machine, never times of two.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "eos/table/builder.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/eos_support.hpp"

namespace {

using namespace whipple::eos;

struct Region {
  double volume_ratio, energy;  ///< V/V0, J/kg
};

void evaluate(benchmark::State& bench, const EquationOfState& eos, Region region) {
  constexpr std::size_t n = 4096;
  std::vector<double> rho(n), e(n), P(n), T(n), c(n), melted(n), vapour(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> spread(0.99, 1.01);
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] = eos.reference_density() / (region.volume_ratio * spread(random));
    e[i] = region.energy * spread(random);
  }
  for (auto _ : bench) {
    benchmark::DoNotOptimize(eos.evaluate({rho, e, P, T, c, melted, vapour}));
    benchmark::ClobberMemory();
  }
  bench.SetLabel(std::string(eos.state(rho[0], e[0]).phase));
  bench.counters["ns/point"] = benchmark::Counter(
      n * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Random states over the phases, one after the other in no order.
void evaluate_spread(benchmark::State& bench, const EquationOfState& eos, double least_ratio,
                     double greatest_ratio, double hottest) {
  constexpr std::size_t n = 4096;
  std::vector<double> rho(n), e(n), P(n), T(n), c(n), melted(n), vapour(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] = eos.reference_density() / (least_ratio + (greatest_ratio - least_ratio) * uniform(random));
    const double from = eos.state_at_temperature(rho[i], 300).specific_internal_energy;
    const double to = eos.state_at_temperature(rho[i], hottest).specific_internal_energy;
    e[i] = from + (to - from) * uniform(random);
  }
  for (auto _ : bench) {
    benchmark::DoNotOptimize(eos.evaluate({rho, e, P, T, c, melted, vapour}));
    benchmark::ClobberMemory();
  }
  bench.counters["ns/point"] = benchmark::Counter(
      n * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const test::GrayEos& copper_eos() {
  static const test::GrayEos eos(test::copper());
  return eos;
}
const test::MieGruneisenEos& aluminium_eos() {
  static const test::MieGruneisenEos eos(test::aluminium_2024());
  return eos;
}

const Table& copper_table() {
  static const Table table(tabulate(copper_eos(), {}));
  return table;
}

void gray_solid(benchmark::State& s) { evaluate(s, copper_eos(), {0.9, 3e5}); }
void gray_melting(benchmark::State& s) { evaluate(s, copper_eos(), {0.8, 1.93e6}); }
void gray_liquid(benchmark::State& s) { evaluate(s, copper_eos(), {0.8, 3e6}); }
void gray_hot_liquid(benchmark::State& s) { evaluate(s, copper_eos(), {1.1, 8e6}); }
void gray_vapour(benchmark::State& s) { evaluate(s, copper_eos(), {50, 8e6}); }
void gray_solid_melt_liquid(benchmark::State& s) { evaluate_spread(s, copper_eos(), 0.6, 1.2, 8000); }
void gray_all_phases(benchmark::State& s) { evaluate_spread(s, copper_eos(), 0.6, 3.0, 20000); }
void gray_equilibrium_melting(benchmark::State& s) {
  static const test::GrayEos eos(test::copper(MeltingTransition::equilibrium));
  evaluate(s, eos, {0.8, 1.93e6});
}
void gray_dome(benchmark::State& s) { evaluate(s, copper_eos(), {5, 3.5e6}); }
void debye_gruneisen(benchmark::State& s) {
  static const ModelEquationOfState<DebyeGruneisen> eos(test::debye_copper());
  evaluate(s, eos, {0.9, 3e5});
}
void mie_gruneisen_spread(benchmark::State& s) { evaluate_spread(s, aluminium_eos(), 0.5, 2.0, 8000); }
void mie_gruneisen(benchmark::State& s) { evaluate(s, aluminium_eos(), {0.9, 3e5}); }
BENCHMARK(gray_solid);
BENCHMARK(gray_melting);
BENCHMARK(gray_liquid);
BENCHMARK(gray_hot_liquid);
BENCHMARK(gray_vapour);
BENCHMARK(gray_dome);
BENCHMARK(gray_solid_melt_liquid);
BENCHMARK(gray_all_phases);
BENCHMARK(gray_equilibrium_melting);
BENCHMARK(debye_gruneisen);
BENCHMARK(mie_gruneisen);
BENCHMARK(mie_gruneisen_spread);

template <class M>
void of(benchmark::State& s, const typename M::Constants& constants, Region region) {
  evaluate(s, ModelEquationOfState<M>(constants), region);
}
void mie_gruneisen_expanded(benchmark::State& s) { of<MieGruneisen>(s, test::aluminium_2024(), {1.2, 1e6}); }
void tillotson(benchmark::State& s) { of<Tillotson>(s, test::aluminium_tillotson(), {0.9, 1e6}); }
void tillotson_vapour(benchmark::State& s) { of<Tillotson>(s, test::aluminium_tillotson(), {5, 2e7}); }
void jwl(benchmark::State& s) { of<Jwl>(s, test::tnt(), {2, 2e6}); }
void tait(benchmark::State& s) { of<Tait>(s, test::water_tait(), {0.9, 1e5}); }
void ideal_gas(benchmark::State& s) { of<IdealGas>(s, test::air(), {2, 3e5}); }
BENCHMARK(mie_gruneisen_expanded);
BENCHMARK(tillotson);
BENCHMARK(tillotson_vapour);
BENCHMARK(jwl);
BENCHMARK(tait);
BENCHMARK(ideal_gas);
/// States over all phases and the whole range of the table, in random order.
void spread(benchmark::State& bench, const EquationOfState& eos, bool with_fractions) {
  constexpr std::size_t n = 4096;
  const Table& table = copper_table();
  std::vector<double> rho(n), e(n), P(n), T(n), c(n), melted(with_fractions ? n : 0),
      vapour(with_fractions ? n : 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] =
        table.minimum_density() * std::pow(table.maximum_density() / table.minimum_density(), share(random));
    const double w = table.data().thermal_energy, base = table.minimum_energy(rho[i]) - w;
    e[i] = base + w * std::pow((table.maximum_energy(rho[i]) - base) / w, 0.999 * share(random));
  }
  for (auto _ : bench) {
    benchmark::DoNotOptimize(eos.evaluate({rho, e, P, T, c, melted, vapour}));
    benchmark::ClobberMemory();
  }
  bench.counters["ns/point"] = benchmark::Counter(
      n * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  bench.counters["kB"] = static_cast<double>(table.data().size()) * 1e-3;
}
void table_spread(benchmark::State& s) { spread(s, copper_table(), false); }
void table_spread_fractions(benchmark::State& s) { spread(s, copper_table(), true); }
void gray_spread_fractions(benchmark::State& s) { spread(s, copper_eos(), true); }
void build_table(benchmark::State& bench) {
  for (auto _ : bench) benchmark::DoNotOptimize(tabulate(copper_eos(), {}));
}
BENCHMARK(table_spread);
BENCHMARK(table_spread_fractions);
BENCHMARK(gray_spread_fractions);
BENCHMARK(build_table)->Unit(benchmark::kMillisecond);

void build_gray(benchmark::State& bench) {
  for (auto _ : bench) benchmark::DoNotOptimize(Gray(test::copper()));
}
void build_free_energy(benchmark::State& bench) {
  for (auto _ : bench) benchmark::DoNotOptimize(GrayFreeEnergy(test::copper()));
}
BENCHMARK(build_gray)->Unit(benchmark::kMillisecond);
BENCHMARK(build_free_energy)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
