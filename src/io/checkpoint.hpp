// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/particles/particles.hpp"

namespace whipple::io {

/// Holds, by name, all values except the particles that a run needs for a bitwise identical restart.
struct CheckpointValues {
  std::map<std::string, double> reals;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<double>> arrays;

  /// Returns the value of a name.
  /// @throws InputError naming the missing value
  [[nodiscard]] double real(const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& name) const;
  [[nodiscard]] const std::string& text(const std::string& name) const;
  [[nodiscard]] const std::vector<double>& array(const std::string& name) const;

  /// Names the file from which the values were read, for messages.
  std::string source;
};

struct Checkpoint {
  Particles particles;
  std::vector<fem::Mesh> meshes;  ///< bodies of elements; `fem::connect` must be called afterwards
  std::vector<fem::Bars> bars;    ///< bodies of trusses, without their material; as for meshes
  CheckpointValues values;
  std::filesystem::path path;
};

/// Writes checkpoint.NNNNNNNN.h5 (NNNNNNNN: the step) into `folder`, which is created if missing. The file contains
/// every field of the particles bit for bit in double precision, in the order of ranks and memory, independent of the
/// number of ranks; the named values; a format version; and a digest of the whole file. It is written under a temporary
/// name, forced to disk and renamed; then all but the two newest checkpoints are removed. Matrices are stored column by
/// column. Collective.
/// @param values  must be the same on every rank
/// @param meshes  of this rank; the nodes and elements of one rank are read back as a whole by one rank
/// @throws InputError if the file cannot be written
std::filesystem::path write_checkpoint(const std::filesystem::path& folder, std::int64_t step,
                                       const Particles& particles, const CheckpointValues& values,
                                       MPI_Comm communicator = MPI_COMM_WORLD,
                                       std::span<const fem::Mesh> meshes = {},
                                       std::span<const fem::Bars> bars = {});

/// Reads one checkpoint; every rank gets an equal number of consecutive particles. The digest is checked before HDF5
/// opens the file, so that damage of any kind is detected. Collective.
/// @throws InputError naming the file and the fault: truncated, damaged, of a newer format, not a checkpoint, or the
/// missing field
Checkpoint read_checkpoint(const std::filesystem::path& path, MPI_Comm communicator = MPI_COMM_WORLD);

/// Reads the newest checkpoint of a folder; if it is damaged, warns and reads the previous one. Collective.
/// @throws InputError if none is usable, with the reason for each
Checkpoint read_latest_checkpoint(const std::filesystem::path& folder,
                                  MPI_Comm communicator = MPI_COMM_WORLD);

/// Returns the paths of the checkpoints of a folder, newest (highest step) first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

}  // namespace whipple::io
