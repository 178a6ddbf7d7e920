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

/// Everything besides the particles that a run needs to go on bitwise: by name.
struct CheckpointValues {
  std::map<std::string, double> reals;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<double>> arrays;

  /// Look-ups that name what is missing. @throws InputError
  [[nodiscard]] double real(const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& name) const;
  [[nodiscard]] const std::string& text(const std::string& name) const;
  [[nodiscard]] const std::vector<double>& array(const std::string& name) const;

  /// File that the values were read from, for messages.
  std::string source;
};

struct Checkpoint {
  Particles particles;
  std::vector<fem::Mesh> meshes;  ///< of the bodies of elements; `fem::connect` must follow
  std::vector<fem::Bars> bars;    ///< of the bodies of bars, without their material; the same
  CheckpointValues values;
  std::filesystem::path path;
};

/// Writes checkpoint.NNNNNNNN.h5 (NNNNNNNN: the step) into `folder`, which is made if missing: every field of
/// the particles in double precision, bit by bit, in the order of ranks and memory, independent of the number
/// of ranks; the named values; a format version; a digest of the whole file. It is written under a temporary
/// name, forced to disk, renamed; then all but the two newest checkpoints are removed. Collective. Matrices
/// are stored column by column.
/// @param values must be the same on every rank
/// @param meshes of this rank; each rank's part of the nodes and elements is read back as a whole by one
/// rank
/// @throws InputError if the file cannot be written
std::filesystem::path write_checkpoint(const std::filesystem::path& folder, std::int64_t step,
                                       const Particles& particles, const CheckpointValues& values,
                                       MPI_Comm communicator = MPI_COMM_WORLD,
                                       std::span<const fem::Mesh> meshes = {},
                                       std::span<const fem::Bars> bars = {});

/// Reads one checkpoint; every rank gets an equal number of consecutive particles. The digest is compared
/// before HDF5 sees the file, so that damage of any kind is recognised. Collective.
/// @throws InputError naming the file and what is wrong with it: truncated, damaged, of a newer format, no
///         checkpoint at all, which field is missing
Checkpoint read_checkpoint(const std::filesystem::path& path, MPI_Comm communicator = MPI_COMM_WORLD);

/// Reads the newest checkpoint of a folder; if it is damaged, warns and takes the one before. Collective.
/// @throws InputError if none is usable, with the reason for each
Checkpoint read_latest_checkpoint(const std::filesystem::path& folder,
                                  MPI_Comm communicator = MPI_COMM_WORLD);

/// Paths of the checkpoints of a folder, newest (highest step) first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

}  // namespace whipple::io
