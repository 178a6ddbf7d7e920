// SPDX-License-Identifier: BSD-3-Clause
// The constitutive model of an explosive that burns: what it declares, what burning does to a deviator, where it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "eos/model_equation_of_state.hpp"
#include "src/core/base/error.hpp"
#include "src/material/burn_model.hpp"
#include "src/material/eos_strength/eos_strength.hpp"
#include "src/material/hyperelastic/model.hpp"
#include "src/material/hyperelastic/neo_hookean.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

/// TNT, burnt from the start, with a yield stress as the unreacted explosive.
Material tnt_with_strength() {
  const auto products = std::make_shared<const eos::ModelEquationOfState<eos::Jwl>>(eos::test::tnt());
  strength::VonMises constants = taylor_copper();
  constants.yield_stress = 1e9;
  Material material =
      make_material("tnt", products, std::make_shared<const strength::VonMisesModel>(constants));
  material.explosive = make_explosive(products, nullptr);
  return material;
}

std::vector<std::string> fields_of(const Material& material) {
  std::vector<std::string> names;
  for (const auto& slot : material.constitutive->history()) names.push_back(slot.field.name);
  return names;
}

TEST(BurnModel, IsThatOfExplosivesThatBurnAlone) {
  const Material burnt = tnt_with_strength(), burns = burning(burnt), inert = unreacted(burns);
  EXPECT_EQ(burns.constitutive->model(), "burn");
  EXPECT_THAT(fields_of(burns), testing::ElementsAre("burn_fraction", "lighting_time"));
  for (const Material& other : {burnt, inert, with_eos(burns, burnt.eos)}) {
    EXPECT_FALSE(other.burns());
    EXPECT_EQ(other.constitutive->model(), "eos_strength");
    EXPECT_TRUE(fields_of(other).empty());
  }
  for (const HistoryField& field : material::EosStrength::fields()) {
    EXPECT_NE(field.name, "burn_fraction");
    EXPECT_NE(field.name, "lighting_time");
  }
  // A second wave of another velocity.
  EXPECT_EQ(burning(burns, 5000.0).burning_explosive().detonation_velocity, 5000.0);
}

TEST(BurnModel, TakesThePlaceOfNoOtherModel) {
  Material rubber = make_material("rubber", tnt_with_strength().explosive->unreacted,
                                  std::make_shared<const material::HyperelasticModel<material::NeoHookean>>(
                                      material::NeoHookean{2e6, {}}));
  rubber.explosive = tnt_with_strength().explosive;
  EXPECT_THROW((void)burning(rubber), InputError);
}

/// Points of a material after a step of shear of 1 %; their burn fractions are given.
MaterialPoints sheared(const Material& material, const std::vector<double>& burnt) {
  MaterialPoints points = points_of(material, burnt.size());
  std::ranges::copy(burnt, points.history.scalar("burn_fraction").begin());
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = 1e4;
  const std::vector<Matrix3> gradients(burnt.size(), gradient);
  UpdateSettings settings{.time_step = 1e-6, .cell_size = 1e-3};
  settings.burn.width = 2e-3;
  EXPECT_TRUE(update_material(material, points, 0, burnt.size(), gradients, settings).valid());
  return points;
}

TEST(BurnModel, TheDeviatorIsLostAsSoonAsAPointBurns) {
  const MaterialPoints points = sheared(burning(tnt_with_strength()), {0.0, 0.5, 1.0});
  EXPECT_GT(points.deviatoric_stress[0].xy, 1e8);
  EXPECT_EQ(points.deviatoric_stress[1].xy, 0.0);
  EXPECT_EQ(points.deviatoric_stress[2].xy, 0.0);
  EXPECT_EQ(points.vaporised_fraction[0], 0.0);
  EXPECT_EQ(points.vaporised_fraction[1], 0.5);
  EXPECT_LT(std::abs(points.pressure[0]), 1e6);
  EXPECT_NEAR(points.pressure[2], 8.38e9, 0.02e9);  // of the burn at constant volume
}

// Products may be denser than the unreacted explosive ever is: each point is held at what it consists of.
TEST(BurnModel, APointIsHeldAtTheDensityOfWhatItConsistsOf) {
  const Material material = burning(tnt_with_strength());
  const double of_reactant = material.eos->maximum_density();
  const double of_products = material.burning_explosive().products->maximum_density();
  ASSERT_GT(of_products, 1.05 * of_reactant);
  MaterialPoints points = points_of(material, 3);
  points.history.scalar("burn_fraction") = {0.0, 0.5, 1.0};
  for (double& volume : points.volume) volume = points.mass[0] / (0.99 * of_reactant);
  const std::vector<Matrix3> gradients(3, -1e4 * Matrix3::Identity());  // 3 % denser
  UpdateSettings settings{.time_step = 1e-6, .cell_size = 1e-3};
  settings.burn.width = 2e-3;
  const MaterialReport report = update_material(material, points, 0, 3, gradients, settings);
  EXPECT_EQ(report.squeezed, 2U);
  EXPECT_NEAR(points.mass[0] / points.volume[0], 0.999 * of_reactant, 1e-9 * of_reactant);
  EXPECT_NEAR(points.mass[1] / points.volume[1], 0.999 * of_reactant, 1e-9 * of_reactant);
  EXPECT_GT(points.mass[2] / points.volume[2], 1.01 * of_reactant);
}

}  // namespace
}  // namespace whipple
