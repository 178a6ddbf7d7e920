// SPDX-License-Identifier: BSD-3-Clause
// Damage of the library's alloys: plane tension is left to the growth of voids, shear breaks at the strain of the set.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/material/failure/johnson_cook_damage.hpp"
#include "src/material/material_file.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

constexpr double rate = 1e5;  // 1/s, of plate impacts

/// Materials of the library with ductile damage beside the growth of voids.
std::vector<Material> damaged_alloys() {
  std::vector<Material> found;
  for (const LibraryMaterial& entry : library_materials()) {
    if (entry.group != "metals") continue;
    Material material = read_material(entry.file);
    const auto has = [&](const char* model) {
      return std::ranges::any_of(material.failure, [&](const auto& law) { return law->model() == model; });
    };
    if (has("johnson_cook_damage") && has("viscous_void_growth")) found.push_back(std::move(material));
  }
  return found;
}

/// Deforms a point at a constant velocity gradient until it fails or has strained by `strain`.
MaterialPoints deformed(const Material& material, const Matrix3& gradient, double strain) {
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = 1e-6;
  initialise(material, points, 0, 1);
  const UpdateSettings settings{.time_step = 1e-9, .cell_size = 1e-3};
  for (double reached = 0.0; reached < strain && points.failed[0] == failure::intact;
       reached += rate * settings.time_step) {
    update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
  }
  return points;
}

TEST(AlloyDamage, CountsStrainsBetweenItsTriaxialitiesAlone) {
  failure::JohnsonCookDamage law;  // OFHC copper, Johnson and Cook (1985)
  law.d1 = 0.54;
  law.d2 = 4.89;
  law.d3 = -3.03;
  law.reference_temperature = 294.0;
  law.melting_temperature = 1356.0;
  law.least_triaxiality = -1.0 / 3.0;
  law.greatest_triaxiality = 1.0;
  const std::array<double, 6> pressure = {-1.01e8, -0.99e8, 0.0, 0.33e8, 0.34e8, 9e8},
                              increment = {.1, .1, .1, .1, .1, .1}, room = {294, 294, 294, 294, 294, 294},
                              one = {1, 1, 1, 1, 1, 1}, zero = {},
                              xx = {2e8 / 3, 2e8 / 3, 2e8 / 3, 2e8 / 3, 2e8 / 3, 2e8 / 3},
                              yy = {-1e8 / 3, -1e8 / 3, -1e8 / 3,
                                    -1e8 / 3, -1e8 / 3, -1e8 / 3};  // equivalent 100 MPa
  std::array<double, 6> damage{};
  std::array<std::uint8_t, 6> failed{};
  law.mark({.time_step = 0.1,
            .pressure = pressure,
            .temperature = room,
            .density = one,
            .bulk_modulus = one,
            .shear_modulus = one,
            .volume = one,
            .band = one,
            .plastic_strain = increment,
            .plastic_increment = increment,
            .melted_fraction = zero,
            .threshold_factor = one,
            .deviator = {{xx, yy, yy, zero, zero, zero}},
            .strain = {}},
           damage, failed);
  EXPECT_EQ(damage[0], 0.0);
  EXPECT_NEAR(damage[1], 0.1 / law.failure_strain(0.99, 1.0, 294.0), 1e-12);
  EXPECT_NEAR(damage[2], 0.1 / 5.43, 1e-12);
  EXPECT_NEAR(damage[3], 0.1 / law.failure_strain(-0.33, 1.0, 294.0), 1e-12);
  EXPECT_EQ(damage[4], 0.0);
  EXPECT_EQ(damage[5], 0.0);
  law.greatest_triaxiality = -0.5;
  EXPECT_THROW(law.require_consistent(), InputError);
}

TEST(AlloyDamage, LeavesSpallToTheGrowthOfVoids) {
  const std::vector<Material> alloys = damaged_alloys();
  EXPECT_GE(alloys.size(), 14U);
  Matrix3 stretch = Matrix3::Zero();
  stretch(0, 0) = rate;
  for (const Material& alloy : alloys) {
    const MaterialPoints points = deformed(alloy, stretch, 0.3);
    EXPECT_EQ(points.failed[0], failure::void_growth) << alloy.name;
    EXPECT_LT(points.plastic_strain[0], 0.3) << alloy.name;
  }
}

TEST(AlloyDamage, BreaksInShearAtTheStrainOfTheSet) {
  Matrix3 shear = Matrix3::Zero();
  shear(0, 1) = rate;
  for (const Material& alloy : damaged_alloys()) {
    const MaterialPoints points = deformed(alloy, shear, 8.0);
    EXPECT_EQ(points.failed[0], failure::fractured) << alloy.name;
    // D1 + D2 at the rate of the test: steel 4340 is the toughest, 2219-T87 the most brittle of the sets.
    EXPECT_GT(points.plastic_strain[0], 0.15) << alloy.name;
    EXPECT_LT(points.plastic_strain[0], 3.9) << alloy.name;
    if (alloy.name == "aluminium 6061-T6, with ductile fracture") {
      EXPECT_NEAR(points.plastic_strain[0], 0.29 + 1.356, 0.02 * 1.646);
    }
  }
}

}  // namespace
}  // namespace whipple
