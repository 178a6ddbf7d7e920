// SPDX-License-Identifier: BSD-3-Clause
// Corrections of GRAY's free energies (docs/theory/fit.md, section 10) find a known deviation from its form, and stay
// stable.
#include "tests/property/fit_correction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "eos/experiments/comparison.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/three_phase_model.hpp"
#include "md_fitting/fit/correction/correction_fit.hpp"
#include "md_fitting/fit/correction/correction_prior.hpp"
#include "md_fitting/fit/correction/stability.hpp"
#include "md_fitting/fit/vapour_fit.hpp"
#include "src/core/base/error.hpp"
#include "tests/property/fit_measured.hpp"

namespace whipple::fit {
namespace {

using eos::CorrectedGray;
using testing::crystal;
using testing::Deviation;
using testing::deviation;
using ::testing::HasSubstr;
using testing::measured;
using testing::steps;
using testing::SyntheticStore;
using ::testing::ThrowsMessage;
using testing::true_constants;
using testing::unseen_states;

TEST(FitCorrection, FollowsADeviationFromTheForm) {
  const eos::GrayConstants constants = true_constants();
  const Deviation extra = deviation(constants);
  const CorrectionResult result = fit_correction({crystal(1), constants, constants}, 0, 1);
  const eos::CorrectedGraySurfaces surfaces({constants, result.common, result.fluid});
  double before = 0.0, after = 0.0;
  for (const auto& [V, T] : unseen_states(constants)) {
    const double truth = surfaces.gray().solid(V, T).pressure + extra.pressure(V, T);
    before = std::max(before, std::abs(extra.pressure(V, T)));
    after = std::max(after, std::abs(surfaces.solid(V, T).pressure - truth));
  }
  EXPECT_GT(before, 400e6);
  EXPECT_LT(after, 60e6);  // noise of one state: 20 MPa, resolution of the splines: 13 MPa
  for (const CorrectionResiduals& kind : result.residuals) {
    if (kind.kind == "melting line kept") continue;
    EXPECT_GT(kind.gray, 3.0 * kind.corrected) << kind.kind;
    EXPECT_LT(kind.of_errors, 1.3) << kind.kind;
    EXPECT_GT(kind.of_errors, 0.3) << kind.kind;
  }
  EXPECT_NEAR(result.energy_zero, -5.3e6, 2e3);
  // The reference state stays.
  const eos::GrayPoint s = surfaces.solid(constants.reference_specific_volume, 293.0);
  EXPECT_NEAR(s.pressure, 0.0, 1e6);
  EXPECT_NEAR(s.energy, 0.0, 100.0);
}

TEST(FitCorrection, FollowsFilmsOfAnotherVapour) {
  const eos::GrayConstants constants = true_constants();
  eos::GrayConstants other = constants;
  other.vapour_attraction = 660.0;
  std::vector<md::PointRecord> points = crystal(3, 0.0, 0.0);
  SyntheticStore films(constants, {}, 1);
  films.points.clear();
  const eos::ModelEquationOfState<eos::Gray> truth(other);
  for (const double T : {4000.0, 4500.0, 5000.0, 5500.0}) {
    const eos::Saturation s = truth.underlying().dome().at_temperature(T).value();
    films.add("liquid_vapour", {{"temperature", T}},
              {{"liquid_density", {1.0 / s.liquid_volume, 1.0}},
               {"vapour_density", {1.0 / s.vapour_volume, 0.1 / s.vapour_volume}},
               {"vapour_pressure", {s.pressure, 0.05 * s.pressure}}});
  }
  points.insert(points.end(), films.points.begin(), films.points.end());
  const CorrectionResult result = fit_correction({points, constants, constants}, 0, 1);
  const CorrectedGray model({constants, result.common, result.fluid});
  for (const double T : {4250.0, 5250.0}) {
    const eos::Saturation wanted = truth.underlying().dome().at_temperature(T).value();
    const auto [liquid, vapour] = saturated_densities(constants, T);
    const eos::Saturation found = model.dome().at_temperature(T).value();
    EXPECT_GT(std::abs(vapour * wanted.vapour_volume - 1.0), 0.3) << T;  // before
    EXPECT_NEAR(wanted.vapour_volume / found.vapour_volume, 1.0, 0.25) << T;
    EXPECT_NEAR(wanted.liquid_volume / found.liquid_volume, 1.0, 0.02) << T;
  }
}

// Measured curves of a metal whose shock curve bends: the corrected model follows each of them, by the change that its
// linear functional states, and simulations with a potential that is 3 % too soft do not pull it.
TEST(FitCorrection, FollowsMeasuredCurvesBesideASoftPotential) {
  using eos::experiments::ExperimentKind;
  const eos::GrayConstants constants = true_constants();
  eos::GrayConstants metal = constants, soft = constants;
  metal.hugoniot_quadratic = -0.35;
  metal.hugoniot_slope += 0.12;
  metal.melting_temperature *= 1.04;
  soft.hugoniot_intercept *= 0.97;
  const std::vector<MeasuredCurve> curves = {
      measured(metal, ExperimentKind::shock_velocity, "shocks", steps(300.0, 2600.0, 24), 2e-3, 1),
      measured(metal, ExperimentKind::isotherm, "isotherm", steps(0.72, 0.97, 20), 5e-3, 2),
      measured(metal, ExperimentKind::isentrope, "isentrope", steps(0.72, 0.95, 12), 5e-3, 3),
      measured(metal, ExperimentKind::melting, "melting", steps(0.0, 80e9, 9), 5e-3, 4)};
  std::vector<md::PointRecord> points = SyntheticStore(soft, {}, 6).points;
  const CorrectionResult result = fit_correction({points, constants, constants, curves}, 0, 1);
  const eos::ModelEquationOfState<CorrectedGray> model(
      eos::CorrectedGrayConstants{constants, result.common, result.fluid});
  const eos::State initial = model.state_at_temperature(model.reference_density(), 293.0);
  for (const MeasuredCurve& curve : curves) {
    const auto& e = curve.experiment;
    const std::vector<double> truth = CurveModel(metal).values(e), before = CurveModel(constants).values(e);
    const std::vector<double> after = eos::experiments::curve(
        model, initial, e,
        {e.abscissa, eos::experiments::initial_densities(initial.density, e), e.temperatures});
    double rms_before = 0.0, rms_after = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      rms_before += std::pow(before[i] / truth[i] - 1.0, 2);
      rms_after += std::pow(after[i] / truth[i] - 1.0, 2);
    }
    // A melting line 4 % off is more than is expected of the melt: it is followed in part.
    const double share = e.kind == ExperimentKind::melting ? 0.75 : 0.4;
    EXPECT_LT(std::sqrt(rms_after), share * std::sqrt(rms_before)) << e.name;
    const auto row = std::ranges::find(result.residuals, "measured, " + e.name, &CorrectionResiduals::kind);
    ASSERT_NE(row, result.residuals.end()) << e.name;
    double left = 0.0;  // of the complete corrected model; the row has that of the linear one
    for (std::size_t i = 0; i < truth.size(); ++i) left += std::pow(after[i] / e.ordinate[i] - 1.0, 2);
    EXPECT_NEAR(std::sqrt(left / static_cast<double>(truth.size())), row->corrected,
                0.1 * row->gray + 0.1 * row->corrected)
        << e.name;
  }
}

// A strong anharmonicity, known up to 1500 K, makes hot and stretched metal unstable where the correction continues.
TEST(FitCorrection, LimitsOfStabilityHoldInTheFitAndItsSamples) {
  const eos::GrayConstants constants = true_constants();
  const CorrectionResult result = fit_correction({crystal(5, 3.0), constants, constants}, 2, 7);
  EXPECT_GT(result.limited, 0);
  std::vector<eos::CorrectedGrayConstants> all = result.samples;
  all.push_back({constants, result.common, result.fluid});
  const double V0 = constants.reference_specific_volume,
               modulus = std::pow(constants.hugoniot_intercept, 2) / V0;
  for (const eos::CorrectedGrayConstants& one : all) {
    const eos::CorrectedGraySurfaces surfaces(one);
    for (double ratio = 0.7; ratio < 1.22; ratio += 0.03) {
      for (double share = 0.1; share < 1.2; share += 0.1) {
        const double V = ratio * V0, T = share * surfaces.gray().melting_temperature(V);
        const eos::GrayPoint p = surfaces.solid(V, T), gray = surfaces.gray().solid(V, T);
        EXPECT_GT(p.heat_capacity, 0.45 * gray.heat_capacity) << ratio << " " << T;
        if (-V * gray.pressure_by_volume > 0.15 * modulus) {
          EXPECT_LT(p.pressure_by_volume, 0.3 * gray.pressure_by_volume) << ratio << " " << T;
        }
      }
    }
  }
  // Data that are themselves unstable are refused, with the state.
  std::vector<md::PointRecord> points = crystal(5);
  for (md::PointRecord& point : points) {
    const double T = point.conditions.at("temperature");
    if (T > 900.0)
      point.results.at("specific_internal_energy").value -= 3.0 * 8.314 / 0.06355 * 0.9 * (T - 900.0);
  }
  EXPECT_THAT([&] { fit_correction({points, constants, constants}, 0, 1); },
              ThrowsMessage<StateError>(HasSubstr("below half of those of GRAY at V/V0 = ")));
}

// A melt whose entropy is that of the crystal has no melting temperature: the limits say so, and GRAY alone violates none.
TEST(FitCorrection, LimitsKeepOneMeltingTemperature) {
  const eos::GrayFreeEnergy gray(true_constants());
  const CorrectionGrids grids = correction_grids({}, gray);
  const std::vector<StabilityLimit> limits = stability_limits(gray, grids);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(grids.size());
  EXPECT_TRUE(worst_violations(limits, c, 1).empty());
  const double entropy = gray.constants().melting_entropy / gray.constants().molar_mass;
  for (std::size_t i = 0; i < grids.fluid.volumes; ++i) {
    for (std::size_t k = 0; k < grids.fluid.temperatures; ++k) {
      const double u = std::min(grids.fluid.temperature_centre(k), 0.9);
      c[static_cast<Eigen::Index>(grids.common.size() + i * grids.fluid.temperatures + k)] =
          entropy * grids.fluid.temperature * u / (1.0 - u);  // F = dS T
    }
  }
  const std::vector<std::size_t> violated = worst_violations(limits, c, 1);
  ASSERT_FALSE(violated.empty());
  EXPECT_LT(limits[violated.front()].volume, 1.1 * gray.constants().reference_specific_volume);
}

// The thermal parts of the fluid must not fall to zero where it has data: T* = 2/3 of the hottest, 3 T_m0 at least.
TEST(FitCorrection, TheFluidReachesItsHottestState) {
  const eos::GrayFreeEnergy gray(true_constants());
  const double T = gray.constants().melting_temperature, V = gray.constants().reference_specific_volume;
  CorrectionData data;
  data.data.push_back(
      {.kind = "fluid, pressure", .terms = {{PhaseSurface::fluid, V, 2.0 * T, {.F_V = -1.0}}}});
  EXPECT_EQ(correction_grids(data, gray).fluid.temperature, 3.0 * T);
  data.data.front().terms.front().temperature = 9.0 * T;
  EXPECT_NEAR(correction_grids(data, gray).fluid.temperature, 6.0 * T, 1e-9 * T);
  data.data.front().terms.front().surface = PhaseSurface::solid;
  EXPECT_EQ(correction_grids(data, gray).fluid.temperature, 3.0 * T);
}

}  // namespace
}  // namespace whipple::fit
