// SPDX-License-Identifier: BSD-3-Clause
// One LAMMPS instance on all ranks meets an error that only one rank reports. Without the abort of the error
// guard the other ranks would wait for ever (tests/parallel/md_ranks_test.cpp starts this and waits for its
// end).
#include <mpi.h>

#include <cstdio>

#include "md_fitting/lammps/lammps.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  try {
    whipple::md::Lammps lammps(MPI_COMM_WORLD);
    for (const char* line :
         {"units metal", "lattice fcc 3.6", "region b block 0 3 0 3 0 3", "create_box 1 b",
          "create_atoms 1 box", "mass 1 63.55", "pair_style eam", "pair_coeff * * /does/not/exist.eam"}) {
      lammps.command(line);
    }
    std::puts("no error was reported");
  } catch (const whipple::md::LammpsError& error) {
    std::puts("the error was thrown on a rank of several");
  }
  MPI_Finalize();
  return 0;
}
