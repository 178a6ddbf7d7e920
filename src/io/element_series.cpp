// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/element_series.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <type_traits>

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

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
  return write(grid(meshes, time));
}

std::function<void()> ElementSeries::prepare(std::span<const fem::Mesh> meshes, double time) {
  UnstructuredGrid prepared = grid(meshes, time);
  prepared.evaluate();
  return [this, prepared = std::move(prepared)]() mutable { write(std::move(prepared)); };
}

fs::path ElementSeries::write(UnstructuredGrid grid) {
  return series_.write(grid.time, [&](const fs::path& path) {
    grid.write(path, ranks_, options_.provenance, options_.deflate);
  });
}

UnstructuredGrid ElementSeries::grid(std::span<const fem::Mesh> meshes, double time) const {
  struct All {
    std::vector<Vector3> position, velocity;
    std::vector<std::uint64_t> id;
    std::vector<std::uint8_t> in_transition;
    std::vector<std::int64_t> connectivity;
    Particles elements;
  };
  const auto all = std::make_shared<All>();  // as long as the arrays are
  const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
  for (const fem::Mesh& mesh : meshes) {
    const auto first = static_cast<std::int64_t>(all->position.size());
    append(all->position, mesh.nodes.position);
    append(all->velocity, mesh.nodes.velocity);
    append(all->id, mesh.nodes.id);
    append(all->in_transition, mesh.nodes.in_transition);
    for (const fem::Corners& corners : mesh.elements.corners) {
      for (const std::uint32_t a : corners) all->connectivity.push_back(first + static_cast<std::int64_t>(a));
    }
  }
  all->elements = elements_as_points(meshes);
  const std::uint64_t n = all->elements.size(), nodes = all->position.size();
  const auto rank = static_cast<std::uint64_t>(ranks_.rank()),
             partitions = static_cast<std::uint64_t>(ranks_.count());
  const hdf5::Slab of_cells = ranks_.slab(n), of_nodes = ranks_.slab(nodes);

  UnstructuredGrid grid{
      .time = time, .points = nodes, .cells = n, .connectivity_ids = all->connectivity.size()};
  grid.geometry.emplace_back("Points", of_nodes, [all](std::size_t i) { return all->position[i]; });
  const hdf5::Slab of_corners{8 * of_cells.first, 8 * n, 8 * of_cells.total};
  grid.geometry.emplace_back("Connectivity", of_corners,
                             [all](std::size_t i) { return all->connectivity[i]; });
  const hdf5::Slab bounds{of_cells.first + rank, n + 1, of_cells.total + partitions};
  grid.geometry.emplace_back(
      "Offsets", bounds, [](std::size_t e) { return static_cast<std::int64_t>(8 * e); },
      Array::From::row_number);
  constexpr std::uint8_t hexahedron = 12;  // VTK_HEXAHEDRON
  grid.geometry.emplace_back(
      "Types", of_cells, [](std::size_t) { return hexahedron; }, Array::From::row_number);
  grid.cell_data = arrays_of(fields_, {all->elements, options_.material_of_body}, of_cells);
  grid.point_data.emplace_back("velocity", of_nodes, [all](std::size_t i) { return all->velocity[i]; });
  grid.point_data.back().set_attribute("unit", "m/s");
  grid.point_data.emplace_back("node_id", of_nodes, [all](std::size_t i) { return all->id[i]; });
  grid.point_data.emplace_back("in_transition", of_nodes,
                               [all](std::size_t i) { return all->in_transition[i]; });
  return grid;
}

}  // namespace whipple::io
