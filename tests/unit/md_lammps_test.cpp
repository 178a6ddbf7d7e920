// SPDX-License-Identifier: BSD-3-Clause
// The LAMMPS wrapper: every error becomes an exception instead of the end of the process, and data come back
// whole.
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/lammps/lammps.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

template <class Call>
std::string lammps_error(const Call& call) {
  try {
    call();
  } catch (const LammpsError& error) {
    return error.what();
  }
  return "no LammpsError";
}

// Without the guard each of these lines ends the process: the test executable itself would be gone.
TEST(ErrorGuard, TurnsEveryKindOfErrorIntoAnException) {
  const auto message = [](const std::vector<std::string>& lines) {
    return lammps_error([&] {
      Lammps lammps;
      for (const std::string& line : lines) lammps.command(line);
    });
  };
  const std::vector<std::string> box = {"units metal",    "lattice fcc 3.6",    "region b block 0 3 0 3 0 3",
                                        "create_box 1 b", "create_atoms 1 box", "mass 1 63.55"};
  const auto after_box = [&](const std::string& line) {
    std::vector<std::string> lines = box;
    lines.push_back(line);
    return message(lines);
  };
  EXPECT_NE(message({"no_such_command 1"}).find("Unknown command"), std::string::npos);
  EXPECT_NE(message({"no_such_command 1"}).find("command: no_such_command 1"), std::string::npos);
  EXPECT_NE(message({"run 1"}).find("Run command before simulation box"), std::string::npos)
      << message({"run 1"});
  EXPECT_NE(message({"include /does/not/exist"}).find("exist"), std::string::npos);
  EXPECT_NE(message({"quit 3"}).find("status 3"), std::string::npos);
  EXPECT_NE(after_box("fix x all no_such_fix").find("no_such_fix"), std::string::npos);
  EXPECT_NE(after_box("run -5").find("LAMMPS"), std::string::npos);
  std::vector<std::string> missing_file = box;
  missing_file.insert(missing_file.end(), {"pair_style eam", "pair_coeff * * /does/not/exist.eam"});
  EXPECT_NE(message(missing_file).find("exist.eam"), std::string::npos);
}

// An error inside a run, far below the command: atoms fly apart with an absurd time step.
TEST(ErrorGuard, CatchesLostAtomsInsideARunAndLeavesTheNextInstanceSound) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  const auto energy_of_new_crystal = [&] {
    Crystal crystal(potential, 3.615, 3, 3, 3);
    crystal.evaluate();
    return crystal.lammps().variable("energy");
  };
  const double before = energy_of_new_crystal();
  const std::string message = lammps_error([&] {
    Crystal crystal(potential, 3.615, 3, 3, 3);
    Lammps& lammps = crystal.lammps();
    lammps.command("velocity all create 3000 1");
    lammps.command("timestep 5.0");
    lammps.command("fix move all nve");
    lammps.command("run 200");
  });
  EXPECT_NE(message.find("LAMMPS: "), std::string::npos) << message;
  EXPECT_NE(message.find("command: run 200"), std::string::npos) << message;
  EXPECT_EQ(energy_of_new_crystal(), before);
}

TEST(Lammps, NamesThatDoNotExistAreErrors) {
  Lammps lammps;
  EXPECT_NE(lammps_error([&] { Lammps().series("nothing", 1); }).find("no data of a fix 'nothing'"),
            std::string::npos);
  EXPECT_NE(lammps_error([&] { lammps.variable("nothing"); }).find("no variable 'nothing'"),
            std::string::npos);
  EXPECT_NE(lammps_error([&] { lammps.series("nothing", 1); }).find("no data of a fix 'nothing'"),
            std::string::npos);
  EXPECT_TRUE(lammps.has_style("pair", "eam/alloy"));
  EXPECT_FALSE(lammps.has_style("pair", "no/such/pair"));
  EXPECT_GE(lammps.version(), 20200000);
}

// One column and several columns use different interfaces of `fix vector`; both must bring every sample.
TEST(Lammps, ReturnsTimeSeriesColumnByColumn) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  Crystal crystal(potential, 3.615, 3, 3, 3);
  crystal.lammps().command("velocity all create 300 7");
  crystal.lammps().command("fix move all nve");
  crystal.lammps().command("fix single all vector 10 v_energy");
  const auto both = crystal.sample({"energy", "volume"}, 10, 100);
  const auto single = crystal.lammps().series("single", 1);
  ASSERT_EQ(both.size(), 2U);
  ASSERT_EQ(both[0].size(), 11U);
  EXPECT_EQ(single[0], both[0]);
  EXPECT_GT(both[0].back(), both[0].front());  // kinetic becomes potential energy
  for (const double volume : both[1]) EXPECT_NEAR(volume, std::pow(3.615, 3) / 4, 1e-9);
}

// Two instances at a time do not disturb each other.
TEST(Lammps, InstancesAreIndependent) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  Crystal small(potential, 3.4, 3, 3, 3);
  Crystal large(potential, 3.8, 4, 4, 4);
  small.evaluate();
  large.evaluate();
  EXPECT_EQ(small.lammps().atoms(), 108);
  EXPECT_EQ(large.lammps().atoms(), 256);
  EXPECT_LT(small.lammps().variable("volume"), large.lammps().variable("volume"));
}

}  // namespace
}  // namespace whipple::md
