// SPDX-License-Identifier: BSD-3-Clause
// Time of the constitutive update per point, by material and by state of the points: random deviatoric flow of an
// intact yielding body, or of a failed body with open voids. `items_per_second` is points per second.
#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>
#include <random>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/polynomial.hpp"
#include "src/material/material_file.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/granular_flow.hpp"
#include "src/material/strength/modified_cam_clay.hpp"
#include "src/material/strength/mohr_coulomb.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

constexpr std::size_t count = 32768;

enum class Matter { intact, failed };

void update(benchmark::State& state, const char* name, Matter matter, bool by_list) {
  const Material material = read_material(name);
  MaterialPoints points;
  resize(points, count);
  std::ranges::fill(points.mass, 1e-6);
  initialise(material, points, 0, count);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1e4, 1e4);
  std::vector<Matrix3> gradients(count);
  for (Matrix3& gradient : gradients) {
    for (int k = 0; k < 9; ++k) gradient(k / 3, k % 3) = uniform(generator);
    gradient.diagonal().array() -= gradient.trace() / 3.0;
  }
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::shuffle(order, generator);
  if (matter == Matter::failed) {
    std::ranges::fill(points.failed, std::uint8_t{1});
    for (std::size_t i = 0; i < count; ++i) points.void_volume[i] = points.volume[i];
  }
  // The sign of the motion alternates, so that the points stay near their state and continue to yield.
  std::vector<Matrix3> reversed = gradients;
  for (Matrix3& gradient : reversed) gradient = -gradient;
  const UpdateSettings settings{.time_step = 1e-7, .cell_size = 1e-3};
  bool forward = true;
  for (auto _ : state) {
    const auto& motion = forward ? gradients : reversed;
    const MaterialReport report = by_list ? update_material(material, points, order, motion, settings)
                                          : update_material(material, points, 0, count, motion, settings);
    if (!report.valid()) state.SkipWithError("a point left the range of its model");
    forward = !forward;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

BENCHMARK_CAPTURE(update, no_strength, "aluminium_mie_gruneisen", Matter::intact, false);
BENCHMARK_CAPTURE(update, linear_hardening, "copper_taylor", Matter::intact, false);
BENCHMARK_CAPTURE(update, linear_hardening_shuffled_list, "copper_taylor", Matter::intact, true);
BENCHMARK_CAPTURE(update, lead_with_open_voids, "lead_mie_gruneisen", Matter::failed, false);
BENCHMARK_CAPTURE(update, gray_johnson_cook, "copper", Matter::intact, false);
BENCHMARK_CAPTURE(update, gray_with_open_voids, "copper", Matter::failed, false);
BENCHMARK_CAPTURE(update, foam, WHIPPLE_SOURCE_DIR "/cases/foam_block/foam.toml", Matter::intact, false);
BENCHMARK_CAPTURE(update, crushable_foam, WHIPPLE_SOURCE_DIR "/tests/data/crushable_foam.toml",
                  Matter::intact, false);
BENCHMARK_CAPTURE(update, neo_hookean, WHIPPLE_SOURCE_DIR "/cases/rubber_rings/rubber.toml", Matter::intact,
                  false);
BENCHMARK_CAPTURE(update, neo_hookean_that_relaxes,
                  WHIPPLE_SOURCE_DIR "/cases/rubber_rings/relaxing_rubber.toml", Matter::intact, false);

/// Returns a soil of a law; all have the same equation of state and stiffness.
template <class Model, class Law>
Material soil(Law law) {
  eos::PolynomialConstants constants;
  constants.reference_density = 2000.0;
  constants.C1 = 50e6;
  constants.heat_capacity = 1000.0;
  law.shear_modulus = 30e6;
  return make_material("soil", std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(constants),
                       std::make_shared<const Model>(law));
}

Material metal() {
  strength::VonMises law;
  law.yield_stress = 50e3;
  return soil<strength::VonMisesModel>(law);
}
Material cone(double dilation) {
  strength::DruckerPrager law;
  law.friction_angle = 0.5;
  law.cohesion = 5e3;
  law.dilation_angle = dilation;
  law.maximum_dilation = 0.5;
  return soil<strength::DruckerPragerModel>(law);
}
Material pyramid(double dilation) {
  strength::MohrCoulomb law;
  law.friction_angle = 0.5;
  law.cohesion = 5e3;
  law.dilation_angle = dilation;
  law.maximum_dilation = 0.5;
  return soil<strength::MohrCoulombModel>(law);
}
Material clay() {
  strength::ModifiedCamClay law;
  law.critical_state_slope = 1.1;
  law.preconsolidation_pressure = 400e3;
  law.plastic_compressibility = 0.06;
  return soil<strength::ModifiedCamClayModel>(law);
}
Material grains() {
  strength::GranularFlow law;
  law.static_friction = 0.382;
  law.limiting_friction = 0.643;
  law.reference_number = 0.279;
  law.grain_size = 1e-3;
  law.grain_density = 3000.0;
  return soil<strength::GranularFlowModel>(law);
}

/// Measures the update of compressed soil that yields in every step. The points begin anew after twenty steps, so that
/// they neither reach the end of their dilation nor harden for ever.
void soil_update(benchmark::State& state, const Material& material) {
  MaterialPoints start;
  resize(start, count);
  std::ranges::fill(start.mass, 1e-6);
  initialise(material, start, 0, count);
  for (double& volume : start.volume) volume *= 0.995;
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1e4, 1e4);
  std::vector<Matrix3> gradients(count);
  for (Matrix3& gradient : gradients) {
    for (int k = 0; k < 9; ++k) gradient(k / 3, k % 3) = uniform(generator);
    gradient.diagonal().array() -= gradient.trace() / 3.0;
  }
  const UpdateSettings settings{.time_step = 1e-7, .cell_size = 1e-3};
  for (int n = 0; n < 10; ++n) {  // until it yields
    if (!update_material(material, start, 0, count, gradients, settings).valid()) {
      state.SkipWithError("a point left the range of its model");
    }
  }
  MaterialPoints points = start;
  int step = 0;
  double work = 0.0;
  for (auto _ : state) {
    if (++step % 20 == 0) {
      state.PauseTiming();
      points = start;
      state.ResumeTiming();
    }
    const MaterialReport report = update_material(material, points, 0, count, gradients, settings);
    if (!report.valid()) state.SkipWithError("a point left the range of its model");
    work += report.plastic_work;
  }
  if (!(work > 0.0)) state.SkipWithError("nothing yields");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}
BENCHMARK_CAPTURE(soil_update, von_mises, metal());
BENCHMARK_CAPTURE(soil_update, drucker_prager, cone(0.0));
BENCHMARK_CAPTURE(soil_update, drucker_prager_dilating, cone(0.2));
BENCHMARK_CAPTURE(soil_update, mohr_coulomb, pyramid(0.0));
BENCHMARK_CAPTURE(soil_update, mohr_coulomb_dilating, pyramid(0.2));
BENCHMARK_CAPTURE(soil_update, modified_cam_clay, clay());
BENCHMARK_CAPTURE(soil_update, granular_flow, grains());

/// Measures the plastic increments of a chunk of yielding points alone.
void plastic_return(benchmark::State& state, const char* name) {
  const Material material = read_material(name);
  constexpr std::size_t points = 64;
  using Values = std::vector<double>;
  Values density(points, material.reference.density), pressure(points, 1e9), temperature(points),
      strain(points), rate(points, 1e5), flow(points), trial(points), modulus(points), solid(points, 1.0),
      increment(points);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t k = 0; k < points; ++k) {
    temperature[k] = 300.0 + 200.0 * uniform(generator);
    strain[k] = 0.05 + 0.45 * uniform(generator);
  }
  const strength::State at{density, pressure, temperature, strain};
  material.strength->shear_modulus(at, modulus);
  material.strength->flow_stress(at, rate, flow);
  for (std::size_t k = 0; k < points; ++k) trial[k] = flow[k] * (1.0 + 0.5 * uniform(generator));
  for (auto _ : state) {
    material.strength->plastic_increment(at, trial, modulus, solid, 5e-8, increment);
    benchmark::DoNotOptimize(increment.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

BENCHMARK_CAPTURE(plastic_return, johnson_cook, "copper_johnson_cook");
BENCHMARK_CAPTURE(plastic_return, steinberg_guinan, "lead");

}  // namespace
}  // namespace whipple

BENCHMARK_MAIN();
