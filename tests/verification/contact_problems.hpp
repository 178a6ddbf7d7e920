// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/verification/solver_problems.hpp"

/// Problems of bodies in contact.
namespace whipple::verification {

struct ContactOptions {
  std::string normal = "separating";
  double friction = 0.0;
  std::string more = {};
  std::string method = "auto";
  [[nodiscard]] std::string toml() const {
    return "[contact]\nmethod = \"" + method + "\"\nnormal = \"" + normal +
           "\"\nfriction = " + std::to_string(friction) + "\n" + more;
  }
};

inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}
inline std::string vector3(const Vector3& v) {
  return "[" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "]";
}

struct BodyOptions {
  std::string name, material, shape;
  Vector3 velocity = Vector3::Zero();
  std::string more = {};  ///< further lines, such as those of its discretization
  /// @param apart  the body is bonded to no other body, even if they touch at the start with equal velocities
  [[nodiscard]] std::string toml(bool apart = false) const {
    return "[[body]]\nname = \"" + name + "\"\nmaterial = \"" + material +
           "\"\nvelocity = " + vector3(velocity) + "\nshape = { " + shape + " }\n" +
           (apart ? "contact_group = \"" + name + "\"\n" : "") + more;
  }
};

inline std::string box(const Vector3& lower, const Vector3& upper) {
  return "box = { lower = " + vector3(lower) + ", upper = " + vector3(upper) + " }";
}
inline std::string sphere(const Vector3& centre, double radius) {
  return "sphere = { center = " + vector3(centre) + ", radius = " + number(radius) + " }";
}

struct Problem {
  Method method;
  double end = 0.0;
  std::string domain;
  std::string contact;  ///< table; empty: the default, with which bodies may be bonded
  std::vector<BodyOptions> bodies;
  std::string more = {};
  [[nodiscard]] cases::Case read() const {
    std::string text = method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n" +
                       domain + contact + more;
    for (const BodyOptions& body : bodies) text += body.toml(!contact.empty());
    return cases::read_case_text(text, "contact.toml");
  }
};

/// Sides of a column of cells along x.
inline constexpr const char* column_sides =
    "boundary = { y_lower = \"symmetry\", y_upper = \"symmetry\", z_lower = \"symmetry\", "
    "z_upper = \"symmetry\" }\n";

/// Two elastic bars that meet head-on, initially a gap of 0.3 cells apart, in a column of one cell; exact: each leaves
/// with its velocity reversed.
struct MeetingBars {
  static constexpr double length = 0.02, speed = 20.0;  // m, m/s
  double dx, gap;
  explicit MeetingBars(int cells) : dx(length / cells), gap(0.3 * dx) {}
  [[nodiscard]] double touch() const { return 0.5 * gap / speed; }
  /// @param left, right  further lines of the bodies
  [[nodiscard]] Problem problem(const std::string& left = {}, const std::string& right = {},
                                const std::string& method = "auto") const {
    Problem problem;
    problem.method.linear_viscosity = problem.method.quadratic_viscosity = 0.0;
    problem.end = 1.6 * 2.0 * length / 5328.0 + touch();
    problem.domain = "[domain]\nlower = [-0.03, 0, 0]\nupper = " + vector3({0.03, dx, dx}) +
                     "\ncell_size = " + number(dx) + "\n" + column_sides;
    problem.contact = ContactOptions{.method = method}.toml();
    problem.bodies = {{"left",
                       elastic_aluminium(),
                       box({-length - gap / 2, 0, 0}, {-gap / 2, dx, dx}),
                       {speed, 0, 0},
                       left},
                      {"right",
                       elastic_aluminium(),
                       box({gap / 2, 0, 0}, {length + gap / 2, dx, dx}),
                       {-speed, 0, 0},
                       right}};
    return problem;
  }
};

struct BodySums {
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero(), centre = Vector3::Zero(), spin = Vector3::Zero();
};
/// Returns mass, momentum, centre of mass and angular momentum about it of one body.
inline BodySums sums_of(const Particles& q, std::uint32_t body, double inertia) {
  BodySums sums;
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (q.body[p] != body) continue;
    sums.mass += q.mass[p];
    sums.momentum += q.mass[p] * q.velocity[p];
    sums.centre += q.mass[p] * q.position[p];
  }
  sums.centre /= sums.mass;
  const Vector3 mean = sums.momentum / sums.mass;
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (q.body[p] != body) continue;
    sums.spin += q.mass[p] * (q.position[p] - sums.centre).cross(q.velocity[p] - mean);
    if (q.affine_velocity.empty()) continue;
    const Matrix3& c = q.affine_velocity[p];
    const Vector3 curl(c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1));
    sums.spin += q.mass[p] * inertia * curl;
  }
  return sums;
}

/// Returns the sums of a body of elements, without angular momentum.
inline BodySums sums_of(const fem::Mesh& mesh) {
  BodySums sums;
  const fem::Nodes& q = mesh.nodes;
  for (std::size_t a = 0; a < q.size(); ++a) {
    sums.mass += q.mass[a];
    sums.momentum += q.mass[a] * q.velocity[a];
    sums.centre += q.mass[a] * q.position[a];
  }
  sums.centre /= sums.mass;
  return sums;
}

/// Returns the sums of a body of either kind.
inline BodySums sums_of(const solver::Simulation& simulation, std::uint32_t body) {
  for (const fem::Mesh& mesh : simulation.meshes()) {
    if (mesh.body == body) return sums_of(mesh);
  }
  return sums_of(simulation.particles(), body, 0.0);
}

}  // namespace whipple::verification
