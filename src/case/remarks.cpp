// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "eos/audit.hpp"
#include "src/case/build/lithostatic.hpp"
#include "src/case/build/placement.hpp"
#include "src/fem/structured.hpp"
#include "src/material/fluid.hpp"

namespace whipple::cases {
namespace {

constexpr std::array<const char*, 6> face_names = {"x_lower", "x_upper", "y_lower",
                                                   "y_upper", "z_lower", "z_upper"};

/// Returns the gap along each axis, 0 where the boxes overlap; m.
Vector3 gap(const Shape::Bounds& a, const Shape::Bounds& b) {
  return (b.lower - a.upper).cwiseMax(a.lower - b.upper).cwiseMax(Vector3::Zero());
}

/// Returns whether a box that moves with a velocity (m/s) reaches another one before the end (s).
bool meet(const Shape::Bounds& a, const Shape::Bounds& b, const Vector3& velocity, double end) {
  double first = 0.0, last = end;
  for (int axis = 0; axis < 3; ++axis) {
    const double near = b.lower[axis] - a.upper[axis], far = b.upper[axis] - a.lower[axis];
    if (velocity[axis] == 0.0) {
      if (near > 0.0 || far < 0.0) return false;
      continue;
    }
    first = std::max(first, std::min(near / velocity[axis], far / velocity[axis]));
    last = std::min(last, std::max(near / velocity[axis], far / velocity[axis]));
  }
  return first <= last;
}

/// Remarks on bodies whose boxes overlap in two directions and have a narrow gap in the third.
void remark_on_gaps(const Case& setup, std::vector<std::string>& remarks) {
  constexpr double round_off = 1e-6;  // cells
  const double h = setup.domain.cell_size;
  for (std::size_t a = 0; a < setup.bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < setup.bodies.size(); ++b) {
      const Vector3 apart = gap(setup.bodies[a].shape->bounds(), setup.bodies[b].shape->bounds());
      if (!(apart.norm() > round_off * h && apart.norm() < h)) continue;
      remarks.push_back(fmt::format(
          "between '{}' and '{}' is a gap of {:.4g} mm, less than a cell of {:.4g} mm: it closes as a gap "
          "does, but what happens in it is not resolved",
          setup.bodies[a].name, setup.bodies[b].name, 1e3 * apart.norm(), 1e3 * h));
    }
  }
}

/// Returns whether a body flies towards a wall or a mirror plane, which may be its intended target.
bool flies_at_a_face(const Case& setup, const Body& body) {
  constexpr double none = 1e-9;
  for (std::size_t face = 0; face < setup.geometry.boundary.size(); ++face) {
    if (setup.geometry.boundary[face] == grid::Boundary::outflow) continue;
    const double towards = (face % 2 == 0 ? -1.0 : 1.0) * body.velocity[static_cast<int>(face / 2)];
    if (towards > none * body.velocity.norm()) return true;
  }
  return false;
}

void remark_on_directions(const Case& setup, std::vector<std::string>& remarks) {
  if (setup.bodies.size() < 2 || !setup.gravity.acceleration.isZero(0.0)) return;
  for (const Body& a : setup.bodies) {
    if (a.velocity.isZero(0.0) || flies_at_a_face(setup, a)) continue;
    const auto meets = [&](const Body& b) {
      return &b != &a && meet(a.shape->bounds(), b.shape->bounds(), a.velocity - b.velocity, setup.time.end);
    };
    if (std::ranges::any_of(setup.bodies, meets)) continue;
    remarks.push_back(
        fmt::format("'{}' meets no other body until t = {:.4g} us: does it fly the right way, and long "
                    "enough?",
                    a.name, 1e6 * setup.time.end));
  }
}

/// Remarks on impacts beyond the audited shocks. In impacts of identical materials, the particle velocity behind the
/// shock is half the impact speed.
void remark_on_speeds(const Case& setup, std::vector<std::string>& remarks) {
  double fastest = 0.0;
  for (const Body& a : setup.bodies) {
    for (const Body& b : setup.bodies) fastest = std::max(fastest, (a.velocity - b.velocity).norm());
  }
  std::set<std::string> seen;
  for (const auto& material : setup.materials) {
    if (fastest == 0.0 || !seen.insert(material->name).second) continue;
    const double limit =
        eos::audit(*material->eos, eos::AuditDepth::brief).range.strongest_shock.particle_velocity;
    if (!(limit > 0.0) || 0.5 * fastest <= limit) continue;
    remarks.push_back(
        fmt::format("bodies meet at {:.4g} km/s; '{}' is audited for shocks with up to {:.4g} km/s behind "
                    "the front (whipple eos audit)",
                    1e-3 * fastest, material->name, 1e-3 * limit));
  }
}

void remark_on_burn(const Case& setup, std::size_t b, std::vector<std::string>& remarks) {
  constexpr double much = 0.01;
  const std::string& name = setup.bodies[b].name;
  const Material& material = *setup.materials[b];
  const double ideal = material.explosive->detonation_velocity;
  const double given = material.burning_explosive().detonation_velocity;
  if (material.explosive->estimated) {
    remarks.push_back(
        fmt::format("'{}': material '{}' has no [eos.unreacted]; until it burns it is a solid of sound speed "
                    "0.35 D = {:.4g} km/s",
                    name, material.name, 0.35e-3 * ideal));
  }
  if (std::abs(given / ideal - 1.0) > much) {
    remarks.push_back(fmt::format(
        "'{}' is lit at {:.4g} km/s, and its products detonate with {:.4g} km/s: {}", name, 1e-3 * given,
        1e-3 * ideal,
        given > ideal ? "behind the front the pressure is too low" : "the pressure runs ahead of the front"));
  }
  if (!setup.bodies[b].velocity.isZero(0.0)) {
    remarks.push_back(fmt::format("'{}' moves: its lighting times are those of where it starts", name));
  }
}

/// Remarks on detonators: one outside of all explosive lights the surfaces of the explosive; one near a mirror plane
/// has an image that also lights.
void remark_on_detonators(const Case& setup, std::vector<std::string>& remarks) {
  if (!setup.has_burn()) return;
  constexpr double still_pushes = 1e9;  // Pa: a hundredth or more of detonation pressures
  if (setup.burn.retire_below > still_pushes) {
    remarks.push_back(
        fmt::format("burn.retire_below = {:.4g} GPa: products are removed while they still push",
                    1e-9 * setup.burn.retire_below));
  }
  for (std::size_t d = 0; d < setup.detonations.size(); ++d) {
    const Detonation& detonation = setup.detonations[d];
    const Vector3& at = detonation.position;
    if (detonation.delay >= setup.time.end) {
      remarks.push_back(
          fmt::format("detonation {} starts at {:.4g} us, after the end of the run: it lights nothing", d + 1,
                      1e6 * detonation.delay));
    }
    const auto holds = [&](std::size_t b) {
      return setup.materials[b]->burns() && setup.holds(setup.bodies[b], at);
    };
    const bool is_place = detonation.shape != DetonatorShape::plane;
    bool inside = false;
    for (std::size_t b = 0; b < setup.bodies.size(); ++b) inside = inside || holds(b);
    const auto is_near = [&](const Body& body) {
      const Shape::Bounds bounds = body.shape->bounds();
      return (bounds.lower - at).maxCoeff() <= setup.geometry.cell_size &&
             (at - bounds.upper).maxCoeff() <= setup.geometry.cell_size;
    };
    bool near = inside;
    for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
      near = near || (setup.materials[b]->burns() && is_near(setup.bodies[b]));
    }
    if (is_place && !near) {
      remarks.push_back(fmt::format(
          "detonation {} is outside of all explosive: it lights what it sees of their surfaces", d + 1));
    }
    for (int face = 0; face < 6 && is_place; ++face) {
      const int a = face / 2;
      if (setup.geometry.is_planar() && a == 2) continue;
      if (setup.geometry.boundary[static_cast<std::size_t>(face)] != grid::Boundary::symmetry) continue;
      const double off =
          std::abs(at[a] - (face % 2 == 0 ? setup.geometry.lower[a] : setup.geometry.upper(a)));
      constexpr double on_plane = 1e-6;  // cells
      const bool across = setup.geometry.is_axisymmetric() && a == 1;
      if (off <= on_plane * setup.geometry.cell_size || across) continue;
      if (!inside) continue;
      remarks.push_back(fmt::format(
          "detonation {} lies {:.4g} mm from the symmetry plane {}: so does its image, which lights "
          "the other half",
          d + 1, 1e3 * off, face_names[static_cast<std::size_t>(face)]));
    }
  }
}

/// Remarks on detonation products: a gas that starts at the pressure of a constant-volume burn.
void remark_on_explosives(const Case& setup, std::vector<std::string>& remarks) {
  constexpr double much = 0.1e9;  // Pa
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material& material = *setup.materials[b];
    if (material.burns()) {
      remark_on_burn(setup, b, remarks);
      continue;
    }
    if (material.eos->condensed() || material.reference.pressure < much) continue;
    remarks.push_back(
        fmt::format("'{}' starts burnt, as the gas of '{}' at {:.4g} GPa all over: no detonation runs "
                    "through it{}",
                    setup.bodies[b].name, material.name, 1e-9 * material.reference.pressure,
                    setup.bodies[b].velocity.isZero(0.0) ? "" : ", and no projectile is like that"));
  }
}

/// Remarks on expanding gas without particle splitting: its particles separate numerically, and its heat is lost to
/// unresolved motion.
void remark_on_splitting(const Case& setup, std::vector<std::string>& remarks) {
  if (setup.splitting.length > 0.0) return;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material& material = *setup.materials[b];
    if (fluidity(material) != Fluidity::always && !material.burns()) continue;
    remarks.push_back(
        fmt::format("'{}' is gas or becomes it, and splitting is off: where it expands freely, its "
                    "particles part and its heat is lost to unresolved motion",
                    setup.bodies[b].name));
  }
}

/// Remarks on a body at a symmetry plane. A body cut by the plane is continuous with its mirror image: it cannot move
/// along the normal, nor rotate about an axis in the plane. A body that only touches the plane may move into it: it
/// then meets its image.
void remark_on_plane(const Case& setup, const Body& body, std::size_t face,
                     std::vector<std::string>& remarks) {
  const grid::Geometry& g = setup.geometry;
  const auto a = static_cast<int>(face / 2);
  const bool lower = face % 2 == 0;
  const Shape::Bounds bounds = body.shape->bounds();
  const bool cut = lower ? bounds.lower[a] < g.lower[a] - 0.05 * g.cell_size
                         : bounds.upper[a] > g.upper(a) + 0.05 * g.cell_size;
  double normal = body.velocity[a];
  const bool expands = body.expansion_rate[a] != 0.0;
  if (expands) {
    const double plane = lower ? g.lower[a] : g.upper(a);
    normal += body.expansion_rate[a] * (plane - 0.5 * (bounds.lower[a] + bounds.upper[a]));
  }
  const bool away = lower ? normal > 0.0 : normal < 0.0;
  constexpr double none = 1e-9;
  const double least = expands ? 1e-3 : none;  // a rate with few digits leaves a residual velocity
  if (std::abs(normal) > least * body.velocity.norm() && (cut || away)) {
    remarks.push_back(fmt::format(
        "'{}' {} the symmetry plane {} and moves along its normal, at {:.6g} m/s {}: its mirror image "
        "moves the other way; set {} of its velocity to 0, or take the whole body",
        body.name, cut ? "is cut by" : "touches", face_names[face], std::abs(normal),
        away ? "off the plane" : "through it", "xyz"[a]));
  }
  Vector3 across = body.angular_velocity;
  across[a] = 0.0;
  if (across.norm() > none * body.angular_velocity.norm()) {
    remarks.push_back(fmt::format(
        "'{}' {} the symmetry plane {} and rotates about an axis that is not the plane's normal {}: its "
        "mirror image turns the other way; take the whole body",
        body.name, cut ? "is cut by" : "touches", face_names[face], "xyz"[a]));
  }
}

void remark_on_symmetry(const Case& setup, std::vector<std::string>& remarks) {
  const std::vector<std::uint8_t> touched = faces_touched(setup);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    for (std::size_t face = 0; face < face_names.size(); ++face) {
      const bool mirror = setup.geometry.boundary[face] == grid::Boundary::symmetry;
      if (mirror && (touched[b] >> face & 1U) != 0) remark_on_plane(setup, setup.bodies[b], face, remarks);
    }
  }
}

/// Remarks on small grains: the fragment size approaches the grain size from ten cells per grain on
/// (docs/theory/cracks.md, 3).
void remark_on_grains(const Case& setup, std::vector<std::string>& remarks) {
  constexpr double least = 10.0;
  for (const Body& body : setup.bodies) {
    const double cells = body.failure_grains.size / setup.geometry.cell_size;
    if (!body.failure_grains.given() || cells >= least) continue;
    remarks.push_back(
        fmt::format("'{}': its failure_grains are {:.3g} cells wide, resolved are those of {} and more",
                    body.name, cells, least));
  }
}

/// Remarks on a friction of cracks in a case whose bodies do not part at cracks.
void remark_on_crack_friction(const Case& setup, std::vector<std::string>& remarks) {
  const bool cracks = std::ranges::any_of(
      setup.bodies, [](const Body& body) { return body.failure.cracks == CrackMotion::fields; });
  if (cracks || setup.contact.crack_friction == ContactControl{}.crack_friction) return;
  remarks.emplace_back(
      "contact.crack_friction has no effect: no body has failure.cracks = \"fields\", which parts it at "
      "cracks");
}

void remark_on_meshes(const Case& setup, std::vector<std::string>& remarks) {
  for (const Body& body : setup.bodies) {
    if (body.discretization.mesh.empty()) continue;
    const Shape::Bounds bounds = body.shape->bounds();
    if (const double size = (bounds.upper - bounds.lower).maxCoeff(); size < setup.geometry.cell_size) {
      remarks.push_back(
          fmt::format("the mesh of '{}' is {:.3g} mm long, less than a cell: is 'mesh_unit' right?",
                      body.name, 1e3 * size));
    }
    const auto mesh = body.shape->hexahedra(setup.geometry.cell_size, body.shape->bounds());
    const std::size_t nodes = mesh ? fem::unmerged_nodes(*mesh) : 0;
    if (nodes == 0) continue;
    remarks.push_back(
        fmt::format("'{}': {} nodes of its mesh {} coincide with another node: parts that meet "
                    "there are not joined; Gmsh joins them with 'Coherence Mesh;'",
                    body.name, nodes, body.discretization.mesh));
  }
}

}  // namespace

std::vector<std::string> remarks(const Case& setup) {
  std::vector<std::string> found;
  remark_on_gaps(setup, found);
  remark_on_directions(setup, found);
  remark_on_speeds(setup, found);
  remark_on_explosives(setup, found);
  remark_on_splitting(setup, found);
  remark_on_detonators(setup, found);
  remark_on_symmetry(setup, found);
  remark_on_grains(setup, found);
  remark_on_crack_friction(setup, found);
  remark_on_meshes(setup, found);
  std::ranges::move(lithostatic_warnings(setup), std::back_inserter(found));
  return found;
}

}  // namespace whipple::cases
