// SPDX-License-Identifier: BSD-3-Clause
// Hexahedra on several ranks (docs/theory/fem.md, section 10), their sums and files.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/afemp/transition.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/solver/carriers/element_totals.hpp"
#include "src/solver/carriers/figures.hpp"
#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/carriers/share_out.hpp"
#include "src/solver/work.hpp"
#include "src/transfer/local_damping.hpp"

namespace whipple::solver {

void Hexahedra::keep_share() {
  if (!state_.is_parallel()) return;
  const int rank = parallel::rank(state_.communicator), ranks = parallel::size(state_.communicator);
  for (fem::Mesh& mesh : meshes_) fem::keep_share(mesh, rank, ranks);
  shared_nodes_ = fem::SharedNodes(meshes_, state_.communicator);
}

void Hexahedra::gather() {
  if (!state_.is_parallel()) {
    for (fem::Mesh& mesh : meshes_) fem::connect(mesh);
    return;
  }
  for (fem::Mesh& mesh : meshes_) fem::gather_nodes(mesh, state_.communicator);
  shared_nodes_ = fem::SharedNodes(meshes_, state_.communicator);
}

void Hexahedra::share_out() {
  if (!solver::share_out(meshes_, state_.grid, state_.communicator)) return;
  shared_nodes_ = fem::SharedNodes(meshes_, state_.communicator);
  surfaces_changed_ = pieces_changed_ = true;
}

/// Updates shared nodes and fields after elements were converted or removed on any rank.
void Hexahedra::elements_removed() {
  surfaces_changed_ = pieces_changed_ = true;
  if (!state_.is_parallel()) return;
  shared_nodes_.elements_removed(meshes_);
  // An optional field is in use on all ranks or on none.
  for_each_field(state_.particles, [&](const auto& field) {
    if (!field.optional) return;
    const bool in_use = parallel::any(state_.communicator, !field.of(state_.particles).empty());
    if (in_use) field.resize(state_.particles, state_.particles.size());
  });
}

/// Sums forces and masses, and takes the maximum sound speed, over all copies of the shared nodes.
void Hexahedra::join_shared_nodes() {
  if (!state_.is_parallel()) return;
  const std::span<const fem::SharedNodes::Place> places = shared_nodes_.places();
  shared_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const fem::Mesh& mesh = meshes_[places[i].mesh];
    const std::uint32_t a = places[i].node;
    const Vector3& f = mesh.nodes.force[a];
    shared_[i] = {f[0], f[1], f[2], mesh.nodes.mass[a],
                  mesh.nodes.in_transition[a] != 0 ? afemp::sound_speed_at(mesh, a) : 0.0};
  }
  using Values = std::array<double, 5>;
  shared_nodes_.reduce(shared_, [](const Values& a, const Values& b) {
    return Values{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], std::max(a[4], b[4])};
  });
  std::size_t i = 0;
  auto place = places.begin();
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    const std::vector<std::uint8_t>& marked = meshes_[m].nodes.in_transition;
    for (std::uint32_t a = 0; a < marked.size(); ++a) {
      if (marked[a] == 0) continue;
      const fem::SharedNodes::Place here{m, a};
      while (place != places.end() && *place < here) ++place;
      if (place != places.end() && *place == here) {
        state_.transition.sound_speed[i] = shared_[static_cast<std::size_t>(place - places.begin())][4];
      }
      ++i;
    }
  }
}

/// Advances v <- v + dt f/m of the nodes of a mesh that are not interface nodes; shared nodes have the forces of all
/// ranks.
fem::ConstraintBalance Hexahedra::advance_free_nodes(std::size_t m) {
  fem::Mesh& mesh = meshes_[m];
  const double dt = state_.run.time_step;
  const double path = path_factor(mesh);
  const std::span<const fem::SharedNodes::Place> places = shared_nodes_.places();
  if (places.empty()) {
    return fem::advance_velocities(mesh, dt, motions_[m], mesh.nodes.in_transition, path);
  }
  std::vector<std::uint8_t> elsewhere = mesh.nodes.in_transition;
  for (const fem::SharedNodes::Place& place : places) {
    if (place.mesh == m) elsewhere[place.node] = 1;
  }
  fem::ConstraintBalance balance = fem::advance_velocities(mesh, dt, motions_[m], elsewhere, path);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].mesh != m || mesh.nodes.in_transition[places[i].node] != 0) continue;
    const std::array<double, 5>& of_node = shared_[i];
    balance += fem::advance_velocity(mesh.nodes, places[i].node,
                                     Vector3(of_node[0], of_node[1], of_node[2]) / of_node[3], dt,
                                     motions_[m], path);
  }
  return balance;
}

/// Applies local damping (3.5e) to the nodes of a mesh that are no interface nodes, which the grid damps.
void Hexahedra::damp_nodes(std::size_t m) {
  fem::Nodes& nodes = meshes_[m].nodes;
  std::vector<Vector3>& impulses = of_mesh_[m].damping;
  const double dt = state_.run.time_step, alpha = state_.setup.damping.mean(state_.run.time, dt);
  impulses.clear();
  if (alpha == 0.0) return;
  impulses.assign(nodes.size(), Vector3::Zero());
  std::vector<Vector3> increment(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) increment[a] = dt / nodes.mass[a] * nodes.force[a];
  const std::span<const fem::SharedNodes::Place> places = shared_nodes_.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::array<double, 5>& sum = shared_[i];
    if (places[i].mesh == m) increment[places[i].node] = dt / sum[3] * Vector3(sum[0], sum[1], sum[2]);
  }
  const auto lanes = [](const Vector3& v) { return Lanes{v[0], v[1], v[2], 0.0}; };
  const auto factor = [&](std::size_t a) {
    const Lanes of_node = transfer::damping_factor(alpha, lanes(nodes.velocity[a]), lanes(increment[a]));
    return Vector3(of_node[0], of_node[1], of_node[2]);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].mesh != m || nodes.in_transition[places[i].node] != 0) continue;
    const Vector3 of_node = factor(places[i].node);
    for (std::size_t c = 0; c < 3; ++c) shared_[i][c] *= of_node[static_cast<Eigen::Index>(c)];
  }
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    if (nodes.in_transition[a] != 0) continue;
    const Vector3 damped = factor(a).cwiseProduct(nodes.force[a]);
    impulses[a] = dt * (damped - nodes.force[a]);
    nodes.force[a] = damped;
  }
}

/// Accumulates impulse and work of local damping on a mesh, when the motion of its nodes is complete.
void Hexahedra::book_damping(std::size_t m) {
  const std::vector<Vector3>& impulses = of_mesh_[m].damping;
  for (std::size_t a = 0; a < impulses.size(); ++a) {
    state_.booked.external_impulse += impulses[a];
    state_.booked.damping_work += impulses[a].dot(motions_[m].mean[a]);
  }
}

/// Returns the velocities that the nodes of a mesh would have after the step without faces and prescribed velocities;
/// those of interface nodes are not used.
std::vector<Vector3> Hexahedra::unconstrained_velocities(std::size_t m) const {
  const fem::Nodes& nodes = meshes_[m].nodes;
  const double dt = state_.run.time_step;
  std::vector<Vector3> velocity(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    velocity[a] = nodes.velocity[a] + dt / nodes.mass[a] * nodes.force[a];
  }
  const std::span<const fem::SharedNodes::Place> places = shared_nodes_.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].mesh != m) continue;
    const std::array<double, 5>& sum = shared_[i];
    velocity[places[i].node] = nodes.velocity[places[i].node] + dt / sum[3] * Vector3(sum[0], sum[1], sum[2]);
  }
  return velocity;
}

/// Books the impulses of the faces of the domain on the nodes of a mesh for the force gauges: those across a face at
/// which a node ends the step, all at a no-slip wall. The grid has those on interface nodes.
void Hexahedra::book_faces(std::size_t m, std::span<const Vector3> unconstrained) {
  const fem::Mesh& mesh = meshes_[m];
  const fem::Nodes& nodes = mesh.nodes;
  const grid::Geometry& geometry = state_.setup.geometry;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    if (nodes.in_transition[a] != 0) continue;
    Vector3 impulse = nodes.mass[a] * (nodes.velocity[a] - unconstrained[a]);
    if (impulse.isZero(0.0)) continue;
    const Vector3 end = nodes.position[a] + state_.run.time_step * motions_[m].end[a];
    for (std::size_t face = 0; face < 6; ++face) {
      const auto axis = static_cast<int>(face / 2);
      if (geometry.boundary[face] == grid::Boundary::outflow || !geometry.is_in_plane(face, end)) continue;
      const bool all = geometry.boundary[face] == grid::Boundary::no_slip;
      const Vector3 of_face = all ? impulse : Vector3(impulse[axis] * Vector3::Unit(axis));
      state_.force_gauges.book_point(mesh.body, face, end, of_face);
      impulse -= of_face;
    }
  }
}

void Hexahedra::add_work(std::vector<Vector3>& centres, std::vector<double>& work) const {
  const std::vector<Vector3> own = centres_of(meshes_, state_.setup.geometry);
  centres.insert(centres.end(), own.begin(), own.end());
  for (const fem::Mesh& mesh : meshes_) {
    work.insert(work.end(), mesh.elements.size(), work_of_element(mesh.quadrature));
  }
}

void Hexahedra::add_totals(Totals& sum) {
  for (const fem::Mesh& mesh : meshes_) sum += totals_of(mesh, state_.affine_inertia());
}

void Hexahedra::add_phases(std::span<PhaseMasses> of_body) const {
  for (const fem::Mesh& mesh : meshes_)
    of_body[mesh.body] += phase_masses(mesh.points, 0, mesh.points.size());
}

void Hexahedra::add_figures(Figures& figures) const {
  for (const fem::Mesh& mesh : meshes_) {
    add_speeds(mesh.nodes.velocity, figures);
    add_state(mesh.points, figures);
    add_energy_parts(mesh.points, state_.setup.materials, [&](std::size_t) { return mesh.body; }, figures);
  }
}

void Hexahedra::add_releasable(Releasable& sum) const {
  for (const fem::Mesh& mesh : meshes_) add_releasable_of(mesh.points, sum);
}

double Hexahedra::largest_speed(const Vector3& frame) {
  double largest = 0.0;
  for (const fem::Mesh& mesh : meshes_)
    largest = std::max(largest, largest_speed_of(mesh.nodes.velocity, frame));
  return largest;
}

std::size_t Hexahedra::element_count() const {
  std::size_t count = 0;
  for (const fem::Mesh& mesh : meshes_) count += mesh.elements.size();
  return count;
}

/// Returns the largest possible id: an element may become eight particles.
std::uint64_t Hexahedra::largest_particle_id() const {
  std::uint64_t largest = 0;
  for (const fem::Mesh& mesh : meshes_) {
    for (const std::uint64_t id : mesh.elements.id) largest = std::max(largest, 8 * id + 7);
  }
  return largest;
}

std::size_t Hexahedra::bytes() const {
  std::size_t bytes = 0;
  for (const fem::Mesh& mesh : meshes_) {
    bytes += bytes_of(mesh.nodes) + bytes_of(mesh.elements) + bytes_of(mesh.points);
  }
  return bytes;
}

double Hexahedra::mass_in(const cases::LoadedRegion& region) const {
  double mass = 0.0;
  for (const fem::Mesh& mesh : meshes_) mass += mass_of_nodes(mesh.nodes, mesh.body, region);
  return mass;
}

void Hexahedra::for_each_point(const std::function<void(const Point& point)>& visit) const {
  for (const fem::Mesh& mesh : meshes_) visit_nodes(mesh.nodes, mesh.body, state_, visit);
}

void Hexahedra::for_each_part(const SelectElement& select,
                              const std::function<void(const Part& part)>& visit) const {
  constexpr std::size_t corners = 8;
  for (const fem::Mesh& mesh : meshes_) {
    const std::size_t rows = fem::points_per_element(mesh.quadrature);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto& nodes = mesh.elements.corners[e];
      Vector3 centre = Vector3::Zero();
      for (const std::uint32_t a : nodes) centre += mesh.nodes.position[a] / corners;
      double reach = 0.0;
      for (const std::uint32_t a : nodes) reach = std::max(reach, (mesh.nodes.position[a] - centre).norm());
      if (!select(mesh.elements.id[e], centre, reach)) continue;
      for (std::size_t k = 0; k < corners; ++k) {
        const std::size_t row = e * rows + (rows == corners ? k : 0);
        const double fraction = rows == corners ? 1.0 : 1.0 / corners;
        Part part{corners * mesh.elements.id[e] + k,
                  Vector3::Zero(),
                  Vector3::Zero(),
                  fraction * mesh.points.mass[row],
                  fraction * mesh.points.volume[row],
                  mesh.points,
                  row};
        for (std::size_t a = 0; a < corners; ++a) {
          double weight = 1.0 / corners;
          for (std::size_t i = 0; i < 3; ++i) {
            weight *= 1.0 + 0.5 * fem::corner_coordinates[a][i] * fem::corner_coordinates[k][i];
          }
          part.position += weight * mesh.nodes.position[nodes[a]];
          part.velocity += weight * mesh.nodes.velocity[nodes[a]];
        }
        visit(part);
      }
    }
  }
}

std::string Hexahedra::count_text(std::size_t body) const {
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const fem::Mesh& mesh = meshes_[m];
    if (mesh.body != body) continue;
    double nodes = shared_nodes_.count(m, std::vector<std::uint8_t>(mesh.nodes.size(), 1));
    parallel::sum(state_.communicator, std::span(&nodes, 1));
    return fmt::format("{} elements, {} nodes", sum_over_ranks(state_.communicator, mesh.elements.size()),
                       static_cast<std::size_t>(nodes));
  }
  return {};
}

void Hexahedra::save(Contents& contents) const {
  contents.meshes = state_.is_parallel() ? shared_nodes_.numbered_together(meshes_) : meshes_;
}

}  // namespace whipple::solver
