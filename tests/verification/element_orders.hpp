// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "src/afemp/conversion.hpp"
#include "src/afemp/transition.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/transfer/shape_function.hpp"
#include "tests/verification/solver_orders.hpp"

/// Orders of convergence of finite elements, and of elements of which a half become particles.
namespace whipple::verification {

struct ElementMethod {
  std::string element = "one_point";
  bool converted = false;  ///< at half of the time the elements of the left half become particles
  Method transfers = {};   ///< of these particles
};

/// Relative error (rms over the mass) of velocity and displacement of a motion along x, n elements.
inline double element_motion_error(const ExactMotion& motion, const ElementMethod& method, int n) {
  const cases::Case setup = motion_case(
      motion, method.transfers, n,
      "discretization = { method = \"finite_elements\", element = \"" + method.element + "\" }\n");
  const long steps = motion_steps(motion, n);
  const double dt = motion.end() / static_cast<double>(steps);
  std::vector<fem::Mesh> meshes = cases::seed(setup).meshes;
  fem::Mesh& mesh = meshes.front();
  afemp::mark_surface(mesh, setup.geometry);
  std::map<std::uint64_t, Vector3> start, middle;  // material places of nodes and of the centres of elements
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3 X = start[mesh.nodes.id[a]] = mesh.nodes.position[a];
    mesh.nodes.position[a] = motion.position(X, 0);
    mesh.nodes.velocity[a] = motion.velocity(X, -0.5 * dt);  // leapfrog
  }
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Vector3& centre = middle[mesh.elements.id[e]] = Vector3::Zero();
    double before = 1.0, after = -1.0;
    for (const std::uint32_t a : mesh.elements.corners[e]) {
      centre += 0.125 * start[mesh.nodes.id[a]];
      before = std::min(before, mesh.nodes.position[a][0]);
      after = std::max(after, mesh.nodes.position[a][0]);
    }
    const double f = (after - before) * n, shear = 2 * Barotropic::shear * std::log(f);
    for (std::size_t i = e * rows; i < (e + 1) * rows; ++i) {
      mesh.points.volume[i] *= f;
      mesh.points.length[i] *= f;
      mesh.points.pressure[i] = Barotropic::pressure(f);
      if (motion.solid()) {
        mesh.points.deviatoric_stress[i] = {shear * 2 / 3, -shear / 3, -shear / 3, 0, 0, 0};
      }
    }
  }
  solver::RunState state;
  const auto advance = [&](solver::Simulation& simulation, long from, long to) {
    for (long i = from; i < to; ++i) simulation.advance(static_cast<double>(i + 1) * dt);
  };
  const long half = method.converted ? steps / 2 : steps;
  solver::Simulation first(setup, {}, state, parallel::world(), std::move(meshes));
  advance(first, 0, half);
  std::vector<fem::Mesh> meshes_then = first.meshes();
  Particles particles = first.particles();
  if (method.converted) {
    fem::Mesh& then = meshes_then.front();
    std::vector<std::uint8_t> chosen(then.elements.size());
    for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = middle[then.elements.id[e]][0] < 0.5 ? 1 : 0;
    const double inertia =
        transfer::affine_inertia(transfer::ShapeFunction::quadratic_bspline, setup.domain.cell_size);
    afemp::convert_elements(then, chosen, inertia, particles);
    use_stores(particles);
  }
  solver::Simulation second(setup, std::move(particles), first.state(), parallel::world(),
                            std::move(meshes_then));
  advance(second, half, steps);

  double sum = 0, mass = 0;
  const auto add = [&](double m, const Vector3& X, const Vector3& x, const Vector3& velocity) {
    const Vector3 v = velocity - motion.velocity(X, motion.end() - 0.5 * dt);
    const Vector3 u = motion.frequency() * (x - motion.position(X, motion.end()));
    sum += m * (v.squaredNorm() + u.squaredNorm());
    mass += m;
  };
  const fem::Nodes& nodes = second.meshes().front().nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    add(nodes.mass[a], start[nodes.id[a]], nodes.position[a], nodes.velocity[a]);
  }
  const Particles& q = second.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const std::array<double, 3>& corner = fem::corner_coordinates[q.id[p] % 8];
    const Vector3 offset = 0.25 / n * Vector3(corner[0], corner[1], corner[2]);
    add(q.mass[p], middle[q.id[p] / 8] + offset, q.position[p], q.velocity[p]);
  }
  return std::sqrt(sum / mass) / motion.velocity_scale();
}

}  // namespace whipple::verification
