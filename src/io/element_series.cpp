// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/element_series.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <type_traits>
#include <utility>

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
  } else if constexpr (!std::is_arithmetic_v<Value>) {  // vectors and tensors
    Value sum = Value::Zero();
    for (std::size_t i = first; i < first + count; ++i) sum += values[i];
    return sum / static_cast<double>(count);
  } else {
    return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(first + count));
  }
}

constexpr std::uint8_t failed_by_plastic_strain = 2;  // as in the description of the field `failed`

/// Writes a truss element to row p of the points.
void write_bar(const fem::Bars& bars, std::size_t b, Particles& points, std::size_t p) {
  const fem::BarElements& elements = bars.elements;
  const auto& [first, second] = elements.ends[b];
  const Vector3 along =  // of a hoop across the section
      first == second ? Vector3::UnitZ().eval()
                      : (bars.nodes.position[second] - bars.nodes.position[first]).normalized();
  points.mass[p] = elements.mass[b];
  points.volume[p] = elements.mass[b] / bars.material.density;
  points.pressure[p] = -elements.stress[b] / 3.0;
  points.deviatoric_stress[p] =
      SymmetricTensor::from(elements.stress[b] * (along * along.transpose() - Matrix3::Identity() / 3.0));
  points.specific_internal_energy[p] = elements.internal_energy[b] / elements.mass[b];
  points.plastic_strain[p] = elements.plastic_strain[b];
  points.failed[p] = elements.broken[b] != 0 ? failed_by_plastic_strain : std::uint8_t{0};
  points.sound_speed[p] = std::sqrt(bars.material.young / bars.material.density);
  points.id[p] = elements.id[b];
  points.body[p] = bars.body;
  points.position[p] = 0.5 * (bars.nodes.position[first] + bars.nodes.position[second]);
  points.velocity[p] = 0.5 * (bars.nodes.velocity[first] + bars.nodes.velocity[second]);
}

}  // namespace

Particles elements_as_points(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars) {
  Particles points;
  std::size_t count = 0;
  for (const fem::Mesh& mesh : meshes) count += mesh.elements.size();
  for (const fem::Bars& of_body : bars) count += of_body.elements.size();
  resize(points, count);
  for (const fem::Mesh& mesh : meshes) {
    for (const History& history : mesh.points.history) points.history.declare(history.field, count);
  }
  std::size_t p = 0;
  for (const fem::Mesh& mesh : meshes) {
    const std::size_t rows = fem::points_per_element(mesh.quadrature);
    const MaterialPoints& material_points = mesh.points;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e, ++p) {
      for_each_field(material_points, [&](const auto& field) {
        const auto& of_points = field.of(material_points);
        if (!of_points.empty() && !field.of(std::as_const(points)).empty()) {
          field.of(points)[p] = mean_of(of_points, e * rows, rows);
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
  for (const fem::Bars& of_body : bars) {
    for (std::size_t b = 0; b < of_body.elements.size(); ++b) write_bar(of_body, b, points, p++);
  }
  return points;
}

ElementSeries::ElementSeries(SeriesOptions options, MPI_Comm communicator)
    : options_(std::move(options)),
      fields_(select_output_fields(options_.fields)),
      ranks_(communicator),
      series_(options_.folder, options_.name, "elements", ranks_) {}

fs::path ElementSeries::write(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars,
                              double time) {
  return write(grid(meshes, bars, time));
}

std::function<void()> ElementSeries::prepare(std::span<const fem::Mesh> meshes,
                                             std::span<const fem::Bars> bars, double time) {
  UnstructuredGrid prepared = grid(meshes, bars, time);
  prepared.evaluate();
  return [this, prepared = std::move(prepared)]() mutable { write(std::move(prepared)); };
}

fs::path ElementSeries::write(UnstructuredGrid grid) {
  return series_.write(grid.time, [&](const fs::path& path) {
    grid.write(path, ranks_, options_.provenance, options_.deflate);
  });
}

UnstructuredGrid ElementSeries::grid(std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars,
                                     double time) const {
  struct All {
    std::vector<Vector3> position, velocity;
    std::vector<std::uint64_t> id;
    std::vector<std::uint8_t> in_transition;
    std::vector<std::int64_t> connectivity;
    Particles elements;
  };
  const auto all = std::make_shared<All>();  // lives as long as the arrays
  const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
  const auto append_body = [&](const fem::Nodes& nodes, const auto& nodes_of_element, std::size_t count) {
    const auto first = static_cast<std::int64_t>(all->position.size());
    append(all->position, nodes.position);
    append(all->velocity, nodes.velocity);
    append(all->id, nodes.id);
    append(all->in_transition, nodes.in_transition);
    for (const auto& of_element : nodes_of_element) {
      for (const std::uint32_t a : std::span(of_element).first(count))
        all->connectivity.push_back(first + static_cast<std::int64_t>(a));
    }
  };
  const bool flat =
      std::ranges::any_of(meshes, [](const fem::Mesh& mesh) { return fem::is_flat(mesh.quadrature); });
  const std::size_t corners = flat ? 4 : 8;  // a section has quadrilaterals only
  for (const fem::Mesh& mesh : meshes) append_body(mesh.nodes, mesh.elements.corners, corners);
  const std::size_t cells = all->connectivity.size() / corners;
  for (const fem::Bars& of_body : bars) append_body(of_body.nodes, of_body.elements.ends, 2);
  all->elements = elements_as_points(meshes, bars);
  const std::uint64_t n = all->elements.size(), nodes = all->position.size();
  const auto rank = static_cast<std::uint64_t>(ranks_.rank()),
             partitions = static_cast<std::uint64_t>(ranks_.count());
  const hdf5::Slab of_cells = ranks_.slab(n), of_nodes = ranks_.slab(nodes);

  UnstructuredGrid grid{
      .time = time, .points = nodes, .cells = n, .connectivity_ids = all->connectivity.size()};
  grid.geometry.emplace_back("Points", of_nodes, [all](std::size_t i) { return all->position[i]; });
  grid.geometry.emplace_back("Connectivity", ranks_.slab(all->connectivity.size()),
                             [all](std::size_t i) { return all->connectivity[i]; });
  const hdf5::Slab bounds{of_cells.first + rank, n + 1, of_cells.total + partitions};
  grid.geometry.emplace_back(
      "Offsets", bounds,
      [cells, corners](std::size_t e) {
        return static_cast<std::int64_t>(corners * std::min(e, cells) + 2 * (e - std::min(e, cells)));
      },
      Array::From::row_number);
  grid.geometry.emplace_back(
      "Types", of_cells,
      [cells, flat](std::size_t e) { return e >= cells ? vtk_line
                                            : flat     ? vtk_quad
                                                       : vtk_hexahedron; },
      Array::From::row_number);
  grid.cell_data = arrays_of(fields_, source_of(options_, all->elements), of_cells);
  grid.point_data.emplace_back("velocity", of_nodes, [all](std::size_t i) { return all->velocity[i]; });
  grid.point_data.back().set_attribute("unit", "m/s");
  grid.point_data.emplace_back("node_id", of_nodes, [all](std::size_t i) { return all->id[i]; });
  grid.point_data.emplace_back("in_transition", of_nodes,
                               [all](std::size_t i) { return all->in_transition[i]; });
  return grid;
}

}  // namespace whipple::io
