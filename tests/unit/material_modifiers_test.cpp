// SPDX-License-Identifier: BSD-3-Clause
// Modifiers of the equation of state in material files, and porous material in the constitutive update.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string metal = R"toml(name = "porous metal"
source = "test"
[eos]
model = "mie_gruneisen"
reference_density = "8.93 g/cm^3"
hugoniot_intercept = "3.94 km/s"
hugoniot_slope = 1.489
gruneisen = 1.97
heat_capacity = "383 J/(kg K)"
)toml";

const std::string pores = R"toml([[eos.modifier]]
model = "p_alpha"
source = "test"
distension = 1.25
elastic_pressure = "100 MPa"
solid_pressure = "1 GPa"
)toml";

class Modifiers : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("material_modifiers_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] Material read(const std::string& text) const {
    std::ofstream(folder_ / "metal.toml") << text;
    return read_material(folder_ / "metal.toml");
  }
  [[nodiscard]] std::string message(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

TEST_F(Modifiers, AreAppliedInTheOrderOfTheFile) {
  const Material plain = read(metal), porous = read(metal + pores);
  EXPECT_NEAR(porous.reference.density * 1.25, plain.reference.density, 1e-6 * plain.reference.density);
  EXPECT_EQ(porous.reference.distension, 1.25);
  EXPECT_EQ(plain.reference.distension, 1.0);
  EXPECT_NEAR(porous.reference.pressure, 0.0, 1.0);
  const Material shifted =
      read(metal + pores + "[[eos.modifier]]\nmodel = \"shift\"\nenergy = \"1 MJ/kg\"\n");
  EXPECT_NEAR(shifted.reference.specific_internal_energy, 1e6, 1e-3);
  EXPECT_EQ(shifted.reference.distension, 1.25);
  EXPECT_EQ(shifted.eos->model(), "mie_gruneisen");
}

TEST_F(Modifiers, ProvenanceIsAMaterialFileThatReadsBack) {
  const std::string scaled = "[[eos.modifier]]\nmodel = \"scale\"\ndensity = 1.02\n";
  const Material first = read(metal + scaled + pores);
  const Material again = read(first.constants());
  EXPECT_EQ(again.eos->constants(), first.eos->constants());
  EXPECT_EQ(again.reference.density, first.reference.density);
  EXPECT_EQ(again.eos->state(8500, 1e5).pressure, first.eos->state(8500, 1e5).pressure);
}

TEST_F(Modifiers, FaultsNameFileLineAndWhatIsKnown) {
  EXPECT_THAT(message(metal + "[[eos.modifier]]\nmodel = \"p_alfa\"\n"),
              AllOf(HasSubstr("metal.toml:11"), HasSubstr("p_alpha"), HasSubstr("scale")));
  EXPECT_THAT(message(metal + "[[eos.modifier]]\nmodel = \"shift\"\nenrgy = \"1 J/kg\"\n"),
              AllOf(HasSubstr("enrgy"), HasSubstr("energy")));
  EXPECT_THAT(message(metal + "[[eos.modifier]]\nmodel = \"scale\"\ndensity = -1\n"), HasSubstr("density"));
  // A contradiction among the constants: found when the modifier is built.
  EXPECT_THAT(
      message(metal +
              "[[eos.modifier]]\nmodel = \"p_alpha\"\ndistension = 1.2\nelastic_pressure = \"2 GPa\"\n"
              "solid_pressure = \"1 GPa\"\n"),
      AllOf(HasSubstr("metal.toml"), HasSubstr("eos.modifier"), HasSubstr("solid_pressure")));
  EXPECT_THAT(message(metal + pores + pores), HasSubstr("pores already"));
}

/// Drives one point by uniaxial strain to a volume ratio in steps, with the energy integrated.
void drive(const Material& material, MaterialPoints& points, double ratio, int steps) {
  const double dt = 1e-9, target = points.volume[0] * ratio;
  for (int i = 0; i < steps; ++i) {
    Matrix3 gradient = Matrix3::Zero();
    gradient(0, 0) = (std::pow(target / points.volume[0], 1.0 / (steps - i)) - 1.0) / dt;
    const MaterialReport report = update_material_and_energy(
        material, points, 0, 1, std::span(&gradient, 1),
        {.time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0});
    ASSERT_TRUE(report.valid());
  }
}

TEST_F(Modifiers, PorousMatterIsCrushedForGoodInTheUpdate) {
  const Material material = read(metal + pores);
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = material.reference.density * 1e-9;
  initialise(material, points, 0, 1);
  EXPECT_EQ(points.history.scalar("distension")[0], 1.25);
  EXPECT_NEAR(points.volume[0], 1e-9, 1e-18);

  drive(material, points, 0.9, 400);  // on the crush curve
  const double crushed = points.history.scalar("distension")[0], pressure = points.pressure[0];
  EXPECT_GT(crushed, 1.05);
  EXPECT_LT(crushed, 1.2);
  EXPECT_GT(pressure, 1e8);
  EXPECT_LT(pressure, 1e9);
  const double by_curve = 1 + 0.25 * std::pow((1e9 - pressure) / 9e8, 2);
  EXPECT_NEAR(crushed, by_curve, 2e-4);  // the pressure is half a secant step beside that of the distension

  drive(material, points, 1.004, 100);  // unloads elastically
  EXPECT_EQ(points.history.scalar("distension")[0], crushed);
  EXPECT_LT(points.pressure[0], pressure);

  drive(material, points, 0.85, 400);  // closes
  EXPECT_EQ(points.history.scalar("distension")[0], 1.0);
  EXPECT_GT(points.pressure[0], 1e9);
  const double energy = points.specific_internal_energy[0];
  EXPECT_GT(energy, 0.5 * 1e8 * (1 / material.reference.density - 1 / 8930.0));
  const eos::State matrix =
      read(metal).eos->state(points.mass[0] / points.volume[0], points.specific_internal_energy[0]);
  EXPECT_NEAR(points.pressure[0], matrix.pressure, 1e-6 * matrix.pressure);
  EXPECT_NEAR(points.temperature[0], matrix.temperature, 1e-3);

  drive(material, points, 1.02, 100);  // releases along the matrix: no pores come back
  EXPECT_EQ(points.history.scalar("distension")[0], 1.0);
}

TEST_F(Modifiers, MatterWithoutPoresCarriesNoDistension) {
  const Material material = read(metal);
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = material.reference.density * 1e-9;
  initialise(material, points, 0, 1);
  drive(material, points, 0.8, 50);
  EXPECT_TRUE(points.history.find("distension") == nullptr);
}

}  // namespace
}  // namespace whipple
