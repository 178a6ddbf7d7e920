// SPDX-License-Identifier: BSD-3-Clause
// Static crystals: elastic constants and cold curves of copper against published numbers, thermodynamic
// identities and the lattice sums.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/cold_curve.hpp"
#include "md_fitting/protocols/elastic.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

const Potential& mishin() {
  static const Potential potential = Potential::load("copper_mishin_2001", "Cu");
  return potential;
}

ColdState cold(CrystalStructure structure, double ratio) {
  std::string transcript;
  return measure_cold(mishin(), structure, ratio * mishin().static_volume(), transcript);
}

// Mishin et al., Phys. Rev. B 63 (2001) 224106: 169.9, 122.6, 76.2 GPa, B = 138.3 GPa.
TEST(Elastic, ConstantsOfMishinsCopperArePublishedOnes) {
  const ElasticResult result = measure_elastic(mishin(), mishin().static_volume(), 0.005, 5);
  EXPECT_NEAR(result.c11.value, 169.9e9, 0.01 * 169.9e9);
  EXPECT_NEAR(result.c12.value, 122.6e9, 0.01 * 122.6e9);
  EXPECT_NEAR(result.c44.value, 76.2e9, 0.01 * 76.2e9);
  EXPECT_NEAR(result.bulk_modulus.value, 138.3e9, 0.01 * 138.3e9);
  EXPECT_NEAR(result.pressure, 0.0, 0.02e9);
  EXPECT_TRUE(result.stable());
  EXPECT_LT(result.c11.error, 0.01 * result.c11.value);
  // Hill's mean lies between the bounds of Voigt and Reuss, which differ for an anisotropic crystal:
  // with the published constants 55.2 and 40.4 GPa.
  EXPECT_NEAR(result.shear_modulus_voigt.value, 55.2e9, 0.6e9);
  EXPECT_NEAR(result.shear_modulus_reuss.value, 40.4e9, 0.6e9);
}

// The bulk modulus from strains of one axis is that of the cold curve, -V dP/dV, also under pressure: the
// constants there are the coefficients of stress against strain, not second derivatives of the energy.
TEST(Elastic, BulkModulusIsTheSlopeOfTheColdCurveAtAnyPressure) {
  for (const double ratio : {1.05, 0.8}) {
    const ElasticResult result = measure_elastic(mishin(), ratio * mishin().static_volume(), 0.002, 5);
    const double step = 1e-4;
    const double slope = -(cold(CrystalStructure::fcc, ratio * (1 + step)).pressure -
                           cold(CrystalStructure::fcc, ratio * (1 - step)).pressure) /
                         (2 * step);
    EXPECT_NEAR(result.bulk_modulus.value / slope, 1.0, 2e-3) << ratio;
    EXPECT_NEAR(result.pressure / cold(CrystalStructure::fcc, ratio).pressure, 1.0, 1e-9);
  }
}

TEST(Elastic, ExtrapolationFindsTheLineAndItsUncertainty) {
  const std::array<double, 4> x = {1.0, 2.0, 3.0, 4.0};
  const Estimate exact = extrapolate_to_zero(x, std::array<double, 4>{8.0, 6.0, 4.0, 2.0});
  EXPECT_NEAR(exact.value, 10.0, 1e-12);
  EXPECT_NEAR(exact.error, 2.0, 1e-12);  // what was extrapolated over
}

// P = -dE/dV, and the energy is that of the lattice sums over the potential's tables.
TEST(ColdCurve, PressureIsTheDerivativeOfTheEnergy) {
  const double volume = mishin().static_volume();
  for (const auto structure : {CrystalStructure::fcc, CrystalStructure::bcc, CrystalStructure::hcp}) {
    for (const double ratio : {0.5, 0.75, 0.9, 1.15}) {
      const double step = 2e-4;
      const double derivative = -(cold(structure, ratio + step).specific_internal_energy -
                                  cold(structure, ratio - step).specific_internal_energy) /
                                (2 * step * volume);
      EXPECT_NEAR(cold(structure, ratio).pressure / derivative, 1.0, 1e-3)
          << word_of(structure) << " " << ratio;
    }
  }
  const double a = std::cbrt(0.7) * mishin().lattice_constant();
  EXPECT_NEAR(cold(CrystalStructure::fcc, 0.7).specific_internal_energy /
                  metal::specific_energy(mishin().tables().crystal_energy(a), mishin().mass()),
              1.0, 2e-5);
}

// Energies of other structures above fcc, each at its own least energy: Mishin et al. (2001): hcp 0.008 eV,
// bcc 0.046 eV. An hcp crystal of a pair-like metal keeps nearly the ideal axial ratio 1.633.
TEST(ColdCurve, StructuresDifferAsPublished) {
  const auto least = [&](CrystalStructure structure) {
    double energy = 0.0;
    for (double ratio = 0.98; ratio < 1.04; ratio += 0.004) {
      energy = std::fmin(energy, cold(structure, ratio).specific_internal_energy);
    }
    return energy / metal::specific_energy(1.0, mishin().mass());
  };
  const double fcc = least(CrystalStructure::fcc);
  EXPECT_NEAR(least(CrystalStructure::hcp) - fcc, 0.008, 0.001);
  EXPECT_NEAR(least(CrystalStructure::bcc) - fcc, 0.046, 0.002);
  EXPECT_NEAR(cold(CrystalStructure::hcp, 1.0).axial_ratio, 1.633, 0.01);
}

TEST(ColdCurve, RefusesCompressionBeyondTheTable) {
  Plan plan;
  plan.element = "Cu";
  plan.potential = "Cu_mishin1.eam.alloy";
  plan.cold_curve = ColdCurvePlan{{1.0, 0.6}};
  plan.elastic = ElasticPlan{{0.65}, 0.005, 5};
  const Potential potential = Potential::load(plan.potential, plan.element);
  try {
    make_tasks(plan, potential);
    FAIL() << "no InputError";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("cold_curve: potential Cu_mishin1.eam.alloy"), std::string::npos) << text;
    EXPECT_NE(text.find("elastic: potential"), std::string::npos) << text;
    EXPECT_NE(text.find("V/V0 = 0.600"), std::string::npos) << text;
  }
}

// Every quantity that leaves this program has a unit in the store.
TEST(ColdCurve, PointsOfAPlanHaveUnits) {
  Plan plan;
  plan.element = "Cu";
  plan.cold_curve = ColdCurvePlan{{0.8}};
  plan.elastic.emplace();
  for (const Task& task : make_tasks(plan, mishin())) {
    for (const auto& [name, estimate] : task.compute(nullptr).results) {
      EXPECT_TRUE(name == "hcp_axial_ratio" || !unit_of(name).empty()) << task.protocol << " " << name;
    }
  }
}

}  // namespace
}  // namespace whipple::md
