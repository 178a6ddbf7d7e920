// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <random>
#include <vector>

#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"
#include "src/fem/structured.hpp"
#include "src/material/strength/elastic.hpp"
#include "tests/unit/material_support.hpp"

/// What the tests of the finite elements share: an elastic solid and an explicit loop over the library's
/// calls.
namespace whipple::fem_test {

using fem::Quadrature;

inline constexpr std::array both = {Quadrature::one_point, Quadrature::b_bar};
inline const char* name(Quadrature q) { return q == Quadrature::one_point ? "one point" : "B-bar"; }

/// Linear elastic for small strains: p = K (rho/rho0 - 1) in tension, a stiffening Hugoniot in compression of
/// which s = 0 leaves K mu; no thermal pressure.
struct Solid {
  double density = 2700.0, bulk_modulus = 75e9, shear_modulus = 27e9;

  [[nodiscard]] double young() const {
    return 9.0 * bulk_modulus * shear_modulus / (3.0 * bulk_modulus + shear_modulus);
  }
  [[nodiscard]] double longitudinal_speed() const {
    return std::sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) / density);
  }
  [[nodiscard]] Material material() const {
    material_test::LinearInEnergy eos;
    eos.rho0 = density;
    eos.c0 = std::sqrt(bulk_modulus / density);
    eos.s = 0.0;
    eos.gamma = 0.0;
    strength::Elastic elastic;
    elastic.shear_modulus = shear_modulus;
    return make_material("solid", std::make_shared<material_test::LinearInEnergy>(eos),
                         std::make_shared<strength::ElasticModel>(elastic));
  }
};

/// One body and its explicit loop.
struct Body {
  Material material;
  fem::Mesh mesh;
  fem::HourglassControl hourglass = {};
  fem::ViscosityCoefficients viscosity = {0.0, 0.0};
  double time = 0.0;
  fem::ConstraintBalance boundary = {};
  fem::DeformationReport deformation = {};

  Body(Material m, const fem::Hexahedra& hexahedra, Quadrature quadrature) : material(std::move(m)) {
    fem::check(hexahedra, "test");
    mesh = fem::make_mesh(hexahedra, quadrature);
    fem::set_density(mesh, material.reference.density);
    initialise(material, mesh.points, 0, mesh.points.size());
    gradients.resize(mesh.points.size());
  }

  template <class Field>
  void set_velocity(Field&& field) {
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      mesh.nodes.velocity[a] = field(mesh.nodes.position[a]);
  }
  [[nodiscard]] double critical_time_step() const { return fem::critical_time_step(mesh, viscosity); }

  void step(double dt) {
    fem::internal_forces(mesh);
    boundary += fem::advance_velocities(mesh, dt, motion);
    time += dt;
    UpdateSettings settings;
    settings.time_step = dt;
    settings.lengths = mesh.points.length;
    settings.linear_viscosity = viscosity.linear;
    settings.quadratic_viscosity = viscosity.quadratic;
    settings.time = time;
    std::mutex one_at_a_time;
    deformation +=
        fem::deform(mesh, motion, dt, hourglass, gradients, [&](std::size_t begin, std::size_t end) {
          const MaterialReport met =
              update_material(material, mesh.points, begin, end, gradients.from(begin), settings);
          const std::scoped_lock lock(one_at_a_time);
          report.merge(met);
        });
    fem::move_nodes(mesh, motion, dt);
  }

  MaterialReport report;
  fem::Motion motion;
  fem::VelocityGradients gradients;
};

/// A box with every node moved by a random part of the element size.
inline fem::Hexahedra distorted_box(std::array<std::size_t, 3> n, double size, double share,
                                    unsigned seed = 7) {
  const Vector3 edges(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2]));
  fem::Hexahedra box = fem::make_box(Vector3::Zero(), size * edges, n);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-share * size, share * size);
  for (Vector3& x : box.nodes) x += Vector3(uniform(generator), uniform(generator), uniform(generator));
  return box;
}

inline fem::Hexahedra distorted_box(std::size_t n, double size, double share, unsigned seed = 7) {
  return distorted_box(std::array{n, n, n}, size, share, seed);
}

/// A body in a state of random velocities, with stresses after a few steps. With three elements along an edge
/// the kernels take what elements there are, with more along one of the directions rows of them
/// (ElementGroup).
inline Body shaken(Quadrature quadrature, fem::HourglassControl hourglass, double viscosity = 0.0,
                   std::array<std::size_t, 3> cells = {3, 3, 3}) {
  Body body(Solid{}.material(), distorted_box(cells, 1e-3, 0.2), quadrature);
  body.hourglass = hourglass;
  body.viscosity = {viscosity, 4.0 * viscosity};
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-30.0, 30.0);
  body.set_velocity([&](const Vector3&) {
    return Vector3(100.0 + uniform(generator), uniform(generator), uniform(generator));
  });
  return body;
}

inline constexpr fem::HourglassControl stiffness = {fem::HourglassControl::Kind::stiffness, 0.05};
inline constexpr fem::HourglassControl viscous = {fem::HourglassControl::Kind::viscous, 0.1};
inline constexpr fem::HourglassControl no_control = {fem::HourglassControl::Kind::stiffness, 0.0};

/// Generalised forces (N) of the four hourglass modes of an element, one column per mode.
using HourglassForce = Eigen::Matrix<double, 3, 4>;

inline HourglassForce hourglass_force(const fem::Elements& elements, std::size_t element) {
  HourglassForce force;
  double* to = force.data();
  for (const auto component : fem::Elements::hourglass_components()) *to++ = (elements.*component)[element];
  return force;
}
inline void set_hourglass_force(fem::Elements& elements, std::size_t element, const HourglassForce& force) {
  const double* from = force.data();
  for (const auto component : fem::Elements::hourglass_components()) (elements.*component)[element] = *from++;
}

/// Elements without rows, and rows along each direction.
inline constexpr std::array<std::array<std::size_t, 3>, 4> box_cells = {
    {{3, 3, 3}, {21, 3, 3}, {3, 21, 3}, {3, 3, 21}}};

}  // namespace whipple::fem_test
