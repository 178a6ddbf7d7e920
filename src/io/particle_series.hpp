// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "src/io/output_fields.hpp"
#include "src/io/ranks.hpp"
#include "src/particles/particles.hpp"

namespace whipple::io {

struct ParticleSeriesOptions {
  std::filesystem::path folder;                   ///< must exist
  std::string name;                               ///< RUN of RUN.particles.hdf.series
  std::vector<std::string> fields;                ///< of output_field_names()
  std::vector<std::uint16_t> material_of_body;    ///< index of the material of every body
  std::map<std::string, std::string> provenance;  ///< attributes of /run: version, input text, machine, ...
  int deflate = 1;                                ///< level of compression, 0 to 9
};

/// Snapshots of the particles for ParaView: one file RUN.particles.NNNNNN.hdf per snapshot (VTKHDF 1.0
/// UnstructuredGrid, one vertex cell per particle, point data in single precision) and the index
/// RUN.particles.hdf.series with the physical times, which is what one opens. A file gets its name when it is
/// complete, and the index is renewed after that: a killed run leaves a series that opens. docs/output.md has
/// the layout.
class ParticleSeries {
 public:
  /// Begins a new series: an index of that name is emptied at the first snapshot.
  /// @throws InputError if a field is unknown
  explicit ParticleSeries(ParticleSeriesOptions options, MPI_Comm communicator = MPI_COMM_WORLD);

  /// Goes on with the series in the folder: keeps its snapshots up to and including `time` (s), drops the
  /// later ones from the index and removes their files. A missing index is an empty series. Collective.
  /// @throws InputError if the index is not readable
  void restart(double time);

  /// Writes one snapshot of this rank's particles and renews the index. A snapshot at the time of the last
  /// one replaces it. Returns the path of the file. Collective.
  /// @param time s, not before the last snapshot
  /// @throws InputError if the file cannot be written
  std::filesystem::path write(const Particles& particles, double time);

  /// Number of snapshots in the index.
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::filesystem::path index_path() const;

 private:
  struct Entry {
    std::string file;
    double time;
  };
  [[nodiscard]] std::string index_text() const;
  void write_file(const std::filesystem::path& path, const Particles& particles, double time) const;

  ParticleSeriesOptions options_;
  std::vector<OutputField> fields_;
  Ranks ranks_;
  std::vector<Entry> entries_;
};

}  // namespace whipple::io
