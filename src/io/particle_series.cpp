// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/particle_series.hpp"

#include <array>
#include <numeric>

#include "src/io/vtkhdf.hpp"

namespace whipple::io {

namespace fs = std::filesystem;

ParticleSeries::ParticleSeries(SeriesOptions options, MPI_Comm communicator)
    : options_(std::move(options)),
      fields_(select_output_fields(options_.fields)),
      ranks_(communicator),
      series_(options_.folder, options_.name, "particles", ranks_) {}

fs::path ParticleSeries::write(const Particles& particles, double time) {
  return series_.write(time, [&](const fs::path& path) { write_file(path, particles, time); });
}

void ParticleSeries::write_file(const fs::path& path, const Particles& particles, double time) const {
  const std::uint64_t n = particles.size();
  const std::vector<std::uint64_t> counts = ranks_.gather(n);
  const auto rank = static_cast<std::uint64_t>(ranks_.rank());
  const auto partitions = static_cast<std::uint64_t>(ranks_.count());
  const std::uint64_t first =
      std::accumulate(counts.begin(), counts.begin() + ranks_.rank(), std::uint64_t{0});
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const hdf5::Slab points{first, n, total};
  const hdf5::Storage compressed{.deflate = options_.deflate};

  hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::vtk, 0, ranks_.communicator());
  const hdf5::Group vtk = create_unstructured_grid(file);

  // One partition per rank.
  const std::array<std::int64_t, 1> count = {static_cast<std::int64_t>(n)};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    vtk.write<std::int64_t>(name, count, {rank, 1, partitions});
  }

  write_array<Vector3>(vtk, "Points", points, options_.deflate,
                       [&](std::size_t i) -> const Vector3& { return particles.position[i]; });

  // One vertex cell per particle: thresholds and clips of ParaView work on cells. The arrays vanish in
  // compression.
  std::vector<std::int64_t> indices(n + 1);
  std::iota(indices.begin(), indices.end(), std::int64_t{0});
  vtk.write<std::int64_t>("Connectivity", {indices.data(), n}, points, compressed);
  vtk.write<std::int64_t>("Offsets", indices, {first + rank, n + 1, total + partitions}, compressed);
  constexpr std::uint8_t vertex = 1;  // VTK_VERTEX
  vtk.write<std::uint8_t>("Types", std::vector<std::uint8_t>(n, vertex), points, compressed);

  write_fields(vtk.create_group("PointData"), fields_, {particles, options_.material_of_body}, points,
               options_.deflate);
  write_run(file, vtk, time, ranks_, options_.provenance);
  file.close();
}

}  // namespace whipple::io
