// SPDX-License-Identifier: BSD-3-Clause
// Potentials by a pair style of LAMMPS, and the pressure to which a potential is meant: examples from LAMMPS'
// own folder.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "md_fitting/lammps/pair_style.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/compressed_start.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

std::string fault_of(const PairStyle& pair, const std::string& element,
                     std::optional<CrystalStructure> structure = {}) {
  try {
    Potential::load("test", element, {}, structure, pair);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

// Mishin, Acta Mater. 53 (2005) 4029: a0 = 3.52 A; angular terms, which a table of the embedded-atom kind has
// not.
TEST(PairStyle, AngularDependentNickelIsMeasured) {
  EXPECT_THROW(Potential::load("Ni.adp", "Ni"), InputError);
  const Potential nickel = Potential::load("mishin_2005", "Ni", {}, {}, {"adp", {"* * Ni.adp Ni"}});
  EXPECT_EQ(nickel.structure(), CrystalStructure::fcc);
  EXPECT_NEAR(nickel.lattice_constant(), 3.52, 0.003);
  EXPECT_NEAR(nickel.mass(), 58.693, 1e-9);
  EXPECT_NEAR(nickel.crystal_energy(nickel.lattice_constant()), -4.45, 0.02);
  EXPECT_NEAR(nickel.cutoff(), 5.168, 0.15);
  EXPECT_FALSE(nickel.has_tables());
  EXPECT_THROW(nickel.require_range(0.2), InputError);
}

// Splines of the modified embedded-atom method; titanium is hcp, which is refused unless the plan states bcc.
TEST(PairStyle, SplinesOfTitaniumAreHexagonal) {
  const PairStyle pair{"meam/spline", {"* * Ti.meam.spline Ti"}};
  EXPECT_NE(fault_of(pair, "Ti").find("hcp"), std::string::npos) << fault_of(pair, "Ti");
  const Potential titanium = Potential::load("hennig_2008", "Ti", {}, CrystalStructure::bcc, pair);
  EXPECT_NEAR(titanium.lattice_constant(), 3.27, 0.05);
}

// Girifalco, Weizer (1959), copper.
constexpr double depth = 0.3429, alpha = 1.3588, r0 = 2.866, cutoff = 6.5;

/// Writes a table of Morse's function from a distance on (A); tapered, it ends smoothly.
void write_morse_table(const std::filesystem::path& path, double least, bool tapered = false) {
  std::ofstream file(path);
  constexpr int points = 4000;
  file << "# test\n\nMORSE\nN " << points << " R " << least << " " << cutoff << "\n\n";
  for (int i = 0; i < points; ++i) {
    const double r = least + (cutoff - least) * i / (points - 1), x = r / cutoff;
    const double e = std::exp(-alpha * (r - r0));
    const double energy = depth * (e * e - 2.0 * e), force = 2.0 * depth * alpha * (e * e - e);
    const double taper = tapered ? (1.0 - x * x) * (1.0 - x * x) : 1.0;
    const double slope = tapered ? -4.0 * x * (1.0 - x * x) / cutoff : 0.0;
    file << fmt::format("{} {:.15g} {:.15g} {:.15g}\n", i + 1, r, taper * energy,
                        taper * force - slope * energy);
  }
}

// LAMMPS ends where two atoms are nearer than a table: the start of a melting point under pressure is sought
// among the volumes that the potential admits.
TEST(PairStyle, CompressedStartsStayWithinTheTable) {
  const TemporaryFolder folder;
  write_morse_table(folder.path() / "morse.table", 2.1, true);
  const Potential table = Potential::load("table", "Cu", folder.path(), CrystalStructure::fcc,
                                          {"table spline 8000", {"* * morse.table MORSE 6.5"}});
  EXPECT_GT(table.least_volume_ratio(), 0.45);
  EXPECT_LT(table.least_volume_ratio(), 0.75);
  const CompressedStart start = compressed_start(table, 40e9);
  EXPECT_LT(start.volume_ratio, 0.91);
  EXPECT_GT(start.volume_ratio, table.least_volume_ratio());
  EXPECT_THROW(compressed_start(table, 4e12), StateError);
}

// A table is the function that it was made of.
TEST(PairStyle, TabulatedMorseIsMorse) {
  const TemporaryFolder folder;
  write_morse_table(folder.path() / "morse.table", 0.5);
  const Potential table = Potential::load("table", "Cu", folder.path(), CrystalStructure::fcc,
                                          {"table spline 8000", {"* * morse.table MORSE 6.5"}});
  const Potential formula = Potential::load("formula", "Cu", {}, CrystalStructure::fcc,
                                            {"morse 6.5", {fmt::format("* * {} {} {}", depth, alpha, r0)}});
  EXPECT_NEAR(table.lattice_constant(), formula.lattice_constant(), 1e-5);
  for (const double a : {3.7, 3.6, 3.5})
    EXPECT_NEAR(table.crystal_energy(a), formula.crystal_energy(a), 1e-5) << a;
  EXPECT_NE(table.hash(), formula.hash());
  // The content of a file is part of the identity, its name and place are not hidden in it.
  std::ofstream(folder.path() / "morse.table", std::ios::app) << "\n# changed\n";
  EXPECT_NE(Potential::load("table", "Cu", folder.path(), CrystalStructure::fcc,
                            {"table spline 8000", {"* * morse.table MORSE 6.5"}})
                .hash(),
            table.hash());
}

// A folder may have blanks in its name; what LAMMPS cannot read is said before it tries.
TEST(PairStyle, FilesLieInFoldersWithBlanks) {
  const TemporaryFolder folder;
  const std::filesystem::path blanks = folder.path() / "my plans #1", accents = folder.path() / "pl\u00e4ne";
  for (const std::filesystem::path& place : {blanks, accents}) {
    std::filesystem::create_directories(place);
    write_morse_table(place / "own.table", 2.0);
  }
  const PairStyle pair{"table spline 8000", {"* * own.table MORSE 6.5"}};
  const Potential copper = Potential::load("mine", "Cu", blanks, CrystalStructure::fcc, pair);
  EXPECT_NEAR(copper.lattice_constant(), 3.65, 0.01);
  try {
    static_cast<void>(pair_interactions(pair, "mine", accents));
    ADD_FAILURE() << "no InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("beyond ASCII: move the file"), std::string::npos)
        << error.what();
  }
}

// The rounds of an adaptive plan are plans in another folder: their points are those of the same potential.
TEST(PairStyle, RoundsOfAPlanFindItsFiles) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(potential_folder() / "Ni.adp", folder.path() / "own.adp");
  Plan plan;
  plan.element = "Ni";
  plan.potential = "mine";
  plan.pair_style = "adp";
  plan.pair_coeff = {"* * own.adp Ni"};
  plan.folder = folder.path();
  const auto hash_of = [](const Plan& of) {
    return pair_interactions({of.pair_style, of.pair_coeff}, of.potential, of.folder).hash;
  };
  auto document = input::Document::from_text(plan_text(plan), "elsewhere/round.toml");
  EXPECT_EQ(hash_of(read_plan(document)), hash_of(plan));
}

TEST(PairStyle, ErrorsNameWhatIsAccepted) {
  EXPECT_NE(
      fault_of({"meam", {"* * library.meam Cu Cu.meam Cu"}}, "Cu").find("without the pair style 'meam'"),
      std::string::npos);
  EXPECT_NE(fault_of({"meam", {}}, "Cu").find("meam/spline"), std::string::npos);
  EXPECT_NE(fault_of({"eam/alloy", {"* * Cu_zhou.eam.alloy Cu"}}, "Cu").find("give the file as `potential`"),
            std::string::npos);
  EXPECT_NE(fault_of({"adp", {"* * Ni2.adp Ni"}}, "Ni").find("there is no file 'Ni2.adp'"),
            std::string::npos);
  EXPECT_NE(fault_of({"adp", {"* * Ni.adp Ni; shell ls"}}, "Ni").find("holds characters"), std::string::npos);
  EXPECT_NE(fault_of({"adp", {"* * Ni.adp Cu"}}, "Cu").find("has no crystal of Cu"), std::string::npos);
  EXPECT_NE(fault_of({"lj/cut 6.0", {"* * 0.0 2.3"}}, "Cu").find("binds no crystal"), std::string::npos);
}

TEST(PairStyle, WhatMayRunCodeIsRefused) {
  for (const PairStyle& pair :
       {PairStyle{"python 6.0", {"* * evil._Cls Cu"}},
        PairStyle{"hybrid/overlay eam/alloy python 6.0",
                  {"* * eam/alloy Cu_zhou.eam.alloy Cu", "* * python a._B Cu"}},
        PairStyle{"kim EAM_Dynamo_FoilesBaskesDaw_1986universal3_Cu__MO_666348409573_004", {"* * Cu"}}}) {
    const std::string fault = fault_of(pair, "Cu");
    EXPECT_NE(fault.find("is refused: it may run code"), std::string::npos) << fault;
    EXPECT_NE(fault.find("meam/spline"), std::string::npos) << fault;
  }
  EXPECT_EQ(fault_of({"hybrid/overlay eam/alloy zbl 1.0 2.0",
                      {"* * eam/alloy Cu_zhou.eam.alloy Cu", "* * zbl 29 29"}},
                     "Cu"),
            "no InputError");
}

TEST(PairStyle, IsPartOfThePlanAndOfTheKeys) {
  auto document = input::Document::from_text(
      "element = \"Ni\"\npotential = \"mishin_2005\"\npair_style = \"adp\"\npair_coeff = [\"* * Ni.adp "
      "Ni\"]\n"
      "[cold_curve]\nvolume_ratio = [0.9]\n",
      "plan.toml");
  const Plan plan = read_plan(document);
  const Potential nickel =
      Potential::load(plan.potential, plan.element, plan.folder, {}, {plan.pair_style, plan.pair_coeff});
  for (const Task& task : make_tasks(plan, nickel)) {
    EXPECT_EQ(task.provenance.at("potential_sha256"), nickel.hash());
    if (task.protocol != "cold_curve") continue;
    const TaskResult result = task.compute(nullptr);
    EXPECT_GT(result.results.at("pressure").value, 10e9);
    // Nickel is fcc; and no folder of this machine is in what is stored.
    EXPECT_GT(result.results.at("bcc_specific_internal_energy").value,
              result.results.at("specific_internal_energy").value);
    EXPECT_EQ(result.transcript.find("/usr/"), std::string::npos);
  }
}

// Mishin's copper keeps its fcc crystal to some 50 GPa, where hcp has less energy
// (docs/theory/molecular_dynamics.md); the embedding functions of Zhou et al. were fitted to 1.15 of the
// density at rest; a short table ends by itself.
TEST(Validity, IsThatOfWhatEndsFirst) {
  const Potential mishin = Potential::load("copper_mishin_2001", "Cu");
  EXPECT_GT(mishin.validity().pressure, 20e9);
  EXPECT_LT(mishin.validity().pressure, 90e9);
  EXPECT_NE(mishin.validity().reason.find("hcp has less energy than fcc"), std::string::npos);
  const Potential zhou = Potential::load("zhou_2004", "Cu");
  EXPECT_LT(zhou.validity().pressure, 30e9);
  EXPECT_NE(zhou.validity().reason.find("not fitted"), std::string::npos) << zhou.validity().reason;
  const Potential short_table = Potential::load("Cu_mishin1.eam.alloy", "Cu");
  EXPECT_LE(short_table.validity().pressure, 100e9);
}

TEST(Validity, FlagsPointsBeyondIt) {
  PointRecord point;
  point.provenance = {{"validity_pressure", "50 GPa"}, {"validity_reason", "because"}};
  point.results["pressure"] = {60e9, 0.0};
  EXPECT_EQ(with_validity("melted", point), "melted; beyond the validity of the potential, 50 GPa (because)");
  point.results["pressure"] = {40e9, 0.0};
  EXPECT_EQ(with_validity("", point), "");
  point.results.clear();
  point.conditions["pressure"] = 51e9;
  EXPECT_EQ(with_validity("", point), "beyond the validity of the potential, 50 GPa (because)");
  point.provenance.clear();  // as of a potential without a known limit
  EXPECT_EQ(with_validity("", point), "");
}

}  // namespace
}  // namespace whipple::md
