// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>

#include "src/analysis/table.hpp"
#include "src/case/case.hpp"
#include "src/case/shapes/points.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/material_file.hpp"

namespace whipple::analysis {
namespace {

namespace fs = std::filesystem;

void take_domain(const cases::Domain& domain, Run& run) {
  run.cell_size = domain.cell_size;
  run.has_two_levels = !domain.refinement.empty();
  run.dimension = domain.dimension;
  run.lower = domain.lower;
  run.upper = domain.upper;
  const std::array<grid::Boundary, 6> faces = domain.boundary.in_order();
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    for (const std::size_t side : {0U, 1U}) {
      const grid::Boundary face = faces[2 * a + side];
      if (face == grid::Boundary::outflow) continue;
      run.walls[a][side] = {.position = (side == 0 ? domain.lower : domain.upper)[axis],
                            .holds = face == grid::Boundary::symmetry};
    }
    if ((domain.dimension == grid::Dimension::axisymmetric && a == 1) || (domain.is_planar() && a == 2))
      continue;
    if (faces[2 * a + 1] == grid::Boundary::symmetry) run.mirror_planes[a] = domain.upper[axis];
    if (faces[2 * a] == grid::Boundary::symmetry) run.mirror_planes[a] = domain.lower[axis];
  }
}

/// Reads phases and initial state from the copy of a material file in the run folder. Does nothing if the file is
/// missing, is located elsewhere, or is not accepted by this program.
void read_material_traits(const fs::path& folder, const std::string& name, BodyInput& body) {
  const fs::path file = folder / name;
  if (!fs::is_regular_file(file) || !lies_in(file, folder)) return;
  try {
    const Material material = read_material(file);
    body.phases = material.eos->has_phases();
    body.condensed = material.eos->condensed();
  } catch (const InputError& error) {
    log::warning("cannot tell whether '{}' has phases: {}", body.name, error.what());
  }
}

/// Returns the mean cross-section (m^2) of a body normal to a direction: its volume over its length along it; in two
/// dimensions that of its bounding rectangle (m).
double section_of(const cases::Shape& shape, const Vector3& direction, bool planar) {
  const cases::Shape::Bounds bounds = shape.bounds();
  Vector3 edge = bounds.upper - bounds.lower;
  if (planar) edge[2] = 0.0;
  const double length = edge.dot(direction.cwiseAbs());
  return (planar ? edge[0] * edge[1] : shape.volume()) / length;
}

/// Returns the velocity (m/s) of the target: the body with the largest cross-section normal to the flight; among equal
/// ones the slowest, then the longest along the flight, then the last. Returns zero where walls, or bodies without a
/// shape, fix the frame.
Vector3 velocity_of_target(const std::vector<cases::Body>& bodies, const Run& run) {
  const auto has_shape = [](const cases::Body& body) { return body.shape != nullptr; };
  if (bodies.size() < 2 || !std::ranges::all_of(bodies, has_shape)) return Vector3::Zero();
  Vector3 flight = Vector3::Zero();
  for (const cases::Body& a : bodies) {
    for (const cases::Body& b : bodies) {
      if ((a.velocity - b.velocity).norm() > flight.norm()) flight = a.velocity - b.velocity;
    }
  }
  if (flight.isZero(0.0)) return Vector3::Zero();
  const Vector3 direction = flight.normalized();
  const bool planar = run.dimension != grid::Dimension::space;
  const auto rank = [&](const cases::Body& body) {
    // Relative differences below 1e-6 are round-off of equal values in the case.
    const auto rounded = [](double x) { return x > 0.0 ? std::round(1e6 * std::log(x)) : -1e300; };
    const cases::Shape::Bounds bounds = body.shape->bounds();
    return std::tuple(rounded(section_of(*body.shape, direction, planar)), -rounded(body.velocity.norm()),
                      rounded((bounds.upper - bounds.lower).dot(direction.cwiseAbs())));
  };
  const cases::Body* target = &bodies.front();
  for (const cases::Body& body : bodies) {
    if (rank(body) >= rank(*target)) target = &body;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const bool held = run.walls[a][0] || run.walls[a][1];
    if (held && target->velocity[static_cast<Eigen::Index>(a)] != 0.0) return Vector3::Zero();
  }
  return target->velocity;
}

void take_bodies(const std::vector<cases::Body>& bodies, Run& run) {
  run.frame_velocity = velocity_of_target(bodies, run);
  for (const cases::Body& body : bodies) {
    const Vector3 velocity = body.velocity - run.frame_velocity;
    // An element counts as the eight particles into which it may be converted.
    const cases::Discretization& made = body.discretization;
    const auto given =
        body.shape != nullptr ? body.shape->particles() : std::span<const cases::GivenParticle>();
    const double spacing = !given.empty() ? cases::mean_edge(given, run.dimension != grid::Dimension::space)
                           : made.has_particles()
                               ? run.cell_size / std::cbrt(static_cast<double>(made.per_cell))
                               : 0.5 * made.size(run.cell_size);
    run.bodies.push_back({.name = body.name,
                          .velocity = velocity,
                          .spacing = spacing,
                          .size = body.shape != nullptr ? body.shape->smallest_extent(velocity) : nan});
    read_material_traits(run.folder, body.material, run.bodies.back());
  }
}

std::vector<SnapshotEntry> read_index(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().ends_with(".particles.hdf.series")) found.push_back(entry.path());
  }
  if (found.empty()) return {};  // the run has not yet written its first snapshot
  if (found.size() > 1) {
    throw InputError(fmt::format("{}: error: has {} files *.particles.hdf.series, expected one",
                                 folder.string(), found.size()));
  }
  std::vector<SnapshotEntry> entries;
  try {
    const nlohmann::json index = parse_json(read_text(found.front()));
    for (const nlohmann::json& file : index.at("files")) {
      const fs::path name = file.at("name").get<std::string>();
      if (name != name.filename()) {
        throw InputError(fmt::format("{}: error: names {}, which is no file of this folder",
                                     found.front().string(), name.string()));
      }
      entries.push_back({folder / name, file.at("time").get<double>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: error: is not the index of a series: {}", found.front().string(), error.what()));
  }
  return entries;
}

/// Returns the values in the order of the particle numbers.
template <class Value>
std::vector<Value> sorted(const std::vector<Value>& values, const std::vector<std::uint32_t>& order) {
  std::vector<Value> result(order.size());
  parallel::for_each(order.size(), [&](std::size_t i) { result[i] = values[order[i]]; });
  return result;
}

std::vector<Vector3> as_vectors(const std::vector<float>& flat, const std::vector<std::uint32_t>& order) {
  std::vector<Vector3> result(order.size());
  parallel::for_each(order.size(), [&](std::size_t i) {
    result[i] = Eigen::Map<const Eigen::Vector3f>(flat.data() + 3 * order[i]).cast<double>();
  });
  return result;
}

std::vector<double> as_reals(const hdf5::Group& data, const std::string& name,
                             const std::vector<std::uint32_t>& order) {
  const auto widen = [&](const auto& values) {
    return sorted(std::vector<double>(values.begin(), values.end()), order);
  };
  const hdf5::Dataset set = data.open_dataset(name);
  const hdf5::Dataset::Shape list{order.size(), 1};
  if (set.stores<std::uint8_t>()) return widen(set.read_all<std::uint8_t>(list));
  if (set.stores<std::uint16_t>()) return widen(set.read_all<std::uint16_t>(list));
  return widen(set.read_all<float>(list));
}

/// Checks the prerequisites of all measures: valid bodies, finite positions and velocities, positive masses.
/// @throws InputError naming the file and the particle
void require_sound(const Snapshot& snapshot, const SnapshotEntry& entry) {
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] >= entry.bodies) {
      throw InputError(fmt::format("{}: error: particle {} is of body {}, but the run has {}",
                                   entry.file.string(), snapshot.id[i], snapshot.body[i], entry.bodies));
    }
    if (!(snapshot.mass[i] > 0.0) || !snapshot.position[i].allFinite() || !snapshot.velocity[i].allFinite()) {
      throw InputError(fmt::format("{}: error: particle {} has no finite position and velocity, or no mass",
                                   entry.file.string(), snapshot.id[i]));
    }
    const Vector3& x = snapshot.position[i];
    if ((x.array() < entry.lower.array()).any() || (x.array() > entry.upper.array()).any()) {
      throw InputError(
          fmt::format("{}: error: particle {} lies at ({:.6g}, {:.6g}, {:.6g}) m, far outside of the domain",
                      entry.file.string(), snapshot.id[i], x[0], x[1], x[2]));
    }
  }
}

}  // namespace

Run read_run(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "run.toml")) {
    throw InputError(
        fmt::format("{}: error: is not the folder of a run: it contains no run.toml", folder.string()));
  }
  Run run;
  run.folder = folder;
  const cases::Case setup = cases::read_written_case(folder / "run.toml");
  run.title = setup.title;
  take_domain(setup.domain, run);
  take_bodies(setup.bodies, run);
  if (run.bodies.empty()) throw InputError(fmt::format("{}: error: run.toml has no bodies", folder.string()));
  run.snapshots = read_index(folder);
  for (SnapshotEntry& entry : run.snapshots) {
    entry.bodies = run.bodies.size();
    entry.frame_velocity = run.frame_velocity;
    const Vector3 edge = run.upper - run.lower;
    for (int a = 0; a < (run.dimension == grid::Dimension::space ? 3 : 2); ++a) {
      entry.lower[a] = run.lower[a] - edge[a];
      entry.upper[a] = run.upper[a] + edge[a];
    }
  }
  return run;
}

const std::vector<double>* Snapshot::scalar(const std::string& name) const {
  const auto found = scalars.find(name);
  return found == scalars.end() ? nullptr : &found->second;
}

std::vector<double> Snapshot::volumes() const {
  const std::vector<double>* density = scalar("density");
  const std::vector<double>* voids = scalar("void_fraction");
  std::vector<double> volume(size(), 0.0);
  if (density == nullptr) return volume;
  parallel::for_each(size(), [&](std::size_t i) {
    const double solid = voids != nullptr ? std::max(1.0 - (*voids)[i], 1e-6) : 1.0;
    volume[i] = mass[i] / ((*density)[i] * solid);
  });
  return volume;
}

namespace {

/// Appends the elements of the snapshot: eight points for each, at the natural coordinates (+-0.5)^3, and one for a
/// bar, at its middle, with equal parts of its mass and the fields of the element.
void append_elements(const fs::path& path, Snapshot& snapshot) {
  constexpr std::uint8_t vtk_line = 3;
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  const hdf5::Group data = vtk.open_group("CellData");
  const auto id = data.open_dataset("id").read_all<std::uint64_t>();
  if (id.empty()) return;
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: is no snapshot of elements: {}", path.string(), why));
  };
  std::vector<std::uint32_t> order(id.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; });
  std::vector<std::int64_t> corners = vtk.open_dataset("Connectivity").read_all<std::int64_t>();
  // The corners of each rank count from its first point.
  const auto points_of = vtk.open_dataset("NumberOfPoints").read_all<std::int64_t>();
  const auto cells_of = vtk.open_dataset("NumberOfCells").read_all<std::int64_t>();
  const auto types = vtk.open_dataset("Types").read_all<std::uint8_t>({id.size(), 1});
  if (cells_of.size() != points_of.size()) fail("NumberOfCells and NumberOfPoints differ in length");
  std::vector<std::size_t> corners_from(id.size() + 1, 0);
  std::size_t cell = 0;
  for (std::int64_t rank = 0, first = 0; rank < std::ssize(points_of); ++rank) {
    const auto r = static_cast<std::size_t>(rank);
    if (cells_of[r] < 0 || static_cast<std::size_t>(cells_of[r]) > id.size() - cell || points_of[r] < 0)
      fail("NumberOfCells does not add up to the elements");
    for (const std::size_t end = cell + static_cast<std::size_t>(cells_of[r]); cell < end; ++cell) {
      corners_from[cell + 1] = corners_from[cell] + (types[cell] == vtk_line ? 2U : 8U);
      if (corners_from[cell + 1] > corners.size()) fail("Connectivity is too short");
      for (std::size_t i = corners_from[cell]; i < corners_from[cell + 1]; ++i) corners[i] += first;
    }
    first += points_of[r];
  }
  if (cell != id.size()) fail("NumberOfCells does not add up to the elements");
  const hdf5::Dataset positions = vtk.open_dataset("Points");
  const std::uint64_t nodes = positions.stored_shape().rows;
  const auto points = positions.read_all<float>({nodes, 3});
  const auto velocities = vtk.open_group("PointData").open_dataset("velocity").read_all<float>({nodes, 3});
  const auto body = data.open_dataset("body").read_all<std::uint16_t>({id.size(), 1});
  if (!std::ranges::all_of(corners,
                           [&](std::int64_t node) { return node >= 0 && node < std::int64_t(nodes); }))
    fail("Connectivity names points that are not there");
  for (std::int64_t node = 0; node < std::int64_t(nodes); ++node) {
    snapshot.nodes.push_back(Eigen::Map<const Eigen::Vector3f>(points.data() + 3 * node).cast<double>());
  }
  // Merges the copies of nodes shared by ranks.
  const auto node_id =
      vtk.open_group("PointData").open_dataset("node_id").read_all<std::uint64_t>({nodes, 1});
  std::unordered_map<std::uint64_t, std::uint32_t> first_of_node;
  for (std::uint32_t node = 0; node < nodes; ++node) first_of_node.emplace(node_id[node], node);
  const std::vector<double> mass = as_reals(data, "mass", order);
  const auto corner = [&](std::size_t k, std::size_t axis) {
    constexpr std::array<std::array<int, 3>, 8> signs = {
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
    return signs[k][axis];
  };
  const auto vector_at = [](const std::vector<float>& of_nodes, std::int64_t node) {
    return Eigen::Map<const Eigen::Vector3f>(of_nodes.data() + 3 * node).cast<double>().eval();
  };
  std::vector<std::size_t> parts(order.size());
  for (std::size_t e = 0; e < order.size(); ++e) {
    const std::size_t from = corners_from[order[e]];
    parts[e] = types[order[e]] == vtk_line ? 1 : 8;
    if (parts[e] == 8) {
      Hexahedron& element = snapshot.hexahedra.emplace_back(Hexahedron{.first = 8 * id[order[e]]});
      for (std::size_t a = 0; a < 8; ++a) {
        element.corners[a] = first_of_node[node_id[static_cast<std::size_t>(corners[from + a])]];
      }
    }
    for (std::size_t k = 0; k < parts[e]; ++k) {
      Vector3 x = Vector3::Zero(), v = Vector3::Zero();
      const auto add = [&](std::size_t a, double weight) {
        x += weight * vector_at(points, corners[from + a]);
        v += weight * vector_at(velocities, corners[from + a]);
      };
      if (parts[e] == 1) {
        add(0, 0.5);
        add(1, 0.5);
      }
      for (std::size_t a = 0; parts[e] == 8 && a < 8; ++a) {
        double weight = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          weight *= corner(a, axis) == corner(k, axis) ? 0.75 : 0.25;
        add(a, weight);
      }
      snapshot.position.push_back(x);
      snapshot.velocity.push_back(v);
      snapshot.mass.push_back(mass[e] / static_cast<double>(parts[e]));
      snapshot.body.push_back(body[order[e]]);
      snapshot.id.push_back(8 * id[order[e]] + k);
    }
  }
  for (auto& [name, values] : snapshot.scalars) {
    const std::vector<double> of_elements = as_reals(data, name, order);
    for (std::size_t e = 0; e < order.size(); ++e) values.insert(values.end(), parts[e], of_elements[e]);
  }
}

/// Sorts all points by their numbers.
void sort_by_number(Snapshot& snapshot) {
  std::vector<std::uint32_t> order(snapshot.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return snapshot.id[i]; });
  snapshot.id = sorted(snapshot.id, order);
  snapshot.position = sorted(snapshot.position, order);
  snapshot.velocity = sorted(snapshot.velocity, order);
  snapshot.mass = sorted(snapshot.mass, order);
  snapshot.body = sorted(snapshot.body, order);
  for (auto& [name, values] : snapshot.scalars) values = sorted(values, order);
}

}  // namespace

fs::path elements_file(const SnapshotEntry& entry) {
  constexpr std::string_view particles = ".particles.";
  std::string name = entry.file.filename().string();
  const std::size_t kind = name.rfind(particles);
  if (kind == std::string::npos) return {};
  return entry.file.parent_path() / name.replace(kind, particles.size(), ".elements.");
}

Snapshot read_snapshot(const SnapshotEntry& entry) {
  const hdf5::File file = hdf5::File::open(entry.file);
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  const hdf5::Group data = vtk.open_group("PointData");
  Snapshot snapshot;
  snapshot.time = entry.time;
  const auto id = data.open_dataset("id").read_all<std::uint64_t>();
  const hdf5::Dataset::Shape list{id.size(), 1}, vectors{id.size(), 3};
  std::vector<std::uint32_t> order(id.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; });
  snapshot.id = sorted(id, order);
  snapshot.position = as_vectors(vtk.open_dataset("Points").read_all<float>(vectors), order);
  snapshot.velocity = as_vectors(data.open_dataset("velocity").read_all<float>(vectors), order);
  snapshot.mass = as_reals(data, "mass", order);
  snapshot.body = sorted(data.open_dataset("body").read_all<std::uint16_t>(list), order);
  constexpr std::array<std::string_view, 3> read_above = {"id", "mass", "body"};
  for (const std::string& name : data.names()) {
    if (std::ranges::find(read_above, name) != read_above.end()) continue;
    if (data.open_dataset(name).shape().size() == 1) snapshot.scalars[name] = as_reals(data, name, order);
  }
  if (const fs::path with_elements = elements_file(entry);
      !with_elements.empty() && fs::exists(with_elements)) {
    append_elements(with_elements, snapshot);
    sort_by_number(snapshot);
  }
  require_sound(snapshot, entry);
  if (!entry.frame_velocity.isZero(0.0)) {
    const Vector3 way = snapshot.time * entry.frame_velocity;
    for (Vector3& v : snapshot.velocity) v -= entry.frame_velocity;
    for (std::vector<Vector3>* const points : {&snapshot.position, &snapshot.nodes}) {
      for (Vector3& x : *points) x -= way;
    }
  }
  return snapshot;
}

}  // namespace whipple::analysis
