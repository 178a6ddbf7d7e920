// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "src/case/case.hpp"

namespace whipple::run {

/// Holds the options of the user for a run, in addition to the case.
struct RunOptions {
  std::filesystem::path case_file;         ///< empty on restart: run.toml of the directory
  std::filesystem::path output_directory;  ///< empty: ./run/ with the name of the folder or file of the case
  std::filesystem::path start_from =
      {};                             ///< run directory whose latest state is the start; empty: the case's
  bool restart = false;               ///< continue from the latest checkpoint in output_directory
  bool force = false;                 ///< remove the outputs of an earlier run in output_directory; on
                                      ///< restart: continue although rows of its tables are missing
  int threads = 0;                    ///< of each rank; 0: an equal part of the cores
  double wall_time = 0.0;             ///< s, after which the run ends with a checkpoint; 0: no limit
  std::filesystem::path replay = {};  ///< steering.csv with the requests to repeat; empty: none
  std::string program = "whipple";    ///< name and version, for provenance
  std::vector<std::pair<std::string, std::string>> overrides;  ///< --set
};

/// Runs a case from its file to its last snapshot on the ranks of a communicator; docs/manual/output.md lists the
/// output files. Collective.
/// The run is controlled by signals (`SignalControl`) and by files in the run directory (`DirectoryControl`) or the
/// requests to an earlier run (`ReplayControl`).
/// @returns 0; 128 + number of the signal that ended the run; 124 at the limit of wall time
/// @throws InputError before any work and before anything is written if the input is invalid; StateError if the physics
/// leaves its range: the state is saved in the folder failed/ of the run
int run_case(const RunOptions& options, MPI_Comm communicator);

}  // namespace whipple::run
