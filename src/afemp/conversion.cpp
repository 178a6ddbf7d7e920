// SPDX-License-Identifier: BSD-3-Clause
#include "src/afemp/conversion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/parallel/threads.hpp"
#include "src/fem/hexahedron.hpp"

namespace whipple::afemp {
namespace {

constexpr std::size_t corner_count = 8;
constexpr double place = 0.5;  ///< natural coordinates of the particles of a regular arrangement

/// Holds the trilinear functions of the corners and their derivatives at a point in natural coordinates.
struct ShapeFunctions {
  std::array<double, corner_count> value;
  std::array<Vector3, corner_count> derivative;
};

ShapeFunctions shape_functions(const Vector3& xi) {
  ShapeFunctions n;
  for (std::size_t a = 0; a < corner_count; ++a) {
    const std::array<double, 3>& c = fem::corner_coordinates[a];
    const double fx = 0.5 * (1.0 + c[0] * xi[0]), fy = 0.5 * (1.0 + c[1] * xi[1]),
                 fz = 0.5 * (1.0 + c[2] * xi[2]);
    n.value[a] = fx * fy * fz;
    n.derivative[a] = 0.5 * Vector3(c[0] * fy * fz, c[1] * fx * fz, c[2] * fx * fy);
  }
  return n;
}

/// Holds the functions at the particles, in the order of the corners: eight, or four in the middle plane.
using AtParticles = std::vector<ShapeFunctions>;

AtParticles make_at_particles(Arrangement arrangement, bool flat) {
  AtParticles functions;
  for (std::size_t k = 0; k < (flat ? corner_count / 2 : corner_count); ++k) {
    const std::array<double, 3>& c = fem::corner_coordinates[k];
    Vector3 xi = place * Vector3(c[0], c[1], flat ? 0.0 : c[2]);
    if (arrangement == Arrangement::layered) {  // a part of an element has edge 1 in natural coordinates
      const std::size_t quadrant = (c[0] > 0 ? 1U : 0U) + (c[1] > 0 ? 2U : 0U);
      xi += flat ? planar_layer_offset(quadrant) : layer_offset(quadrant + (c[2] > 0 ? 4U : 0U));
    }
    functions.push_back(shape_functions(xi));
  }
  return functions;
}

const AtParticles& at_particles(Arrangement arrangement, bool flat) {
  static const std::array<std::array<AtParticles, 2>, 2> all = {
      {{make_at_particles(Arrangement::regular, false), make_at_particles(Arrangement::regular, true)},
       {make_at_particles(Arrangement::layered, false), make_at_particles(Arrangement::layered, true)}}};
  return all[arrangement == Arrangement::layered ? 1 : 0][flat ? 1 : 0];
}

/// Holds the contribution of a corner: its part of the nodal mass with the motion of the node.
struct Corner {
  double mass;
  Vector3 position, velocity;
  Matrix3 affine_velocity;
};

struct Fragment {
  double mass, share;  // kg; fraction of the volumes of its row
  Vector3 position, velocity;
  SymmetricTensor extent;
};

struct Conversion {
  std::vector<Fragment> fragment;
  Matrix3 affine_velocity = Matrix3::Zero();  // of all fragments
  double heat = 0.0;                          // J
};

std::array<Corner, corner_count> corners_of(const fem::Mesh& mesh, std::size_t element) {
  std::array<Corner, corner_count> corners;
  for (std::size_t a = 0; a < corner_count; ++a) {
    const std::uint32_t n = mesh.elements.corners[element][a];
    corners[a] = {fem::corner_mass(mesh, element, a), mesh.nodes.position[n], mesh.nodes.velocity[n],
                  mesh.nodes.affine_velocity[n]};
  }
  return corners;
}

/// Sets masses, positions and domains (3.1).
void place_fragments(const fem::Mesh& mesh, std::size_t element,
                     const std::array<Corner, corner_count>& corners, const AtParticles& at,
                     std::vector<Fragment>& fragments) {
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  const bool flat = fem::is_flat(mesh.quadrature);
  fragments.resize(at.size());
  std::array<double, corner_count> jacobian{};
  double sum = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < at.size(); ++k) {
    const ShapeFunctions& n = at[k];
    Fragment& f = fragments[k];
    f.position.setZero();
    Matrix3 j = Matrix3::Zero();  // columns dx/dxi
    for (std::size_t a = 0; a < corner_count; ++a) {
      f.position += n.value[a] * corners[a].position;
      j += corners[a].position * n.derivative[a].transpose();
    }
    f.extent = SymmetricTensor::from(0.25 * j * j.transpose());
    if (flat) j(2, 2) = mesh.quadrature == fem::Quadrature::ring ? f.position[1] : 1.0;
    jacobian[k] = j.determinant();
    sum += jacobian[k];
    least = std::min(least, jacobian[k]);
  }
  for (std::size_t k = 0; k < at.size(); ++k) {
    Fragment& f = fragments[k];
    const double equal = 1.0 / static_cast<double>(at.size());
    f.share = rows == corner_count ? 1.0 : least > 0.0 ? jacobian[k] / sum : equal;
    f.mass = f.share * mesh.points.mass[element * rows + (rows == corner_count ? k : 0)];
  }
}

/// Returns the velocity gradient at the centre of the element.
Matrix3 mean_gradient(const std::array<Corner, corner_count>& corners, bool flat) {
  static const ShapeFunctions center = shape_functions(Vector3::Zero());
  Matrix3 x = Matrix3::Zero(), v = Matrix3::Zero();  // derivatives with respect to natural coordinates
  for (std::size_t a = 0; a < corner_count; ++a) {
    x += corners[a].position * center.derivative[a].transpose();
    v += corners[a].velocity * center.derivative[a].transpose();
  }
  if (flat) x(2, 2) = 1.0;
  return v * x.inverse();
}

/// Computes the velocities (3.2) to (3.6).
Conversion convert(const fem::Mesh& mesh, std::size_t element, double affine_inertia, const AtParticles& at) {
  const std::array<Corner, corner_count> corners = corners_of(mesh, element);
  Conversion out;
  place_fragments(mesh, element, corners, at, out.fragment);
  double mass = 0.0;
  Vector3 momentum = Vector3::Zero(), moment = Vector3::Zero();
  for (const Corner& c : corners) {
    mass += c.mass;
    momentum += c.mass * c.velocity;
    moment += c.mass * c.position;
  }
  const Vector3 center = moment / mass, mean = momentum / mass;
  double available = 0.0;  // kinetic energy of the corners about the centre
  for (const Corner& c : corners) {
    available +=
        0.5 * c.mass * ((c.velocity - mean).squaredNorm() + affine_inertia * c.affine_velocity.squaredNorm());
  }
  Vector3 drift = Vector3::Zero(), offset = Vector3::Zero();
  for (std::size_t k = 0; k < at.size(); ++k) {
    Fragment& f = out.fragment[k];
    f.velocity.setZero();
    for (std::size_t a = 0; a < corner_count; ++a) {
      f.velocity += at[k].value[a] * (corners[a].velocity - mean);
    }
    drift += f.mass * f.velocity;
    offset += f.mass * (f.position - center);
  }
  drift /= mass;
  offset /= mass;
  double relative = 0.0;  // kinetic energy of the fragments
  for (Fragment& f : out.fragment) {
    f.velocity -= drift;
    f.position -= offset;
    relative += 0.5 * f.mass * f.velocity.squaredNorm();
  }
  const double factor = relative > available ? std::sqrt(available / relative) : 1.0;
  Matrix3 missing = Matrix3::Zero();  // moment of the velocities not carried by the fragments
  for (const Corner& c : corners) {
    missing += c.mass *
               ((c.velocity - mean) * (c.position - center).transpose() + affine_inertia * c.affine_velocity);
  }
  for (Fragment& f : out.fragment) {
    f.velocity *= factor;
    missing -= f.mass * f.velocity * (f.position - center).transpose();
    f.velocity += mean;
  }
  const double left = std::max(available - factor * factor * relative, 0.0);
  double affine_energy = 0.0;
  if (affine_inertia > 0.0) {
    out.affine_velocity = missing / (mass * affine_inertia);
    const double limit = mean_gradient(corners, fem::is_flat(mesh.quadrature)).norm();
    const double wanted = out.affine_velocity.norm();
    if (wanted > limit) out.affine_velocity *= limit / wanted;
    affine_energy = 0.5 * mass * affine_inertia * out.affine_velocity.squaredNorm();
    if (affine_energy > left) {
      out.affine_velocity *= std::sqrt(left / affine_energy);
      affine_energy = left;
    }
  }
  out.heat = left - affine_energy;
  return out;
}

/// Writes the rows of the particles from `first` on, from the Gauss points of an element.
void write_particles(const fem::Mesh& mesh, std::size_t element, const Conversion& conversion,
                     std::size_t first, Particles& particles) {
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  const MaterialPoints& material_points = mesh.points;
  const double heat = (conversion.heat + mesh.elements.hourglass_energy[element]) / fem::mass(mesh, element);
  for (std::size_t k = 0; k < conversion.fragment.size(); ++k) {
    const std::size_t p = first + k, row = element * rows + (rows == corner_count ? k : 0);
    for_each_field(material_points, [&](const auto& field) {
      const auto& from = field.of(material_points);
      if (!from.empty()) field.of(particles)[p] = from[row];
    });
    if (!particles.heating_viscosity.empty()) {  // the viscosity of elements heats entirely
      particles.heating_viscosity[p] = particles.artificial_viscosity[p];
    }
    const Fragment& f = conversion.fragment[k];
    particles.mass[p] = f.mass;
    particles.volume[p] *= f.share;
    particles.void_volume[p] *= f.share;
    particles.specific_internal_energy[p] += heat;
    particles.id[p] = corner_count * mesh.elements.id[element] + k;
    particles.body[p] = mesh.body;
    particles.position[p] = f.position;
    particles.velocity[p] = f.velocity;
    particles.affine_velocity[p] = conversion.affine_velocity;
    particles.extent[p] = f.extent;
    particles.generation[p] = 0;
  }
}

}  // namespace

std::vector<std::uint8_t> distorted_elements(const fem::Mesh& mesh, const Thresholds& thresholds,
                                             const fem::ViscosityCoefficients& viscosity,
                                             double grid_time_step) {
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  std::vector<std::uint8_t> distorted(mesh.elements.size(), 0);
  parallel::for_each(distorted.size(), [&](std::size_t e) {
    bool passes = false;
    for (std::size_t row = e * rows; row < (e + 1) * rows; ++row) {
      passes = passes || mesh.points.plastic_strain[row] > thresholds.plastic_strain ||
               (thresholds.failed && mesh.points.failed[row] != 0);
    }
    if (!passes && thresholds.jacobian > 0.0) passes = fem::scaled_jacobian(mesh, e) < thresholds.jacobian;
    if (!passes && thresholds.time_step_ratio > 0.0 && std::isfinite(grid_time_step)) {
      passes = fem::critical_time_step(mesh, e, viscosity) < thresholds.time_step_ratio * grid_time_step;
    }
    distorted[e] = passes ? 1 : 0;
  });
  return distorted;
}

std::vector<RangeFault> range_faults(const fem::Mesh& mesh, const ElementRange& range,
                                     const fem::ViscosityCoefficients& viscosity, double grid_time_step) {
  const std::size_t rows = fem::points_per_element(mesh.quadrature);
  const bool asks_time_step = range.time_step_ratio > 0.0 && std::isfinite(grid_time_step);
  const auto fault_of = [&](std::size_t e) {
    if (fem::scaled_jacobian(mesh, e) < range.jacobian) return RangeFault::jacobian;
    if (asks_time_step &&
        fem::critical_time_step(mesh, e, viscosity) < range.time_step_ratio * grid_time_step) {
      return RangeFault::time_step;
    }
    if (std::isfinite(range.hourglass_share)) {
      double internal = 0.0;
      for (std::size_t row = e * rows; row < (e + 1) * rows; ++row) {
        internal += mesh.points.mass[row] * mesh.points.specific_internal_energy[row];
      }
      if (mesh.elements.hourglass_energy[e] > range.hourglass_share * std::abs(internal)) {
        return RangeFault::hourglass;
      }
    }
    const auto is_too_fast = [&](std::uint32_t a) { return mesh.nodes.velocity[a].norm() > range.speed; };
    if (std::ranges::any_of(mesh.elements.corners[e], is_too_fast)) return RangeFault::speed;
    for (std::size_t row = e * rows; row < (e + 1) * rows; ++row) {
      if (mesh.points.plastic_strain[row] > range.plastic_strain) return RangeFault::plastic_strain;
      if (range.failed && mesh.points.failed[row] != 0) return RangeFault::failed;
    }
    return RangeFault::none;
  };
  std::vector<RangeFault> faults(mesh.elements.size());
  parallel::for_each(faults.size(), [&](std::size_t e) { faults[e] = fault_of(e); });
  return faults;
}

ConversionBalance convert_elements(fem::Mesh& mesh, std::span<const std::uint8_t> chosen,
                                   double affine_inertia, Particles& particles, Arrangement arrangement) {
  ConversionBalance balance;
  std::vector<std::size_t> list;
  for (std::size_t e = 0; e < chosen.size(); ++e) {
    if (chosen[e] != 0) list.push_back(e);
  }
  balance.elements = list.size();
  if (list.empty()) return balance;
  const std::size_t before = particles.size();
  const std::size_t parts = fem::particles_per_element(mesh.quadrature);
  resize(particles, before + parts * list.size());
  const MaterialPoints& material_points = mesh.points;
  for_each_field(material_points, [&](const auto& field) {  // optional fields not yet needed by any particle
    if (!field.of(material_points).empty()) field.resize(particles, particles.size());
  });
  particles.affine_velocity.resize(particles.size());
  particles.extent.resize(particles.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::size_t e = list[i];
    const Conversion conversion =
        convert(mesh, e, affine_inertia, at_particles(arrangement, fem::is_flat(mesh.quadrature)));
    write_particles(mesh, e, conversion, before + parts * i, particles);
    balance.mass += fem::mass(mesh, e);
    balance.kinetic_heat += conversion.heat;
    balance.hourglass_energy += mesh.elements.hourglass_energy[e];
    for (const std::uint32_t node : mesh.elements.corners[e]) mesh.nodes.on_surface[node] = 1;
  }
  fem::remove_elements(mesh, chosen);
  return balance;
}

}  // namespace whipple::afemp
