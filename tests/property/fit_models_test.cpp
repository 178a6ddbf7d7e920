// SPDX-License-Identifier: BSD-3-Clause
// The other models and the fluid: data made of known constants give them back, within the stated errors.
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/laws.hpp"
#include "md_fitting/fit/solid_models.hpp"
#include "md_fitting/fit/solid_problem.hpp"
#include "md_fitting/fit/vapour_fit.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"
#include "tests/property/fit_recovery.hpp"

namespace whipple::fit {
namespace {

using testing::Noise;
using testing::noise_only;
using testing::SyntheticStore;
using testing::true_constants;

double pull(const Fit& fit, const char* name, double truth) {
  const Constant& constant = fit.constant(name);
  EXPECT_EQ(constant.origin, Origin::fitted) << name;
  return (constant.value - truth) / constant.error;
}

/// chi^2 of the deviations from the truth by the stated covariance, over several seeds: its mean is the
/// number of constants.
template <class FitOf, class Truth>
void expect_honest(const FitOf& fit_of, const Truth& truth, int seeds) {
  double sum = 0.0;
  double data_sum = 0.0;
  double degrees_of_freedom = 0.0;
  Eigen::Index constants = 0;
  for (unsigned seed = 1; seed <= static_cast<unsigned>(seeds); ++seed) {
    const Fit fit = fit_of(seed);
    constants = fit.covariance.rows();
    Eigen::VectorXd deviation(constants);
    for (Eigen::Index k = 0; k < constants; ++k) {
      const std::string& name = fit.fitted_names[static_cast<std::size_t>(k)];
      deviation[k] = fit.value(name) - truth(name);
    }
    // In units of the errors: the covariance itself mixes m^3/kg with K.
    const Eigen::VectorXd scale = fit.covariance.diagonal().cwiseSqrt();
    sum += deviation.cwiseQuotient(scale).dot(
        Eigen::VectorXd(solve_symmetric(fit.correlation(), deviation.cwiseQuotient(scale))));
    data_sum += fit.chi_squared;
    degrees_of_freedom += fit.degrees_of_freedom;
  }
  const double expected = static_cast<double>(constants) * seeds;
  EXPECT_NEAR(sum, expected, 4.0 * std::sqrt(2.0 * expected));
  EXPECT_NEAR(data_sum, degrees_of_freedom, 4.0 * std::sqrt(2.0 * degrees_of_freedom));
}

// The statistical weights are the errors of the data carried through the residuals: C = J Sigma J^T, J by
// differences. GRAY's whole surface, and Lindemann's law alone, whose volumes have errors.
TEST(FitModels, WeightsAreTheErrorsOfTheDataCarriedThroughTheResiduals) {
  for (const bool surface : {true, false}) {
    SCOPED_TRACE(surface);
    const FitSettings settings;
    const SyntheticStore store(true_constants(), Noise{}, 5);
    Observations data = observe(store.points, settings, {}, "synthetic");
    data.isotherm = {{1.10e-4, {4.5e9, 2e7}}, {1.05e-4, {12e9, 3e7}}};
    SolidModel model;
    model.free = {Place::volume,          Place::intercept,  Place::slope,  Place::gruneisen,
                  Place::gruneisen_slope, Place::anharmonic, Place::melting};
    model.hugoniot = model.isotherm = true;
    model.surface = surface;
    if (surface) model.free.push_back(Place::entropy);
    for (MeltingPoint& point : data.melting) {
      if (!surface) point.solid_volume.error = 3e-4 * point.solid_volume.value;
    }
    SolidConstants start{true_constants()};
    start.heat_capacity = 3.0 * 8.314462618 / start.gray.molar_mass;
    start.bulk_modulus = 135e9;
    start.bulk_modulus_slope = 5.0;
    const SolidProblem problem(data, settings, model, start);
    const LeastSquaresProblem least_squares = problem.least_squares();
    const Eigen::VectorXd& p = least_squares.start;
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(problem.size(), problem.size());

    // Change of the residuals by one error of a value. `again`: what a problem makes of the data when it is
    // built (its window of shock states, its melting curve) is made again.
    const auto carried = [&](md::Estimate& value, bool anew) -> Eigen::VectorXd {
      if (value.error == 0.0) return Eigen::VectorXd::Zero(problem.size());
      const double before = value.value, step = 1e-2 * value.error;
      const auto at = [&](double there) -> Eigen::VectorXd {
        value.value = there;
        return anew ? SolidProblem(data, settings, model, start).residuals(p) : problem.residuals(p);
      };
      const Eigen::VectorXd above = at(before + step), below = at(before - step);
      value.value = before;
      return (above - below) / (2e-2);
    };
    const auto add = [&](const Eigen::VectorXd& r) { expected += r * r.transpose(); };
    add(carried(data.reference_volume, false));
    for (HugoniotState& state : data.hugoniot) add(carried(state.pressure, true));
    for (IsothermState& state : data.isotherm) add(carried(state.pressure, false));
    for (Isochore& isochore : data.isochores) {
      for (ThermalState& state : isochore.states) {
        const Eigen::VectorXd pressure = carried(state.pressure, false),
                              energy = carried(state.energy, false);
        add(pressure);
        add(energy);
        expected += state.correlation * (pressure * energy.transpose() + energy * pressure.transpose());
      }
    }
    for (MeltingPoint& point : data.melting) {
      add(carried(point.temperature, false));
      add(carried(point.solid_volume, true));
      if (surface) add(carried(*point.latent_heat, false));
    }
    ASSERT_GT(problem.window().size(), 3U);
    ASSERT_EQ(expected.rows(), least_squares.statistical.rows());
    const Eigen::VectorXd scale = least_squares.statistical.diagonal().cwiseSqrt();
    ASSERT_GT(scale.minCoeff(), 0.0);
    const Eigen::MatrixXd deviation = scale.cwiseInverse().asDiagonal() *
                                      (expected - least_squares.statistical) *
                                      scale.cwiseInverse().asDiagonal();
    EXPECT_LT(deviation.cwiseAbs().maxCoeff(), 1e-3);
  }
}

// Data made with a law do not tell whether it is that of its constants.
TEST(FitModels, SlopeOfTheBulkModulusIsThatOfTheIsotherm) {
  SolidConstants constants;
  constants.gray.reference_specific_volume = 1.1e-4;
  constants.bulk_modulus = 140e9;
  constants.bulk_modulus_slope = 5.2;
  const double V0 = constants.gray.reference_specific_volume;
  const auto P = [&](double V) { return isotherm_pressure(constants, V); };
  const auto K = [&](double V) { return -V * (P(V + 1e-5 * V0) - P(V - 1e-5 * V0)) / (2e-5 * V0); };
  EXPECT_EQ(P(V0), 0.0);
  EXPECT_NEAR(K(V0), constants.bulk_modulus, 1e-6 * constants.bulk_modulus);
  const double below = 0.998 * V0, above = 1.002 * V0;
  EXPECT_NEAR((K(below) - K(above)) / (P(below) - P(above)), constants.bulk_modulus_slope, 1e-3);
}

// GRAY: eight constants over eight seeds, within the stated covariance, and chi^2 of the data within its
// scatter.
TEST(FitModels, GrayIsRecoveredWithinItsCovariance) {
  const eos::GrayConstants truth = true_constants();
  const std::vector<double> expected = testing::values(truth);
  expect_honest(
      [&](unsigned seed) { return fit_gray(SyntheticStore(truth, Noise{}, seed).points, noise_only(), "s"); },
      [&](const std::string& name) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
          if (testing::fitted[i] == name) return expected[i];
        }
        return std::nan("");
      },
      8);
}

eos::GrayConstants harmonic() {
  eos::GrayConstants truth = true_constants();
  truth.anharmonic_heat_coefficient = 0.0;
  return truth;
}

// Mie and Grueneisen: the same solid without anharmonic energy; rho Gamma = rho0 (Gamma0 + b mu) with b =
// gamma0 - a.
TEST(FitModels, MieGruneisenIsRecovered) {
  const eos::GrayConstants truth = harmonic();
  const auto value = [&](const std::string& name) {
    if (name == "reference_density") return 1.0 / truth.reference_specific_volume;
    if (name == "hugoniot_intercept") return truth.hugoniot_intercept;
    if (name == "hugoniot_slope") return truth.hugoniot_slope;
    if (name == "gruneisen") return truth.gruneisen;
    if (name == "gruneisen_slope") return truth.gruneisen - truth.gruneisen_slope;
    if (name == "heat_capacity") return 3.0 * eos::GrayConstants::gas_constant / truth.molar_mass;
    return std::nan("");
  };
  Noise silent;
  silent.silent = true;
  const Fit exact = fit_mie_gruneisen(SyntheticStore(truth, silent, 1).points, noise_only(), "s");
  for (const std::string& name : exact.fitted_names) {
    EXPECT_NEAR(exact.value(name), value(name), 1e-6 * std::abs(value(name))) << name;
  }
  ASSERT_EQ(exact.words.size(), 1u);
  EXPECT_EQ(exact.words.front().second, "linear");
  expect_honest(
      [&](unsigned seed) {
        return fit_mie_gruneisen(SyntheticStore(truth, Noise{}, seed).points, noise_only(), "s");
      },
      value, 8);
}

/// Points with an isotherm of Vinet's form in place of the shocks.
SyntheticStore isotherm_store(const SolidConstants& solid, bool silent, unsigned seed) {
  Noise noise;
  noise.silent = silent;
  SyntheticStore store(solid.gray, noise, seed);
  std::erase_if(store.points, [](const md::PointRecord& point) {
    return point.protocol == "isotherm" || point.protocol == "hugoniot";
  });
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  for (const double ratio : {1.02, 0.99, 0.96, 0.93, 0.89, 0.86, 0.82, 0.78}) {
    const double v = ratio * solid.gray.reference_specific_volume;
    const double error = 2e7;
    store.add(
        "isotherm", {{"specific_volume", v}, {"temperature", 293.0}},
        {{"pressure", {isotherm_pressure(solid, v) + (silent ? 0.0 : error * normal(generator)), error}},
         {"specific_internal_energy", {0.0, 400.0}}});
  }
  return store;
}

SolidConstants debye_gruneisen_truth() {
  SolidConstants solid{harmonic(), 0.0, 135e9, 5.3};
  solid.gray.melting = eos::MeltingTransition::isochoric;  // the model melts by Lindemann's law alone
  return solid;
}

// Of melting points at one pressure those of the largest cells count; one that says nothing on the volume hides none.
TEST(FitModels, MeltingPointsAreThoseOfTheLargestCells) {
  SyntheticStore store(true_constants(), Noise{}, 3);
  std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
  const auto add = [&](int cells, double temperature, bool with_volume) {
    store.add("coexistence", {{"pressure", 0.0}}, {{"melting_temperature", {temperature, 5.0}}});
    md::PointRecord& point = store.points.back();
    point.provenance["cells"] = std::to_string(cells);
    point.provenance["length"] = "30";
    if (with_volume) point.results["solid_specific_volume"] = {0.118e-3, 0.0};
  };
  add(6, 1300.0, true);
  add(10, 1320.0, true);
  add(20, 1340.0, false);
  const Observations data = observe(store.points, {}, {}, "s");
  ASSERT_EQ(data.melting.size(), 1u);
  EXPECT_EQ(data.melting.front().temperature.value, 1320.0);
}

// Classical data of a solid whose quantum isotherm is known: what the points of the protocol "quantum" add
// leads back to it; without them, or with --nuclei classical, volume and modulus are those of the classical
// crystal.
TEST(FitModels, QuantumNucleiShiftTheIsotherm) {
  const SolidConstants solid = debye_gruneisen_truth();
  const double v0 = solid.gray.reference_specific_volume;
  const auto quantum_pressure = [&](double v) { return 0.4e9 + 2.0e9 * (1.0 - v / v0); };
  double classical = 0.99 * v0;  // there the classical pressure is zero
  for (double above = v0; above - classical > 1e-9 * v0;) {
    const double middle = 0.5 * (classical + above);
    (isotherm_pressure(solid, middle) > quantum_pressure(middle) ? classical : above) = middle;
  }
  SyntheticStore store = isotherm_store(solid, true, 1);
  for (md::PointRecord& point : store.points) {
    if (point.protocol == "isotherm") {
      point.results["pressure"].value -= quantum_pressure(point.conditions["specific_volume"]);
    }
    if (point.protocol == "zero_pressure_volume") point.results["specific_volume"].value *= classical / v0;
  }
  const Fit without = fit_debye_gruneisen(store.points, noise_only(), "s");
  EXPECT_NEAR(without.value("reference_density") * classical, 1.0, 1e-3);
  for (const double ratio : {1.05, 0.7}) {
    store.add(
        "quantum", {{"specific_volume", ratio * v0}, {"temperature", 293.0}},
        {{"quantum_pressure", {quantum_pressure(ratio * v0), 0.0}}, {"debye_temperature", {321.0, 0.0}}});
  }
  const Fit with = fit_debye_gruneisen(store.points, noise_only(), "s");
  EXPECT_NEAR(with.value("reference_density") * v0, 1.0, 1e-4);
  EXPECT_NEAR(with.value("bulk_modulus") / solid.bulk_modulus, 1.0, 5e-3);
  EXPECT_NEAR(with.value("debye_temperature"), 321.0, 1e-9);
  // A state that an isochore shares with the isotherm is one datum, and two runs at one volume have no slope.
  SyntheticStore crossed = store;
  for (const double off : {0.0, 1e6}) {
    const double v = 0.99 * v0, pressure = isotherm_pressure(solid, v) - quantum_pressure(v) + off;
    crossed.add("isochore", {{"specific_volume", v}, {"temperature", 293.0}},
                {{"pressure", {pressure, 2e7}}, {"specific_internal_energy", {0.0, 400.0}}});
    const Fit again = fit_debye_gruneisen(crossed.points, noise_only(), "s");
    if (off == 0.0) {
      EXPECT_EQ(again.value("bulk_modulus"), with.value("bulk_modulus"));
    }
    EXPECT_NEAR(again.value("reference_density") * v0, 1.0, 1e-4);
  }
  FitSettings settings = noise_only();
  settings.nuclei = Nuclei::classical;
  const Fit ignored = fit_debye_gruneisen(store.points, settings, "s");
  EXPECT_EQ(ignored.value("reference_density"), without.value("reference_density"));
  // Both say what the nuclei make of the isotherm, volume by volume, and whether it is in the constants.
  EXPECT_TRUE(without.nuclei.isotherm.empty());
  EXPECT_NE(fit_details(with).find("the fitted constants contain the difference"), std::string::npos);
  EXPECT_NE(fit_details(ignored).find("the fitted constants are those of classical nuclei"),
            std::string::npos);
  for (const Fit* fit : {&with, &ignored}) {
    ASSERT_EQ(fit->nuclei.isotherm.size(), 8u);
    EXPECT_NEAR(fit->nuclei.expansion, v0 / classical - 1.0, 0.02 * (v0 / classical - 1.0));
    for (const NucleiPressures& row : fit->nuclei.isotherm) {
      EXPECT_NEAR(row.addition, quantum_pressure(row.volume), 1.0);
      EXPECT_NEAR(row.classical + row.addition, isotherm_pressure(solid, row.volume), 1.0) << row.volume / v0;
    }
  }
  // Points that do not reach the whole isotherm are no ground to extrapolate from.
  std::erase_if(store.points, [&](const md::PointRecord& point) {
    return point.protocol == "quantum" && point.condition("specific_volume") < v0;
  });
  EXPECT_THROW(static_cast<void>(fit_debye_gruneisen(store.points, noise_only(), "s")), InputError);
}

TEST(FitModels, DebyeGruneisenIsRecovered) {
  const SolidConstants solid = debye_gruneisen_truth();
  const eos::GrayConstants& truth = solid.gray;
  const auto store = [&](bool silent, unsigned seed) { return isotherm_store(solid, silent, seed).points; };
  const auto value = [&](const std::string& name) {
    if (name == "reference_density") return 1.0 / truth.reference_specific_volume;
    if (name == "bulk_modulus") return solid.bulk_modulus;
    if (name == "bulk_modulus_slope") return solid.bulk_modulus_slope;
    if (name == "gruneisen") return truth.gruneisen;
    if (name == "gruneisen_slope") return truth.gruneisen_slope;
    if (name == "melting_temperature") return truth.melting_temperature;
    return std::nan("");
  };
  const Fit exact = fit_debye_gruneisen(store(true, 1), noise_only(), "s");
  ASSERT_EQ(exact.fitted_names.size(), 6u);
  for (const std::string& name : exact.fitted_names) {
    EXPECT_NEAR(exact.value(name), value(name), 1e-6 * std::abs(value(name))) << name;
  }
  EXPECT_EQ(exact.constant("debye_temperature").origin, Origin::by_default);
  EXPECT_DOUBLE_EQ(exact.value("debye_temperature"), 343.0);
  expect_honest([&](unsigned seed) { return fit_debye_gruneisen(store(false, seed), noise_only(), "s"); },
                value, 8);
}

// Copper at 4 K: C11, C12, C44 of 176.2, 124.9, 81.8 GPa (Overton & Gaffney 1955) have the moduli 142
// and 51.5 GPa after Hill; calorimetry gives 343 K (Kittel, Introduction to Solid State Physics).
TEST(FitModels, DebyeTemperatureIsThatOfTheElasticStateNextToTheReference) {
  EXPECT_NEAR(debye_temperature(142e9, 51.5e9, 1.107e-4, 0.06355), 343.0, 0.04 * 343.0);

  const SolidConstants solid = debye_gruneisen_truth();
  SyntheticStore store = isotherm_store(solid, false, 1);
  const double v0 = solid.gray.reference_specific_volume;
  for (const auto& [ratio, shear] : {std::pair{0.9, 80e9}, std::pair{1.001, 50e9}, std::pair{1.1, 30e9}}) {
    store.add("elastic", {{"specific_volume", ratio * v0}, {"temperature", 0.0}},
              {{"bulk_modulus", {140e9, 0.0}}, {"shear_modulus_hill", {shear, 0.0}}});
  }
  const Fit fit = fit_debye_gruneisen(store.points, noise_only(), "s");
  EXPECT_EQ(fit.constant("debye_temperature").origin, Origin::given);
  EXPECT_NEAR(fit.value("debye_temperature"),
              debye_temperature(140e9, 50e9, 1.001 * v0, solid.gray.molar_mass), 1e-4);
}

TEST(FitModels, DebyeGruneisenAsksForAnIsotherm) {
  std::vector<md::PointRecord> points = SyntheticStore(harmonic(), Noise{}, 1).points;
  std::erase_if(points, [](const md::PointRecord& point) { return point.protocol == "isotherm"; });
  try {
    fit_debye_gruneisen(points, noise_only(), "s");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("protocol \"isotherm\": 0 solid states at 293 K, the fit needs 5"),
        std::string::npos)
        << error.what();
  }
}

/// Saturated densities of the model, with noise.
void add_saturation(SyntheticStore& store, const eos::GrayConstants& truth, double error, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  for (const double temperature : {4500.0, 5000.0, 5500.0, 6000.0}) {
    const auto [liquid, vapour] = saturated_densities(truth, temperature);
    const auto noisy = [&](double value) {
      return md::Estimate{value * (1.0 + error * normal(generator)), (error > 0.0 ? error : 1e-3) * value};
    };
    const md::Estimate dense = noisy(liquid);
    store.add("liquid_vapour", {{"temperature", temperature}},
              {{"liquid_density", dense}, {"vapour_density", noisy(vapour)}});
  }
}

// The fluid: a_y and V_J from saturated densities.
TEST(FitModels, VapourIsRecovered) {
  eos::GrayConstants truth = true_constants();
  truth.join_volume_ratio = 1.27;
  truth.vapour_attraction = 570.0;
  Noise silent;
  silent.silent = true;
  SyntheticStore store(truth, silent, 1);
  add_saturation(store, truth, 0.0, 1);
  const GrayFit fit = fit_gray(store.points, noise_only(), "s");
  EXPECT_TRUE(fit.remarks.empty()) << fit.remarks.front();
  EXPECT_EQ(fit.constant("vapour_attraction").origin, Origin::fitted);
  EXPECT_NEAR(fit.value("vapour_attraction"), 570.0, 0.01);
  EXPECT_NEAR(fit.value("join_volume_ratio"), 1.27, 1e-4);
  // The joint covariance is positive and holds the solid's share.
  EXPECT_EQ(fit.covariance.rows(), 10);
  EXPECT_GT(symmetric_eigen(fit.correlation()).values[0], 0.0);

  double attraction = 0.0;
  double join = 0.0;
  constexpr int seeds = 6;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SyntheticStore noisy(truth, Noise{}, seed);
    add_saturation(noisy, truth, 0.01, seed);
    const GrayFit one = fit_gray(noisy.points, noise_only(), "s");
    attraction += std::pow(pull(one, "vapour_attraction", 570.0), 2);
    join += std::pow(pull(one, "join_volume_ratio", 1.27), 2);
  }
  EXPECT_LT(attraction / seeds, 1.0 + 4.0 * std::sqrt(2.0 / seeds));
  EXPECT_LT(join / seeds, 1.0 + 4.0 * std::sqrt(2.0 / seeds));
  EXPECT_GT(attraction + join, 0.02 * seeds);  // the errors are not vastly too large, either
}

// A vapour that the model does not have widens the error of a_y, and densities that say nothing of V_J leave it.
TEST(FitModels, VapourThatDoesNotFitIsUncertain) {
  const eos::GrayConstants truth = true_constants();
  const auto fitted = [&](double factor, double error, bool inflation) {
    std::vector<SaturationState> data;
    for (const double temperature : {5200.0, 5600.0}) {
      const auto [liquid, vapour] = saturated_densities(truth, temperature);
      data.push_back({temperature, {liquid, error * liquid}, {factor * vapour, error * factor * vapour}});
    }
    const Eigen::MatrixXd small = Eigen::MatrixXd::Constant(1, 1, 1e-8);
    return fit_vapour(truth, data, ModelErrors{}, inflation, {{"gruneisen"}, small, small});
  };
  const VapourFit good = fitted(1.0, 0.2, true);
  EXPECT_EQ(good.names, std::vector<std::string>{"vapour_attraction"});
  EXPECT_NE(good.remark.find("V_J/V0 stays at 1.3: the saturated densities leave V_J/V0"), std::string::npos)
      << good.remark;
  EXPECT_EQ(good.inflation, 1.0);
  const VapourFit bad = fitted(0.1, 0.01, true), stated = fitted(0.1, 0.01, false);
  EXPECT_EQ(stated.inflation, 1.0);
  EXPECT_GT(bad.inflation, 1.5);
  EXPECT_NEAR(bad.inflation * bad.inflation, bad.chi_squared / bad.degrees_of_freedom, 1e-9);
  EXPECT_NEAR(bad.covariance(0, 0) / stated.covariance(0, 0), bad.inflation * bad.inflation, 1e-3);
}

TEST(FitModels, OneTemperatureOfSaturationIsTooFew) {
  const eos::GrayConstants truth = true_constants();
  SyntheticStore store(truth, Noise{}, 1);
  store.add("liquid_vapour", {{"temperature", 6000.0}},
            {{"liquid_density", {5000.0, 50.0}}, {"vapour_density", {100.0, 10.0}}});
  const GrayFit fit = fit_gray(store.points, noise_only(), "s");
  ASSERT_EQ(fit.remarks.size(), 1u);
  EXPECT_NE(fit.remarks.front().find("one temperature only"), std::string::npos);
  EXPECT_EQ(fit.constant("vapour_attraction").origin, Origin::by_default);
}

// The bootstrap of a whole store agrees with the errors that the fit derives from the noise.
TEST(FitModels, BootstrapAgreesWithTheCovariance) {
  FitSettings settings = noise_only();
  settings.bootstrap = 60;
  const GrayFit fit = fit_gray(SyntheticStore(true_constants(), Noise{}, 2).points, settings, "s");
  ASSERT_TRUE(fit.bootstrap.has_value());
  EXPECT_EQ(fit.bootstrap->replicates, 60);
  for (Eigen::Index k = 0; k < fit.bootstrap->covariance.rows(); ++k) {
    const double ratio = std::sqrt(fit.bootstrap->covariance(k, k) / fit.statistical_covariance(k, k));
    EXPECT_NEAR(ratio, 1.0, 4.0 / std::sqrt(2.0 * 60)) << fit.fitted_names[static_cast<std::size_t>(k)];
  }
}

// Leave-one-out: data that obey the laws differ from their predictions by their errors.
TEST(FitModels, LeaveOneOutIsUnityForHonestData) {
  const GrayFit fit = fit_gray(SyntheticStore(true_constants(), Noise{}, 4).points, noise_only(), "s");
  ASSERT_EQ(fit.left_out.size(), 5u);
  for (const LeaveOneOut& part : fit.left_out) {
    EXPECT_GT(part.data, 0) << part.quantity;
    EXPECT_NEAR(part.rms, 1.0, 4.0 / std::sqrt(2.0 * part.data)) << part.quantity;
  }
}

}  // namespace
}  // namespace whipple::fit
