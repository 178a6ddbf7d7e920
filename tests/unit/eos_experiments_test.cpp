// SPDX-License-Identifier: BSD-3-Clause
// Measured data and their comparison, called without the command line: data made from the model have no deviation, and
// those shifted by a known amount have that one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "eos/experiments/comparison.hpp"
#include "eos/experiments/measured_table.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::eos::experiments {
namespace {

constexpr double c0 = 5328.0, slope = 1.338;  // of test::aluminium_2024

TEST(EosExperiments, ADeviationIsThatOfTheData) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "shocks.csv";
  {
    std::ofstream text(file);
    text << "# a source\n# material: aluminium\nup_km_s,us_km_s\n";
    for (const double up : {1.0, 2.0, 3.0})
      text << fmt::format("{},{:.12g}\n", up, (1e-3 * c0 + slope * up) / 1.02);
  }
  const std::vector<Experiment> found = read_experiments(file);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, ExperimentKind::shock_velocity);
  EXPECT_EQ(found[0].source, "a source");
  EXPECT_TRUE(belongs_to(found[0], "Aluminium 1100-O"));
  EXPECT_FALSE(belongs_to(found[0], "copper"));
  const test::MieGruneisenEos eos(test::aluminium_2024());
  const State initial = eos.state(eos.reference_density(), eos.reference_energy());
  const Comparison comparison = compare(eos, initial, found[0]);
  EXPECT_EQ(comparison.points, 3);
  EXPECT_NEAR(comparison.mean, 2.0, 1e-6);  // % of Us
  EXPECT_NEAR(comparison.rms, 2.0, 1e-6);
  const std::vector<double> ratio = measured_quantity(file, "V_over_V0");
  EXPECT_NEAR(ratio[0], 1.0 - 1000.0 / found[0].ordinate[0], 1e-12);
  EXPECT_THROW(measured_quantity(file, "T_K"), InputError);
}

TEST(EosExperiments, HeadingsNameQuantities) {
  EXPECT_EQ(MeasuredTable::quantity_of("us_km_s"), Quantity::shock_velocity);
  EXPECT_EQ(MeasuredTable::quantity_of("P [GPa]"), Quantity::pressure);
  EXPECT_EQ(MeasuredTable::quantity_of("rho0_g_cm3"), Quantity::initial_density);
  EXPECT_EQ(MeasuredTable::quantity_of("solidus_K"), std::nullopt);
}

}  // namespace
}  // namespace whipple::eos::experiments
