// SPDX-License-Identifier: BSD-3-Clause
// Potential files are understood before LAMMPS reads them: lattice sums, the end of the density table, error
// texts.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "md_fitting/lammps/eam_files.hpp"
#include "md_fitting/lammps/lammps.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/lammps/zhou_2004.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

template <class Call>
std::string input_error(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

// Mishin et al. (2001), table III: a0 = 3.615 A, E0 = -3.54 eV. Foiles, Baskes, Daw (1986), table I: 3.615
// A, 3.54 eV.
TEST(Potential, LatticeSumsGiveThePublishedCopper) {
  for (const char* name : {"copper_mishin_2001", "copper_universal_3"}) {
    const Potential potential = Potential::load(name, "Cu");
    EXPECT_NEAR(potential.lattice_constant(), 3.615, 5e-4) << name;
    EXPECT_NEAR(potential.tables().crystal_energy(potential.lattice_constant()), -3.54, 5e-3) << name;
    EXPECT_NEAR(potential.mass(), 63.546, 0.005) << name;
    EXPECT_NEAR(potential.static_volume(), 1.119e-4, 1e-7) << name;
  }
}

// Zhou, Johnson, Wadley (2004): every metal of the formulas has its lattice constant and its cohesive energy
// (table II).
TEST(Potential, FormulasOfZhouGiveThePublishedMetals) {
  struct Metal {
    const char* element;
    double lattice_constant, cohesive_energy;  // A, eV
  };
  for (const Metal& metal : {Metal{"Cu", 3.615, 3.54}, Metal{"Al", 4.05, 3.58}, Metal{"Pb", 4.95, 2.02},
                             Metal{"Ni", 3.52, 4.45}, Metal{"Ta", 3.303, 8.09}, Metal{"W", 3.165, 8.76}}) {
    const Potential potential = Potential::load("zhou_2004", metal.element);
    EXPECT_NEAR(potential.lattice_constant(), metal.lattice_constant, 0.003 * metal.lattice_constant)
        << metal.element;
    EXPECT_NEAR(potential.tables().crystal_energy(potential.lattice_constant()), -metal.cohesive_energy,
                0.01 * metal.cohesive_energy)
        << metal.element;
    EXPECT_LT(potential.least_volume_ratio(), 0.3) << metal.element;
  }
  EXPECT_THROW(Potential::load("zhou_2004", "U"), InputError);
}

// Against the authors' own tables of copper and tantalum, which LAMMPS ships. There tantalum stands as an fcc
// metal: that is the author's program, which knows no other lattice.
TEST(Potential, FormulasOfZhouAgreeWithTheTablesOfTheAuthors) {
  for (const char* element : {"Cu", "Ta"}) {
    const EamTables formula = zhou_2004(element);
    EamTables file = read_eam(potential_folder() / "CuTa.eam.alloy", element);
    file.structure = formula.structure;
    for (const double factor : {0.85, 0.92, 1.0, 1.08, 1.2}) {
      const double a = factor * formula.header_lattice_constant;
      EXPECT_NEAR(formula.crystal_energy(a), file.crystal_energy(a), 2e-4) << element << " " << factor;
      EXPECT_NEAR(formula.crystal_density(a), file.crystal_density(a), 1e-5 * file.crystal_density(a))
          << element << " " << factor;
    }
  }
}

// What each named potential can bear is known from its tables, before any run.
TEST(Potential, EveryNamedPotentialKnowsItsLimit) {
  for (const auto& [name, element] :
       {std::pair("copper_universal_6", "Cu"), std::pair("aluminium_mendelev_2008", "Al"),
        std::pair("aluminium_voter_chen_1987", "Al"), std::pair("nickel_universal_3", "Ni")}) {
    const Potential potential = Potential::load(name, element);
    EXPECT_NO_THROW(potential.require_range(0.65)) << name;
    EXPECT_EQ(potential.tables().structure, CrystalStructure::fcc) << name;
    const double least = potential.least_volume_ratio();
    if (least > 0.0) {
      EXPECT_EQ(input_error([&] { potential.require_range(0.99 * least); }).substr(0, 10),
                std::string("potential "))
          << name;
    }
  }
  EXPECT_NE(input_error([] { Potential::load("nickel_universal_3", "Cu"); }).find("is for Ni, not for Cu"),
            std::string::npos);
}

// The short table of the file that LAMMPS ships and the full table are two tabulations of the same function:
// they differ by their resolution, 0.2 meV at V0 and 0.5 meV at V/V0 = 0.75, where the crystal is 550 meV
// above its minimum.
TEST(Potential, FullTableOfMishinsCopperContinuesTheShortOne) {
  const EamTables full = Potential::load("copper_mishin_2001", "Cu").tables();
  const EamTables small = Potential::load("Cu_mishin1.eam.alloy", "Cu").tables();
  for (const double ratio : {0.75, 0.85, 0.95, 1.0, 1.1, 1.3}) {
    const double a = 3.615 * std::cbrt(ratio);
    EXPECT_NEAR(full.crystal_energy(a), small.crystal_energy(a), 6e-4) << "V/V0 = " << ratio;
  }
  EXPECT_GT(full.density_end() / full.crystal_density(3.615), 20.0);
}

TEST(Potential, KnowsWhereTheDensityTableEnds) {
  const Potential potential = Potential::load("Cu_mishin1.eam.alloy", "Cu");
  EXPECT_NEAR(potential.tables().density_end() / potential.tables().crystal_density(3.615), 1.64, 0.01);
  EXPECT_NEAR(potential.table_end(), 0.719, 0.002);
  EXPECT_GT(potential.least_volume_ratio(), potential.table_end());
  EXPECT_NO_THROW(potential.require_range(0.80));
  const std::string message = input_error([&] { potential.require_range(0.65); });
  EXPECT_NE(message.find("potential Cu_mishin1.eam.alloy: density table ends at V/V0 = 0.719"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("V/V0 = 0.650 is refused"), std::string::npos) << message;
  for (const char* name : {"copper_mishin_2001", "copper_universal_3"}) {
    EXPECT_NO_THROW(Potential::load(name, "Cu").require_range(0.5)) << name;
  }
}

TEST(Potential, ListsWhatIsThereWhenTheNameIsWrong) {
  const std::string missing = input_error([] { Potential::load("Cu_mishin.eam.alloy", "Cu"); });
  for (const char* part :
       {"there is no potential 'Cu_mishin.eam.alloy'", "did you mean \"Cu_mishin1.eam.alloy\"",
        "copper_mishin_2001", "Cu_u3.eam", "AlCu.adp"}) {
    EXPECT_NE(missing.find(part), std::string::npos) << part << "\n" << missing;
  }
  const std::string element = input_error([] { Potential::load("AlCu.adp", "Pb"); });
  EXPECT_NE(element.find("has no element Pb; it has Al, Cu"), std::string::npos) << element;
  const std::string single = input_error([] { Potential::load("Cu_u3.eam", "Al"); });
  EXPECT_NE(single.find("is for Cu, not for Al"), std::string::npos) << single;
  // The aluminium block of the same file has angular parts: it is not an embedded-atom potential.
  const std::string angular = input_error([] { Potential::load("Ni.adp", "Ni"); });
  EXPECT_NE(angular.find("is not zero"), std::string::npos) << angular;
}

TEST(Potential, ReportsDamagedFiles) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
    return input_error([&] { Potential::load(name, "Cu", folder.path()); });
  };
  EXPECT_NE(write("short.eam.alloy", "a\nb\nc\n1 Cu\n10 0.1 10 0.1 1.0\n29 63.55 3.615 fcc\n1 2 3\n")
                .find("too few numbers for an embedding function"),
            std::string::npos);
  EXPECT_NE(write("sizes.eam.alloy", "a\nb\nc\n1 Cu\n-5 0.1 10 0.1 1.0\n").find("table sizes"),
            std::string::npos);
  EXPECT_NE(write("word.eam.alloy", "a\nb\nc\n1 Cu\n4 0.1 4 0.1 1.0\n29 63.55 3.615 fcc\n1 2 3\n1.0D-3\n")
                .find("word.eam.alloy:8: error: the potential file has '1.0D-3' for a number of an embedding "
                      "function"),
            std::string::npos);
  // LAMMPS takes words of a header for formats, and dies of a brace in one.
  const std::string head = "a {b}\nb\nc\n1 Cu\n";
  for (const char* sizes : {"10 0.1 10 0.1 5.5}29", "10 0.1 10 0.1 5.5 {}", "10 0.1 10 0.1 5.5 \x01"}) {
    const std::string fault = write("brace.eam.alloy", head + sizes + "\n");
    EXPECT_NE(fault.find(":5: error: the potential file holds braces"), std::string::npos) << fault;
  }
  EXPECT_NE(
      write("brace.eam", "a\n29 63.55 3.615 {fcc}\n").find(":2: error: the potential file holds braces"),
      std::string::npos);
  EXPECT_NE(write("glued.eam.alloy", head + "10 0.1 10 0.1 5.5x\n").find("table sizes"), std::string::npos);
  EXPECT_NE(write("empty.eam", "").find("ends too early"), std::string::npos);
  EXPECT_NE(write("potential.meam", "x").find("unknown ending"), std::string::npos);
}

// The file gives tantalum the structure fcc, because its author's program knows no other.
TEST(Potential, TakesTheStructureOfLeastEnergy) {
  const Potential tantalum = Potential::load("CuTa.eam.alloy", "Ta");
  EXPECT_EQ(tantalum.structure(), CrystalStructure::bcc);
  EXPECT_NEAR(tantalum.lattice_constant(), 3.303, 0.002);
  EXPECT_NEAR(tantalum.crystal_energy(tantalum.lattice_constant()), -8.09, 0.001);
  EXPECT_NE(tantalum.remark().find("the header gives Ta the structure 'fcc', but bcc has the lowest energy"),
            std::string::npos)
      << tantalum.remark();
  const Potential stated = Potential::load("CuTa.eam.alloy", "Ta", {}, CrystalStructure::fcc);
  EXPECT_EQ(stated.structure(), CrystalStructure::fcc);
  EXPECT_NEAR(stated.lattice_constant(), 4.140, 0.001);
  const Potential copper = Potential::load("CuTa.eam.alloy", "Cu");
  EXPECT_EQ(copper.structure(), CrystalStructure::fcc);
  EXPECT_EQ(copper.remark(), "");
  const std::string hexagonal = input_error([] { Potential::load("Mg_mm.eam.fs", "Mg"); });
  EXPECT_NE(hexagonal.find("the crystal is hcp; fcc and bcc are supported"), std::string::npos) << hexagonal;
}

// Headers of potential files, changed by hand as people do.
TEST(Potential, HeadersMustAgreeWithThePeriodicTable) {
  const TemporaryFolder folder;
  EamTables tables = zhou_2004("Cu");
  const std::string whole = to_setfl(tables, "copper");
  const auto with_header = [&](const std::string& header) {
    std::string text = whole;
    const std::size_t begin = text.find("\n29 ") + 1;
    text.replace(begin, text.find('\n', begin) - begin, header);
    std::ofstream(folder.path() / "c.eam.alloy") << text;
    return input_error([&] { Potential::load("c.eam.alloy", "Cu", folder.path()); });
  };
  EXPECT_EQ(with_header("29 63.546 3.615 fcc"), "no InputError");
  EXPECT_EQ(with_header("1 63.55 3.615 FCC"), "no InputError");  // as many files have it
  EXPECT_NE(with_header("29 0.06355 3.615 fcc")
                .find("c.eam.alloy:6: error: the potential file gives Cu the mass "
                      "0.06355 g/mol; the standard atomic weight is 63.546"),
            std::string::npos);
  EXPECT_NE(with_header("13 63.55 3.615 fcc").find("atomic number 13, which is that of Al; expected 29"),
            std::string::npos);
  EXPECT_NE(with_header("29 63.55 3,615 fcc").find(":6: error"), std::string::npos);
}

// LAMMPS replaces characters beyond ASCII in its commands.
TEST(Potential, LiesInAFolderOfAnyName) {
  const TemporaryFolder folder;
  const auto place = folder.path() /
                     "gr\xC3\xB6\xC3\x9F"
                     "e";
  std::filesystem::create_directory(place);
  std::filesystem::copy_file(potential_folder() / "Cu_u3.eam", place / "Cu_u3.eam");
  const Potential potential = Potential::load("Cu_u3.eam", "Cu", place);
  Lammps lammps;
  potential.begin(lammps);
  lammps.command("region box block 0 9 0 9 0 9");
  lammps.command("create_box 1 box");
  EXPECT_NO_THROW(potential.apply(lammps));
}

// What is written reads back to the same numbers: the one-element file for LAMMPS loses no digit.
TEST(EamFiles, SetflRoundTripKeepsAllDigits) {
  const TemporaryFolder folder;
  const EamTables tables = Potential::load("copper_mishin_2001", "Cu").tables();
  std::ofstream(folder.path() / "copy.eam.alloy") << to_setfl(tables, "comment");
  const EamTables copy = read_eam(folder.path() / "copy.eam.alloy", "Cu");
  EXPECT_EQ(copy.embedding, tables.embedding);
  EXPECT_EQ(copy.density, tables.density);
  EXPECT_EQ(copy.radius_times_pair, tables.radius_times_pair);
  EXPECT_EQ(copy.cutoff, tables.cutoff);
  EXPECT_EQ(copy.density_step, tables.density_step);
  EXPECT_EQ(copy.radius_step, tables.radius_step);
}

}  // namespace
}  // namespace whipple::md
