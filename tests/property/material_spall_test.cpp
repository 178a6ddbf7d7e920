// SPDX-License-Identifier: BSD-3-Clause
// Spall of a point: effect of a cut-off on the deviator, time to failure by accumulated tension, rate-dependent growth
// of voids, healing after compression, and the energy of tearing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/material/failure/tearing.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/failure/tuler_butcher.hpp"
#include "src/material/failure/viscous_void_growth.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace spall_test {

using namespace material_test;

constexpr double dt = 1e-9;
const UpdateSettings settings{
    .time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};
const LinearInEnergy cold_eos = [] {
  LinearInEnergy eos;
  eos.gamma = 0.0;  // pressure of the density alone
  return eos;
}();
const double modulus = cold_eos.rho0 * cold_eos.c0 * cold_eos.c0;

template <class Law>
Material with_law(const Law& law, const LinearInEnergy& eos = cold_eos) {
  return with(taylor_copper(), {std::make_shared<failure::CriterionModel<Law>>(law)}, eos);
}

Matrix3 dilation(double ratio) { return (std::cbrt(ratio) - 1.0) / dt * Matrix3::Identity(); }

/// Strains one point to a total volume (m^3) in `steps` equal steps.
void strain_to(const Material& material, MaterialPoints& points, double total, int steps) {
  const double ratio = std::pow(total / (points.volume[0] + points.void_volume[0]), 1.0 / steps);
  for (int n = 0; n < steps; ++n) step_with_work(material, points, dilation(ratio), settings);
}

/// Shears until the metal yields.
void shear(const Material& material, MaterialPoints& points) {
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = 0.001 / dt;
  for (int n = 0; n < 20; ++n) step_with_work(material, points, gradient, settings);
}

TEST(TensilePressure, ResponseDecidesWhatIsLeftOfTheDeviatorAndWhatComesBack) {
  for (const auto& [response, word] : words(failure::SpallResponse{})) {
    SCOPED_TRACE(word);
    const Material material = with_law(failure::TensilePressure{{}, 1e9, response});
    MaterialPoints points = points_of(material, 1);
    shear(material, points);
    const double yield = equivalent_stress(points.deviatoric_stress[0]);
    ASSERT_GT(yield, 150e6);
    strain_to(material, points, 1.03e-9, 100);  // 4.2 GPa of tension without a limit
    const bool cut_off = response == failure::SpallResponse::cut_off;
    EXPECT_EQ(points.failed[0] == failure::intact, cut_off);
    EXPECT_NEAR(points.pressure[0], cut_off ? -1e9 : 0.0, 1.0);
    EXPECT_NEAR(equivalent_stress(points.deviatoric_stress[0]), cut_off ? yield : 0.0, 1e-6 * yield);
    EXPECT_NEAR(points.void_volume[0], cut_off ? 0.0229e-9 : 0.03e-9, 5e-4 * 1e-9);
    strain_to(material, points, 0.99e-9, 100);
    EXPECT_EQ(points.void_volume[0], 0.0);
    EXPECT_NEAR(points.pressure[0], cold_eos.pressure(8930.0 / 0.99, 0.0), 1e-3 * modulus);
    EXPECT_EQ(points.failed[0] == failure::intact, response != failure::SpallResponse::failure);
    shear(material, points);
    const double after = equivalent_stress(points.deviatoric_stress[0]);
    EXPECT_NEAR(after, response == failure::SpallResponse::failure ? 0.0 : yield, 0.1 * yield);
    strain_to(material, points, 1.01e-9, 20);  // 1.4 GPa: it fails again, at the same tension
    EXPECT_NEAR(points.pressure[0], cut_off ? -1e9 : 0.0, 1.0);
  }
}

TEST(TensilePressure, CutOffHoldsForALongExpansionAndGivesNoEnergy) {
  const Material material = with_law(failure::TensilePressure{{}, 0.5e9, failure::SpallResponse::cut_off});
  MaterialPoints points = points_of(material, 1);
  strain_to(material, points, 1.5e-9, 2000);
  EXPECT_NEAR(points.pressure[0], -0.5e9, 1.0);
  EXPECT_EQ(points.failed[0], failure::intact);
  const double opened = points.specific_internal_energy[0];
  strain_to(material, points, 1e-9, 2000);
  EXPECT_GE(opened, 0.0);
  EXPECT_GE(points.specific_internal_energy[0], -1e-3 * opened);  // a closed cycle returns no energy
}

TEST(TulerButcher, ConstantTensionFailsAtTheExactTime) {
  constexpr double sigma_0 = 0.4e9, tau = 1e-6;
  for (const double lambda : {1.0, 2.0, 2.5}) {
    for (const double times : {1.5, 2.0, 3.0}) {
      for (const auto& [measure, word] : words(failure::Tension{})) {
        const Material material = with_law(failure::TulerButcher{sigma_0, lambda, tau, measure, false});
        MaterialPoints points = points_of(material, 1);
        points.volume[0] = points.mass[0] / (cold_eos.rho0 * (1.0 - times * sigma_0 / modulus));
        const double exact = tau / std::pow(times - 1.0, lambda);
        int steps = 0;
        const Matrix3 rest = Matrix3::Zero();
        while (points.failed[0] == failure::intact && steps * dt < 2.0 * exact) {
          step_with_work(material, points, rest, settings);
          ++steps;
          if (points.failed[0] == failure::intact) {
            ASSERT_NEAR(points.history.scalar("damage")[0], steps * dt / exact, 1e-9);
            // There is no softening before the damage is complete
            ASSERT_NEAR(points.pressure[0], -times * sigma_0, 1.0);
          }
        }
        EXPECT_EQ(points.failed[0], failure::spalled);
        EXPECT_NEAR(steps * dt, exact, 1.01 * dt) << lambda << " " << times << " " << word;
      }
    }
  }
}

TEST(TulerButcher, NothingAccumulatesBelowTheThresholdAndPrincipalStressIsTheSameInEveryFrame) {
  const failure::TulerButcher mean{0.4e9, 2.0, 1e-6, failure::Tension::mean_stress, false},
      principal{0.4e9, 2.0, 1e-6, failure::Tension::principal_stress, false};
  // 0.3 GPa of mean tension and 0.2 GPa of deviator along an axis: 0.5 GPa across the plane.
  const Matrix3 turn = (Eigen::AngleAxisd(0.7, Vector3::UnitX()) * Eigen::AngleAxisd(1.1, Vector3::UnitZ()))
                           .toRotationMatrix();
  std::array<double, 2> damages{};
  for (const int turned : {0, 1}) {
    Matrix3 s = 0.2e9 * Vector3(1.0, -0.5, -0.5).asDiagonal().toDenseMatrix();
    if (turned != 0) s = turn * s * turn.transpose();
    const std::array<double, 6> lanes = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
    const std::array pressure = {-0.3e9}, solid = {0.0}, factor = {1.0};
    failure::State state{};
    state.time_step = dt;
    state.pressure = pressure;
    state.melted_fraction = solid;
    state.threshold_factor = factor;
    for (std::size_t j = 0; j < 6; ++j) state.deviator.lane[j] = std::span(&lanes[j], 1);
    std::array damage = {0.0};
    std::array<std::uint8_t, 1> failed = {failure::intact};
    mean.mark(state, damage, failed);
    EXPECT_EQ(damage[0], 0.0);
    principal.mark(state, damage, failed);
    damages[static_cast<std::size_t>(turned)] = damage[0];
  }
  EXPECT_NEAR(damages[0], std::pow(0.25, 2.0) * dt / 1e-6, 1e-12);
  EXPECT_NEAR(damages[1], damages[0], 1e-9 * damages[0]);
}

TEST(TulerButcher, HealsOnlyIfAskedTo) {
  for (const bool healing : {false, true}) {
    const Material material =
        with_law(failure::TulerButcher{0.4e9, 2.0, 1e-8, failure::Tension::mean_stress, healing});
    MaterialPoints points = points_of(material, 1);
    strain_to(material, points, 1.02e-9, 100);
    ASSERT_EQ(points.failed[0], failure::spalled);
    strain_to(material, points, 0.99e-9, 100);
    EXPECT_GT(points.pressure[0], 1e9);
    EXPECT_EQ(points.failed[0] == failure::intact, healing);
    EXPECT_EQ(points.history.scalar("damage")[0], healing ? 0.0 : 1.0);
    shear(material, points);
    EXPECT_NEAR(equivalent_stress(points.deviatoric_stress[0]), healing ? 158e6 : 0.0, 10e6);
  }
}

const failure::ViscousVoidGrowth copper_voids{{}, 0.16e9, 1.0, 3e-4, 0.29, false};

/// Returns the maximum tension at a constant rate of the volume, by the equations of the source in steps of 10 ps.
double greatest_tension(double rate) {
  const double least = 1.0 + copper_voids.nuclei;
  double alpha = least, strain = 0.0, greatest = 0.0;
  constexpr double step = 1e-11;
  for (int n = 0; n < 400000; ++n) {
    strain += rate * step;
    const double tension = modulus * (1.0 - std::exp(-(strain - std::log(alpha / least)))) / alpha;
    const double drive = tension - copper_voids.resistance / alpha * std::log(alpha / (alpha - 1.0));
    if (drive > 0.0) {
      alpha += step * std::pow(least - 1.0, 2.0 / 3.0) / copper_voids.viscosity * alpha *
               std::cbrt(alpha - 1.0) * drive;
    }
    greatest = std::max(greatest, tension);
    if (tension < 0.9 * greatest) break;
  }
  return greatest;
}

TEST(ViscousVoidGrowth, TensionRisesWithTheRateAsTheEquationsOfTheSource) {
  const Material material = with_law(copper_voids);
  double before = 0.16e9 * std::log(1.0003 / 3e-4);  // static
  for (const double rate : {1e5, 1e6}) {
    const double exact = greatest_tension(rate);
    EXPECT_GT(exact, before);
    before = exact;
    for (const double divided : {1.0, 10.0}) {
      UpdateSettings finer = settings;
      finer.time_step = dt / divided;
      MaterialPoints points = points_of(material, 1);
      double greatest = 0.0;
      const Matrix3 gradient = rate / 3.0 * Matrix3::Identity();
      for (int n = 0; n < 400 * divided * 1e5 / rate * 1.5; ++n) {
        step_with_work(material, points, gradient, finer);
        const double volume = points.volume[0], total = volume + points.void_volume[0];
        greatest = std::max(greatest, -points.pressure[0] * volume / total);
      }
      EXPECT_NEAR(greatest, exact, (divided > 1.0 ? 0.01 : 0.05) * exact) << rate << ", " << finer.time_step;
      EXPECT_GT(points.void_volume[0], 0.0);
    }
  }
}

TEST(ViscousVoidGrowth, OpensBeyondTheStaticTensionKeepsTheDeviatorAndClosesUnderPressure) {
  const Material material = with_law(copper_voids);
  MaterialPoints points = points_of(material, 1);
  const double at_rest = 0.16e9 * std::log(1.0003 / 3e-4);
  strain_to(material, points, 1e-9 / (1.0 - 0.99 * at_rest / modulus), 1000);
  EXPECT_EQ(points.void_volume[0], 0.0);
  strain_to(material, points, 1e-9, 1000);
  shear(material, points);
  const double yield = equivalent_stress(points.deviatoric_stress[0]);
  strain_to(material, points, 1.03e-9, 3000);
  EXPECT_EQ(points.failed[0], failure::intact);
  EXPECT_NEAR(equivalent_stress(points.deviatoric_stress[0]), yield, 1e-6 * yield);
  EXPECT_GT(points.void_volume[0], 0.02e-9);
  EXPECT_GT(points.pressure[0], -1.0e9);  // the grown voids carry less tension than the nuclei
  const double opened = points.specific_internal_energy[0];
  EXPECT_GT(opened, 0.0);
  strain_to(material, points, 0.98e-9, 3000);
  EXPECT_EQ(points.void_volume[0], 0.0);
  EXPECT_NEAR(points.pressure[0], cold_eos.pressure(8930.0 / 0.98, 0.0), 1e-3 * modulus);
  EXPECT_EQ(points.failed[0], failure::intact);
  EXPECT_GT(points.specific_internal_energy[0], opened);  // opening and closing both dissipate
}

TEST(ViscousVoidGrowth, PartsWhereTheVoidsMeetAndHealsOnlyIfAskedTo) {
  for (const bool healing : {false, true}) {
    failure::ViscousVoidGrowth law = copper_voids;
    law.healing = healing;
    const Material material = with_law(law);
    MaterialPoints points = points_of(material, 1);
    strain_to(material, points, 1.38e-9, 3000);
    EXPECT_EQ(points.failed[0], failure::intact);
    strain_to(material, points, 1.43e-9, 1000);
    EXPECT_EQ(points.failed[0], failure::void_growth);
    EXPECT_EQ(points.pressure[0], 0.0);
    strain_to(material, points, 0.99e-9, 1000);
    EXPECT_GT(points.pressure[0], 1e9);
    EXPECT_EQ(points.failed[0] == failure::intact, healing);
  }
}

TEST(ViscousVoidGrowth, MoltenMatterPartsAtTheFirstTension) {
  LinearInEnergy eos = cold_eos;
  eos.melting_starts = 1e3;
  eos.melting_ends = 2e3;
  const Material material = with_law(copper_voids, eos);
  MaterialPoints points = points_of(material, 1);
  points.specific_internal_energy[0] = 5e3;
  strain_to(material, points, 1.0001e-9, 2);
  EXPECT_EQ(points.failed[0], failure::tensile);
}

TEST(Spall, OneModelOfAMaterialOpensVoids) {
  const auto voids = std::make_shared<failure::CriterionModel<failure::ViscousVoidGrowth>>(copper_voids);
  const auto cut_off = std::make_shared<failure::CriterionModel<failure::TensilePressure>>(
      failure::TensilePressure{{}, 1e9, failure::SpallResponse::cut_off});
  try {
    with(taylor_copper(), {voids, cut_off});
    FAIL() << "accepted";
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), testing::HasSubstr("both open voids"));
  }
}

// The work of the deviator from the limit to separation, in a band of one cell, is the energy per area of the crack.
TEST(Tearing, TakesItsEnergyPerAreaInTensionWhateverTheCell) {
  failure::Tearing law;
  law.failure_strain = 0.05;
  law.energy_per_area = 2e4;
  const Material material = with_law(law);
  const auto stretch = [&](MaterialPoints& points, double cell, double across) {
    UpdateSettings of_cell = settings;
    of_cell.cell_size = cell;
    const Matrix3 gradient = 2e-4 / dt * Matrix3(Vector3(1.0, across, across).asDiagonal());
    const double before = points.plastic_strain[0];
    points.specific_internal_energy[0] = 0.0;
    update_material(material, points, 0, 1, std::span(&gradient, 1), of_cell);
    return std::sqrt(1.5 * points.deviatoric_stress[0].squared_norm()) * (points.plastic_strain[0] - before);
  };
  for (const double cell : {0.25e-3, 0.5e-3, 1e-3, 2e-3}) {
    MaterialPoints points = points_of(material, 1);
    double work = 0.0;
    while (points.failed[0] == failure::intact) {
      const double of_step = stretch(points, cell, -0.4999);  // barely in tension
      work += points.history.scalar("damage")[0] > 0.0 ? of_step : 0.0;
      ASSERT_LT(points.plastic_strain[0], 2.0);
    }
    EXPECT_EQ(points.failed[0], failure::plastic);
    EXPECT_NEAR(work * cell, law.energy_per_area, 0.02 * law.energy_per_area) << cell;
  }
  MaterialPoints points = points_of(material, 1);
  for (int i = 0; i < 2000; ++i) stretch(points, 1e-3, -0.5001);  // under pressure
  EXPECT_GT(points.plastic_strain[0], 0.3);
  EXPECT_EQ(points.history.scalar("damage")[0], 0.0);
}

}  // namespace spall_test
}  // namespace whipple
