// SPDX-License-Identifier: BSD-3-Clause
// Models of OpenKIM: what is measured of them when they are loaded, against tables of the same functions, and
// what is refused. The models are optional packages; without them only the messages are tested.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "md_fitting/lammps/kim_model.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

constexpr const char* mishin_model = "EAM_Dynamo_MishinMehlPapaconstantopoulos_2001_Cu__MO_346334655118_005";
constexpr const char* landa_model = "EAM_Dynamo_LandaWynblattSiegel_2000_AlPb__MO_699137396381_005";
constexpr const char* ravelo_model = "EAM_Dynamo_RaveloGermannGuerrero_2013Ta1_Ta__MO_816821594689_000";
constexpr const char* magnesium_model = "EAM_Dynamo_SunMendelevBecker_2006_Mg__MO_848345414202_005";

std::string loading_fault(const std::string& model, const std::string& element) {
  try {
    Potential::load(model, element);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool models_installed() {
  static const bool all = loading_fault(mishin_model, "Cu").empty();
  return all;
}

TEST(KimModel, IdentifiersAreTold) {
  EXPECT_TRUE(is_kim_identifier(mishin_model));
  EXPECT_TRUE(is_kim_identifier("Sim_LAMMPS_ADP_ApostolMishin_2011_AlCu__SM_667696763561_000"));
  for (const char* other :
       {"copper_mishin_2001", "Cu_u3.eam", "EAM_Dynamo__MO_346334655118", "EAM; quit__MO_346334655118_005"}) {
    EXPECT_FALSE(is_kim_identifier(other)) << other;
  }
}

TEST(KimModel, ThoseThatAreNotThereAreNamed) {
  const std::string fault = loading_fault("EAM_Dynamo_Nobody_2001_Cu__MO_346334655119_005", "Cu");
  EXPECT_NE(fault.find("KIM Model name not found"), std::string::npos) << fault;
  EXPECT_NE(fault.find(models_installed() ? "for Cu there are" : "scripts/install_deps.sh --kim"),
            std::string::npos)
      << fault;
  EXPECT_FALSE(std::filesystem::exists("kim.log"));
}

// The program's own tables of Mishin's copper and the model hold the same functions.
TEST(KimModel, MishinsCopperIsThatOfTheTables) {
  if (!models_installed()) GTEST_SKIP() << "no models of OpenKIM (scripts/install_deps.sh --kim)";
  const Potential model = Potential::load(mishin_model, "Cu");
  const Potential tables = Potential::load("copper_mishin_2001", "Cu");
  EXPECT_EQ(model.structure(), CrystalStructure::fcc);
  EXPECT_NEAR(model.lattice_constant(), tables.lattice_constant(), 2e-5);
  EXPECT_NEAR(model.mass(), tables.mass(), 0.01);
  EXPECT_NEAR(model.cutoff(), tables.cutoff(), 0.1);
  for (const double ratio : {1.3, 1.0, 0.83, 0.7, 0.55, 0.42}) {
    const double a = std::cbrt(ratio) * tables.lattice_constant();
    EXPECT_NEAR(model.crystal_energy(a), tables.crystal_energy(a), 5e-4) << ratio;
  }
  EXPECT_THROW(static_cast<void>(model.tables()), InternalError);
  EXPECT_THROW(static_cast<void>(model.crystal_energy(0.6 * tables.lattice_constant())), StateError);

  const RunSize size{.cells = 3, .equilibration_steps = 500, .steps = 1000};
  NvtStateSource first(model, size, 11);
  NvtStateSource second(tables, size, 12);
  const double volume = 0.85 * tables.static_volume();
  const State a = first.state(volume, 600.0, StateSource::Effort::final);
  const State b = second.state(volume, 600.0, StateSource::Effort::final);
  EXPECT_TRUE(a.solid);
  EXPECT_NEAR(a.pressure.value, b.pressure.value, 4.0 * std::hypot(a.pressure.error, b.pressure.error));
}

// Landa, Wynblatt, Siegel, Nichols, Mundy, Mouritsen, Philos. Mag. A 80 (2000) 1039: the model refuses
// densities beyond its table, which the static crystal of lead reaches at V/V0 = 0.54.
TEST(KimModel, CompressionEndsWhereTheModelRefuses) {
  if (!models_installed()) GTEST_SKIP() << "no models of OpenKIM (scripts/install_deps.sh --kim)";
  const Potential lead = Potential::load(landa_model, "Pb");
  EXPECT_NEAR(lead.lattice_constant(), 4.909, 0.002);
  EXPECT_NEAR(lead.table_end(), 0.540, 0.01);
  EXPECT_NEAR(lead.least_volume_ratio(), 1.05 * lead.table_end(), 1e-12);
  EXPECT_NO_THROW(lead.require_range(lead.least_volume_ratio()));
  EXPECT_THROW(lead.require_range(0.999 * lead.least_volume_ratio()), InputError);
}

// Ravelo, Germann, Guerrero, An, Holian, Phys. Rev. B 88 (2013) 134101: a0 = 3.304 A, bcc.
TEST(KimModel, FindsTheStructure) {
  if (!models_installed()) GTEST_SKIP() << "no models of OpenKIM (scripts/install_deps.sh --kim)";
  const Potential tantalum = Potential::load(ravelo_model, "Ta");
  EXPECT_EQ(tantalum.structure(), CrystalStructure::bcc);
  EXPECT_NEAR(tantalum.lattice_constant(), 3.304, 5e-4);
  EXPECT_EQ(tantalum.table_end(), 0.0);
  EXPECT_NE(loading_fault(magnesium_model, "Mg").find("is hcp; fcc and bcc are supported"),
            std::string::npos);
  EXPECT_NE(loading_fault(mishin_model, "Al").find("symbol not found: Al"), std::string::npos)
      << loading_fault(mishin_model, "Al");
}

}  // namespace
}  // namespace whipple::md
