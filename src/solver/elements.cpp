// SPDX-License-Identifier: BSD-3-Clause
// Bodies of finite elements in the time step (docs/theory/afemp.md).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

#include "src/afemp/conversion.hpp"
#include "src/afemp/transition.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t conversion_every = 4;  // steps: distortion grows by a few per cent in each

afemp::Thresholds thresholds(const cases::Conversion& control) {
  return {.plastic_strain = control.plastic_strain,
          .time_step_ratio = control.time_step_ratio,
          .jacobian = control.jacobian,
          .failed = control.failed};
}

fem::HourglassControl hourglass(const cases::Discretization& control) {
  return {control.hourglass, control.hourglass_coefficient};
}

fem::ViscosityCoefficients viscosity(const cases::ArtificialViscosity& control) {
  return {.linear = std::max(control.linear, control.expansion), .quadratic = control.quadratic};
}

}  // namespace

double Simulation::element_time_step() const {
  double dt = std::numeric_limits<double>::infinity();
  for (const fem::Mesh& mesh : meshes_) {
    dt = std::min(dt, fem::critical_time_step(mesh, viscosity(setup_.viscosity_of(mesh.body))));
  }
  for (const fem::Bars& bars : bars_) dt = std::min(dt, fem::critical_time_step(bars));
  return setup_.time.element_safety * -parallel::maximum(communicator_, -dt);
}

void Simulation::convert_elements() {
  profile_.time("convert elements", [&] {
    collect_nodes();  // of the step before: those that limit the step of the grid
    const double grid_step = grid_time_step();
    double converted = 0.0;
    for (fem::Mesh& mesh : meshes_) {
      const cases::Body& body = setup_.bodies[mesh.body];
      if (!body.discretization.converts()) continue;
      const std::vector<std::uint8_t> distorted = afemp::distorted_elements(
          mesh, thresholds(body.conversion), viscosity(setup_.viscosity_of(mesh.body)), grid_step);
      const auto count = static_cast<double>(std::ranges::count(distorted, 1));
      if (state_.step == 0) {
        std::array<double, 2> counts = {count, static_cast<double>(distorted.size())};
        parallel::sum(communicator_, counts);
        if (counts[0] > 0.0 && counts[0] == counts[1]) {
          log::warning(
              "body \"{}\": its thresholds turn all of its {} elements into particles in the first step",
              body.name, static_cast<std::size_t>(counts[0]));
        }
      }
      if (count == 0.0) continue;
      const afemp::ConversionBalance balance =
          afemp::convert_elements(mesh, distorted, particle_affine_inertia(), particles_);
      converted += count;
      step_.converted_mass += balance.mass;
      step_.conversion_heat += balance.kinetic_heat;
    }
    parallel::sum(communicator_, std::span(&converted, 1));
    if (converted == 0.0) return;
    if (losses_.kept) use_stores(particles_);
    particle_count_ += 8 * static_cast<std::size_t>(converted);
    element_count_ -= static_cast<std::size_t>(converted);
    elements_removed();
    particles_reallocated();
  });
}

/// Distorted elements become particles, and nodes at particles or at other bodies move with the grid.
void Simulation::adapt_elements() {
  if (meshes_.empty() && bars_.empty()) return;
  share_out_elements();
  if (meshes_.empty()) {
    collect_nodes();
    return;
  }
  if (state_.step % conversion_every == 0) convert_elements();
  profile_.time("transition", [&] {
    step_.transfer_heat += afemp::mark_transition(meshes_, particles_, setup_.geometry,
                                                  particle_affine_inertia(), communicator_);
    collect_nodes();
    if (state_.step == 0 && !contact_) warn_of_contact();
  });
}

/// Bodies within reach of each other at the start push each other from the first step on.
void Simulation::warn_of_contact() const {
  for (const fem::Mesh& mesh : meshes_) {
    double count =
        shared_nodes_.count(static_cast<std::size_t>(&mesh - meshes_.data()), mesh.nodes.in_transition);
    parallel::sum(communicator_, std::span(&count, 1));
    if (count == 0.0) continue;
    log::warning(
        "body \"{}\": {} nodes of its surface are within two cells of another body at the start: the bodies "
        "are in "
        "contact from the first step on",
        setup_.bodies[mesh.body].name, static_cast<std::size_t>(count));
  }
}

void Simulation::add_gravity(fem::Nodes& nodes) const {
  const Vector3 g = setup_.gravity.at(state_.time);
  if (g.isZero(0.0)) return;
  for (std::size_t a = 0; a < nodes.size(); ++a) nodes.force[a] += nodes.mass[a] * g;
}

void Simulation::compute_element_forces() {
  if (meshes_.empty() && bars_.empty()) return;
  profile_.time("element forces", [&] {
    for (fem::Mesh& mesh : meshes_) {
      fem::internal_forces(mesh);
      add_gravity(mesh.nodes);
    }
    compute_bar_forces();
    collect_nodes();
    join_shared_nodes();
  });
}

/// Momentum and work of gravity on nodes.
void Simulation::book_gravity(const fem::Nodes& nodes, const fem::Motion& motion) {
  const Vector3 g = setup_.gravity.at(state_.time);
  if (g.isZero(0.0)) return;
  const double dt = state_.time_step;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Vector3 impulse = dt * nodes.mass[a] * g;
    step_.external_impulse += impulse;
    step_.external_work += impulse.dot(motion.mean[a]);
  }
}

/// Strain, work, heat, new stresses and their forces of the elements of a mesh, block by block.
/// @param heated  is there heat at any of its nodes?
/// @returns an error that ends the run, or nothing
std::string Simulation::deform_elements(std::size_t m, bool heated) {
  using Clock = std::chrono::steady_clock;
  fem::Mesh& mesh = meshes_[m];
  const cases::Body& body = setup_.bodies[mesh.body];
  const Material& material = *setup_.materials[mesh.body];
  UpdateSettings settings = update_settings(mesh.body);
  settings.lengths = mesh.points.length;
  const std::size_t rows = fem::points_per_element(mesh.quadrature), block = fem::Blocks::size * rows;
  fem::VelocityGradients& gradient = element_gradient_[m];
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
      fem::deform(mesh, motions_[m], state_.time_step, hourglass(body.discretization), gradient, update);
  step_.work += report.work;
  Clock::duration in_material{};  // of all threads
  MaterialReport sum;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    sum.merge(reports[i]);
    in_material += durations[i];
  }
  profile_.reassign("elements", "material",
                    std::chrono::duration<double>(in_material).count() / parallel::threads());
  element_compression_rate_ = std::max(element_compression_rate_, sum.compression_rate);
  const std::string of_material = book(sum, material, [&](std::size_t p, const std::string& reason) {
    return describe_element(mesh, p, reason);
  });
  if (report.inverted == 0) return of_material;
  return describe_element(
      mesh, report.first_inverted * rows,
      body.discretization.converts()
          ? "is inverted: raise conversion.jacobian or conversion.time_step_ratio, or lower "
            "conversion.plastic_strain, so that it becomes particles earlier"
          : "is inverted: discretization.method = \"adaptive\" turns such elements into particles");
}

/// Nodes by themselves or as the grid moved them, and what that does to their elements.
void Simulation::advance_elements() {
  if (meshes_.empty() && bars_.empty()) return;
  profile_.time("elements", [&] {
    const double dt = state_.time_step;
    motions_.resize(meshes_.size());
    node_heat_.resize(meshes_.size());
    element_gradient_.resize(meshes_.size());
    afemp::distribute(transition_, meshes_, motions_, node_heat_);
    std::string error;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      fem::Mesh& mesh = meshes_[m];
      const fem::ConstraintBalance balance = advance_free_nodes(m);
      step_.wall_impulse += balance.impulse;
      step_.external_work += balance.work;
      step_.wall_impulse += afemp::stop_at_faces(mesh.nodes, setup_.geometry, dt, motions_[m], node_heat_[m]);
      Lanes heat{};
      bool heated = false;
      for (std::size_t a = 0; a < mesh.nodes.size(); a += 4) {
        const Lanes four = load(&node_heat_[m][a], std::min<std::size_t>(4, mesh.nodes.size() - a), 0.0);
        heat += four;
        heated = heated || any(four != 0.0);
      }
      step_.transfer_heat += sum4(heat);
      book_gravity(mesh.nodes, motions_[m]);
      const std::string of_mesh = deform_elements(m, heated);
      if (error.empty()) error = of_mesh;
      fem::move_nodes(mesh, motions_[m], dt);
    }
    const auto of_bars = static_cast<std::ptrdiff_t>(bar_node_count());
    for (auto heat = transition_.contact_heat.begin(); heat != transition_.contact_heat.end() - of_bars;
         ++heat) {
      step_.transfer_heat -= *heat;  // booked by contact
    }
    advance_bars();
    parallel::throw_together(communicator_, error);
  });
}

void Simulation::book_outflow(std::size_t body, const Totals& before, Totals after) {
  for_each_number(after, [](const std::string&, double& x) { x = -x; });
  after += before;
  book_outflow(body, after);
}

/// Elements that lie outside of the domain as a whole are gone, and their shares of the nodes.
void Simulation::remove_elements_outside() {
  bool gone_any = false;
  for (fem::Mesh& mesh : meshes_) {
    // (Nodes on walls may stand beyond them by round-off: those faces do not count.)
    const auto is_outside = [&](std::size_t a) { return setup_.geometry.has_left(mesh.nodes.position[a]); };
    const std::size_t nodes = mesh.nodes.size();
    const double any = parallel::maximum((nodes + 3) / 4, 0.0, [&](std::size_t four) {
      const std::size_t first = 4 * four, end = std::min(nodes, first + 4);
      const double* const x = mesh.nodes.position[first].data();
      if (end == first + 4 && setup_.geometry.contains_four({load(x), load(x + 4), load(x + 8)})) return 0.0;
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
    const Totals before = totals_of(mesh, particle_affine_inertia());
    for (std::size_t e = 0; e < removed.size(); ++e) {
      for (const std::uint32_t a : mesh.elements.corners[e]) {
        if (removed[e] != 0) mesh.nodes.on_surface[a] = 1;
      }
    }
    fem::remove_elements(mesh, removed);
    gone_any = true;
    book_outflow(mesh.body, before, totals_of(mesh, particle_affine_inertia()));
  }
  if (!meshes_.empty() && parallel::any(communicator_, gone_any)) elements_removed();
}

std::string Simulation::describe_element(const fem::Mesh& mesh, std::size_t point,
                                         const std::string& reason) const {
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
      state_.step + 1, state_.time + state_.time_step, setup_.bodies[mesh.body].name, mesh.elements.id[e],
      reason, x[0], x[1], x[2], v[0], v[1], v[2], points.mass[point] / points.volume[point],
      points.specific_internal_energy[point], points.pressure[point], points.temperature[point],
      points.plastic_strain[point], points.failed[point]);
}

}  // namespace whipple::solver
