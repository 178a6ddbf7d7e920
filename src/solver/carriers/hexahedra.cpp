// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/carriers/hexahedra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "src/afemp/transition.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/update.hpp"
#include "src/solver/carriers/element_control.hpp"
#include "src/solver/carriers/element_totals.hpp"
#include "src/solver/carriers/nodal_loads.hpp"
#include "src/solver/stages/material.hpp"

namespace whipple::solver {

Hexahedra::Hexahedra(State& state, const Loads& loads, std::vector<fem::Mesh> meshes)
    : Carrier(state),
      loads_(loads),
      meshes_(std::move(meshes)),
      parts_(meshes_.size()),
      part_counts_(meshes_.size(), 1) {
  for (fem::Mesh& mesh : meshes_) mesh.has_path = state_.setup.bodies[mesh.body].path.has_value();
}

/// Returns the factor of the prescribed velocities of a mesh in the current step.
double Hexahedra::path_factor(const fem::Mesh& mesh) const {
  const std::optional<cases::Path>& path = state_.setup.bodies[mesh.body].path;
  return path ? path->factor(state_.run.time, state_.run.time_step) : 1.0;
}

const std::vector<std::vector<fem::Facet>>& Hexahedra::free_facets() {
  if (surfaces_changed_) {
    free_facets_.clear();
    for (const fem::Mesh& mesh : meshes_)
      free_facets_.push_back(afemp::free_facets(mesh, state_.setup.geometry));
    shared_nodes_.drop_inner_facets(meshes_, free_facets_);
    surfaces_changed_ = false;
  }
  return free_facets_;
}

void Hexahedra::compute_forces() {
  of_mesh_.resize(meshes_.size());
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    fem::internal_forces(meshes_[m]);
    of_mesh_[m].hoop_force = 0.0;
    if (meshes_[m].quadrature ==
        fem::Quadrature::ring) {  // what does not add up to zero (docs/theory/fem.md, 11)
      for (const Vector3& force : meshes_[m].nodes.force) of_mesh_[m].hoop_force += force[1];
    }
    add_loads(loads_, state_.run.time, meshes_[m].body, meshes_[m].nodes, of_mesh_[m].acceleration);
  }
}

/// Collects the marked nodes; those of other carriers follow them.
void Hexahedra::collect() {
  transfer::TransitionNodes& to = state_.transition;
  afemp::collect(meshes_, to);
  if (state_.setup.transfer.particle_update != cases::ParticleUpdate::relaxed_affine) to.unrelaxed = 0;
  for (const fem::Mesh& mesh : meshes_) {
    const auto count = static_cast<std::size_t>(std::ranges::count(mesh.nodes.in_transition, 1));
    state_.transition_body.insert(state_.transition_body.end(), count, mesh.body);
  }
  state_.transition_part.resize(state_.transition_body.size(), 0);
  std::size_t i = 0;
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const std::vector<std::uint8_t>& marked = meshes_[m].nodes.in_transition;
    const bool parted = parts_[m].size() == marked.size();
    for (std::size_t a = 0; a < marked.size(); ++a) {
      if (marked[a] == 0) continue;
      if (parted) state_.transition_part[i] = parts_[m][a];
      ++i;
    }
  }
  count_ = to.size();
}

double Hexahedra::critical_time_step() const {
  double dt = std::numeric_limits<double>::infinity();
  for (const fem::Mesh& mesh : meshes_) {
    dt = std::min(dt, fem::critical_time_step(mesh, viscosity(state_.setup.viscosity_of(mesh.body))));
  }
  return dt;
}

/// Moves the nodes, freely or with the motion of the grid, and updates their elements.
std::string Hexahedra::advance() {
  motions_.resize(meshes_.size());
  node_heat_.resize(meshes_.size());
  tools_.resize(meshes_.size());
  std::vector<double> path;
  for (const fem::Mesh& mesh : meshes_) path.push_back(path_factor(mesh));
  afemp::distribute(
      state_.transition, meshes_, motions_, node_heat_,
      {.dt = state_.run.time_step, .affine_inertia = state_.particle_affine_inertia(), .path = path}, tools_);
  std::string error;
  SqueezedPoints squeezed(state_.setup.materials.size());
  for (std::size_t m = 0; m < meshes_.size(); ++m) {
    const std::string of_mesh = advance_mesh(m, squeezed);
    if (error.empty()) error = of_mesh;
  }
  const std::string too_dense = squeezed.fault(state_.communicator, state_.setup.materials);
  if (error.empty()) error = too_dense;
  const std::vector<double>& of_contact = state_.transition.contact_heat;
  for (std::size_t i = 0; i < count_; ++i)
    state_.booked.transfer_heat -= of_contact[i];  // already counted by contact
  return error;
}

std::string Hexahedra::advance_mesh(std::size_t m, SqueezedPoints& squeezed) {
  fem::Mesh& mesh = meshes_[m];
  Ledger& booked = state_.booked;
  const double dt = state_.run.time_step;
  booked.wall_impulse[1] += dt * of_mesh_[m].hoop_force;
  damp_nodes(m);
  const bool gauged = state_.force_gauges.any();
  const std::vector<Vector3> unconstrained = gauged ? unconstrained_velocities(m) : std::vector<Vector3>();
  fem::ConstraintBalance balance = advance_free_nodes(m);
  balance += tools_[m];
  booked.wall_impulse += balance.impulse;
  booked.external_work += balance.work;
  booked.wall_impulse +=
      afemp::stop_at_faces(mesh.nodes, state_.setup.geometry, dt, motions_[m], node_heat_[m]);
  if (gauged) book_faces(m, unconstrained);
  Lanes heat{};
  bool heated = false;
  for (std::size_t a = 0; a < mesh.nodes.size(); a += 4) {
    const Lanes four = load(&node_heat_[m][a], std::min<std::size_t>(4, mesh.nodes.size() - a), 0.0);
    heat += four;
    heated = heated || any(four != 0.0);
  }
  booked.transfer_heat += sum4(heat);
  book_loads(of_mesh_[m].acceleration, mesh.nodes, motions_[m], dt, booked);
  book_damping(m);
  std::string error = deform(m, heated, squeezed);
  fem::move_nodes(mesh, motions_[m], dt);
  return error;
}

/// Updates strain, work, heat and stress of the elements of a mesh, and computes their forces, block by block.
/// @param heated  whether any of its nodes has heat to distribute
/// @returns an error that ends the run, or nothing
std::string Hexahedra::deform(std::size_t m, bool heated, SqueezedPoints& squeezed) {
  using Clock = std::chrono::steady_clock;
  fem::Mesh& mesh = meshes_[m];
  const cases::Body& body = state_.setup.bodies[mesh.body];
  const Material& material = *state_.setup.materials[mesh.body];
  UpdateSettings settings = update_settings(state_, mesh.body);
  settings.lengths = mesh.points.length;
  const std::size_t rows = fem::points_per_element(mesh.quadrature), block = fem::Blocks::size * rows;
  fem::VelocityGradients& gradient = of_mesh_[m].gradient;
  gradient.resize(mesh.points.size());
  std::vector<MaterialReport> reports((mesh.points.size() + block - 1) / block);
  std::vector<Clock::duration> durations(reports.size());
  const auto update = [&](std::size_t begin, std::size_t end) {
    const Clock::time_point start = Clock::now();
    if (heated) fem::add_heat(mesh, node_heat_[m], begin / block);
    reports[begin / block] =
        whipple::update_material(material, mesh.points, begin, end, gradient.from(begin), settings);
    durations[begin / block] = Clock::now() - start;
  };
  const fem::DeformationReport report =
      fem::deform(mesh, motions_[m], state_.run.time_step, hourglass(body.discretization), gradient, update);
  state_.booked.work += report.work;
  state_.booked.hourglass_work += report.hourglass_work;
  state_.booked.hourglass_overdrawn += report.hourglass_overdrawn;
  state_.booked.limited_hourglass += report.limited_hourglass;
  Clock::duration in_material{};  // sum over all threads
  MaterialReport sum;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    sum.merge(reports[i]);
    in_material += durations[i];
  }
  state_.profile.reassign("elements", "material",
                          std::chrono::duration<double>(in_material).count() / parallel::threads());
  double& rate = state_.rates.element_compression;
  rate = std::max(rate, sum.compression_rate);
  const auto of_point = [this, &mesh](std::size_t p, const std::string& reason) {
    return describe(mesh, p, reason);
  };
  const std::string of_material = book(state_, sum, material, of_point);
  squeezed.add(mesh.body, sum, of_point);
  if (report.inverted == 0) return of_material;
  return describe(mesh, report.first_inverted * rows,
                  body.discretization.converts()
                      ? "is inverted: raise conversion.jacobian or conversion.time_step_ratio, or lower "
                        "conversion.plastic_strain, so that it becomes particles earlier"
                      : "is inverted: raise element_range.jacobian or element_range.time_step_ratio, so that "
                        "it leaves its "
                        "valid range earlier");
}

/// Removes the elements that are outside of the domain as a whole, with their contributions to the nodes.
void Hexahedra::remove_outside() {
  bool gone_any = false;
  for (fem::Mesh& mesh : meshes_) {
    // Only outflow faces count: nodes on walls may be beyond these by round-off.
    const auto is_outside = [&](std::size_t a) {
      return state_.setup.geometry.has_left(mesh.nodes.position[a]);
    };
    const std::size_t nodes = mesh.nodes.size();
    const double any = parallel::maximum((nodes + 3) / 4, 0.0, [&](std::size_t four) {
      const std::size_t first = 4 * four, end = std::min(nodes, first + 4);
      const double* const x = mesh.nodes.position[first].data();
      if (end == first + 4 && state_.setup.geometry.contains_four({load(x), load(x + 4), load(x + 8)}))
        return 0.0;
      for (std::size_t a = first; a < end; ++a) {
        if (is_outside(a)) return 1.0;
      }
      return 0.0;
    });
    if (any == 0.0) continue;
    std::vector<std::uint8_t> removed(mesh.elements.size(), 0);
    for (std::size_t e = 0; e < removed.size(); ++e) {
      removed[e] = std::ranges::all_of(mesh.elements.corners[e], is_outside);
    }
    if (std::ranges::count(removed, 1) == 0) continue;
    remove(mesh, removed);
    gone_any = true;
  }
  if (parallel::any(state_.communicator, gone_any)) elements_removed();
}

/// Deletes elements of a mesh and counts their contents as outflow.
/// @returns their mass, kg
double Hexahedra::remove(fem::Mesh& mesh, std::span<const std::uint8_t> removed) {
  const Totals before = totals_of(mesh, state_.particle_affine_inertia());
  for (std::size_t e = 0; e < removed.size(); ++e) {
    for (const std::uint32_t a : mesh.elements.corners[e]) {
      if (removed[e] != 0) mesh.nodes.on_surface[a] = 1;
    }
  }
  fem::remove_elements(mesh, removed);
  const Totals after = totals_of(mesh, state_.particle_affine_inertia());
  state_.book_outflow(mesh.body, before, after);
  return before.mass - after.mass;
}

std::string Hexahedra::describe(const fem::Mesh& mesh, std::size_t point, const std::string& reason) const {
  const std::size_t e = point / fem::points_per_element(mesh.quadrature);
  Vector3 x = Vector3::Zero(), v = Vector3::Zero();
  for (const std::uint32_t a : mesh.elements.corners[e]) {
    x += 0.125 * mesh.nodes.position[a];
    v += 0.125 * mesh.nodes.velocity[a];
  }
  const fem::GaussPoints& points = mesh.points;
  return fmt::format(
      "step {}, t = {} s, body \"{}\", element {}: {}\n  centre ({}, {}, {}) m, velocity ({}, {}, {}) m/s\n  "
      "density {} kg/m^3, specific internal energy {} J/kg, pressure {} Pa, temperature {} K, plastic strain "
      "{}, failed {}",
      state_.run.step + 1, state_.run.time + state_.run.time_step, state_.setup.bodies[mesh.body].name,
      mesh.elements.id[e], reason, x[0], x[1], x[2], v[0], v[1], v[2],
      points.mass[point] / points.volume[point], points.specific_internal_energy[point],
      points.pressure[point], points.temperature[point], points.plastic_strain[point], points.failed[point]);
}

}  // namespace whipple::solver
