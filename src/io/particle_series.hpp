// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "src/io/output_fields.hpp"
#include "src/io/ranks.hpp"
#include "src/io/series.hpp"
#include "src/io/vtkhdf.hpp"
#include "src/particles/particles.hpp"

namespace whipple::io {

struct SeriesOptions {
  std::filesystem::path folder;                 ///< must exist
  std::string name;                             ///< RUN of RUN.particles.hdf.series, RUN.elements.hdf.series
  std::vector<std::string> fields;              ///< names from output_field_names()
  std::vector<std::uint16_t> material_of_body;  ///< index of the material of every body
  std::map<std::string, std::string> provenance;  ///< attributes of /run: version, input text, machine, ...
  int deflate = 1;                                ///< compression level, 0 to 9
  grid::Geometry geometry = {};                   ///< of the finest cells; without cells: not known
};

/// Returns what fields of points are computed from.
inline FieldSource source_of(const SeriesOptions& options, const Particles& points) {
  return {points, options.material_of_body, options.geometry.cell_size > 0.0 ? &options.geometry : nullptr};
}

/// Writes snapshots of the particles for ParaView: one file RUN.particles.NNNNNN.hdf per snapshot (VTKHDF 1.0
/// UnstructuredGrid, one vertex cell per particle, point data in single precision) and their index (`Series`).
/// docs/manual/output.md describes the layout.
class ParticleSeries {
 public:
  /// @throws InputError if a field is unknown
  explicit ParticleSeries(SeriesOptions options, MPI_Comm communicator = MPI_COMM_WORLD);

  /// Restarts the series and writes the particles of this rank, as `Series` does. Collective.
  void restart(double time) { series_.restart(time); }
  std::filesystem::path write(const Particles& particles, double time);
  /// Copies the current values and returns a function that writes them, once, on any thread, while the particles move
  /// on. No other call of this series may run concurrently. For programs with one rank.
  [[nodiscard]] std::function<void()> prepare(const Particles& particles, double time);
  [[nodiscard]] std::size_t size() const { return series_.size(); }
  [[nodiscard]] std::filesystem::path index_path() const { return series_.index_path(); }

 private:
  [[nodiscard]] UnstructuredGrid grid(const Particles& particles, double time) const;
  std::filesystem::path write(UnstructuredGrid grid);

  SeriesOptions options_;
  std::vector<OutputField> fields_;
  Ranks ranks_;
  Series series_;
};

}  // namespace whipple::io
