// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/particle_series.hpp"

#include <utility>

namespace whipple::io {

namespace fs = std::filesystem;

ParticleSeries::ParticleSeries(SeriesOptions options, MPI_Comm communicator)
    : options_(std::move(options)),
      fields_(select_output_fields(options_.fields)),
      ranks_(communicator),
      series_(options_.folder, options_.name, "particles", ranks_) {}

fs::path ParticleSeries::write(const Particles& particles, double time) {
  return write(grid(particles, time));
}

std::function<void()> ParticleSeries::prepare(const Particles& particles, double time) {
  UnstructuredGrid prepared = grid(particles, time);
  prepared.evaluate();
  return [this, prepared = std::move(prepared)]() mutable { write(std::move(prepared)); };
}

fs::path ParticleSeries::write(UnstructuredGrid grid) {
  return series_.write(grid.time, [&](const fs::path& path) {
    grid.write(path, ranks_, options_.provenance, options_.deflate);
  });
}

UnstructuredGrid ParticleSeries::grid(const Particles& particles, double time) const {
  const std::uint64_t n = particles.size();
  const hdf5::Slab points = ranks_.slab(n);
  const auto rank = static_cast<std::uint64_t>(ranks_.rank()),
             partitions = static_cast<std::uint64_t>(ranks_.count());
  UnstructuredGrid grid{.time = time, .points = n, .cells = n, .connectivity_ids = n};
  grid.geometry.emplace_back("Points", points, [&particles](std::size_t i) { return particles.position[i]; });
  // One vertex cell per particle: thresholds and clips of ParaView operate on cells. Compression makes the size of
  // these arrays negligible.
  const auto row_number = [](std::size_t i) { return static_cast<std::int64_t>(i); };
  grid.geometry.emplace_back("Connectivity", points, row_number, Array::From::row_number);
  const hdf5::Slab bounds{points.first + rank, n + 1, points.total + partitions};
  grid.geometry.emplace_back("Offsets", bounds, row_number, Array::From::row_number);
  grid.geometry.emplace_back(
      "Types", points, [](std::size_t) { return vtk_vertex; }, Array::From::row_number);
  grid.point_data = arrays_of(fields_, source_of(options_, particles), points);
  return grid;
}

}  // namespace whipple::io
