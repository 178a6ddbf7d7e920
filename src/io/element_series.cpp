// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/element_series.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>

#include "src/io/vtkhdf.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

/// Rows of this rank among those of all ranks.
hdf5::Slab slab_of(std::uint64_t count, const Ranks& ranks) {
  const std::vector<std::uint64_t> counts = ranks.gather(count);
  return {std::accumulate(counts.begin(), counts.begin() + ranks.rank(), std::uint64_t{0}), count,
          std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})};
}

template <class Value>
Value mean_of(const std::vector<Value>& values, std::size_t first, std::size_t count) {
  if constexpr (std::is_same_v<Value, double>) {
    const double sum = std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(first),
                                       values.begin() + static_cast<std::ptrdiff_t>(first + count), 0.0);
    return sum / static_cast<double>(count);
  } else if constexpr (std::is_same_v<Value, SymmetricTensor>) {
    Matrix3 sum = Matrix3::Zero();
    for (std::size_t i = first; i < first + count; ++i) sum += values[i].matrix();
    return SymmetricTensor::from(sum / static_cast<double>(count));
  } else {
    return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(first + count));
  }
}

}  // namespace

Particles elements_as_points(std::span<const fem::Mesh> meshes) {
  Particles points;
  std::size_t count = 0;
  for (const fem::Mesh& mesh : meshes) count += mesh.elements.size();
  resize(points, count);
  std::size_t p = 0;
  for (const fem::Mesh& mesh : meshes) {
    const std::size_t rows = fem::points_per_element(mesh.quadrature);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e, ++p) {
      for_each_field<MaterialPoints>([&](const auto& field) {
        if (!field.optional) {
          (points.*(field.values))[p] = mean_of(mesh.points.*(field.values), e * rows, rows);
        }
      });
      for (auto* extensive : {&points.mass, &points.volume, &points.void_volume}) {
        (*extensive)[p] *= static_cast<double>(rows);
      }
      points.id[p] = mesh.elements.id[e];
      points.body[p] = mesh.body;
      points.position[p].setZero();
      points.velocity[p].setZero();
      for (const std::uint32_t a : mesh.elements.corners[e]) {
        points.position[p] += 0.125 * mesh.nodes.position[a];
        points.velocity[p] += 0.125 * mesh.nodes.velocity[a];
      }
    }
  }
  return points;
}

ElementSeries::ElementSeries(SeriesOptions options, MPI_Comm communicator)
    : options_(std::move(options)),
      fields_(select_output_fields(options_.fields)),
      ranks_(communicator),
      series_(options_.folder, options_.name, "elements", ranks_) {}

fs::path ElementSeries::write(std::span<const fem::Mesh> meshes, double time) {
  return series_.write(time, [&](const fs::path& path) { write_file(path, meshes, time); });
}

void ElementSeries::write_file(const fs::path& path, std::span<const fem::Mesh> meshes, double time) const {
  std::vector<Vector3> position, velocity;
  std::vector<std::uint64_t> id;
  std::vector<std::uint8_t> in_transition;
  std::vector<std::int64_t> connectivity;
  const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  for (const fem::Mesh& mesh : meshes) {
    const auto first = static_cast<std::int64_t>(position.size());
    append(position, mesh.nodes.position);
    append(velocity, mesh.nodes.velocity);
    append(id, mesh.nodes.id);
    append(in_transition, mesh.nodes.in_transition);
    for (const fem::Corners& corners : mesh.elements.corners) {
      for (const std::uint32_t a : corners) connectivity.push_back(first + static_cast<std::int64_t>(a));
    }
  }
  const Particles elements = elements_as_points(meshes);
  const std::uint64_t n = elements.size(), nodes = position.size();
  const auto rank = static_cast<std::uint64_t>(ranks_.rank()),
             partitions = static_cast<std::uint64_t>(ranks_.count());
  const hdf5::Slab of_cells = slab_of(n, ranks_), of_nodes = slab_of(nodes, ranks_);
  const hdf5::Storage compressed{.deflate = options_.deflate};

  hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::vtk, 0, ranks_.communicator());
  const hdf5::Group vtk = create_unstructured_grid(file);
  const auto write_count = [&](const char* name, std::uint64_t count) {
    const std::array<std::int64_t, 1> value = {static_cast<std::int64_t>(count)};
    vtk.write<std::int64_t>(name, value, {rank, 1, partitions});
  };
  write_count("NumberOfPoints", nodes);
  write_count("NumberOfCells", n);
  write_count("NumberOfConnectivityIds", connectivity.size());
  write_array<Vector3>(vtk, "Points", of_nodes, options_.deflate,
                       [&](std::size_t i) -> const Vector3& { return position[i]; });
  vtk.write<std::int64_t>("Connectivity", connectivity, {8 * of_cells.first, 8 * n, 8 * of_cells.total},
                          compressed);
  std::vector<std::int64_t> offsets(n + 1);
  for (std::size_t e = 0; e <= n; ++e) offsets[e] = static_cast<std::int64_t>(8 * e);
  vtk.write<std::int64_t>("Offsets", offsets, {of_cells.first + rank, n + 1, of_cells.total + partitions},
                          compressed);
  constexpr std::uint8_t hexahedron = 12;  // VTK_HEXAHEDRON
  vtk.write<std::uint8_t>("Types", std::vector<std::uint8_t>(n, hexahedron), of_cells, compressed);

  write_fields(vtk.create_group("CellData"), fields_, {elements, options_.material_of_body}, of_cells,
               options_.deflate);
  const hdf5::Group at_nodes = vtk.create_group("PointData");
  const hdf5::Dataset speeds =
      write_array<Vector3>(at_nodes, "velocity", of_nodes, options_.deflate,
                           [&](std::size_t i) -> const Vector3& { return velocity[i]; });
  speeds.set_attribute("unit", std::string_view("m/s"));
  write_array<std::uint64_t>(at_nodes, "node_id", of_nodes, options_.deflate,
                             [&](std::size_t i) { return id[i]; });
  write_array<std::uint8_t>(at_nodes, "in_transition", of_nodes, options_.deflate,
                            [&](std::size_t i) { return in_transition[i]; });
  write_run(file, vtk, time, ranks_, options_.provenance);
  file.close();
}

}  // namespace whipple::io
