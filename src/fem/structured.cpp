// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/structured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <unordered_map>

#include "src/core/base/error.hpp"

namespace whipple::fem {
namespace {

using Counts = std::array<std::size_t, 3>;
/// Maps the unit cube to space.
using Map = std::function<Vector3(double, double, double)>;

void require_positive(const char* body, const char* what, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InputError(fmt::format("mesh of a {}: {} must be positive, not {:.6g} m", body, what, value));
  }
}

std::size_t divisions(double length, double size) {
  return static_cast<std::size_t>(std::max(1.0, std::round(length / size)));
}

/// Exchanges the two faces of each element along xi, eta or zeta, as required for a mirror image. If this is the
/// direction reversed by the mirror, rows of elements continue across it.
void turn_round(Hexahedra& mesh, std::size_t direction) {
  constexpr std::array<std::array<std::size_t, 8>, 3> exchanged = {
      {{1, 0, 3, 2, 5, 4, 7, 6}, {3, 2, 1, 0, 7, 6, 5, 4}, {4, 5, 6, 7, 0, 1, 2, 3}}};
  for (Corners& corners : mesh.elements) {
    const Corners before = corners;
    for (std::size_t a = 0; a < 8; ++a) corners[a] = before[exchanged[direction][a]];
  }
}

/// Appends a block of elements. The map must preserve the orientation.
void add_block(Hexahedra& mesh, const Counts& n, const Map& map) {
  const std::size_t first = mesh.nodes.size();
  for (std::size_t k = 0; k <= n[2]; ++k) {
    for (std::size_t j = 0; j <= n[1]; ++j) {
      for (std::size_t i = 0; i <= n[0]; ++i) {
        const auto part = [](std::size_t m, std::size_t of) {
          return static_cast<double>(m) / static_cast<double>(of);
        };
        mesh.nodes.push_back(map(part(i, n[0]), part(j, n[1]), part(k, n[2])));
      }
    }
  }
  const auto node = [&](std::size_t i, std::size_t j, std::size_t k) {
    return static_cast<std::uint32_t>(first + i + (n[0] + 1) * (j + (n[1] + 1) * k));
  };
  for (std::size_t k = 0; k < n[2]; ++k) {
    for (std::size_t j = 0; j < n[1]; ++j) {
      for (std::size_t i = 0; i < n[0]; ++i) {
        mesh.elements.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                 node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                 node(i, j + 1, k + 1)});
      }
    }
  }
}

/// Adds the mirror images of the part at positive coordinates, then merges the parts.
void complete(Hexahedra& mesh, std::size_t axes, const Halved& halved, double size) {
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (halved[axis]) continue;
    Hexahedra image = mesh;
    for (Vector3& x : image.nodes) x[static_cast<int>(axis)] *= -1.0;
    turn_round(image, axis);
    const auto offset = static_cast<std::uint32_t>(mesh.nodes.size());
    mesh.nodes.insert(mesh.nodes.end(), image.nodes.begin(), image.nodes.end());
    for (Corners& corners : image.elements) {
      for (std::uint32_t& node : corners) node += offset;
      mesh.elements.push_back(corners);
    }
  }
  merge_nodes(mesh, 1e-6 * size);
}

// Fractions of the radius: half-diagonal of the core, and half its width at the middle of a side.
constexpr double core_corner = 0.62, core_middle = 0.5;
constexpr double eighth_turn = 0.25 * std::numbers::pi;

/// Holds the number of elements from the axis of a round section to the edge of its core, and from there to its
/// surface.
struct Section {
  std::size_t core, ring;
  double radius;

  Section(double outer_radius, double size)
      : core(divisions(core_middle * outer_radius, size)),
        ring(divisions((1.0 - core_middle) * outer_radius, size)),
        radius(outer_radius) {}

  /// Returns a point of the square core with curved edges, with u and v from 0 on the axis to 1 at the edge.
  [[nodiscard]] Vector3 core_point(double u, double v) const {
    const double corner = core_corner * radius * std::sqrt(0.5), bulge = core_middle * radius - corner;
    return {u * (corner + bulge * (1.0 - v * v)), v * (corner + bulge * (1.0 - u * u)), 0.0};
  }
};

/// Adds a quarter of a segment of a body of revolution: a core, and two blocks between it and the surface.
/// @param core     (u, v, w), w from 0 to 1 along the axis
/// @param surface  (eighths of a turn from the x axis, w)
template <class Core, class Surface>
void add_butterfly(Hexahedra& mesh, const Section& section, std::size_t axial, const Core& core,
                   const Surface& surface) {
  const auto between = [](const Vector3& inner, const Vector3& outer, double share) {
    return Vector3(inner + share * (outer - inner));
  };
  add_block(mesh, {section.core, section.core, axial}, core);
  add_block(mesh, {section.ring, section.core, axial},
            [&](double share, double v, double w) { return between(core(1.0, v, w), surface(v, w), share); });
  add_block(mesh, {section.core, section.ring, axial}, [&](double u, double share, double w) {
    return between(core(u, 1.0, w), surface(2.0 - u, w), share);
  });
}

Vector3 on_circle(double radius, double eighths, double z) {
  return {radius * std::cos(eighths * eighth_turn), radius * std::sin(eighths * eighth_turn), z};
}

/// Adds a quarter of a cylinder, from z = 0 to `length`.
void add_cylinder(Hexahedra& mesh, const Section& section, double length, double size) {
  add_butterfly(
      mesh, section, divisions(length, size),
      [&](double u, double v, double w) {
        return Vector3(section.core_point(u, v) + Vector3(0.0, 0.0, w * length));
      },
      [&](double eighths, double w) { return on_circle(section.radius, eighths, w * length); });
}

/// Moves the nodes away from the z axis, so that polygonal sections with `around` edges per quarter have the area of
/// the circles: mass and bending stiffness of bodies then do not depend on the element size.
void widen_to_circles(Hexahedra& mesh, std::size_t around) {
  const double angle = 2.0 * eighth_turn / static_cast<double>(around);
  const double factor = std::sqrt(angle / std::sin(angle));
  for (Vector3& x : mesh.nodes) x.head<2>() *= factor;
}

}  // namespace

void transform(Hexahedra& hexahedra, const Matrix3& rotation, const Vector3& translation) {
  for (Vector3& x : hexahedra.nodes) x = rotation * x + translation;
  if (rotation.determinant() < 0.0) turn_round(hexahedra, 2);
}

void merge_nodes(Hexahedra& hexahedra, double tolerance) {
  // Nodes are indexed by cells of four tolerances; nodes near a point are in one of the up to 8 cells that its box of
  // +- one tolerance overlaps.
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      std::size_t h = 0;
      for (const std::int64_t i : c) h = h * 0x9e3779b97f4a7c15ULL + static_cast<std::size_t>(i);
      return h ^ (h >> 29U);
    }
  };
  const double width = 4.0 * tolerance;
  const auto cell = [&](const Vector3& x) {
    Cell c;
    for (std::size_t i = 0; i < 3; ++i)
      c[i] = static_cast<std::int64_t>(std::floor(x[static_cast<int>(i)] / width));
    return c;
  };
  std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> nodes_of;
  std::vector<Vector3> kept;
  std::vector<std::uint32_t> renumbered(hexahedra.nodes.size());
  for (std::size_t a = 0; a < hexahedra.nodes.size(); ++a) {
    const Vector3& x = hexahedra.nodes[a];
    auto found = static_cast<std::uint32_t>(kept.size());
    for (unsigned k = 0; k < 8 && found == kept.size(); ++k) {
      const auto side = [&](unsigned bit) { return (k >> bit & 1U) != 0 ? tolerance : -tolerance; };
      const auto near = nodes_of.find(cell(x + Vector3(side(0), side(1), side(2))));
      if (near == nodes_of.end()) continue;
      for (const std::uint32_t b : near->second) {
        if ((kept[b] - x).norm() <= tolerance) found = b;
      }
    }
    if (found == kept.size()) {
      nodes_of[cell(x)].push_back(found);
      kept.push_back(x);
    }
    renumbered[a] = found;
  }
  hexahedra.nodes = std::move(kept);
  for (Corners& corners : hexahedra.elements) {
    for (std::uint32_t& node : corners) node = renumbered[node];
  }
}

double coincidence(const Hexahedra& hexahedra) {
  return 1e-5 * std::cbrt(volume(hexahedra) / static_cast<double>(hexahedra.elements.size()));
}

std::size_t unmerged_nodes(const Hexahedra& hexahedra) {
  Hexahedra merged = hexahedra;
  merge_nodes(merged, coincidence(hexahedra));
  return hexahedra.nodes.size() - merged.nodes.size();
}

Hexahedra make_box(const Vector3& lower, const Vector3& upper, const Counts& counts) {
  for (int i = 0; i < 3; ++i) require_positive("box", "each edge", upper[i] - lower[i]);
  if (std::ranges::count(counts, 0U) > 0)
    throw InputError("mesh of a box: each edge needs at least one element");
  Hexahedra mesh;
  add_block(mesh, counts, [&](double u, double v, double w) {
    return Vector3(lower + (upper - lower).cwiseProduct(Vector3(u, v, w)));
  });
  return mesh;
}

Hexahedra make_box(const Vector3& lower, const Vector3& upper, double size) {
  require_positive("box", "the size of an element", size);
  Counts counts;
  for (int i = 0; i < 3; ++i) {
    require_positive("box", "each edge", upper[i] - lower[i]);
    counts[static_cast<std::size_t>(i)] = divisions(upper[i] - lower[i], size);
  }
  return make_box(lower, upper, counts);
}

Hexahedra make_cylinder(double radius, double length, double size, const Halved& halved) {
  require_positive("cylinder", "the radius", radius);
  require_positive("cylinder", "the length", length);
  require_positive("cylinder", "the size of an element", size);
  const Section section(radius, size);
  Hexahedra mesh;  // a quarter
  add_cylinder(mesh, section, length, size);
  widen_to_circles(mesh, 2 * section.core);
  complete(mesh, 2, halved, size);
  return mesh;
}

Hexahedra make_ogive(double radius, double nose, double shank, double size, const Halved& halved) {
  require_positive("ogive", "the radius", radius);
  require_positive("ogive", "the length of the nose", nose);
  require_positive("ogive", "the size of an element", size);
  const Section section(radius, size);
  const double arc = (radius * radius + nose * nose) / (2.0 * radius), depth = arc - radius;
  const auto radius_at = [=](double z) { return std::sqrt(arc * arc - z * z) - depth; };
  const auto height_at = [=](double r) { return std::sqrt(arc * arc - (r + depth) * (r + depth)); };

  // A cap closes the tip, like one face of the cube for a sphere. Its edge has a larger radius at its corner, where
  // three blocks meet; the core ends below the edge. Values were selected for the best elements (scaled Jacobian).
  constexpr double edge_share = 0.55, corner_share = 1.06 * edge_share, slope = 1.1;
  const auto edge_radius = [=](double eighths) {
    const double v = std::min(eighths, 2.0 - eighths);
    return radius * (edge_share + (corner_share - edge_share) * v * v);
  };
  const double edge = height_at(radius * edge_share);
  const double core_end = edge - slope * radius * edge_share * (1.0 - core_middle);
  const auto core_point = [&](double u, double v, double w) {
    return Vector3(section.core_point(u, v) * (radius_at(w * edge) / radius) +
                   Vector3(0.0, 0.0, shank + w * core_end));
  };
  const auto edge_point = [&](double eighths) {
    return on_circle(edge_radius(eighths), eighths, shank + height_at(edge_radius(eighths)));
  };

  Hexahedra mesh;  // a quarter
  if (shank > 0.0) add_cylinder(mesh, section, shank, size);
  add_butterfly(mesh, section, divisions(edge, size), core_point, [&](double eighths, double w) {
    const double z = w * height_at(edge_radius(eighths));
    return on_circle(radius_at(z), eighths, shank + z);
  });
  add_block(mesh, {section.core, section.core, section.ring}, [&](double u, double v, double share) {
    // Coons patch between the symmetry planes and the edge, at its height on the ogive
    Vector3 outer = u * edge_point(v) + v * edge_point(2.0 - u) - u * v * edge_point(1.0);
    outer[2] = shank + height_at(outer.head<2>().norm());
    const Vector3 inner = core_point(u, v, 1.0);
    return Vector3(inner + share * (outer - inner));
  });
  widen_to_circles(mesh, 2 * section.core);
  complete(mesh, 2, halved, size);
  return mesh;
}

Hexahedra make_tube(double inner_radius, double outer_radius, double length, double size,
                    const Halved& halved) {
  require_positive("tube", "the inner radius", inner_radius);
  require_positive("tube", "the outer radius less the inner one", outer_radius - inner_radius);
  require_positive("tube", "the length", length);
  require_positive("tube", "the size of an element", size);
  const std::size_t radial = divisions(outer_radius - inner_radius, size);
  const std::size_t around = std::max<std::size_t>(2, divisions(2.0 * eighth_turn * outer_radius, size));
  Hexahedra mesh;
  add_block(mesh, {radial, around, divisions(length, size)}, [&](double u, double v, double w) {
    return on_circle(inner_radius + u * (outer_radius - inner_radius), 2.0 * v, w * length);
  });
  widen_to_circles(mesh, around);
  complete(mesh, 2, halved, size);
  return mesh;
}

Hexahedra make_sphere(double radius, double size, const Halved& halved) {
  require_positive("sphere", "the radius", radius);
  require_positive("sphere", "the size of an element", size);
  const std::size_t core = divisions(core_middle * radius, size);
  const std::size_t layer = divisions((1.0 - core_middle) * radius, size);
  const double corner = core_corner * radius / std::sqrt(3.0), bulge = core_middle * radius - corner;
  const auto core_point = [=](double u, double v, double w) {
    const auto along = [=](double x, double y, double z) {
      return x * (corner + bulge * (1.0 - 0.5 * (y * y + z * z)));
    };
    return Vector3(along(u, v, w), along(v, w, u), along(w, u, v));
  };
  Hexahedra mesh;  // an octant
  add_block(mesh, {core, core, core}, core_point);
  // Towards x; the other two by permuting the axes.
  const Map towards_x = [&](double share, double v, double w) {
    const Vector3 inner = core_point(1.0, v, w);
    const Vector3 outer =
        radius * Vector3(1.0, std::tan(v * eighth_turn), std::tan(w * eighth_turn)).normalized();
    return Vector3(inner + share * (outer - inner));
  };
  add_block(mesh, {layer, core, core}, towards_x);
  add_block(mesh, {layer, core, core}, [&](double share, double v, double w) {
    const Vector3 x = towards_x(share, v, w);
    return Vector3(x[2], x[0], x[1]);
  });
  add_block(mesh, {layer, core, core}, [&](double share, double v, double w) {
    const Vector3 x = towards_x(share, v, w);
    return Vector3(x[1], x[2], x[0]);
  });
  const double factor = std::cbrt(std::numbers::pi / 6.0 * radius * radius * radius / volume(mesh));
  for (Vector3& x : mesh.nodes) x *= factor;
  complete(mesh, 3, halved, size);
  return mesh;
}

Hexahedra section_of(const Hexahedra& hexahedra, double tolerance) {
  // Faces clockwise about their outward normal, which is -z here: counter-clockwise seen from z > 0.
  constexpr std::array<std::array<std::size_t, 4>, 6> inward = {
      {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  Hexahedra section;
  std::vector<std::uint32_t> number(hexahedra.nodes.size(), unused);
  const auto in_plane = [&](std::uint32_t a) { return std::abs(hexahedra.nodes[a][2]) <= tolerance; };
  for (const Corners& corners : hexahedra.elements) {
    const auto above = [&](std::uint32_t a) { return hexahedra.nodes[a][2] > tolerance; };
    if (!std::ranges::any_of(corners, above)) continue;
    for (const std::array<std::size_t, 4>& face : inward) {
      if (!std::ranges::all_of(face, [&](std::size_t k) { return in_plane(corners[k]); })) continue;
      Corners& added = section.elements.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t a = corners[face[k]];
        if (number[a] == unused) {
          number[a] = static_cast<std::uint32_t>(section.nodes.size());
          section.nodes.emplace_back(hexahedra.nodes[a][0], hexahedra.nodes[a][1], 0.0);
        }
        added[k] = added[k + 4] = number[a];
      }
    }
  }
  return section;
}

}  // namespace whipple::fem
