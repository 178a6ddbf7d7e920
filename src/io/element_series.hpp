// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/series.hpp"

namespace whipple::io {

/// Returns every element as a point at its centre with its mean velocity and the means of its Gauss points; `failed` if
/// one of these has failed. Truss elements follow: their stress is axial, broken ones have failed by plastic strain,
/// and their temperature is 0 (undefined).
Particles elements_as_points(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars);

/// Writes snapshots of finite elements: RUN.elements.NNNNNN.hdf (VTKHDF 1.0 unstructured grid of hexahedra and, for
/// trusses, lines; the fields of the particles as cell data, velocity, id and transition of the nodes as point data)
/// and their index. A snapshot without elements is written as well. The files have one partition per rank; a node
/// shared by ranks is in the partition of each.
class ElementSeries {
 public:
  /// @throws InputError if a field is unknown
  explicit ElementSeries(SeriesOptions options, MPI_Comm communicator = MPI_COMM_SELF);

  /// Restarts and writes the series as `Series` does. Collective.
  void restart(double time) { series_.restart(time); }
  std::filesystem::path write(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars,
                              double time);
  /// Prepares a snapshot as `ParticleSeries::prepare` does.
  [[nodiscard]] std::function<void()> prepare(std::span<const fem::Mesh> meshes,
                                              std::span<const fem::Bars> bars, double time);
  [[nodiscard]] std::size_t size() const { return series_.size(); }
  [[nodiscard]] std::filesystem::path index_path() const { return series_.index_path(); }

 private:
  [[nodiscard]] UnstructuredGrid grid(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars,
                                      double time) const;
  std::filesystem::path write(UnstructuredGrid grid);

  SeriesOptions options_;
  std::vector<OutputField> fields_;
  Ranks ranks_;
  Series series_;
};

}  // namespace whipple::io
