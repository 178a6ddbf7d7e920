// SPDX-License-Identifier: BSD-3-Clause
// Samples of corrected free energies (docs/theory/fit.md, section 10) scatter as their errors and are thermodynamically
// consistent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "eos/identities.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/three_phase_model.hpp"
#include "md_fitting/fit/correction/correction_fit.hpp"
#include "tests/property/fit_correction.hpp"

namespace whipple::fit {
namespace {

using eos::CorrectedGray;
using testing::crystal;
using testing::Deviation;
using testing::deviation;
using testing::true_constants;
using testing::unseen_states;

// Truth less prediction over the spread of the samples has the scatter 1, over realisations of the noise.
TEST(FitCorrectionSamples, ScatterAsTheErrors) {
  const eos::GrayConstants constants = true_constants();
  const Deviation extra = deviation(constants);
  const auto states = unseen_states(constants);
  constexpr int stores = 8, samples = 12;
  double sum = 0.0, count = 0.0;
  for (unsigned seed = 1; seed <= stores; ++seed) {
    const CorrectionResult result = fit_correction({crystal(10 + seed), constants, constants}, samples, seed);
    ASSERT_EQ(result.samples.size(), static_cast<std::size_t>(samples));
    std::vector<eos::CorrectedGraySurfaces> drawn;
    for (const eos::CorrectedGrayConstants& sample : result.samples) drawn.emplace_back(sample);
    const eos::CorrectedGraySurfaces best({constants, result.common, result.fluid});
    for (const auto& [V, T] : states) {
      const double expected = best.solid(V, T).pressure;
      double variance = 0.0;
      for (const auto& sample : drawn)
        variance += std::pow(sample.solid(V, T).pressure - expected, 2) / samples;
      const double truth = best.gray().solid(V, T).pressure + extra.pressure(V, T);
      sum += (truth - expected) * (truth - expected) / variance;
      count += 1.0;
    }
  }
  // Stated errors contain the resolution of the splines beside the noise: pulls are below 1, and not far.
  EXPECT_LT(std::sqrt(sum / count), 1.2);
  EXPECT_GT(std::sqrt(sum / count), 0.5);
}

// Identities of a hundred samples, to 1e-6 over the range: section 10.
TEST(FitCorrectionSamples, IdentitiesHold) {
  const eos::GrayConstants constants = true_constants();
  const CorrectionResult result = fit_correction({crystal(1), constants, constants}, 100, 3);
  double largest = 0.0;
  int states = 0;
  for (const eos::CorrectedGrayConstants& sample : result.samples) {
    const eos::ModelEquationOfState<CorrectedGray> model(sample);
    for (const double ratio : {0.62, 0.75, 0.88, 1.0, 1.1, 1.6, 4.0, 20.0}) {
      for (const double T : {150.0, 700.0, 1500.0, 3000.0, 7000.0, 20000.0}) {
        const double rho = model.reference_density() / ratio;
        const double e = model.state_at_temperature(rho, T).specific_internal_energy;
        // Differences across a node of the melting curve, or far below the melting point of expanded material, are
        // less exact than the model: those of the better step count.
        const double defect = std::min(eos::check_identities(model, rho, e).largest(),
                                       eos::check_identities(model, rho, e, 2e-4).largest());
        EXPECT_LT(defect, 1e-6) << ratio << " " << T << " " << model.state(rho, e).phase;
        largest = std::max(largest, defect);
        ++states;
      }
    }
  }
  EXPECT_EQ(states, 4800);
  EXPECT_LT(largest, 1e-6);
}

}  // namespace
}  // namespace whipple::fit
