// SPDX-License-Identifier: BSD-3-Clause
// What belongs to which rank: particles follow the blocks of the forest, elements the blocks of their
// centres, with copies of the nodes that several ranks share (docs/theory/fem.md, 10).
#include "src/fem/distribution.hpp"

#include <algorithm>
#include <array>

#include "src/afemp/transition.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/particles/migrate.hpp"
#include "src/particles/rows.hpp"
#include "src/solver/simulation.hpp"
#include "src/solver/work.hpp"

namespace whipple::solver {
namespace {

constexpr double lookahead_steps = 8.0;  // motion that the active blocks foresee
constexpr double astray = 0.05;          // fraction of a rank's elements elsewhere before elements move
constexpr int rank_of_bars_in_files = 0;

/// The nodes of every element.
const std::vector<fem::Corners>& nodes_of_elements(const fem::Mesh& mesh) { return mesh.elements.corners; }
const std::vector<std::array<std::uint32_t, 2>>& nodes_of_elements(const fem::Bars& bars) {
  return bars.elements.ends;
}

/// Centres of the elements of all bodies, inside of the domain.
template <class Body>
std::vector<Vector3> centres_of(const std::vector<Body>& bodies, const grid::Geometry& geometry) {
  const Vector3 upper(geometry.upper(0), geometry.upper(1), geometry.upper(2));
  std::vector<Vector3> centres;
  for (const Body& body : bodies) {
    for (const auto& nodes : nodes_of_elements(body)) {
      Vector3 centre = Vector3::Zero();
      for (const std::uint32_t a : nodes)
        centre += body.nodes.position[a] / static_cast<double>(nodes.size());
      centres.push_back(centre.cwiseMax(geometry.lower).cwiseMin(upper));
    }
  }
  return centres;
}

/// Sends elements to the ranks that own the blocks of their centres if enough of them are elsewhere.
/// @returns whether they were
template <class Body>
bool share_out(std::vector<Body>& bodies, const grid::BlockGrid& grid, MPI_Comm communicator) {
  const std::vector<int> owners = grid.owners(centres_of(bodies, grid.geometry()));
  const auto elsewhere = static_cast<double>(
      owners.size() - static_cast<std::size_t>(std::ranges::count(owners, parallel::rank(communicator))));
  if (!parallel::any(communicator, elsewhere > astray * static_cast<double>(owners.size()))) return false;
  std::size_t first = 0;
  for (Body& body : bodies) {
    const std::size_t count = body.elements.size();
    fem::migrate(body, std::span(owners).subspan(first, count), communicator);
    first += count;
  }
  return true;
}

}  // namespace

/// At the start every rank has all elements and bars.
void Simulation::keep_own_elements() {
  const int rank = parallel::rank(communicator_), ranks = parallel::size(communicator_);
  if (ranks == 1) return;
  for (fem::Mesh& mesh : meshes_) fem::keep_share(mesh, rank, ranks);
  shared_nodes_ = fem::SharedNodes(meshes_, communicator_);
  for (fem::Bars& bars : bars_) fem::keep_share(bars, rank, ranks);
}

/// From a checkpoint, of which every rank read any part. Bars are few: all go to one rank, and from there to
/// the owners of their blocks.
void Simulation::gather_elements() {
  if (parallel::size(communicator_) == 1) {
    for (fem::Mesh& mesh : meshes_) fem::connect(mesh);
    return;
  }
  for (fem::Mesh& mesh : meshes_) fem::gather_nodes(mesh, communicator_);
  shared_nodes_ = fem::SharedNodes(meshes_, communicator_);
  const auto all_to_one = [&](auto& points) {
    std::vector<std::vector<std::uint32_t>> leaving(static_cast<std::size_t>(parallel::size(communicator_)));
    for (std::uint32_t i = 0; i < points.size(); ++i) leaving[rank_of_bars_in_files].push_back(i);
    exchange_rows(points, {}, leaving, communicator_);
  };
  for (fem::Bars& bars : bars_) {
    all_to_one(bars.nodes);
    all_to_one(bars.elements);
  }
}

/// Elements go to the ranks that own the blocks of their centres, after the forest was divided anew.
void Simulation::share_out_elements() {
  if (!elements_astray_) return;
  elements_astray_ = false;
  share_out(bars_, grid_, communicator_);
  if (!share_out(meshes_, grid_, communicator_)) return;
  shared_nodes_ = fem::SharedNodes(meshes_, communicator_);
  surfaces_changed_ = true;
}

/// After elements became particles or left, on whatever rank.
void Simulation::elements_removed() {
  surfaces_changed_ = true;
  if (parallel::size(communicator_) == 1) return;
  shared_nodes_.elements_removed(meshes_);
  // Optional fields are in use on all ranks or on none.
  for_each_field<Particles>([&](const auto& field) {
    if (!field.optional) return;
    auto& values = particles_.*(field.values);
    if (parallel::any(communicator_, !values.empty())) values.resize(particles_.size());
  });
}

/// Forces, masses and sound speeds of all copies of the shared nodes.
void Simulation::join_shared_nodes() {
  if (parallel::size(communicator_) == 1) return;
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
        transition_.sound_speed[i] = shared_[static_cast<std::size_t>(place - places.begin())][4];
      }
      ++i;
    }
  }
}

/// v <- v + dt f/m of the nodes of a mesh that are not in transition, with the forces of all ranks on those
/// that they share.
fem::ConstraintBalance Simulation::advance_free_nodes(std::size_t m) {
  fem::Mesh& mesh = meshes_[m];
  const double dt = state_.time_step;
  const std::span<const fem::SharedNodes::Place> places = shared_nodes_.places();
  if (places.empty()) {
    return fem::advance_velocities(mesh, dt, motions_[m], mesh.nodes.in_transition);
  }
  std::vector<std::uint8_t> elsewhere = mesh.nodes.in_transition;
  for (const fem::SharedNodes::Place& place : places) {
    if (place.mesh == m) elsewhere[place.node] = 1;
  }
  fem::ConstraintBalance balance = fem::advance_velocities(mesh, dt, motions_[m], elsewhere);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].mesh != m || mesh.nodes.in_transition[places[i].node] != 0) continue;
    const std::array<double, 5>& of_node = shared_[i];
    balance +=
        fem::advance_velocity(mesh.nodes, places[i].node,
                              Vector3(of_node[0], of_node[1], of_node[2]) / of_node[3], dt, motions_[m]);
  }
  return balance;
}

std::vector<fem::Mesh> Simulation::meshes_for_checkpoint() const {
  return parallel::size(communicator_) == 1 ? meshes_ : shared_nodes_.numbered_together(meshes_);
}

std::vector<fem::Bars> Simulation::bars_for_checkpoint() const {
  std::vector<fem::Bars> bars = bars_;
  if (parallel::size(communicator_) == 1) return bars;
  for (fem::Bars& of_body : bars) {
    fem::migrate(of_body, std::vector<int>(of_body.elements.size(), rank_of_bars_in_files), communicator_);
  }
  return bars;
}

/// Blocks where the particles and guests are and will be; particles on the rank that owns their block.
void Simulation::follow_particles(grid::Stencil stencil) {
  const double lookahead = lookahead_steps * state_.time_step;
  std::vector<Vector3> all_positions, all_velocities;
  const auto with_guests = [](std::span<const Vector3> particles, std::span<const Vector3> guests,
                              std::vector<Vector3>& all) {
    if (guests.empty()) return particles;
    all.assign(particles.begin(), particles.end());
    all.insert(all.end(), guests.begin(), guests.end());
    return std::span<const Vector3>(all);
  };
  const auto positions = [&] {
    return with_guests(particles_.position, transition_.position, all_positions);
  };
  const auto velocities = [&] {
    return with_guests(particles_.velocity, transition_.velocity, all_velocities);
  };
  const bool several_ranks = parallel::size(communicator_) > 1;
  elements_astray_ = several_ranks;
  if (several_ranks) work_of_particles(setup_, bodies_, work_);  // one rank has nothing to share out
  if (several_ranks && matter_may_rest()) {
    parallel::for_each(work_.size(),
                       [&](std::size_t p) { work_[p] *= is_restless(p) ? 1.0 : share_of_rest; });
    most_at_rest_ = 0;
  }
  if (!several_ranks || meshes_.empty()) {
    grid_.adapt(positions(), velocities(), lookahead, stencil, {work_, work_of_block});
  } else {  // elements are work, too
    const std::vector<Vector3> centres = centres_of(meshes_, setup_.geometry);
    const auto append = [&](std::span<const Vector3> points, std::span<const Vector3> more) {
      std::vector<Vector3> all(points.begin(), points.end());
      all.insert(all.end(), more.begin(), more.end());
      return all;
    };
    const std::vector<Vector3> at = append(positions(), centres),
                               moving = append(velocities(), std::vector<Vector3>(centres.size()));
    work_.resize(at.size() - centres.size(), 1.0);
    for (const fem::Mesh& mesh : meshes_) {
      work_.insert(work_.end(), mesh.elements.size(), work_of_element(mesh.quadrature));
    }
    grid_.adapt(at, moving, lookahead, stencil, {work_, work_of_block, centres.size()});
  }
  if (several_ranks && migrate(particles_, grid_.owners(particles_.position), communicator_)) find_bodies();
  grid_.activate(positions(), velocities(), lookahead, stencil, transition_.size());
  if (!bin(stencil)) {
    throw InternalError("adaptation left a particle without its blocks");
  }
}

}  // namespace whipple::solver
